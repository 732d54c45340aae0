#!/usr/bin/env python3
"""paper_table.py TOOL [SEEDS]   the paper's tables 1 and 3 beside this tool's own numbers, as Markdown.

"Hooke's Optimization for 3D triangular mesh": its meshes are not published, so they are made again after its
recipes (artificial_meshes.py; needs numpy and scipy). Ours are medians over SEEDS meshes (default 10) of a family.
"""

import statistics
import sys
import tempfile
from pathlib import Path

import artificial_meshes
from run_tool import run_tool

# Tables 1 and 3: minimum angle before and after (rad), edge length SD before and after, maximum displacement.
# M2's SD before is printed as .4000; every recipe gives a tenth of it.
PAPER = {
    "G1": (.0018, .5336, .0347, .0076, .1652),
    "M1": (.0546, .4140, .0777, .0226, .2318),
    "M2": (.0270, .5664, .0400, .0094, .1226),
    "M3": (.0092, .2159, .0280, .0071, .1143),
    "S1": (.1265, .5423, .1129, .0509, .3229),
    "S2": (.0147, .5340, .0501, .0154, .2805),
}
MODES = {"--paper": ["--paper"], "default": []}


def columns(report):
    before, after = report["paper"]["before"], report["paper"]["after"]
    return (before["least_angle_rad"], after["least_angle_rad"], before["edge_length_sd"], after["edge_length_sd"],
            report["paper"]["greatest_displacement"], report["geometry"]["flipped_faces"],
            report["after"]["folded_edges"] - report["before"]["folded_edges"])


def measure(tool, family, seeds):
    """For each mode the columns of all seeds."""
    rows = {mode: [] for mode in MODES}
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for seed in range(1, seeds + 1):
            artificial_meshes.write(family, seed, source)
            for mode, options in MODES.items():
                rows[mode].append(columns(run_tool(tool, source, output, *options)))
    return rows


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, seeds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10
    print("| mesh | who | minimum angle before (rad) | after (rad) | edge SD before | after | maximum displacement "
          "| meshes with a flipped face or a new fold |")
    print("|---|---|---|---|---|---|---|---|")
    for family, numbers in PAPER.items():
        print("| %s | paper | %s | not stated |" % (family, " | ".join("%.4f" % x for x in numbers)))
        for mode, rows in measure(tool, family, seeds).items():
            medians = [statistics.median(column) for column in zip(*rows)]
            spoilt = sum(flipped > 0 or folds > 0 for *_, flipped, folds in rows)
            print("| | ours, %s | %s | %d of %d |"
                  % (mode, " | ".join("%.4f" % x for x in medians[:5]), spoilt, seeds), flush=True)


if __name__ == "__main__":
    main()

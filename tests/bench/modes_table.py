#!/usr/bin/env python3
"""modes_table.py TOOL [SEEDS]   what each connectivity mode and effort reaches on the paper's meshes, as Markdown.

Least angle (degrees) / variation of the edges (standard deviation over mean): medians over SEEDS meshes (default 10)
of each family, made by artificial_meshes.py (needs numpy and scipy).
"""

import statistics
import sys
import tempfile
from pathlib import Path

import artificial_meshes
from run_tool import quality, run_tool

FAMILIES = ("G1", "M1", "M2", "M3", "S1", "S2")
RUNS = {
    "fixed": [],
    "flip, fast": ["--connectivity", "flip", "--effort", "fast"],
    "flip": ["--connectivity", "flip"],
    "flip, thorough": ["--connectivity", "flip", "--effort", "thorough"],
    "adapt, fast": ["--connectivity", "adapt", "--effort", "fast"],
    "adapt": ["--connectivity", "adapt"],
    "adapt, thorough": ["--connectivity", "adapt", "--effort", "thorough"],
}


def cell(values):
    return "%.1f / %.3f" % tuple(statistics.median(column) for column in zip(*values))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, seeds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10
    print("| mesh | input | %s |\n|---|---|%s" % (" | ".join(RUNS), "---|" * len(RUNS)))
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for family in FAMILIES:
            before, after = [], {name: [] for name in RUNS}
            for seed in range(1, seeds + 1):
                artificial_meshes.write(family, seed, source)
                for name, options in RUNS.items():
                    report = run_tool(tool, source, output, *options)
                    after[name].append(quality(report["after"]))
                before.append(quality(report["before"]))
            print("| %s | %s | %s |" % (family, cell(before), " | ".join(cell(after[name]) for name in RUNS)), flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""paper_departures.py TOOL [SEEDS]   what happens where --paper does not depart from the paper's letter, as Markdown.

One departure is undone at a time, on the near-regular meshes (near_regular_meshes.py, needs numpy and scipy) of all
six families, SEEDS of each (default 3). Medians over all meshes; the edge SD and the CPU time over those of --paper.
"""

import statistics
import sys
import tempfile
from pathlib import Path

import near_regular_meshes
from paper_table import LENGTHS, PAPER
from run_tool import run_tool


def torque_of_the_file(length):
    """In file units strings are L times as weak against torques as on a mesh scaled to L = 1."""
    return ["--torque", "%r" % (1 / length)]


DEPARTURES = {
    "`--paper`": lambda length: [],
    "no altitude springs (`--altitude 0`)": lambda length: ["--altitude", "0"],
    "half their weight (`--altitude 0.5`)": lambda length: ["--altitude", "0.5"],
    "twice their weight (`--altitude 2`)": lambda length: ["--altitude", "2"],
    "filtered after Algorithm 2 only (`--filter-every outer`)": lambda length: ["--filter-every", "outer"],
    "a spline for each M_t (`--refit each`)": lambda length: ["--refit", "each"],
    "constants in the unit of the file (`--torque 1/L`)": torque_of_the_file,
    "a positive delta_bound (`--step-area 0.05`)": lambda length: ["--step-area", "0.05"],
    "all of Algorithm 1 to the letter": lambda length: ["--altitude", "0", "--filter-every", "outer", "--refit", "each"],
}


def figures(report):
    projection, n = report["projection"], report["input"]["vertices"]
    steps = sum(outer["steps"] for outer in report["paper"]["evolution"])
    failed = sum(projection[key] for key in ("no_cover", "flat_gradient", "too_far", "step_limit"))
    return {"angle": report["paper"]["after"]["least_angle_rad"], "sd": report["paper"]["after"]["edge_length_sd"],
            "folded": report["geometry"]["flipped_faces"] > 0
            or report["after"]["folded_edges"] > report["before"]["folded_edges"],
            "jammed": report["status"] == "jammed", "converged": report["status"] == "converged",
            "evaluations": projection["field_evaluations"] / (steps * n) if steps else 0, "failed": failed,
            "cpu": report["resources"]["cpu_s"]}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, seeds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3
    rows = {name: [] for name in DEPARTURES}
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for family in PAPER:
            for seed in range(1, seeds + 1):
                near_regular_meshes.write(family, seed, source)
                spec = LENGTHS.get(("near-regular", family), "auto")
                length = run_tool(tool, source, output, "--paper", "--max-outer", 1, "--max-steps", 1, "-L",
                                  spec)["parameters"]["L"]
                for name, options in DEPARTURES.items():
                    rows[name].append(figures(run_tool(tool, source, output, "--paper", "-L", spec, *options(length))))
    count = len(rows["`--paper`"])
    print("| with | least angle (rad) | edge SD | folded or flipped | jammed | converged | evaluations of psi per vertex "
          "and step | Newton failed | CPU time |")
    print("|---" * 9 + "|")
    for name, of_meshes in rows.items():
        median = lambda key: statistics.median(row[key] for row in of_meshes)
        ratio = lambda key: statistics.median(row[key] / base[key] for row, base in zip(of_meshes, rows["`--paper`"]))
        total = lambda key: sum(row[key] for row in of_meshes)
        print("| %s | %.3f | x %.2f | %d of %d | %d | %d | %.2f | %d | x %.2f |"
              % (name, median("angle"), ratio("sd"), total("folded"), count, total("jammed"), total("converged"),
                 median("evaluations"), total("failed"), ratio("cpu")))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""effort_times.py TOOL [SIZE...]   how much faster `--effort fast` is than the default, as Markdown.

File to file on irregular bumpy tori, all threads: medians of five runs each, taken in turn. Sizes default to 10000
100000 vertices. Needs numpy and scipy (artificial_meshes.py).
"""

import statistics
import sys
import tempfile
from pathlib import Path

import artificial_meshes
from run_tool import timed_run

RUNS = 5
EFFORTS = ("fast", "default")


def quality(report):
    edges = report["after"]["edge_length"]
    return "%.1f / %.3f" % (report["after"]["min_angle"]["min"], edges["std"] / edges["mean"])


def print_row(tool, size, mode, source, output):
    seconds, reports = {effort: [] for effort in EFFORTS}, {}
    for _ in range(RUNS):
        for effort in EFFORTS:
            wall, reports[effort] = timed_run(tool, source, output, "--connectivity", mode, "--effort", effort)
            seconds[effort].append(wall)
    fast, default = (statistics.median(seconds[effort]) for effort in EFFORTS)
    print("| %d | %s | %.2f | %.2f | %.1f | %s | %s |"
          % (size, mode, fast, default, default / fast, quality(reports["fast"]), quality(reports["default"])), flush=True)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, sizes = sys.argv[1], [int(s) for s in sys.argv[2:]] or [10000, 100000]
    print("| vertices | connectivity | fast, s | default, s | ratio | fast: angle / CV | default: angle / CV |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for size in sizes:
            artificial_meshes.write("torus:%d" % size, 1, source)
            for mode in ("flip", "adapt"):
                print_row(tool, size, mode, source, output)


if __name__ == "__main__":
    main()

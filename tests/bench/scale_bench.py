#!/usr/bin/env python3
"""scale_bench.py TOOL [SIZE...]   time per vertex and per stage on irregular bumpy tori, as Markdown.

File to file, default options, all threads; the run of median wall time out of three. Sizes default to 1000 10000
100000; 1000000 takes a minute or two. Stages are those of --trace. Needs numpy and scipy (artificial_meshes.py).
"""

import csv
import sys
import tempfile
from pathlib import Path

import artificial_meshes
from run_tool import timed_run

RUNS = 3


def timed(tool, source, output):
    """Wall seconds, report and trace of a run."""
    trace = output.with_suffix(".csv")
    wall, report = timed_run(tool, source, output, "--trace", trace)
    with open(trace, newline="") as lines:
        return wall, report, list(csv.DictReader(lines))


def print_stages(size, trace):
    for stage in trace:
        depth = stage["stage"].count("/")
        print("| %d | %s%s | %s | %.3f | %.3f | %.2f | %.0f |"
              % (size, "&nbsp;&nbsp;" * depth, stage["stage"].rsplit("/")[-1], stage["calls"], float(stage["wall_s"]),
                 float(stage["cpu_s"]), 1e6 * float(stage["wall_s"]) / size, int(stage["peak_rss_bytes"]) / 1e6))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, sizes = sys.argv[1], [int(s) for s in sys.argv[2:]] or [1000, 10000, 100000]
    runs = {}
    print("| vertices | wall s | us per vertex | CPU s | peak MB | minimum angle | edge CV |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for size in sizes:
            artificial_meshes.write("torus:%d" % size, 1, source)
            wall, report, runs[size] = sorted((timed(tool, source, output) for _ in range(RUNS)),
                                              key=lambda run: run[0])[RUNS // 2]
            edge, used = report["after"]["edge_length"], report["resources"]
            print("| %d | %.2f | %.1f | %.2f | %.0f | %.2f | %.3f |"
                  % (size, wall, 1e6 * wall / size, used["cpu_s"], used["peak_rss_bytes"] / 1e6,
                     report["after"]["min_angle"]["min"], edge["std"] / edge["mean"]), flush=True)
    print("\n| vertices | stage | calls | wall s | CPU s | us per vertex | peak MB so far |")
    print("|---|---|---|---|---|---|---|")
    for size in sizes:
        print_stages(size, runs[size])


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""scale_bench.py TOOL [SIZE...]   time per vertex and per stage on irregular bumpy tori, as Markdown.

File to file, default options, all threads; the run of median wall time out of three. Sizes default to 1000 10000
100000. Needs numpy and scipy (artificial_meshes.py).
"""

import sys
import tempfile
import time
from pathlib import Path

import artificial_meshes
from run_tool import run_tool

RUNS = 3


def timed(tool, source, output):
    start = time.perf_counter()
    report = run_tool(tool, source, output)
    return time.perf_counter() - start, report


def stage_seconds(report, wall):
    """Seconds of each stage in order of appearance; the rest of the process is reading, measuring, writing."""
    stages, end_of_last = {}, 0
    for iteration in report["iterations"]:
        stages[iteration["stage"]] = stages.get(iteration["stage"], 0) + iteration["t_s"] - end_of_last
        end_of_last = iteration["t_s"]
    stages["rest"] = wall - end_of_last
    return stages


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, sizes = sys.argv[1], [int(s) for s in sys.argv[2:]] or [1000, 10000, 100000]
    print("| vertices | wall s | us per vertex | CPU s | wall s by stage | peak MB | least angle | edge CV |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for size in sizes:
            artificial_meshes.write("torus:%d" % size, 1, source)
            wall, report = sorted((timed(tool, source, output) for _ in range(RUNS)), key=lambda run: run[0])[RUNS // 2]
            stages = ", ".join("%s %.2f" % item for item in stage_seconds(report, wall).items())
            edge, used = report["after"]["edge_length"], report["resources"]
            print("| %d | %.2f | %.1f | %.2f | %s | %.0f | %.2f | %.3f |"
                  % (size, wall, 1e6 * wall / size, used["cpu_s"], stages, used["peak_rss_bytes"] / 1e6,
                     report["after"]["min_angle"]["min"], edge["std"] / edge["mean"]), flush=True)


if __name__ == "__main__":
    main()

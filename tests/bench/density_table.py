#!/usr/bin/env python3
"""density_table.py TOOL [SEEDS]   one surface at four densities of vertices, as a Markdown table (needs numpy, scipy).

"Hooke's Optimization for 3D triangular mesh", section 5.2, finds its method independent of the density. Its surface
of M1 to M3 with random vertices (artificial_meshes.py), at four densities; medians over SEEDS meshes (default 10) of
the minimum angle and of the SD of the edge lengths over their target.
"""

import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np

import artificial_meshes
from mesh_file import write_off
from run_tool import run_tool

COUNTS = (121, 441, 961, 10000)
MODES = {
    "`--paper`": ["--paper"],
    "default": [],
    "`--connectivity flip`": ["--connectivity", "flip"],
    "`--connectivity adapt`": ["--connectivity", "adapt"],
}
LARGEST_OF_PAPER = 1000  # its one dense spline takes memory like the square of the vertices


def figures(report):
    length = report["parameters"]["L"]
    return [value for when in ("before", "after")
            for value in (report[when]["min_angle"]["min"], report[when]["edge_length"]["std"] / length)]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, seeds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for count in COUNTS:
            for seed in range(1, seeds + 1):
                rng = np.random.default_rng([seed, count])
                height = artificial_meshes.PLANAR["M1"][1]
                vertices, faces = artificial_meshes.graph_over_square(rng, count, height)
                write_off(source, vertices.tolist(), faces.tolist())
                for mode, options in MODES.items():
                    if "--paper" in options and count > LARGEST_OF_PAPER: continue
                    rows.setdefault((mode, count), []).append(figures(run_tool(tool, source, output, *options)))
    print("| who | vertices | minimum angle before (degrees) | SD / L before | minimum angle after | SD / L after |")
    print("|---|---|---|---|---|---|")
    for mode in MODES:
        for count in COUNTS:
            if (mode, count) in rows:
                print("| %s | %d | %.1f | %.3f | %.1f | %.3f |"
                      % (mode, count, *(statistics.median(column) for column in zip(*rows[mode, count]))))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""primitives_table.py TOOL   what each connectivity mode reaches on the shapes that modelling programs offer, as Markdown.

Least angle (degrees) / variation of the edges (standard deviation over mean). The shapes are of quadrilaterals, cut in
two: globes, tori, surfaces of revolution and graphs; and bodies that cross, and a torus folded over by noise.
"""

import random
import sys
import tempfile
from math import cos, pi, sin
from pathlib import Path

import mesh_file
from run_tool import quality, run_tool

MODES = ("fixed", "flip", "adapt")


def sheet(point, along, across, closed_along, closed_across):
    """The mesh of point(u, v) for u and v from 0 to 1, in along x across cells."""
    rows, columns = along + (not closed_along), across + (not closed_across)
    vertices = [point(i / along, j / across) for i in range(rows) for j in range(columns)]
    vertex = lambda i, j: i % rows * columns + j % columns
    cells = [(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1))
             for i in range(along) for j in range(across)]
    return vertices, [t for a, b, c, d in cells for t in ((a, b, c), (a, c, d))]


def revolved(profile, around):
    """The closed surface that a profile (r, z) from pole to pole makes; its first and last r are 0."""
    rings = profile[1:-1]
    vertices = [(r * cos(2 * pi * i / around), r * sin(2 * pi * i / around), z) for r, z in rings for i in range(around)]
    bottom, top = len(vertices), len(vertices) + 1
    vertices += [(0, 0, profile[0][1]), (0, 0, profile[-1][1])]
    vertex = lambda j, i: j * around + i % around
    faces, last = [], len(rings) - 1
    for i in range(around):
        faces += [(bottom, vertex(0, i + 1), vertex(0, i)), (top, vertex(last, i), vertex(last, i + 1))]
        for j in range(last):
            a, b, c, d = vertex(j, i), vertex(j, i + 1), vertex(j + 1, i + 1), vertex(j + 1, i)
            faces += [(a, b, c), (a, c, d)]
    return vertices, faces


def globe(meridians, bands):
    return revolved([(sin(pi * j / bands), -cos(pi * j / bands)) for j in range(bands + 1)], meridians)


def torus(along, across, radius, noise=0):
    shift = random.Random(1).uniform
    def point(u, v):
        a, b = 2 * pi * (u + shift(-noise, noise) / along), 2 * pi * (v + shift(-noise, noise) / across)
        return ((radius + cos(b)) * cos(a), (radius + cos(b)) * sin(a), sin(b))
    return sheet(point, along, across, True, True)


def capsule(around):
    quarter = [pi / 2 * k / 6 for k in range(7)]
    return revolved([(sin(t), -cos(t)) for t in quarter] + [(1, z) for z in (.5, 1)]
                    + [(cos(t), 1.5 + sin(t)) for t in quarter], around)


def vase(around):
    heights = [3 * k / 24 for k in range(25)]
    return revolved([(0, 0)] + [(1 + .5 * sin(3 * z) + .1 * z, z) for z in heights] + [(0, 3)], around)


def crossing(first, shift):
    vertices, faces = first
    moved = [tuple(x + d for x, d in zip(v, shift)) for v in vertices]
    return vertices + moved, faces + [tuple(v + len(vertices) for v in face) for face in faces]


SHAPES = {
    "globe 24 x 12": globe(24, 12),
    "globe 20 x 20": globe(20, 20),
    "globe 64 x 64": globe(64, 64),
    "torus 40 x 12": torus(40, 12, 3),
    "torus 24 x 24": torus(24, 24, 3),
    "saddle": sheet(lambda u, v: (2 * u - 1, 2 * v - 1, (2 * u - 1) ** 2 - (2 * v - 1) ** 2), 24, 16, False, False),
    "waves": sheet(lambda u, v: (4 * u, 2 * v, .3 * sin(6 * u)), 40, 20, False, False),
    "capsule": capsule(24),
    "vase": vase(32),
    "two tori that cross": crossing(torus(60, 24, 3, .3), (1.5, .5, .25)),
    "torus with folds": torus(100, 40, 3, .5),
}


def cell(values):
    return "%.1f / %.3f" % values


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print("| shape | input | %s |\n|---|---|%s" % (" | ".join(MODES), "---|" * len(MODES)))
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for name, (vertices, faces) in SHAPES.items():
            mesh_file.write_off(source, vertices, faces)
            reports = [run_tool(sys.argv[1], source, output, "--connectivity", mode) for mode in MODES]
            cells = [cell(quality(reports[0]["before"]))] + [cell(quality(report["after"])) for report in reports]
            print("| %s | %s |" % (name, " | ".join(cells)), flush=True)


if __name__ == "__main__":
    main()

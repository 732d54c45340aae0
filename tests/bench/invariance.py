#!/usr/bin/env python3
"""invariance.py TOOL [MESH...]   what a change of units, place, direction or thread count does to the result.

Python 3 standard library only; the meshes default to the samples of data/. Each mesh is moved, optimized, and
compared with the optimized mesh moved the same way. Printed: the maximum distance between the two over the target
length L, and the change of the minimum angle and of the edge lengths' standard deviation. Exits with 1 when a law is
broken: powers of two and threads change no bit, the rest moves along to 1e-3 L and its quality to 1 %.
"""

import math
import sys
import tempfile
from pathlib import Path

from mesh_file import read_mesh, write_off
from run_tool import run_tool

SAMPLES = [Path(__file__).resolve().parents[2] / "data" / name for name in ("patch.obj", "blob.ply", "torus.off")]


def scaling(factor):
    return lambda p: tuple(factor * c for c in p)


def translation(*offset):
    return lambda p: tuple(c + o for c, o in zip(p, offset))


def rotation(axis, degrees):
    """About an axis through the origin (O. Rodrigues, 1840)."""
    length = math.sqrt(sum(c * c for c in axis))
    x, y, z = (c / length for c in axis)
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))

    def rotate(p):
        along = (1 - c) * (x * p[0] + y * p[1] + z * p[2])
        turned = (y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0])
        return tuple(c * p[k] + s * turned[k] + along * (x, y, z)[k] for k in range(3))

    return rotate


# name, motion, scale, must be exact
MOTIONS = [
    ("x 2^10", scaling(2. ** 10), 2. ** 10, True),
    ("x 2^-30", scaling(2. ** -30), 2. ** -30, True),
    ("x 0.001", scaling(.001), .001, False),
    ("x 25.4", scaling(25.4), 25.4, False),
    ("turned by 37 degrees", rotation((1, 2, 3), 37), 1, False),
    ("moved by 10 sizes", translation(10, -7, 3), 1, False),
    ("moved by 1e6 sizes", translation(1e6, -2e6, 1e6), 1, False),
]


def quality(report):
    return report["after"]["min_angle"]["min"], report["after"]["edge_length"]["std"]


def compare(tool, folder, mesh):
    """Prints the rows of a mesh; true when all laws hold."""
    vertices, faces = read_mesh(mesh)
    source, output = folder / "in.off", folder / "out.off"
    write_off(source, vertices, faces)
    base = run_tool(tool, source, output, "-j", 1)
    single_thread = output.read_bytes()
    result, _ = read_mesh(output)
    run_tool(tool, source, output, "-j", 2)
    same_bytes = output.read_bytes() == single_thread
    print("| %s | 2 threads | %s | | |" % (mesh.name, "same bytes" if same_bytes else "OTHER BYTES"))
    holds = same_bytes
    length = base["parameters"]["L"]
    for name, motion, scale, exact in MOTIONS:
        write_off(source, [motion(p) for p in vertices], faces)
        report = run_tool(tool, source, output)
        moved, _ = read_mesh(output)
        distance = max(math.dist(motion(p), q) for p, q in zip(result, moved)) / (length * scale)
        angle = quality(report)[0] / quality(base)[0] - 1
        deviation = quality(report)[1] / (scale * quality(base)[1]) - 1
        good = distance == 0 if exact else distance <= 1e-3 and max(abs(angle), abs(deviation)) <= .01
        holds = holds and good
        print("| %s | %s | %.2g | %+.2g %% | %+.2g %% |%s"
              % (mesh.name, name, distance, 100 * angle, 100 * deviation, "" if good else " BROKEN"), flush=True)
    return holds


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    meshes = [Path(name) for name in sys.argv[2:]] or SAMPLES
    print("| mesh | motion | maximum distance over L | minimum angle | edge SD |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        laws = [compare(sys.argv[1], Path(folder), mesh) for mesh in meshes]
    return 0 if all(laws) else 1


if __name__ == "__main__":
    sys.exit(main())

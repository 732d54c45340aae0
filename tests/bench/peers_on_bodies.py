#!/usr/bin/env python3
"""peers_on_bodies.py TOOL PEERS [COUNT] [FIRST_SEED]   remeshers on bodies with flat and ruled faces, as Markdown.

The bodies are the first COUNT (default 100) of random_bodies.py, the length is that of each body, and so are the
checks: a result is good if it is a closed manifold with the volume, the sharp edges and the faces of the body, nothing
turned over and no self-intersections. PEERS is the program built from peers.cpp (cmake -DHOOKE_BENCHMARKS=ON); gmsh is
run if there is one. Angles and times are medians over all results, good or not; `worst` is over the good ones. Times
are whole processes, file to file, all threads (CGAL and gmsh use one). Needs numpy and scipy.
"""

import json
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import mesh_file
import random_bodies

GMSH_SCRIPT = """Merge "%s";
ClassifySurfaces{40 * Pi / 180, 1, 1, Pi};
CreateGeometry;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMin = %.17g;
Mesh.MeshSizeMax = %.17g;
"""
TIME_LIMIT = 60  # seconds


def write_stl(path, points, faces):
    """As text, in double precision."""
    lines = ["solid body"]
    for face in faces:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex %.17g %.17g %.17g" % tuple(points[v]) for v in face]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join(lines + ["endsolid body", ""]))


def read_msh(path):
    """The triangles of a Gmsh file of version 2."""
    rows = iter(path.read_text().splitlines())
    ids, points, faces = {}, [], []
    for row in rows:
        if row == "$Nodes":
            for _ in range(int(next(rows))):
                name, *x = next(rows).split()
                ids[name] = len(points)
                points.append([float(c) for c in x])
        elif row == "$Elements":
            for _ in range(int(next(rows))):
                _, kind, tags, *rest = next(rows).split()
                if kind == "2":
                    faces.append([ids[v] for v in rest[int(tags):]])
    used = sorted({v for f in faces for v in f})
    index = {v: i for i, v in enumerate(used)}
    return [points[v] for v in used], [[index[v] for v in f] for f in faces]


def run_gmsh(source, output, length):
    """Remeshes and writes the result as OFF; its seconds, reading and writing by this script left out."""
    points, faces = mesh_file.read_mesh(source)
    stl, script, msh = (output.with_suffix(s) for s in (".stl", ".geo", ".msh"))
    write_stl(stl, points, faces)
    script.write_text(GMSH_SCRIPT % (stl, length, length))
    wall = seconds(["gmsh", script, "-2", "-format", "msh2", "-v", "0", "-o", msh])
    if wall is not None and msh.exists():
        mesh_file.write_off(output, *read_msh(msh))
    msh.unlink(missing_ok=True)
    return wall


def seconds(command):
    """Wall time of a command; None when it fails."""
    start = time.perf_counter()
    try:
        run = subprocess.run([str(w) for w in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                             timeout=TIME_LIMIT)
    except subprocess.TimeoutExpired:
        return None
    return time.perf_counter() - start if run.returncode == 0 else None


def methods(tool, peers):
    yield "hooke-remesh --connectivity adapt", lambda i, o, length: seconds(
        [tool, i, "-o", o, "-q", "--connectivity", "adapt", "-L", "%.17g" % length, "--report", o.with_suffix(".json")])
    for name in ("cgal-creases", "cgal-isotropic"):
        yield name, lambda i, o, length, name=name: seconds([peers, name, i, o, "%.17g" % length])
    if shutil.which("gmsh"):
        yield "gmsh", run_gmsh


def judged(tool, seed, output):
    """(is it good, minimum angle) of a result; None if it cannot be read."""
    p, f, surface, length = random_bodies.body(seed)
    check = subprocess.run([str(tool), str(output), "--check", "-q", "--report", "-"], capture_output=True, text=True)
    if check.returncode != 0:
        return None
    before = json.loads(check.stdout)["before"]
    q, g = mesh_file.read_mesh(output)
    found = random_bodies.flaws(p, f, np.array(q), np.array(g), surface, length, before["self_intersections"])
    return not found, before["min_angle"]["min"]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    tool, peers = sys.argv[1:3]
    count, first = (int(a) for a in (sys.argv[3:] + ["100", "0"][len(sys.argv[3:]):]))
    print("| %d bodies | good | wrong | none | minimum angle, median (worst) | wall s |" % count)
    print("|---|---|---|---|---|---|")
    for name, run in methods(tool, peers):
        angles, good_angles, times, none = [], [], [], 0
        with tempfile.TemporaryDirectory() as folder:
            source, output = Path(folder) / "in.off", Path(folder) / "out.off"
            for seed in range(first, first + count):
                p, f, _, length = random_bodies.body(seed)
                mesh_file.write_off(source, p.tolist(), f.tolist())
                output.unlink(missing_ok=True)
                wall = run(source, output, length)
                result = judged(tool, seed, output) if wall is not None and output.exists() else None
                if result is None:
                    none += 1
                    continue
                times.append(wall)
                angles.append(result[1])
                good_angles += [result[1]] if result[0] else []
        if not angles:
            print("| %s | 0 | 0 | %d | | |" % (name, none), flush=True)
            continue
        print("| %s | %d | %d | %d | %.1f (%s) | %.2f |"
              % (name, len(good_angles), len(angles) - len(good_angles), none, statistics.median(angles),
                 "%.1f" % min(good_angles) if good_angles else "-", statistics.median(times)), flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""peers.py TOOL PEERS [SEEDS] [MESH...]   this tool beside other libraries, on the same meshes in the same run, as Markdown.

PEERS is the program built from peers.cpp (cmake -DHOOKE_BENCHMARKS=ON). Without MESH files: medians over SEEDS
meshes (default 10) of each of the paper's families (needs numpy and scipy, artificial_meshes.py); with them, one
table per mesh. Times are whole processes, file to file, all threads (the others use one); ours writes its report too.
Every result is measured by this tool's --check.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import artificial_meshes

OURS = {
    "hooke-remesh": [],
    "hooke-remesh --connectivity flip": ["--connectivity", "flip"],
    "hooke-remesh --connectivity flip --effort fast": ["--connectivity", "flip", "--effort", "fast"],
    "hooke-remesh --connectivity adapt": ["--connectivity", "adapt"],
}
PEERS = ["cgal-angle", "cgal-relax-angle", "openmesh-smoother", "cgal-angle-flips", "cgal-isotropic"]


def seconds(command):
    """Wall time of a command; None when it fails."""
    start = time.perf_counter()
    run = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start if run.returncode == 0 else None


def figures(tool, path):
    """(minimum angle, edge CV, folded edges, self-intersections, faces) of a mesh file; None when it is not acceptable."""
    run = subprocess.run([str(tool), str(path), "--check", "-q", "--report", "-"], capture_output=True, text=True)
    if run.returncode != 0:
        return None
    report = json.loads(run.stdout)
    q = report["before"]
    return (q["min_angle"]["min"], q["edge_length"]["std"] / q["edge_length"]["mean"], q["folded_edges"],
            q["self_intersections"], report["input"]["faces"])


def methods(tool, peers, source, output):
    for name, extra in OURS.items():
        yield name, [tool, source, "-o", output, "-q", "--report", output.with_suffix(".json"), *extra]
    for name in PEERS:
        yield name, [peers, name, source, output]


def compare(tool, peers, sources):
    """Per method the lines (minimum angle, CV, new folds, new self-intersections, faces, seconds) of all sources."""
    lines = {}
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "out.off"
        for source in sources:
            start = figures(tool, source)
            lines.setdefault("input", []).append((*start, 0))
            for name, command in methods(tool, peers, source, output):
                output.unlink(missing_ok=True)
                wall = seconds(command)
                end = figures(tool, output) if wall is not None else None
                lines.setdefault(name, []).append((*end, wall) if end else None)
    return lines


def print_table(title, lines):
    print("| %s | minimum angle, median (worst) | edge CV | folded edges | self-intersections | faces | wall s |" % title)
    print("|---|---|---|---|---|---|---|")
    for name, rows in lines.items():
        done = [row for row in rows if row]
        if not done:
            print("| %s | fails | | | | | |" % name)
            continue
        angle, cv, folds, crossings, faces, wall = zip(*done)
        note = "" if len(done) == len(rows) else ", %d failed" % (len(rows) - len(done))
        print("| %s | %.1f (%.1f%s) | %.3f | %d | %d | %d | %s |"
              % (name, statistics.median(angle), min(angle), note, statistics.median(cv), sum(folds), sum(crossings),
                 statistics.median(faces), "" if name == "input" else "%.2f" % statistics.median(wall)))
    print(flush=True)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    tool, peers = sys.argv[1:3]
    seeds = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    if len(sys.argv) > 4:
        for mesh in map(Path, sys.argv[4:]):
            print_table(mesh.name, compare(tool, peers, [mesh]))
        return
    for family in artificial_meshes.NAMES:
        with tempfile.TemporaryDirectory() as folder:
            sources = [Path(folder) / ("%d.off" % seed) for seed in range(1, seeds + 1)]
            for seed, path in enumerate(sources, 1):
                artificial_meshes.write(family, seed, path)
            print_table(family, compare(tool, peers, sources))


if __name__ == "__main__":
    main()

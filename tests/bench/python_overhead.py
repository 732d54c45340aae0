#!/usr/bin/env python3
"""What a run from Python costs against the command: python_overhead.py TOOL [VERTICES [RUNS]]; PYTHONPATH has the package.

Both read a torus, optimize it and write the result; the least wall and CPU seconds of the runs, in turns. Of the
command also without reading and writing, as its report says, beside remesh() on arrays alone.
"""

import json
import os
import random
import resource
import subprocess
import sys
import tempfile
import time
from math import cos, pi, sin
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
os.environ["HOOKE_REMESH"] = sys.argv[1]
from command import write_off  # noqa: E402

import hooke_remesh  # noqa: E402


def cpu(who):
    use = resource.getrusage(who)
    return use.ru_utime + use.ru_stime


def torus(around, across):
    """(vertices, faces): a grid on a torus, its points moved a little, without folds."""
    rng = random.Random(1)
    vertices, faces = [], []
    for i in range(around):
        for j in range(across):
            u = 2 * pi * (i + .5 * (rng.random() - .5)) / around
            v = 2 * pi * (j + .5 * (rng.random() - .5)) / across
            vertices.append(((1 + .4 * cos(v)) * cos(u), (1 + .4 * cos(v)) * sin(u), .4 * sin(v)))
            a, b = i * across + j, (i + 1) % around * across + j
            c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
            faces += [(a, b, c), (a, c, d)]
    return vertices, faces


def main():
    vertices = int(sys.argv[2]) if len(sys.argv) > 2 else 100_000
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    across = round((vertices / 2.5) ** .5)
    times = {"command": [], "python": [], "command, without files": [], "python, without files": []}
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        write_off(folder / "in.off", *torus(vertices // across, across))
        for _ in range(runs):
            start, used = time.perf_counter(), cpu(resource.RUSAGE_CHILDREN)
            subprocess.run([sys.argv[1], folder / "in.off", "-o", folder / "a.ply", "-q", "--map", folder / "map.txt",
                            "--report", folder / "report.json"], check=True)
            times["command"].append((time.perf_counter() - start, cpu(resource.RUSAGE_CHILDREN) - used))
            stages = json.loads((folder / "report.json").read_text())["resources"]["stages"]
            own = [stages[s] for s in ("sizing", "tree", "before", "remesh")]
            times["command, without files"].append((sum(s["wall_s"] for s in own), sum(s["cpu_s"] for s in own)))

            start, used = time.perf_counter(), cpu(resource.RUSAGE_SELF)
            mesh = hooke_remesh.read(folder / "in.off")
            inner, inner_used = time.perf_counter(), cpu(resource.RUSAGE_SELF)
            done = hooke_remesh.remesh(mesh.vertices, mesh.faces)
            inner, inner_used = time.perf_counter() - inner, cpu(resource.RUSAGE_SELF) - inner_used
            hooke_remesh.write(folder / "b.ply", done.vertices, done.faces)
            times["python"].append((time.perf_counter() - start, cpu(resource.RUSAGE_SELF) - used))
            times["python, without files"].append((inner, inner_used))
            assert (folder / "a.ply").read_bytes() == (folder / "b.ply").read_bytes()
        print(f"{len(mesh.vertices)} vertices, least of {runs} runs\n{'':24}   wall s    CPU s")
        for name, seconds in times.items():
            wall, used = (min(column) for column in zip(*seconds))
            print(f"{name:24} {wall:8.2f} {used:8.2f}")


if __name__ == "__main__":
    main()

"""What every test of the command needs: the binary, a folder of its own, meshes, the message of an error."""

import json
import os
import random
import subprocess
import sys
import tempfile
import unittest
from math import cos, pi, sin
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "bench"))
from mesh_file import read_fields, read_mesh, write_off  # noqa: E402  (used by the tests through this module)

TOOL = os.environ["HOOKE_REMESH"]  # the binary under test
DATA = Path(__file__).resolve().parents[2] / "data"

SANITIZED = "HOOKE_SANITIZED" in os.environ  # such a binary takes no limits of its address space, and is slow

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


class CommandTest(unittest.TestCase):
    """Runs the command in a temporary folder, where `good.obj` is an acceptable mesh."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.write("good.obj", TETRAHEDRON)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())

    def start(self, *arguments, streams=None, prepare=None, **environment):
        """The running command; thread settings of the caller's environment do not reach it. `streams` replace its
        standard streams, `prepare` is called in its process first."""
        env = {k: v for k, v in os.environ.items() if k not in ("SLURM_CPUS_PER_TASK", "OMP_NUM_THREADS")}
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **(streams or {})}
        return subprocess.Popen([TOOL, *(a if isinstance(a, bytes) else str(a) for a in arguments)], cwd=self.folder, env={**env, **environment},
                                preexec_fn=prepare, **streams)

    def start_until(self, mark, *arguments, **how):
        """The running command, once its progress bar has shown the mark."""
        process = self.start(*arguments, "--progress", "bar", **how)
        seen = b""
        while mark not in seen:
            byte = process.stderr.read(1)
            self.assertTrue(byte, seen)
            seen += byte
        return process

    def run_command(self, *arguments, expect=0, **environment):
        """(standard output, standard error) of a run that must end with the exit code expected."""
        process = self.start(*arguments, **environment)
        out, err = ((text or b"").decode() for text in process.communicate())
        self.assertEqual(process.returncode, expect, err)
        return out, err

    def refused(self, code, *arguments, names=None, says=None, **how):
        """A run that must fail with one message and leave the folder's files as they are."""
        contents = lambda: {p.name: p.read_bytes() if p.is_file() else None for p in self.folder.iterdir()}
        before = contents()
        out, err = self.run_command(*arguments, expect=code, **how)
        self.assertEqual(out, "")
        self.assertEqual(err.count("\n"), 1, err)
        self.assertTrue(err.startswith("hooke-remesh: error: "), err)
        for text in filter(None, (names, says)):
            self.assertIn(text, err)
        self.assertEqual(contents(), before)
        return err

    def report(self, *arguments, expect=0, **environment):
        out, _ = self.run_command(*arguments, "--report", "-", expect=expect, **environment)
        return json.loads(out)


def irregular_torus(around, across, seed=1):
    """(vertices, faces): a grid on a torus, its points moved and its diagonals chosen at random."""
    rng = random.Random(seed)
    vertices = []
    for i in range(around):
        for j in range(across):
            u = 2 * pi * (i + .8 * (rng.random() - .5)) / around
            v = 2 * pi * (j + .8 * (rng.random() - .5)) / across
            r = 1 + .4 * cos(v)
            vertices.append((r * cos(u), r * sin(u), .4 * sin(v)))
    faces = []
    for i in range(around):
        for j in range(across):
            a, b = i * across + j, (i + 1) % around * across + j
            c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
            faces += [(a, b, c), (a, c, d)] if rng.random() < .5 else [(a, b, d), (b, c, d)]
    return vertices, faces


def ply_text(names, vertices, faces, data):
    """An ASCII PLY file whose vertices have values of these names."""
    lines = ["ply", "format ascii 1.0", "element vertex %d" % len(vertices)]
    lines += ["property double " + name for name in ("x", "y", "z", *names)]
    lines += ["element face %d" % len(faces), "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join("%r" % x for x in (*v, *d)) for v, d in zip(vertices, data)]
    return "\n".join(lines + ["3 %d %d %d" % f for f in faces]) + "\n"


def rows_of(path):
    """What stands on each vertex line after the coordinates, in OBJ what stands on the lines vt and vn."""
    lines = [line.split() for line in path.read_text().splitlines()]
    if path.suffix == ".obj":
        columns = [[line[1:] for line in lines if line[0] == word] for word in ("vt", "vn")]
        rows = [sum(row, []) for row in zip(*[c for c in columns if c])]
        corners = [corner.split("/") for line in lines if line[0] == "f" for corner in line[1:]]
        assert all(len(set(corner) - {""}) == 1 for corner in corners), "a corner with several numbers"
    elif path.suffix == ".off":
        rows = [line[3:] for line in lines[2:2 + int(lines[1][0])]]
    else:
        count = next(int(line[2]) for line in lines if line[:2] == ["element", "vertex"])
        body = lines.index(["end_header"]) + 1
        rows = [line[3:] for line in lines[body:body + count]]
    return [tuple(map(float, row)) for row in rows]

"""Colours, normals and texture coordinates: where they are in the output, for each format and connectivity mode."""

import json
import random
import unittest
from math import sqrt

from command import DATA, CommandTest, ply_text, read_mesh, rows_of

MODES = ("fixed", "flip", "adapt")


def square(n=7, seed=1, right=0):
    """(vertices, faces): a grid on the unit square, or on that `right` of it; inner points are moved at random."""
    rng = random.Random(seed)
    inner = lambda i: i % n and .5 * (rng.random() - .5)
    vertices = []
    for j in range(n + 1):
        for i in range(n + 1):
            dx, dy = (inner(i), inner(j)) if i % n and j % n else (0, 0)
            vertices.append(((i + dx) / n + right, (j + dy) / n, 0.))
    quads = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    return vertices, [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))]


def texture_of(x, y):
    """A linear function: what is interpolated linearly on a plane stays it."""
    return 2 * x - y, .25 + .5 * y


def obj_text(vertices, faces, texture, normals=()):
    rows = [("v", vertices), ("vt", texture), ("vn", normals)]
    lines = [" ".join([word] + ["%r" % x for x in row]) for word, block in rows for row in block]
    form = "%d/%d" if not normals else "%d/%d/%d"
    corner = lambda v: form % ((v + 1,) * (3 if normals else 2))
    return "\n".join(lines + ["f " + " ".join(map(corner, face)) for face in faces]) + "\n"


def off_text(keyword, vertices, faces, data):
    lines = [keyword, "%d %d 0" % (len(vertices), len(faces))]
    lines += [" ".join("%r" % x for x in (*v, *d)) for v, d in zip(vertices, data)]
    return "\n".join(lines + ["3 %d %d %d" % f for f in faces]) + "\n"


class Attributes(CommandTest):
    def result(self, source, mode, *options, warned=False):
        """(positions, rows) of what comes of the file."""
        out = "out" + (self.folder / source).suffix
        _, err = self.run_command(source, "-o", out, "-q", "--connectivity", mode, *options)
        self.assertEqual(bool(err), warned, err)
        return read_mesh(self.folder / out)[0], rows_of(self.folder / out)

    def test_a_linear_texture_stays_linear_where_vertices_are_new_or_travel(self):
        vertices, faces = square()
        texture = [texture_of(x, y) for x, y, _ in vertices]
        self.write("in.obj", obj_text(vertices, faces, texture))
        self.write("in.off", off_text("STOFF", vertices, faces, texture))
        self.write("in.ply", ply_text("st", vertices, faces, texture))
        for source in ("in.obj", "in.off", "in.ply"):
            with self.subTest(source=source):
                self.assertEqual(self.result(source, "fixed", warned=True)[1], texture)
            for mode, options in (("flip", []), ("adapt", ["-L", ".8x"]), ("adapt", ["-L", "1.3x"])):
                with self.subTest(source=source, mode=mode):
                    positions, rows = self.result(source, mode, *options)
                    self.assertEqual(len(rows), len(positions))
                    self.assertNotEqual(rows, texture)
                    for (x, y, _), row in zip(positions, rows):
                        for value, expected in zip(row, texture_of(x, y)):
                            self.assertAlmostEqual(value, expected, 9)

    def test_values_that_leave_their_places_with_fixed_faces_are_named(self):
        mesh = read_mesh(DATA / "torus.off")
        rows = ["ply", "format ascii 1.0", f"element vertex {len(mesh[0])}", *(f"property double {c}" for c in "xyz"),
                "property float thickness", "property int id", "property int part", f"element face {len(mesh[1])}",
                "property list uchar int vertex_indices", "end_header"]
        rows += ["%r %r %r %r %d %d" % (x, y, z, x + y, v, x > 0) for v, (x, y, z) in enumerate(mesh[0])]
        rows += ["3 %d %d %d" % tuple(face) for face in mesh[1]]
        self.write("in.ply", "\n".join(rows) + "\n")
        for mode in ("fixed", "adapt"):
            report = self.report("in.ply", "-o", "out.ply", "-q", "--connectivity", mode)
            told = [w["message"] for w in report["warnings"] if w["code"] == "values_moved"]
            if mode == "fixed":
                self.assertRegex(told[0], r"at their new places: thickness by [\d.]+ %, part by [\d.]+ % of the range \(rms\); ")
            else:
                self.assertEqual(told, [])

    def test_what_is_constant_stays_it_to_the_last_bit(self):
        vertices, faces = square()
        constant = [(.1, .7)] * len(vertices)
        self.write("in.obj", obj_text(vertices, faces, constant))
        self.write("in.off", off_text("STCOFF", vertices, faces, [(9, 200, 31, 255, .1, .7)] * len(vertices)))
        for mode in MODES:
            with self.subTest(mode=mode):
                self.assertEqual(set(self.result("in.obj", mode)[1]), {(.1, .7)})
                self.assertEqual(set(self.result("in.off", mode)[1]), {(9, 200, 31, 255, .1, .7)})
                self.assertIn(" 9 200 31 255 0.1 0.7\n", (self.folder / "out.off").read_text())

    def test_normals_are_those_of_the_output(self):
        vertices, faces = read_mesh(DATA / "blob.ply")
        wrong = [(0, 0, 1)] * len(vertices)
        self.write("in.obj", obj_text(vertices, faces, [(0, 0)] * len(vertices), wrong))
        self.write("in.off", off_text("NOFF", vertices, faces, wrong))
        self.write("in.ply", ply_text(("nx", "ny", "nz"), vertices, faces, wrong))
        for mode in MODES:
            results = [self.result(source, mode) for source in ("in.obj", "in.off", "in.ply")]
            for positions, rows in results:
                self.assertEqual(len(rows), len(positions))
                for position, row in zip(positions, rows):
                    normal = row[-3:]
                    self.assertAlmostEqual(sqrt(sum(x * x for x in normal)), 1, 6)
                    self.assertGreater(sum(x * y for x, y in zip(normal, position)), 0)  # the blob is about 0

    def test_seams_and_hard_edges_are_named_once_where_they_cannot_be_kept(self):
        vertices, faces = square(6)
        texture = [texture_of(x, y) for x, y, _ in vertices]
        plain = obj_text(vertices, faces, texture + [(9 + s, t) for s, t in texture]).splitlines()
        left = lambda line: all(vertices[int(c.split("/")[0]) - 1][0] <= .6 for c in line.split()[1:])
        lines = [line if line[0] != "f" or left(line) else
                 "f " + " ".join("%s/%d" % (c.split("/")[0], int(c.split("/")[0]) + len(vertices)) for c in line.split()[1:])
                 for line in plain]
        self.write("seam.obj", "\n".join(lines))
        self.write("hard.obj", "\n".join(line.replace("vt", "vn").replace("/", "//") for line in lines)
                   .replace("vn ", "vn 0 "))
        for source, code, element in (("seam.obj", "texture_seams", "vt"), ("hard.obj", "hard_edges", "vn")):
            for target, mode, *options in (("out.off", "fixed"), ("out.ply", "fixed"), ("out.obj", "flip", "--keep", "none"),
                                           ("out.obj", "adapt", "--keep", "materials,groups")):
                with self.subTest(source=source, target=target, mode=mode):
                    out, err = self.run_command(source, "-o", target, "-q", "--connectivity", mode, "--report", "-", *options)
                    self.assertEqual(err.count("\n"), 1, err)
                    self.assertIn("%s: not kept in the output: " % source, err)
                    self.assertIn("several %s: " % element, err)
                    self.assertEqual([w["code"] for w in json.loads(out)["warnings"]], [code])
                    if target == "out.obj":
                        text = (self.folder / target).read_text()
                        self.assertNotIn("/", text)
                        self.assertNotIn(element, text)

    def test_both_sides_of_a_mesh_that_is_cut_open_keep_theirs(self):
        left, faces = square(6)
        right, _ = square(6, seed=2, right=1)
        vertices = left + right
        both = faces + [tuple(v + len(left) for v in face) for face in faces]
        texture = [texture_of(x, y) for x, y, _ in left] + [(9 + x, y) for x, y, _ in right]
        self.write("in.obj", obj_text(vertices, both, texture))
        for mode in MODES:
            with self.subTest(mode=mode):
                positions, rows = self.result("in.obj", mode, warned=True)  # of vertices that lie on each other
                on_cut = [(round(y * 6), s > 8.5) for (x, y, _), (s, _) in zip(positions, rows) if x == 1]
                self.assertEqual(sorted(on_cut), [(j, side) for j in range(7) for side in (False, True)])
                if mode == "fixed":
                    continue
                for (x, y, _), (s, t) in zip(positions, rows):
                    expected = (9 + x, y) if s > 8.5 else texture_of(x, y)
                    self.assertTrue(x >= 1 if s > 8.5 else x <= 1)
                    self.assertAlmostEqual(s, expected[0], 9)
                    self.assertAlmostEqual(t, expected[1], 9)

    def test_they_go_from_format_to_format(self):
        vertices, faces = square()
        texture = [texture_of(x, y) for x, y, _ in vertices]
        self.write("a.obj", obj_text(vertices, faces, texture, [(0, 0, 1)] * len(vertices)))
        for source, target in (("a.obj", "b.off"), ("b.off", "c.obj"), ("c.obj", "d.ply"), ("d.ply", "e.obj"), ("e.obj", "f.off")):
            report = self.report(source, "-o", target, "-q")
            self.assertLessEqual({w["code"] for w in report["warnings"]}, {"values_moved"})
        rows = rows_of(self.folder / "f.off")
        self.assertEqual([row[3:] for row in rows], texture)
        self.assertTrue((self.folder / "f.off").read_text().startswith("STNOFF\n"))
        self.assertIn("property double s\nproperty double t\n", (self.folder / "d.ply").read_bytes().decode("latin1"))
        report = self.report("d.ply", "-o", "g.obj", "-q", "--format", "off")
        self.assertLessEqual({w["code"] for w in report["warnings"]}, {"values_moved"})

    def test_a_format_without_a_place_for_them_says_so(self):
        vertices, faces = square()
        self.write("in.ply", ply_text(("s", "t", "heat"), vertices, faces, [(0, 1, 2)] * len(vertices)))
        for target in ("out.obj", "out.off"):
            _, err = self.run_command("in.ply", "-o", target, "-q")
            self.assertEqual(err.count("\n"), 1)
            self.assertIn("%s: %s files cannot hold heat; use PLY" % (target, target[-3:]), err)


if __name__ == "__main__":
    unittest.main()

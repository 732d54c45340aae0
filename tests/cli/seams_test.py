"""--keep: textures, materials, groups and face labels go along with new faces, and their borders stay where they are."""

import collections
import json
import math
import random
import unittest

from command import CommandTest

TURNS = 2 * math.pi


def can(n=20, rows=10, radius=3, height=8):
    """An OBJ as artists make them: a can of quads, unwrapped along a seam, and two lids of triangles about a point, in a
    group, material and smoothing group of their own. Two groups have the same name; vt are listed twice."""
    draw = random.Random(1)
    points, texture, lines = [], [], ["mtllib can.mtl other.mtl", "o Can"]
    for j in range(rows + 1):
        for i in range(n):
            inner = 0 < j < rows
            t, z = (i + .4 * (draw.random() - .5) * (inner and i > 0)) / n, (j + .4 * (draw.random() - .5) * inner) / rows
            points.append((radius * math.cos(TURNS * t), radius * math.sin(TURNS * t), height * z))
            texture.append((t, z))
    texture += [(1, texture[j * n][1]) for j in range(rows + 1)]
    copies = len(texture)
    texture += texture  # the same again: equal values are no seam
    corner = lambda i, j, copy: "%d/%d" % (j * n + i % n + 1, (j * n + i if i < n else n * (rows + 1) + j) + 1 + copy * copies)
    for j in range(rows):
        lines += ["g side", "usemtl paint", "s 1"]
        lines += ["f " + " ".join(corner(a, b, (i + j) % 2) for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))) for i in range(n)]
    for name, j in (("floor", 0), ("lid", rows)):
        points.append((0, 0, height * j / rows))
        texture.append((.5 + 2 + j, .5))
        centre = "%d/%d" % (len(points), len(texture))
        first = len(texture)
        texture += [(.5 + 2 + j + .4 * math.cos(TURNS * i / n) * (1 if j else -1), .5 + .4 * math.sin(TURNS * i / n)) for i in range(n)]
        lines += ["g " + name, "usemtl steel", "s off"]
        rim = lambda i: "%d/%d" % (j * n + i % n + 1, first + i % n + 1)
        lines += ["f " + " ".join([centre] + ([rim(i), rim(i + 1)] if j else [rim(i + 1), rim(i)])) for i in range(n)]
    return "\n".join(["v %r %r %r" % p for p in points] + ["vt %r %r" % t for t in texture] + lines) + "\n"


def read(text):
    """(points, texture, faces) of an OBJ, faces as ([(v, vt)], labels)."""
    points, texture, faces, labels = [], [], [], {}
    for word, *rest in (line.split() for line in text.splitlines() if line):
        if word in ("v", "vt"):
            (points if word == "v" else texture).append(tuple(map(float, rest)))
        elif word in ("g", "o", "usemtl", "s"):
            labels = dict(labels, **{word: " ".join(rest)})
        elif word == "f":
            faces.append(([tuple(int(x) - 1 if x else None for x in (c + "/").split("/")[:2]) for c in rest], labels))
    return points, texture, faces


def areas(mesh):
    """Area by labels, and the areas in the texture."""
    points, texture, faces = mesh
    of_labels, in_texture = collections.Counter(), []
    for corners, labels in faces:
        for k in range(1, len(corners) - 1):
            p, q, r = (points[corners[i][0]] for i in (0, k, k + 1))
            u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
            n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            of_labels[tuple(sorted(labels.items()))] += math.hypot(*n) / 2
            if corners[0][1] is not None:
                p, q, r = (texture[corners[i][1]] for i in (0, k, k + 1))
                in_texture.append(((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2)
    return of_labels, in_texture


def borders(mesh):
    """Length of the edges across which the texture jumps, and of those between each two materials."""
    points, texture, faces = mesh
    edges = collections.defaultdict(list)
    for corners, labels in faces:
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edges[tuple(sorted((a[0], b[0])))].append(({c[0]: texture[c[1]] for c in (a, b)}, labels["usemtl"]))
    jumps, pairs = 0, collections.Counter()
    for (a, b), ((left, one), (right, other)) in edges.items():
        length = math.dist(points[a], points[b])
        jumps += length * (left != right)
        if one != other:
            pairs[tuple(sorted((one, other)))] += length
    return jumps, pairs


class Seams(CommandTest):
    def test_an_artists_file_keeps_all_it_has(self):
        self.write("can.obj", can())
        before = read(can())
        for options in (["flip"], ["adapt"], ["adapt", "-L", ".6x"], ["adapt", "-L", "1.5x"]):
            with self.subTest(options=options):
                report = self.report("can.obj", "-o", "out.obj", "-q", "--connectivity", *options)
                self.assertEqual([w["code"] for w in report["warnings"] if "polygons" not in w["code"] and "facets" not in w["code"]], [])
                self.assertEqual(report["features"]["seam_edges"], 20 + 20 + 10)
                self.assertEqual(report["parameters"]["keep"], "seams,materials,groups")
                text = (self.folder / "out.obj").read_text()
                self.assertTrue(text.startswith("mtllib can.mtl other.mtl\n"))
                self.assertEqual(text.count("usemtl"), 2, "faces of one label stand together")
                after = read(text)
                (old, old_map), (new, new_map) = areas(before), areas(after)
                self.assertEqual(set(old), set(new))
                for labels, area in old.items():
                    self.assertAlmostEqual(new[labels] / area, 1, delta=.06)
                self.assertGreater(min(new_map), 0)
                self.assertAlmostEqual(sum(new_map) / sum(old_map), 1, delta=.04)
                (jumps, pairs), (new_jumps, new_pairs) = borders(before), borders(after)
                self.assertAlmostEqual(new_jumps / jumps, 1, delta=.02)
                self.assertEqual(set(pairs), set(new_pairs))

    def test_a_new_file_of_the_same_faces_has_the_same_data(self):
        self.write("can.obj", can())
        self.run_command("can.obj", "-o", "out.obj", "-q", "--preserve", "off")
        before, after = read(can()), read((self.folder / "out.obj").read_text())
        self.assertEqual(set(areas(before)[0]), set(areas(after)[0]))
        corners = lambda mesh: {(v, mesh[1][vt]) for face, _ in mesh[2] for v, vt in face}
        self.assertEqual(corners(before), corners(after))

    def test_keep_says_what(self):
        self.write("can.obj", can())
        for words, has, count in (("none", [], 0), ("seams", ["vt"], 50), ("materials", ["usemtl", "mtllib"], 40),
                                  ("groups,seams", ["vt", "g", "o", "s"], 50)):
            out, err = self.run_command("can.obj", "-o", "out.obj", "-q", "--connectivity", "adapt", "--keep", words, "--report", "-")
            self.assertEqual(((json.loads(out)["features"] or {}).get("seam_edges", 0)), count)
            first = {line.split()[0] for line in (self.folder / "out.obj").read_text().splitlines()}
            self.assertEqual(first, {"v", "f", *has})
            self.assertIn("not kept", err)
        self.refused(2, "can.obj", "-o", "o.obj", "--connectivity", "flip", "--keep", "seams,x", says="expected seams, materials, groups")
        self.refused(2, "can.obj", "-o", "o.obj", "--keep", "none", says="--keep")

    def test_seams_of_what_the_output_cannot_hold_are_none(self):
        self.write("can.obj", can())
        out, err = self.run_command("can.obj", "-o", "out.off", "-q", "--connectivity", "adapt", "--report", "-")
        self.assertEqual(json.loads(out)["features"]["seam_edges"], 0)
        self.assertIn("out.off: off files cannot hold object, group, material, smoothing; use OBJ", err)

    def test_groups_of_single_faces_are_told(self):
        lines, n = [], 8
        draw = random.Random(3)
        for j in range(n + 1):
            for i in range(n + 1):
                inner = 0 < i < n and 0 < j < n
                lines.append("v %r %r 0" % (i + .5 * inner * (draw.random() - .5), j + .5 * inner * (draw.random() - .5)))
        for j in range(n):
            for i in range(n):
                a = j * (n + 1) + i + 1
                lines += ["g quad%d" % a, "f %d %d %d %d" % (a, a + 1, a + n + 2, a + n + 1)]
        self.write("each.obj", "\n".join(lines))
        report = self.report("each.obj", "-o", "out.obj", "-q", "--connectivity", "adapt")
        warning = next(w["message"] for w in report["warnings"] if w["code"] == "many_seams")
        self.assertIn("--keep seams,materials gives them up", warning)
        self.assertEqual(self.report("each.obj", "-o", "out.obj", "-q", "--connectivity", "adapt", "--keep", "seams,materials")["features"], None)

    def test_labels_of_ply_faces_go_along(self):
        self.write("can.obj", can())
        self.run_command("can.obj", "-o", "can.ply", "-q")
        header = (self.folder / "can.ply").read_bytes().split(b"end_header")[0].decode()
        self.assertIn("property int material\n", header)
        self.run_command("can.ply", "-o", "can2.ply", "-q", "--connectivity", "adapt", "-L", "1.3x")
        self.run_command("can2.ply", "-o", "can3.obj", "-q")
        old, new = areas(read(can()))[0], areas(read((self.folder / "can3.obj").read_text()))[0]
        by = lambda counter, key: sorted(sum(a for k, a in counter.items() if dict(k)[key] == v) for v in {dict(k)[key] for k in counter})
        for key in ("g", "usemtl"):
            for a, b in zip(by(old, key), by(new, key)):
                self.assertAlmostEqual(a / b, 1, delta=.05)


if __name__ == "__main__":
    unittest.main()

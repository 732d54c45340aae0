"""--keep: textures, materials, groups and face labels go along with new faces, and their borders stay where they are."""

import collections
import json
import math
import random
import unittest

from command import CommandTest, irregular_torus

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


def edges_of(faces):
    """The faces at each edge, a pair of vertices in ascending order."""
    edges = collections.defaultdict(list)
    for f, face in enumerate(faces):
        for a, b in zip(face, face[1:] + face[:1]):
            edges[min(a, b), max(a, b)].append(f)
    return edges


def unit_normal(vertices, face):
    p, q, r = (vertices[v] for v in face)
    u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return [x / math.hypot(*n) for x in n]


def degrees(a, b):
    return math.degrees(math.atan2(math.dist(a, b), math.dist(a, [-x for x in b])) * 2)


def shaded(vertices, faces, is_hard):
    """An OBJ with a normal for each fan of faces around a vertex between edges that are hard, as modelling programs write
    it."""
    fan = {(f, v): (f, v) for f, face in enumerate(faces) for v in face}

    def find(corner):
        while fan[corner] != corner:
            corner = fan[corner]
        return corner

    for edge, (f, g) in edges_of(faces).items():
        if not is_hard(edge, f, g):
            for v in edge:
                fan[find((f, v))] = find((g, v))
    sums = collections.defaultdict(lambda: [0, 0, 0])
    for f, v in fan:
        sums[find((f, v))] = [a + b for a, b in zip(sums[find((f, v))], unit_normal(vertices, faces[f][:3]))]
    numbers = {corner: i + 1 for i, corner in enumerate(sums)}
    lines = ["v %r %r %r" % tuple(v) for v in vertices]
    lines += ["vn %.4f %.4f %.4f" % tuple(x / math.hypot(*n) for x in n) for n in sums.values()]
    lines += ["f " + " ".join("%d//%d" % (v + 1, numbers[find((f, v))]) for v in face) for f, face in enumerate(faces)]
    return "\n".join(lines) + "\n"


def hard_length(text):
    """Length of the edges at which normals are more than a degree apart, and of all edges."""
    words = [line.split() for line in text.splitlines()]
    vertices, normals = ([tuple(map(float, w[1:])) for w in words if w[0] == key] for key in ("v", "vn"))
    faces = [{int(c.split("/")[0]) - 1: normals[int(c.split("/")[2]) - 1] for c in w[1:]} for w in words if w[0] == "f"]
    hard = every = 0
    for (a, b), (f, g) in edges_of([list(face) for face in faces]).items():
        length = math.dist(vertices[a], vertices[b])
        every += length
        hard += length * any(degrees(faces[f][v], faces[g][v]) > 1 for v in (a, b))
    return hard, every


class HardEdges(CommandTest):
    AROUND, ACROSS = 36, 16

    def ring(self, edge, f, g):
        """Edges of two rings around the tube of the torus."""
        return all(v // self.ACROSS == edge[0] // self.ACROSS and v // self.ACROSS in (0, self.AROUND // 2) for v in edge)

    def optimized(self, *options):
        report = self.report("in.obj", "-o", "out.obj", "-q", *options)
        return report, *hard_length((self.folder / "out.obj").read_text())

    def test_stay_where_they_are_and_others_stay_smooth(self):
        self.write("in.obj", shaded(*irregular_torus(self.AROUND, self.ACROSS), self.ring))
        before, _ = hard_length((self.folder / "in.obj").read_text())
        for mode in ("flip", "adapt"):
            report, after, _ = self.optimized("--connectivity", mode)
            self.assertEqual(report["features"]["seam_edges"], 2 * self.ACROSS)
            self.assertAlmostEqual(after / before, 1, delta=.02, msg=mode)
            self.assertGreater(report["after"]["min_angle"]["min"], 25)
            for words in ("seams", "seams,materials,groups"):
                report, after, _ = self.optimized("--connectivity", mode, "--keep", words)
                self.assertLess(after / before, .1, "only where they are creases")

    def test_of_a_mesh_where_each_face_has_a_normal_say_nothing(self):
        vertices, faces = irregular_torus(self.AROUND, self.ACROSS)
        quads = [[i * self.ACROSS + j, (i + 1) % self.AROUND * self.ACROSS + j, (i + 1) % self.AROUND * self.ACROSS + (j + 1) % self.ACROSS,
                  i * self.ACROSS + (j + 1) % self.ACROSS] for i in range(self.AROUND) for j in range(self.ACROSS)]
        for polygons in (faces, quads):
            self.write("in.obj", shaded(vertices, polygons, lambda *_: True))
            report, hard, every = self.optimized("--connectivity", "adapt")
            self.assertIsNone(report["features"])
            self.assertGreater(hard / every, .9, "and it looks as before")
            self.write("in.obj", shaded(vertices, polygons, lambda *_: False))
            report, hard, _ = self.optimized("--connectivity", "adapt")
            self.assertIsNone(report["features"])
            self.assertEqual(hard, 0)

    def test_that_are_sharp_are_never_noise(self):
        vertices, faces = irregular_torus(20, 9)
        draw = random.Random(5)
        vertices = [tuple(x * (1 + .25 * draw.random()) for x in v) for v in vertices]
        normals = [unit_normal(vertices, face) for face in faces]
        is_sharp = lambda edge, f, g: degrees(normals[f], normals[g]) > 40
        sharp = sum(is_sharp(e, *both) for e, both in edges_of(faces).items())
        self.write("in.obj", shaded(vertices, faces, lambda *_: False))
        self.assertEqual(self.optimized()[0]["warnings"][-1]["code"], "sharp_edges_dropped")
        self.write("in.obj", shaded(vertices, faces, is_sharp))
        for mode in ("fixed", "flip", "adapt"):
            report, *_ = self.optimized("--connectivity", mode)
            self.assertEqual(report["features"]["sharp_edges"], sharp)
            self.assertLess(report["features"]["sharp_edges_dropped"], .03 * sharp, "those that end where nothing else is hard")
            self.run_command("in.obj", "-o", "out.ply", "-q", "--connectivity", mode, "--report", "report.json")
            self.assertLess(json.loads((self.folder / "report.json").read_text())["features"]["sharp_edges_dropped"], .03 * sharp)

    def test_are_none_along_a_seam_of_the_texture(self):
        self.write("in.obj", shaded(*irregular_torus(self.AROUND, self.ACROSS), lambda *_: False))
        text = (self.folder / "in.obj").read_text()
        faces = [line for line in text.splitlines() if line[0] == "f"]
        columns = "".join("vt %r %r\n" % (x, y) for x in (0, 1) for y in (0, 1))
        is_left = lambda line: all(int(c.split("/")[0]) <= self.ACROSS * 18 for c in line.split()[1:])
        textured = [line.replace("//", "/1/" if is_left(line) else "/4/") for line in faces]
        self.write("in.obj", text[:text.index("f ")] + columns + "\n".join(textured))
        for mode in ("flip", "adapt"):
            report, hard, _ = self.optimized("--connectivity", mode)
            self.assertGreaterEqual(report["features"]["seam_edges"], 2 * self.ACROSS)
            self.assertEqual(hard, 0)


class Seams(CommandTest):
    def test_an_artists_file_keeps_all_it_has(self):
        self.write("can.obj", can())
        before = read(can())
        for options in (["flip"], ["adapt"], ["adapt", "-L", ".6x"], ["adapt", "-L", "1.5x"]):
            with self.subTest(options=options):
                report = self.report("can.obj", "-o", "out.obj", "-q", "--connectivity", *options)
                others = {"surface_left"} if "1.5x" in options else set()  # a can of so few facets is narrower
                self.assertLessEqual({w["code"] for w in report["warnings"] if "polygons" not in w["code"] and "facets" not in w["code"]}, others)
                self.assertEqual(report["features"]["seam_edges"], 20 + 20 + 10)
                self.assertEqual(report["parameters"]["keep"], "seams,hard-edges,materials,groups")
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
                                  ("groups,seams", ["vt", "g", "o", "s"], 50), ("hard-edges", [], 0)):
            out, err = self.run_command("can.obj", "-o", "out.obj", "-q", "--connectivity", "adapt", "--keep", words, "--report", "-")
            self.assertEqual(((json.loads(out)["features"] or {}).get("seam_edges", 0)), count)
            first = {line.split()[0] for line in (self.folder / "out.obj").read_text().splitlines()}
            self.assertEqual(first, {"v", "f", *has})
            self.assertIn("not kept", err)
        self.refused(2, "can.obj", "-o", "o.obj", "--connectivity", "flip", "--keep", "seams,x", says="expected seams, hard-edges, materials, groups")
        self.refused(2, "can.obj", "-o", "o.obj", "--keep", "none", says="--keep")

    def test_hold_borders_where_faces_stay(self):
        """Of a plane of two materials, with vertices off the grid but for those of the border."""
        size = 12
        shift = lambda i, j: .35 * math.sin(7 * i + 3 * j * j) if 0 < i < size and 0 < j < size and i != size // 2 else 0
        rows = ["v %g %g 0" % (i + shift(i, j), j + shift(j, i) if i != size // 2 else j) for j in range(size + 1) for i in range(size + 1)]
        for name, columns in (("left", range(size // 2)), ("right", range(size // 2, size))):
            rows.append("usemtl " + name)
            for j in range(size):
                for i in columns:
                    a, b = j * (size + 1) + i + 1, (j + 1) * (size + 1) + i + 1
                    rows += ["f %d %d %d" % (a, a + 1, b + 1), "f %d %d %d" % (a, b + 1, b)]
        self.write("plane.obj", "\n".join(rows) + "\n")
        border = [j * (size + 1) + size // 2 for j in range(size + 1)]
        def off_border(*options):
            report = self.report("plane.obj", "-o", "out.obj", "-q", *options)
            x = [float(line.split()[1]) for line in (self.folder / "out.obj").read_text().splitlines() if line.startswith("v ")]
            told = [w["message"] for w in report["warnings"] if w["code"] == "borders_moved"]
            return max(abs(x[v] - size // 2) for v in border), told
        distance, told = off_border()
        self.assertGreater(distance, .01)
        self.assertEqual(told, ["plane.obj: 12 edges at borders of materials, groups or labels have moved with their faces; "
                                "--keep materials holds these borders in their places"])
        distance, told = off_border("--keep", "materials")
        self.assertLess(distance, 1e-6)
        self.assertEqual(told, [])

    def test_that_hold_slivers_are_named(self):
        columns, rows = 20, 8  # narrow columns, each with a texture of its own
        lines = ["v %r %r 0" % (.2 * i, j) for i in range(columns + 1) for j in range(rows + 1)]
        lines += ["vt %r %r" % (.1 * i, .1 * j) for i in range(2 * columns) for j in range(rows + 1)]
        at = lambda column, side, j: "%d/%d" % ((column + side) * (rows + 1) + j + 1, (2 * column + side) * (rows + 1) + j + 1)
        for i in range(columns):
            for j in range(rows):
                lines.append("f %s %s %s" % (at(i, 0, j), at(i, 1, j), at(i, 1, j + 1)))
                lines.append("f %s %s %s" % (at(i, 0, j), at(i, 1, j + 1), at(i, 0, j + 1)))
        self.write("strips.obj", "\n".join(lines) + "\n")
        for mode, length, code in (("flip", "auto", "facets_without_inner_vertices"), ("adapt", "1.5", "narrow_regions")):
            for words in ("seams", "none"):
                with self.subTest(mode=mode, words=words):
                    report = self.report("strips.obj", "-o", "out.obj", "-q", "--connectivity", mode, "-L", length, "--keep", words)
                    told = [w["message"] for w in report["warnings"] if w["code"] == code and "words of --keep" in w["message"]]
                    self.assertEqual(len(told), words == "seams")

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
        self.assertIn("--keep seams,hard-edges,materials gives them up", warning)
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

"""--preserve: the output is the input's bytes, but for the digits of moved coordinates and their normals."""

import json
import random
import re
import struct
import unittest
from math import sqrt

from command import CommandTest, irregular_torus

NUMBER = rb"[-+.0-9eE]+"


def artists_obj(n=8, line_end="\r\n"):
    """An OBJ as modelling programs write it: a bent sheet of quads and triangles, its right half in a group, material
    and smoothing group of its own and with its own texture coordinates (a seam) and normals (a hard edge); lines,
    points, colours, comments, and numbers written in several ways."""
    lines = ["# Sheet by hand", "mtllib sheet.mtl skin.mtl", "o Sheet", "", "vp 0.5"]
    place = lambda i, j: (i + .35 * ((i * 7 + j * 5) % 5 - 2) / 2 * (0 < i < n), j + .35 * ((i * 3 + j * 11) % 7 - 3) / 3 * (0 < j < n))
    for j in range(n + 1):
        for i in range(n + 1):
            x, y = place(i, j) if i != n // 2 else (i, place(i, j)[1])
            bend = abs(x - n // 2)
            lines.append("%s %.6f\t%+.5e  %s%s" % ("v" if i % 3 else "v ", x, y, repr(-bend), "  # fold" if bend == 0 else ""))
    for side in (0, 1):
        lines += ["vt %.4f %.4f" % (i / n + side, j / n) for j in range(n + 1) for i in range(n + 1)]
    lines += ["vn -0.7071 0.0000 0.7071", "vn 0.7071 0.0000 0.7071"]
    for side, words in ((0, ["g left", "usemtl skin", "s 1"]), (1, ["g right arm", "usemtl metal", "s off", "custom 1.50"])):
        lines += words
        for j in range(n):
            for i in range(n // 2):
                a = j * (n + 1) + i + side * (n // 2) + 1
                corner = lambda v: "%d/%d/%d" % (v, v + side * (n + 1) ** 2, side + 1)
                quad = [corner(v) for v in (a, a + 1, a + n + 2, a + n + 1)]
                if (i + j) % 3:
                    lines.append("f " + " ".join(quad))
                else:
                    lines += ["f " + " ".join(quad[:3]), "f %s %s \\" % (quad[0], quad[2]), "  " + quad[3] + "  # continued"]
    lines += ["l 1 2 3", "p 4", "# end"]
    return line_end.join(lines).encode() + b"  "


def ply_file(encoding, vertices, faces, number="double"):
    """A PLY with comments, extra elements, properties and lists, and with normals; the numbers are those of `encoding`."""
    header = ("ply\nformat %s 1.0\ncomment made  here\nobj_info num_cols 3\nelement camera 1\nproperty float x\nproperty float y\n"
              "element vertex %d\nproperty uchar red\nproperty %s x\nproperty %s y\nproperty %s z\nproperty list uchar short seen_by\n"
              "property float nx\nproperty float ny\nproperty float nz\nelement face %d\nproperty int part\n"
              "property list uchar uint vertex_indices\nproperty list uchar float texcoord\nelement edge 1\nproperty int a\n"
              "end_header\n" % (encoding, len(vertices), number, number, number, len(faces)))
    kind = "d" if number == "double" else "f"
    rows = [[("f", .5), ("f", 2)]]
    for k, v in enumerate(vertices):
        rows.append([("B", k % 256), *((kind, x) for x in v), ("B", 2), ("h", -k % 100), ("h", 7), ("f", 0), ("f", 0), ("f", 1)])
    for k, f in enumerate(faces):
        rows.append([("i", k), ("B", 3), *(("I", v) for v in f), ("B", 2), ("f", .25), ("f", 1)])
    rows.append([("i", 3)])
    if encoding == "ascii":
        text = lambda code, x: repr(float("%.8g" % x) if code == "f" else x)
        body = "".join(" ".join(text(*value) for value in row) + "\n" for row in rows).encode()
    else:
        order = "<" if encoding == "binary_little_endian" else ">"
        body = b"".join(struct.pack(order + code, x) for row in rows for code, x in row)
    return header.encode() + body


def off_file(keyword, vertices, faces, data=""):
    rows = ["# made here", keyword, "%d %d 0  # counts" % (len(vertices), len(faces)), ""]
    rows += ["%r  %r %r %s" % (*v, data) for v in vertices] + ["3  %d %d %d 0.50 .5 1" % f for f in faces]
    return ("\r\n".join(rows) + "\r\n# end\r\n").encode()


def binary_off(keyword, vertices, faces):
    counts = struct.pack(">3i", len(vertices), len(faces), 0)
    rows = [struct.pack(">3f", *v) + (struct.pack(">3f", 0, 0, 1) if "N" in keyword else b"") for v in vertices]
    rows += [struct.pack(">5i", 3, *f, 3) + struct.pack(">3f", 1, .5, 0) for f in faces]
    return keyword.encode() + b" BINARY\n" + counts + b"".join(rows)


class Preserve(CommandTest):
    def put(self, name, data):
        (self.folder / name).write_bytes(data)

    def get(self, name):
        return (self.folder / name).read_bytes()

    def kept(self, source, *options):
        """(output, standard error, report) of a run on the file that must preserve it."""
        target = "out" + (self.folder / source).suffix
        report, err = self.run_command(source, "-o", target, "-q", "--report", "-", *options)
        report = json.loads(report)
        self.assertIs(report["output"]["preserved"], True, err)
        self.assertEqual(report["parameters"]["preserve"], "on")
        self.assertEqual(report["input"]["connectivity_sha256"], report["output"]["connectivity_sha256"])
        return self.get(target), err, report

    def test_without_motion_the_output_is_the_input(self):
        vertices, faces = irregular_torus(8, 6)
        files = {"artist.obj": artists_obj(), "unix.obj": artists_obj(line_end="\n"), "mac.obj": artists_obj(line_end="\r"),
                 "bom.obj": b"\xef\xbb\xbf" + artists_obj(), "t.off": off_file("OFF", vertices, faces),
                 "c.off": off_file("COFF", vertices, faces, "255 0 0  255"), "n.off": off_file("NOFF", vertices, faces, "0 0 1.0"),
                 "st.off": off_file("STOFF", vertices, faces, "0.50 1"), "b.off": binary_off("OFF", vertices, faces),
                 "bn.off": binary_off("NOFF", vertices, faces)}
        for encoding in ("ascii", "binary_little_endian", "binary_big_endian"):
            for number in ("float", "double"):
                files["%s_%s.ply" % (encoding, number)] = ply_file(encoding, vertices, faces, number)
        files["int.ply"] = (b"ply\nformat ascii 1.0\nelement vertex 4\nproperty int x\nproperty int y\nproperty int z\nelement face 2\n"
                            b"property list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
        for name, data in files.items():
            with self.subTest(name=name):
                self.put(name, data)
                count = self.report(name, "--check")["input"]["vertices"]
                self.write("all", "\n".join(map(str, range(count))))
                output, _, report = self.kept(name, "--fix", "all")
                self.assertTrue(output == data)
                self.assertEqual(report["output"]["sha256"], report["input"]["sha256"])

    def test_a_box_of_squares_has_no_digit_to_change(self):
        n, size = 4, 1.9
        ids, faces = {}, []
        for axis in range(3):
            for side in (0, n):
                for i in range(n):
                    for j in range(n):
                        square = []
                        for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                            place = [side] * 3
                            place[(axis + 1) % 3], place[(axis + 2) % 3] = a, b
                            square.append(ids.setdefault(tuple(place), len(ids) + 1))
                        faces.append(square if side else square[::-1])
        lines = ["v %r %r %r" % tuple(size * c / n for c in place) for place in ids] + ["f %d %d %d %d" % tuple(f) for f in faces]
        text = "\n".join(lines) + "\n"
        self.write("box.obj", text)
        report = self.report("box.obj", "-o", "out.obj", "-q")
        self.assertEqual((self.folder / "out.obj").read_text(), text)
        self.assertEqual(report["geometry"]["displacement"]["max"], 0)

    def test_of_an_artists_file_only_numbers_of_v_and_vn_change(self):
        data = artists_obj()
        self.put("artist.obj", data)
        output, err, report = self.kept("artist.obj")
        self.assertGreater(report["geometry"]["displacement"]["max"], .01)
        self.assertNotIn("not kept", err)
        self.assertEqual(sorted(w["code"] for w in report["warnings"]), ["carried_along", "polygons_triangulated", "values_moved"])
        before, after = data.split(b"\r\n"), output.split(b"\r\n")
        self.assertEqual(len(before), len(after))
        changed = [(a, b) for a, b in zip(before, after) if a != b]
        self.assertGreater(len(changed), 20)
        for a, b in changed:
            self.assertEqual(re.sub(NUMBER, b"", a.replace(b"vn", b"v")), re.sub(NUMBER, b"", b.replace(b"vn", b"v")))
            self.assertIn(a[:2], (b"v ", b"vn"))
            self.assertEqual(a[:2], b[:2])

    def test_pasting_the_coordinates_of_a_new_file_gives_the_same(self):
        data = re.sub(rb"vn .*\r\n|/[12](?=[ \r])", b"", artists_obj())  # without normals
        self.put("artist.obj", data)
        output, _, _ = self.kept("artist.obj")
        self.run_command("artist.obj", "-o", "new.obj", "-q", "--preserve", "off")
        places = iter(line.split()[1:4] for line in self.get("new.obj").splitlines() if line.startswith(b"v "))
        pasted = []
        for line in data.split(b"\r\n"):
            if line.startswith(b"v "):
                parts = re.split(rb"(\s+)", line)
                for k, number in zip((2, 4, 6), next(places)):
                    if float(parts[k]) != float(number):
                        parts[k] = number
                line = b"".join(parts)
            pasted.append(line)
        self.assertEqual(output, b"\r\n".join(pasted))

    def test_hard_edges_stay_hard_and_normals_are_those_of_the_faces(self):
        self.put("artist.obj", artists_obj())
        output, _, _ = self.kept("artist.obj")
        normals = [tuple(map(float, line.split()[1:])) for line in output.splitlines() if line.startswith(b"vn")]
        for normal, side in zip(normals, (-1, 1)):  # the sheet is flat on both sides of its fold
            for x, expected in zip(normal, (side * sqrt(.5), 0, sqrt(.5))):
                self.assertAlmostEqual(x, expected, 3)

    def test_ply_keeps_all_else_in_every_encoding(self):
        vertices, faces = irregular_torus(12, 8)
        count = len(vertices)
        for encoding in ("ascii", "binary_little_endian", "binary_big_endian"):
            for number in ("float", "double"):
                with self.subTest(encoding=encoding, number=number):
                    data = ply_file(encoding, vertices, faces, number)
                    self.put("in.ply", data)
                    output, err, report = self.kept("in.ply")
                    self.assertNotIn("not kept", err)
                    self.assertGreater(report["geometry"]["displacement"]["max"], .01)
                    head, old = data.split(b"end_header\n")
                    new_head, new = output.split(b"end_header\n")
                    self.assertEqual(new_head, head)
                    size = 4 if number == "float" else 8
                    if encoding == "ascii":
                        old, new = old.split(b"\n"), new.split(b"\n")
                        self.assertEqual(len(new), len(old))
                        self.assertEqual(old[:1] + old[1 + count:], new[:1] + new[1 + count:])
                        for a, b in zip(old[1:1 + count], new[1:1 + count]):
                            a, b = a.split(b" "), b.split(b" ")
                            self.assertEqual(a[:1] + a[4:7], b[:1] + b[4:7])
                    else:
                        row = 1 + 3 * size + 5 + 12
                        self.assertEqual(len(new), len(old))
                        self.assertEqual(old[:8] + old[8 + count * row:], new[:8] + new[8 + count * row:])
                        for k in range(8, 8 + count * row, row):
                            list_at = k + 1 + 3 * size
                            self.assertEqual(old[k:k + 1] + old[list_at:list_at + 5], new[k:k + 1] + new[list_at:list_at + 5])

    def test_floats_round_the_coordinates_of_a_new_file(self):
        vertices, faces = irregular_torus(12, 8)
        count = len(vertices)
        self.put("in.ply", ply_file("binary_little_endian", vertices, faces, "float"))
        output, _, _ = self.kept("in.ply")
        self.run_command("in.ply", "-o", "new.off", "-q")
        exact = [list(map(float, line.split()[:3])) for line in self.get("new.off").splitlines()[2:2 + count]]
        body = output.split(b"end_header\n")[1][8:]
        for k, place in enumerate(exact):
            self.assertEqual(body[30 * k + 1:30 * k + 13], struct.pack("<3f", *place))

    def test_what_cannot_be_preserved_is_said_once(self):
        self.put("artist.obj", artists_obj())
        self.put("int.ply", b"ply\nformat ascii 1.0\nelement vertex 5\nproperty int x\nproperty int y\nproperty int z\nelement face 4\n"
                            b"property list uchar int vertex_index\nend_header\n0 0 0\n9 0 0\n9 9 0\n0 9 0\n1 1 0\n3 0 1 4\n3 1 2 4\n"
                            b"3 2 3 4\n3 3 0 4\n")
        for source, target, options, says in (
                ("artist.obj", "out.obj", ["--connectivity", "flip"], "--connectivity"),
                ("artist.obj", "out.ply", [], "the input is obj and the output ply"),
                ("int.ply", "out.ply", [], "cannot hold")):
            with self.subTest(target=target, options=options):
                report, err = self.run_command(source, "-o", target, "-q", "--report", "-", *options)
                self.assertEqual("not_preserved" in report, source == "int.ply")  # same format, same faces
                self.assertIs(json.loads(report)["output"]["preserved"], False)
                report, err = self.run_command(source, "-o", target, "-q", "--report", "-", "--preserve", "on", *options)
                warnings = [w["message"] for w in json.loads(report)["warnings"] if w["code"] == "not_preserved"]
                self.assertEqual(len(warnings), 1)
                self.assertIn(says, warnings[0])

    def test_what_simple_readers_would_misread_is_kept_only_when_asked_for(self):
        self.write("dart.obj", "v 0 0 0\nv 2 1 0\nv 0 2 0\nv .5 1 0\nf 1 2 3 4\n")
        self.write("lines.obj", "v 0 0 \\\n 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for name, says in (("dart.obj", "concave polygons"), ("lines.obj", "continued")):
            report, err = self.run_command(name, "-o", "new.obj", "-q", "--report", "-")
            self.assertIs(json.loads(report)["output"]["preserved"], False)
            self.assertIn("new.obj: is a new file", err)
            self.assertIn(says, err)
            output, err, _ = self.kept(name, "--preserve", "on")
            self.assertNotIn("new file", err)
            self.assertEqual(output, self.get(name))

    def test_textures_swim_unless_they_are_reprojected(self):
        data = artists_obj()
        self.put("artist.obj", data)
        swims, _, _ = self.kept("artist.obj")
        output, _, report = self.kept("artist.obj", "--reproject-uv", "on")
        self.assertEqual(report["parameters"]["reproject_uv"], "on")
        without = lambda text: [line for line in text.split(b"\r\n") if not line.startswith(b"vt")]
        self.assertEqual(without(output), without(swims))
        read = lambda text, word: [tuple(map(float, line.split()[1:4])) for line in text.split(b"\r\n") if line.startswith(word + b" ")]
        before, places, old = read(data, b"v"), read(output, b"v"), read(data, b"vt")
        count, moved = len(places), 0
        for k, (s, t) in enumerate(read(output, b"vt")):
            v = k % count
            on_side = (v % 9 <= 4) if k < count else (v % 9 >= 4)
            if not on_side or before[v] == places[v]:
                self.assertEqual((s, t), old[k])
                continue
            moved += (s, t) != old[k]
            if 0 < v % 9 < 8 and before[v][0] != places[v][0]:  # s is about x: off by less than the move
                drift = lambda x, s: abs(s - (k >= count) - x / 8)
                self.assertLess(drift(places[v][0], s), drift(before[v][0], old[k][0]) + .05)
        self.assertGreater(moved, 20)
        self.refused(2, "artist.obj", "-o", "o.obj", "--reproject-uv", "on", "--connectivity", "flip", says="--reproject-uv")
        self.refused(2, "artist.obj", "-o", "o.ply", "--reproject-uv", "on", says="--reproject-uv")

    def test_off_writes_a_new_file(self):
        self.put("artist.obj", artists_obj())
        report = self.report("artist.obj", "-o", "out.obj", "-q", "--preserve", "off")
        self.assertIs(report["output"]["preserved"], False)
        self.assertEqual(report["parameters"]["preserve"], "off")
        self.assertEqual([w["code"] for w in report["warnings"]], ["values_moved", "attributes_not_kept", "polygons_triangulated"])
        for word in (b"mtllib sheet.mtl skin.mtl", b"usemtl metal", b"g right arm", b"s off"):
            self.assertIn(word, self.get("out.obj"))
        self.refused(2, "artist.obj", "-o", "o.obj", "--preserve", "maybe", says="expected on|off")
        self.refused(2, "artist.obj", "--check", "--preserve", "on", says="--preserve")

    def test_quadrilaterals_that_become_concave_are_told(self):
        n, told_at_all = 12, 0
        quads = [(a + 1, a + 2, a + n + 3, a + n + 2) for j in range(n) for a in range(j * (n + 1), j * (n + 1) + n)]

        def concave(name, count):
            x = [tuple(map(float, line.split()[1:4])) for line in self.get(name).decode().splitlines() if line.startswith("v ")]
            turn = lambda a, b, c: (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            return sum(any(turn(*(x[q[(k + i) % 4] - 1] for i in range(3))) < 0 for k in range(4)) for q in quads[:count])

        for seed in range(6):
            shift = random.Random(seed).uniform
            points = [(i + shift(-.3, .3), 4 * (j + shift(-.3, .3)), 0) for j in range(n + 1) for i in range(n + 1)]
            vertices = ["v %r %r %r\n" % p for p in points]
            self.put("quads.obj", "".join(vertices + ["f %d %d %d %d\n" % q for q in quads]).encode())
            report = self.kept("quads.obj")[2]
            angles = [report[when]["polygon_angles"] for when in ("before", "after")]
            self.assertGreater(min(angles[0]["min"], angles[1]["min"]), 0)
            self.assertLess(max(angles[0]["max"], angles[1]["max"]), 180)
            output = self.get("out.obj")
            self.run_command("quads.obj", "-o", "repaired.obj", "-q", "--repair")
            self.assertEqual(self.get("repaired.obj"), output)
            few = n * n // 2 - 1
            triangles = [t for a, b, c, d in quads[few:] for t in ((a, b, c), (a, c, d))]
            faces = ["f " + " ".join(map(str, face)) + "\n" for face in quads[:few] + triangles]
            self.put("few.obj", "".join(vertices + faces).encode())
            report = self.kept("few.obj", "-L", "3x")[2]
            told = [w["message"] for w in report["warnings"] if w["code"] == "polygons_concave"]
            after, before = concave("out.obj", few), concave("few.obj", few)
            self.assertEqual(len(told), int(after > before), (before, after))
            if told:
                self.assertIn("%d polygons are concave, %d before" % (after, before), told[0])
            told_at_all += len(told)
        self.assertGreater(told_at_all, 0)

    def test_few_quadrilaterals_are_moved_as_the_triangles_they_are(self):
        n, shift = 12, random.Random(4).uniform
        points = [(i + j / 2 + shift(-.2, .2), j + shift(-.2, .2), 0) for j in range(n + 1) for i in range(n + 1)]
        quads = [(a + 1, a + 2, a + n + 3, a + n + 2) for j in range(n) for a in range(j * (n + 1), j * (n + 1) + n)]

        def moved(count):
            triangles = [triangle for a, b, c, d in quads[count:] for triangle in ((a, b, d), (b, c, d))]
            lines = ["v %r %r %r\n" % p for p in points]
            lines += ["f " + " ".join(map(str, face)) + "\n" for face in quads[:count] + triangles]
            self.put("some.obj", "".join(lines).encode())
            self.run_command("some.obj", "-o", "out.obj", "-q")
            return [float(x) for line in self.get("out.obj").splitlines() if line.startswith(b"v ") for x in line.split()[1:]]

        difference = lambda x, y: max(abs(a - b) for a, b in zip(x, y))
        triangles = moved(0)
        self.assertLess(difference(moved(n * n // 2 - 1), triangles), 1e-6)
        self.assertGreater(difference(moved(n * n // 2), triangles), .1)

    def test_an_input_that_changes_meanwhile_is_refused(self):
        data = off_file("OFF", *irregular_torus(240, 100))
        self.put("in.off", data)
        process = self.start_until(b"step", "in.off", "-o", "out.off")
        self.put("in.off", data.replace(b"made here", b"made there"))
        _, err = process.communicate()
        self.assertEqual(process.returncode, 3, err)
        self.assertIn(b"hooke-remesh: error: in.off: has changed since it was read; expected the same bytes", err)
        self.assertEqual(self.files(), ["good.obj", "in.off"])


if __name__ == "__main__":
    unittest.main()

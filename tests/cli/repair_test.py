"""--repair and --weld: what is refused without them, what they change, what they tell, and ids that are the file's."""

import json
import random
import unittest
from collections import Counter

from command import DATA, TETRAHEDRON, CommandTest, irregular_torus, ply_text, read_mesh, rows_of

QUIET = ["-q", "--effort", "fast"]


def obj(vertices, faces):
    return "".join("v %r %r %r\n" % tuple(map(float, v)) for v in vertices) + "".join(
        "f %s\n" % " ".join(str(v + 1) for v in face) for face in faces)


def is_oriented_manifold(faces):
    """Every directed edge once, and the faces about each vertex are one fan."""
    directed = Counter((f[k], f[(k + 1) % 3]) for f in faces for k in range(3))
    if max(directed.values()) > 1:
        return False
    links = {}
    for f in faces:
        for k in range(3):
            links.setdefault(f[k], []).append((f[(k + 1) % 3], f[(k + 2) % 3]))
    for link in links.values():
        follows = dict(link)
        starts = [a for a in follows if a not in follows.values()] or [link[0][0]]
        at, seen = starts[0], 0
        while at in follows and seen < len(link):
            at, seen = follows[at], seen + 1
        if len(starts) > 1 or seen != len(link):
            return False
    return True


class Repair(CommandTest):
    def setUp(self):
        super().setUp()
        self.vertices, self.faces = irregular_torus(16, 8)

    def repaired(self, name, *options, codes):
        """The report of a run with --repair whose changes have these codes, and the output."""
        out, err = self.run_command(name, "-o", "out.obj", "--repair", *options, *QUIET, "--report", "-")
        report = json.loads(out)
        self.assertEqual([r["code"] for r in report["repairs"]], codes)
        for change in report["repairs"]:
            self.assertIn("hooke-remesh: warning: %s\n" % change["message"], err)
            self.assertIn(" %d " % change["count"], change["message"])
        vertices, faces = read_mesh(self.folder / "out.obj")
        self.assertTrue(is_oriented_manifold(faces))
        return report, vertices, faces

    def test_each_fault_is_refused_with_the_option_that_mends_it(self):
        torus, n = self.faces, len(self.vertices)
        apart = [v for f in torus for v in (self.vertices[k] for k in f)]
        far = [(x + 3, y, z) for x, y, z in self.vertices]
        touching = torus + [tuple(5 if v == 0 else v + n - 1 for v in f) for f in torus]
        fin = torus + [(torus[0][0], torus[0][1], n)]
        for vertices, faces, code, count, says in (
                (self.vertices, torus + torus[:7], "duplicate_faces_dropped", 7, "faces listed twice (7): "),
                (self.vertices, torus + [(4, 4, 9)], "faces_dropped", 1, "faces that use a vertex twice (1): vertices 4, faces 256 (line 385)"),
                (self.vertices, [f[::-1] if k % 9 == 3 else f for k, f in enumerate(torus)], "faces_flipped", 29,
                 "edges whose two faces are oriented against each other"),
                (self.vertices + far[1:], touching, "vertices_split", 1, "vertices in which separate parts only touch (1): vertices 5"),
                (self.vertices + [(0, 0, 3)], fin, "edges_cut", 1, "edges with three or more faces (1): edges ")):
            with self.subTest(code=code):
                self.write("bad.obj", obj(vertices, faces))
                message = self.refused(4, "bad.obj", "-o", "out.obj", says=says)
                kept = ", which cuts the sheets apart, or --keep non-manifold, which keeps them joined" if code in ("edges_cut", "vertices_split") else ""
                self.assertTrue(message.endswith(", or use --repair%s\n" % kept), message)
                report, _, _ = self.repaired("bad.obj", "--accept-invalid", codes=[code])
                self.assertEqual(report["repairs"][0]["count"], count)
        self.write("apart.obj", obj(apart, [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(torus))]))
        _, err = self.run_command("apart.obj", "-o", "out.obj", "-q")
        self.assertIn("every one is on its own; --repair joins them", err)
        report, vertices, _ = self.repaired("apart.obj", codes=["vertices_welded"])
        self.assertEqual(len(vertices), n)
        self.assertEqual(report["input"]["boundary_loops"], 0)

    def test_a_mesh_without_faults_gives_the_same_bytes(self):
        for option in ([], ["--repair"], ["--weld", "0"]):
            self.run_command(DATA / "patch.obj", "-o", "out%d.obj" % len(option), *QUIET, *option)
        self.assertEqual(len({(self.folder / ("out%d.obj" % k)).read_bytes() for k in range(3)}), 1)

    def test_only_adapt_collapses_edges_without_length(self):
        for v, w in ((self.faces[k][0], self.faces[k][1]) for k in range(0, len(self.faces), 40)):
            self.vertices[w] = self.vertices[v]
        self.write("bad.obj", obj(self.vertices, self.faces))
        report = self.report("bad.obj", "-o", "out.obj", "--connectivity", "adapt", "--map", "map.csv", "-q")
        (change,) = report["repairs"]
        self.assertEqual(change["code"], "edges_collapsed")
        self.assertEqual(report["input"]["vertices"], len(self.vertices) - change["count"])
        self.assertEqual(report["before"]["degenerate_faces"], 0)
        self.assertGreater(report["after"]["min_angle"]["min"], 20)
        rows = (self.folder / "map.csv").read_text().splitlines()
        self.assertEqual(len(rows), report["output"]["vertices"])
        kept = self.report("bad.obj", "-o", "out.obj", "-q")
        self.assertEqual(kept["repairs"], [])
        self.assertEqual(kept["output"]["vertices"], len(self.vertices))

    def test_edges_of_a_rounding_are_collapsed_or_told(self):
        v, w, _ = self.faces[40]
        fresh = len(self.vertices)
        beside = tuple(a + 1e-7 * (b - a) for a, b in zip(self.vertices[v], self.vertices[w]))
        faces = []
        for f in self.faces:  # the edge is split, next to one of its ends
            ends = (v, w) if v in f and w in f else (None,)
            faces += [tuple(fresh if u == end else u for u in f) for end in ends]
        self.write("cut.obj", obj(self.vertices + [beside], faces))
        report = self.report("cut.obj", "-o", "out.obj", "--connectivity", "adapt", "-q")
        self.assertEqual([change["code"] for change in report["repairs"]], ["edges_collapsed"])
        self.write("fixed.txt", "%d\n%d\n" % (v, fresh))
        report = self.report("cut.obj", "-o", "out.obj", "--fix", "fixed.txt", "-q")
        (warning,) = [w for w in report["warnings"] if w["code"] == "edges_without_length"]
        self.assertIn("1 of its edges are no longer than a rounding", warning["message"])
        report = self.report("cut.obj", "-o", "out.obj", "--weld", "1e-05%", "-q")
        self.assertEqual([change["code"] for change in report["repairs"]], ["vertices_welded", "faces_dropped"])
        self.assertEqual([w for w in report["warnings"] if w["code"] == "edges_without_length"], [])

    def test_what_is_left_is_refused_without_that_advice(self):
        self.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 2 3\n")
        message = self.refused(4, "bad.obj", "-o", "out.obj", "--repair", says="no face with an area")
        self.assertNotIn("--repair", message)

    def test_a_refusal_says_what_was_changed_before(self):
        self.write("bad.obj", obj(self.vertices, self.faces))
        message = self.refused(4, "bad.obj", "-o", "out.obj", "--weld", "9", says="bad.obj: no faces")
        self.assertTrue(message.endswith("; this is after the repair: vertices_welded 127, faces_dropped 256\n"), message)

    def test_places_of_changes_are_told_up_to_five(self):
        self.write("bad.obj", obj(self.vertices, self.faces + self.faces[:7]))
        report, _, _ = self.repaired("bad.obj", codes=["duplicate_faces_dropped"])
        self.assertEqual(report["repairs"][0]["message"],
                         "bad.obj: 7 faces dropped whose vertices another face has: faces 256 (line 385), 257 (line 386), "
                         "258 (line 387), 259 (line 388), 260 (line 389) ...")

    def test_welding_takes_a_distance(self):
        rng = random.Random(2)
        loose = [tuple(x + 1e-4 * rng.random() for x in self.vertices[v]) for f in self.faces for v in f]
        self.write("loose.obj", obj(loose, [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(self.faces))]))
        for distance in ("2e-4", "0.01%"):
            report = self.report("loose.obj", "--check", "--weld", distance, "-q")
            self.assertEqual([r["code"] for r in report["repairs"]], ["vertices_welded"])
            self.assertEqual(report["input"]["vertices"], len(self.vertices))
            self.assertEqual(report["parameters"]["weld"], distance)
        report = self.report("loose.obj", "--check", "--weld", "1e-7", "-q")
        self.assertEqual(report["repairs"], [])

    def test_holes_and_crumbs(self):
        crumb = [(x / 100 + 9, y / 100, z / 100) for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0))]
        n = len(self.vertices)
        self.write("bad.obj", obj(self.vertices + crumb, self.faces[:40] + self.faces[41:] + [(n, n + 1, n + 2)]))
        report, vertices, faces = self.repaired("bad.obj", "--drop-components", "1%", "--fill-holes", "3",
                                                codes=["components_dropped", "holes_filled", "vertices_dropped"])
        self.assertEqual((len(vertices), len(faces)), (n, len(self.faces)))
        self.assertEqual(report["input"]["boundary_loops"], 0)
        self.assertEqual(report["parameters"]["fill_holes"], 3)

    def test_a_repair_that_only_leaves_holes_keeps_the_file(self):
        vertices = "".join("v %d %d 0\n" % (x, y) for y in range(3) for x in range(3))
        self.write("square.obj", "# mine\n" + vertices + "".join(
            "f %d %d %d %d\n" % (i, i + 1, i + 4, i + 3) for i in (1, 2, 4, 5)))
        self.run_command("square.obj", "-o", "out.obj", "--repair", "--fill-holes", "3")
        self.assertTrue((self.folder / "out.obj").read_text().startswith("# mine\n"))

    def test_lists_of_vertices_have_the_ids_of_the_file(self):
        """Every face has vertices of its own: 3 f + k is corner k of face f."""
        vertices = [self.vertices[v] for f in self.faces for v in f]
        self.write("apart.obj", obj(vertices + [(50, 50, 50)], [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(self.faces))]))
        ids = [0, 100, 333, 767]
        self.write("ids", "".join("%d\n" % i for i in ids))
        self.run_command("apart.obj", "-o", "out.obj", "--repair", "--fix", "ids", *QUIET)
        moved = set(read_mesh(self.folder / "out.obj")[0])
        for i in ids:
            self.assertIn(vertices[i], moved)
        self.assertFalse(set(vertices) <= moved)
        self.write("ids", "0\n768\n")
        self.refused(3, "apart.obj", "-o", "x.obj", "--repair", "--fix", "ids", says="ids: vertex 768 was dropped in the repair")
        self.write("lengths", "".join("%r\n" % (.2 + .01 * abs(v[0])) for v in vertices + [(1, 0, 0)]))
        report = self.report("apart.obj", "-o", "out.obj", "--repair", "--sizing", "lengths", "-L", "sizing", "--gradation", "off", *QUIET)
        self.assertLess(abs(report["parameters"]["L_max"] - .2 - .01 * max(abs(v[0]) for v in vertices)), 1e-12)
        self.run_command("apart.obj", "-o", "out.obj", "--repair", "--map", "map", *QUIET)
        rows = [line.split() for line in (self.folder / "map").read_text().splitlines()]
        self.assertEqual(len(rows), len(self.vertices))
        firsts = {vertices.index(v) for v in self.vertices}
        self.assertEqual({int(row[0]) for row in rows}, firsts)
        for row, (x, y, z) in zip(rows, read_mesh(self.folder / "out.obj")[0]):
            corners = [vertices[3 * int(row[1]) + k] for k in range(3)]
            place = [sum(float(w) * c[axis] for w, c in zip(row[2:], corners)) for axis in range(3)]
            self.assertLess(max(abs(a - b) for a, b in zip(place, (x, y, z))), .2)

    def test_data_of_vertices_and_faces_goes_along(self):
        data = ["%g 1" % v for v in range(len(self.vertices))]
        text = obj(self.vertices, self.faces + self.faces[:1])
        text = "".join("vt %s\n" % d for d in data) + "".join(
            line if line[0] == "v" else "f " + " ".join("%s/%s" % (w, w) for w in line.split()[1:]) + "\n"
            for line in text.splitlines(True))
        self.write("bad.obj", text)
        self.run_command("bad.obj", "-o", "out.obj", "--repair", *QUIET)
        lines = (self.folder / "out.obj").read_text().splitlines()
        self.assertEqual([line[3:] for line in lines if line.startswith("vt ")], data)
        self.write("in.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                   "$Elements\n3\n1 2 2 5 1 1 2 3\n2 2 2 5 1 1 2 3\n3 2 2 8 2 1 4 3\n$EndElements\n")
        self.run_command("in.msh", "-o", "out.msh", "--repair", *QUIET)
        rows = (self.folder / "out.msh").read_text().splitlines()
        self.assertEqual([row.split()[3] for row in rows if len(row.split()) == 8], ["5", "8"])

    def write_cut(self, names, values_of):
        """Two squares side by side that touch; values_of(x, y, side) of their vertices. Returns vertices and faces."""
        n = 6
        grid = [(i / n, j / n) for j in range(n + 1) for i in range(n + 1)]
        quads = [j * (n + 1) + i for j in range(n) for i in range(n)]
        faces = [f for q in quads for f in ((q, q + 1, q + n + 2), (q, q + n + 2, q + n + 1))]
        faces += [tuple(v + len(grid) for v in f) for f in faces]
        vertices = [(x + side, y, 0) for side in (0, 1) for x, y in grid]
        values = [values_of(x, y, side) for side in (0, 1) for x, y in grid]
        self.write("cut.ply", ply_text(names, vertices, faces, values))
        return values, faces

    def warnings_of(self, *arguments):
        return {w["code"]: w["message"] for w in self.report(*arguments, "--repair", *QUIET)["warnings"]}

    def test_a_texture_that_was_cut_open_stays_cut(self):
        for names in (("s", "t", "heat"), ("texture_u", "texture_v", "heat")):
            values, faces = self.write_cut(names, lambda x, y, side: (x + 2 * side, y, side))
            for mode in ("fixed", "adapt"):
                told = self.warnings_of("cut.ply", "-o", "out.obj", "--connectivity", mode, "-L", ".8x")
                self.assertRegex(told["merged_values"], r"cut\.ply: 7 vertices had other values .*: heat$")
                self.assertNotIn("texture_seams", told)
                of = {"v": [], "vt": [], "f": []}
                for line in (self.folder / "out.obj").read_text().splitlines():
                    word, *rest = line.split()
                    if word in of:
                        of[word].append(rest)
                self.assertEqual({row[0] for row in of["vt"]} >= {"1", "2"}, True)
                for f, face in enumerate(of["f"]):
                    corners = [tuple(int(k) - 1 for k in corner.split("/")[:2]) for corner in face]
                    if mode == "adapt":
                        shifts = {round(float(of["vt"][t][0]) - float(of["v"][v][0]), 9) for v, t in corners}
                        self.assertEqual(len(shifts), 1, face)
                        self.assertTrue(shifts <= {0, 1}, shifts)
                    else:
                        self.assertEqual([tuple(map(float, of["vt"][t])) for _, t in corners], [values[v][:2] for v in faces[f]])
            told = self.warnings_of("cut.ply", "-o", "out.ply")
            self.assertRegex(told["texture_seams"], "texture coordinates of 7 vertices that were merged .*; OBJ holds both")
            kept = rows_of(self.folder / "out.ply")
            self.assertEqual([row[:2] for row in kept], [v[:2] for n, v in enumerate(values) if n < 49 or v[0] > 2])

    def test_values_that_are_equal_are_no_others(self):
        nan = float("nan")
        for names, values_of, lost in (
                (("heat",), lambda x, y, side: (nan if y < .6 else x + side,), False),
                (("heat",), lambda x, y, side: (.1 * (x + side) + side * 1e-17,), False),
                (("id",), lambda x, y, side: (1e6 + (x < 1) * side,), True),
                (("id",), lambda x, y, side: (-2147483648 if x == y == 0 else 3 + side,), True),
                (("heat",), lambda x, y, side: (3.4e38 if x == y == 0 else 20 + 70.5 * side,), True),
                (("s", "t"), lambda x, y, side: ((x + side) * (1 + side * 1e-9), y), False),
                (("t",), lambda x, y, side: (x + 2 * side,), True)):
            self.write_cut(names, values_of)
            for output in ("out.ply", "out.obj"):
                told = self.warnings_of("cut.ply", "-o", output)
                self.assertEqual("merged_values" in told, lost, names)
                self.assertNotIn("texture_seams", told)
            self.assertNotIn("vt", (self.folder / "out.obj").read_text() if "s" not in names else "")
            self.assertEqual({len(row) for row in rows_of(self.folder / "out.ply")}, {len(names)})

    def test_a_mesh_that_is_inside_out_is_named(self):
        inside_out = TETRAHEDRON.replace("f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4", "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1")
        self.write("in.obj", inside_out)
        report = self.report("in.obj", "--check", "-q")
        self.assertEqual([w["code"] for w in report["warnings"]], ["inside_out"])
        self.assertIn("its volume is -0.1667; --repair turns it over", report["warnings"][0]["message"])
        report, _, _ = self.repaired("in.obj", codes=["components_turned"])
        self.assertGreater(report["input"]["volume"], 0)

    def test_a_seam_that_nearly_closes_is_named(self):
        n = len(self.vertices)
        first = {v for v in range(8)}  # a ring of the torus
        away = [f for f in self.faces if first & set(f) and any(v >= n - 8 for v in f)]
        vertices = self.vertices + [(x + 1e-6, y, z) for x, y, z in self.vertices[:8]]
        faces = [tuple(n + v if f in away and v < 8 else v for v in f) for f in self.faces]
        self.write("seam.obj", obj(vertices, faces))
        report = self.report("seam.obj", "--check", "-q")
        self.assertEqual([w["code"] for w in report["warnings"]], ["near_boundary"])
        self.assertIn("8 boundary vertices nearly lie on another", report["warnings"][0]["message"])
        report, vertices, _ = self.repaired("seam.obj", codes=["vertices_welded"])
        self.assertEqual(len(vertices), n)

    def test_cracks_whose_sides_do_not_match_are_named_with_what_keeps_them(self):
        def square(n, x):
            at = lambda i, j: (n + 1) * j + i
            return ([(x + i / n, j / n, .1 * (j / n) ** 2) for j in range(n + 1) for i in range(n + 1)],
                    [f for j in range(n) for i in range(n)
                     for f in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))])
        (left, faces), (right, others) = square(8, 0), square(16, 1)
        self.write("crack.obj", obj(left + right, faces + [tuple(v + len(left) for v in f) for f in others]))
        warned = lambda *options: {w["code"]: w["message"] for w in self.report("crack.obj", *options)["warnings"]}
        self.assertIn("8 boundary vertices lie within a hundredth of another boundary edge",
                      warned("-o", "out.obj")["cracks"])
        self.assertNotIn("cracks", warned("-o", "out.obj", "--boundary", "fixed"))

    def test_options_that_need_repair_or_make_no_sense(self):
        for option in (["--drop-components", "1%"], ["--fill-holes", "9"]):
            self.refused(2, "good.obj", "-o", "out.obj", *option, names=option[0], says="--repair only")
        for option in (["--weld", "-1"], ["--weld", "nan"], ["--weld", "1x"], ["--drop-components", "5"],
                       ["--drop-components", "0%"], ["--fill-holes", "2"], ["--fill-holes", "x"]):
            self.refused(2, "good.obj", "-o", "out.obj", "--repair", *option, names=option[0])


if __name__ == "__main__":
    unittest.main()

"""The mesh that is written: same vertices and faces, better triangles, constraints kept, the same on every run."""

import csv
import math
import random
import re
import unittest

from command import DATA, CommandTest, irregular_torus, read_mesh, write_off

SAMPLES = ["patch.obj", "blob.ply", "torus.off"]


def boundary_vertices(faces):
    directed = {edge for a, b, c in faces for edge in ((a, b), (b, c), (c, a))}
    return {v for a, b in directed if (b, a) not in directed for v in (a, b)}


class Result(CommandTest):
    def optimized(self, source, name, *options, **environment):
        self.run_command(source, "-o", name, "-q", *options, **environment)
        return read_mesh(self.folder / name)

    def test_samples_get_better_and_stay_what_they_are(self):
        for sample in SAMPLES:
            with self.subTest(sample=sample):
                report = self.report(DATA / sample, "-o", "out.off")
                before, after = report["before"], report["after"]
                self.assertGreater(after["min_angle"]["min"], 20)
                self.assertLess(after["edge_length"]["std"], .65 * before["edge_length"]["std"])
                self.assertEqual(report["geometry"]["flipped_faces"], 0)
                self.assertEqual((after["folded_edges"], after["self_intersections"]), (0, 0))
                self.assertLess(report["geometry"]["distance_to_input"]["rms_over_diagonal"], .005)
                self.assertEqual(read_mesh(self.folder / "out.off")[1], read_mesh(DATA / sample)[1])

    def test_lengths_of_the_input_keep_its_density(self):
        n = 16
        at = [i / n * (.1 + .9 * i / n) for i in range(n + 1)]  # ten times finer at the left
        points = [(at[i], j / n, 0) for i in range(n + 1) for j in range(n + 1)]
        faces = [face for i in range(n) for j in range(n) for a in (i * (n + 1) + j,)
                 for face in ((a, a + n + 1, a + n + 2), (a, a + n + 2, a + 1))]
        write_off(self.folder / "in.off", points, faces)
        shares = []
        for mode, gradation in (("fixed", None), ("flip", None), ("adapt", .3)):
            for sizing in ("off", "input"):
                with self.subTest(mode=mode, sizing=sizing):
                    report = self.report("in.off", "-o", "out.off", "--connectivity", mode, "--sizing", sizing)
                    self.assertEqual(report["parameters"]["gradation"], gradation if sizing == "input" else None)
                    if mode == "adapt":
                        result = read_mesh(self.folder / "out.off")[0]
                        shares.append(sum(x < .25 for x, _, _ in result) / len(result))
        even, as_given = shares
        self.assertGreater(as_given, 1.3 * even)

    def test_what_breaks_a_promise_is_not_written(self):
        run = (DATA / "torus.off", "-o", "out.off", "--connectivity", "adapt", "-L", "4x", "--effort", "fast",
               "--max-distance", "0.001%")
        err = self.refused(9, *run, names="torus.off: its result would break a promise, out.off was not written: ",
                           says="; try a smaller --length, --min-length for narrow parts, --connectivity flip, or --accept-invalid to write it nevertheless")
        self.assertRegex(err, r"the surface would be \S+ \(\S+ % of the size\) from that of \S+ at \S+ \S+ \S+, volume")
        report = self.report(*run, "--accept-invalid")
        self.assertIn("promise_broken", [w["code"] for w in report["warnings"]])
        self.assertFalse(report["promises"]["kept"])
        self.assertTrue((self.folder / "out.off").exists())

    def test_edges_get_shorter_where_they_would_cut_through_a_thin_part(self):
        around, rings = 24, 8
        points = [(0, 0, .05)]
        for k in range(1, rings):
            r, z = math.sin(math.pi * k / rings), .05 * math.cos(math.pi * k / rings)
            points += [(r * math.cos(2 * math.pi * i / around), r * math.sin(2 * math.pi * i / around), z)
                       for i in range(around)]
        points.append((0, 0, -.05))
        at = lambda k, i: 1 + (k - 1) * around + i % around
        faces = [(0, at(1, i), at(1, i + 1)) for i in range(around)]
        for k in range(1, rings - 1):
            faces += [t for i in range(around) for t in ((at(k, i), at(k + 1, i), at(k + 1, i + 1)),
                                                         (at(k, i), at(k + 1, i + 1), at(k, i + 1)))]
        faces += [(len(points) - 1, at(rings - 1, i + 1), at(rings - 1, i)) for i in range(around)]
        write_off(self.folder / "disc.off", points, faces)
        for length, is_short in ((.3, False), (2, True)):
            report = self.report("disc.off", "-o", "out.off", "--connectivity", "adapt", "-L", length)
            codes = [w["code"] for w in report["warnings"]]
            self.assertTrue(report["promises"]["kept"])
            self.assertEqual(report["promises"]["shortened_vertices"] > 0, is_short)
            self.assertEqual("lengths_shortened" in codes, is_short, codes)
            self.assertNotIn("face_count_missed", codes)

    def test_large_angles_that_come_for_small_ones_are_named(self):
        def globe(rings, around):
            points = [(0, 0, 1)]
            for k in range(1, rings):
                r, z = math.sin(math.pi * k / rings), math.cos(math.pi * k / rings)
                points += [(r * math.cos(2 * math.pi * i / around), r * math.sin(2 * math.pi * i / around), z)
                           for i in range(around)]
            points.append((0, 0, -1))
            at = lambda k, i: 1 + (k - 1) * around + i % around
            faces = [(0, at(1, i), at(1, i + 1)) for i in range(around)]
            for k in range(1, rings - 1):
                faces += [t for i in range(around) for t in ((at(k, i), at(k + 1, i), at(k + 1, i + 1)),
                                                             (at(k, i), at(k + 1, i + 1), at(k, i + 1)))]
            return points, faces + [(len(points) - 1, at(rings - 1, i + 1), at(rings - 1, i)) for i in range(around)]

        text = r"a twentieth of its faces has an angle of 1[45]\d degrees or more, before it was 9\d: .*flip or adapt"
        for mesh, is_told in ((globe(16, 48), True), (irregular_torus(40, 16), False)):
            write_off(self.folder / "in.off", *mesh)
            _, errors = self.run_command("in.off", "-o", "out.off", "--connectivity", "fixed")
            self.assertEqual(bool(re.search(text, errors.replace("\n", " "))), is_told, errors)

    def test_overhangs_of_a_terrain_are_named(self):
        n, noise = 40, random.Random(3)

        def height(x, y):
            outside = max(.3 - x, x - .6, .35 - y, y - .7, 0)
            return .1 * math.sin(4 * x) * math.cos(3 * y) + .3 * max(0, 1 - outside / .01)
        places = [tuple((k + .2 * noise.uniform(-1, 1) * (0 < i < n and 0 < j < n)) / n for k in (i, j))
                  for j in range(n + 1) for i in range(n + 1)]
        faces = [f for j in range(n) for i in range(n) for a in (j * (n + 1) + i,)
                 for f in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))]
        write_off(self.folder / "terrain.off", [(x, y, height(x, y)) for x, y in places], faces)
        report = self.report("terrain.off", "-o", "out.off", "--connectivity", "adapt")
        told = [w["message"] for w in report["warnings"] if w["code"] == "overhangs"]
        self.assertGreater(report["geometry"]["overhangs"], 0)
        self.assertIn("%d of its faces look down" % report["geometry"]["overhangs"], told[0])
        closest = self.report("terrain.off", "-o", "out.off", "--connectivity", "adapt", "--filter", "closest")
        self.assertLess(closest["geometry"]["overhangs"], report["geometry"]["overhangs"])

    def test_places_far_from_the_origin_are_told_to_the_size_of_edges(self):
        sides, far = 6, 5.3e6
        points = [(far + r * math.cos(2 * math.pi * k / 48), r * math.sin(2 * math.pi * k / 48), z)
                  for z in range(0, 60, 4) for r, k in ((.5, k) for k in range(48))]
        rows = len(points) // 48
        faces = [f for j in range(rows - 1) for k in range(48)
                 for a, b in ((j * 48 + k, j * 48 + (k + 1) % 48),)
                 for f in ((a, b, b + 48), (a, b + 48, a + 48))]
        write_off(self.folder / "tube.off", points, faces)
        _, errors = self.run_command("tube.off", "-o", "out.off", "--connectivity", "adapt", "-L", "1.2")
        places = re.findall(r"near (-?\d\S*) (-?\d\S*) (-?\d\S*?),? ", errors.replace("\n", " "))
        self.assertTrue(places, errors)
        for x, y, z in places:
            self.assertLess(abs(float(x) - far), 1)

    def test_walls_that_are_lost_are_named_with_what_keeps_them(self):
        sides, rows = 48, 6
        profile = [(10.2, 2 * row) for row in range(rows + 1)] + [(10, 2 * row) for row in range(rows, -1, -1)]
        n = len(profile)
        points = [(r * math.cos(2 * math.pi * k / sides), r * math.sin(2 * math.pi * k / sides), z)
                  for k in range(sides) for r, z in profile]
        faces = [f for k in range(sides) for j in range(n)
                 for a, b in ((k * n + j, k * n + (j + 1) % n),)
                 for c, d in (((a + n) % len(points), (b + n) % len(points)),) for f in ((a, c, d), (a, d, b))]
        write_off(self.folder / "pipe.off", points, faces)
        wall = r"walls or gaps are not as thick as in pipe\.off: where one is 0\.2, near .*, a side is 0\.\d+ off; "
        for length, options, advice in (
                ("6", (), "--max-distance 0.02 or a smaller --length"),
                ("6", ("--sizing", "curvature"), "--max-distance 0.02 or a smaller --length"),
                ("6", ("--max-distance", ".5"), "--max-distance 0.02 or a smaller --length"),
                ("6", ("--max-distance", ".02"), None),
                ("1.3", (), None)):
            with self.subTest(length=length, options=options):
                report = self.report("pipe.off", "-o", "out.off", "--connectivity", "adapt", "-L", length, *options)
                told = [w["message"] for w in report["warnings"] if w["code"] == "thin_walls"]
                self.assertEqual(len(told), advice is not None, told)
                if advice:
                    self.assertRegex(told[0], wall + advice + " keeps them better$")

    def test_flips_that_turn_faces_over_are_named_though_no_vertex_moves(self):
        # A sheet that lies on itself, a little above: its lower half and its upper half.
        n, noise = 14, random.Random(7)
        points = [((i if i < n / 2 else n - i) / n + (0 < i < n) * noise.uniform(-.03, .03), j / n,
                   (0 if i < n / 2 else .004) + noise.uniform(-.001, .001)) for j in range(n + 1) for i in range(n + 1)]
        faces = [f for j in range(n) for i in range(n) for q in (j * (n + 1) + i,)
                 for f in (((q, q + 1, q + n + 2), (q, q + n + 2, q + n + 1)) if noise.random() < .5 else
                           ((q, q + 1, q + n + 1), (q + 1, q + n + 2, q + n + 1)))]
        write_off(self.folder / "folded.off", points, faces)
        (self.folder / "all").write_text("".join("%d\n" % v for v in range(len(points))))
        report = self.report("folded.off", "-o", "out.off", "--connectivity", "flip", "--fix", "all")
        self.assertEqual(report["geometry"]["displacement"]["max"], 0)
        self.assertTrue(report["geometry"]["folded_faces"])
        self.assertIn("folded_faces", {w["code"] for w in report["warnings"]})

    def test_walls_that_bodies_share_are_not_said_to_be_turned(self):
        corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        faces = [f for a, b, c, d in sides for f in ((a, b, c), (a, c, d))]
        points = corners + [(2 - x, y, z) for x, y, z in corners]  # its mirror image shares a wall with it
        write_off(self.folder / "touching.off", points, faces + [(a + 8, c + 8, b + 8) for a, b, c in faces])
        for mode in ("fixed", "flip"):
            report = self.report("touching.off", "-o", "out.off", "--connectivity", mode)
            self.assertEqual(report["geometry"]["displacement"]["max"], 0)
            self.assertFalse(report["geometry"]["folded_faces"])
            self.assertNotIn("folded_faces", {w["code"] for w in report["warnings"]})

    def test_with_its_faces_kept_a_mesh_goes_back_rather_than_too_far(self):
        report = self.report(DATA / "torus.off", "-o", "out.off", "--max-distance", "0.001%")
        self.assertTrue(report["promises"]["kept"])
        self.assertEqual(report["promises"]["rescue"], "put_back")
        self.assertLess(report["geometry"]["distance_to_input"]["max_over_diagonal"], 1e-5)

    def test_a_mesh_that_went_back_is_not_said_to_be_at_rest(self):
        _, err = self.run_command(DATA / "torus.off", "-o", "out.off", "--max-distance", "1e-12%")
        err = " ".join(err.split())
        self.assertIn("the surface did not move", err)
        self.assertIn("nothing moved: vertices were put back", err)
        self.assertNotIn("equilibrium", err)

    def test_formats_hold_the_same_doubles(self):
        meshes = [self.optimized(DATA / "patch.obj", "out." + ext) for ext in ("obj", "ply", "off")]
        self.assertEqual(meshes[0], meshes[1])
        self.assertEqual(meshes[0], meshes[2])

    def test_format_option_beats_the_extension(self):
        self.run_command("good.obj", "-o", "out.obj", "--format", "off", "-q")
        self.assertTrue((self.folder / "out.obj").read_text().startswith("OFF"))

    def test_format_of_the_input_changes_nothing(self):
        vertices, faces = read_mesh(DATA / "patch.obj")
        write_off(self.folder / "same.off", vertices, faces)
        self.assertEqual(self.optimized("same.off", "a.off"), self.optimized(DATA / "patch.obj", "b.off"))

    def test_threads_change_no_byte(self):
        vertices, faces = irregular_torus(60, 24)
        write_off(self.folder / "torus.off", vertices, faces)
        for source in ("torus.off", DATA / "patch.obj"):
            for options in ([], ["--integrator", "damped", "--max-outer", 2]):
                with self.subTest(source=source, options=options):
                    self.optimized(source, "one.off", "-j", 1, *options)
                    self.optimized(source, "two.off", "-j", 2, *options)
                    self.assertEqual((self.folder / "one.off").read_bytes(),
                                     (self.folder / "two.off").read_bytes())

    def test_adapt_makes_a_mesh_of_the_length_and_tells_where_it_came_from(self):
        report = self.report(DATA / "blob.ply", "-o", "out.off", "--connectivity", "adapt", "-L", "1.5x", "--map", "map")
        faces = report["input"]["faces"] / 1.5 ** 2
        self.assertAlmostEqual(report["output"]["faces"] / faces, 1, delta=.03)
        self.assertEqual(report["output"]["euler"], report["input"]["euler"])
        self.assertGreater(report["after"]["min_angle"]["min"], 35)
        self.assertIsNone(report["geometry"]["displacement"])
        lines = (self.folder / "map").read_text().splitlines()
        rows = [line.split() for line in lines if not line.startswith("#")]
        self.assertEqual(len(rows), report["output"]["vertices"])
        for vertex, face, *weights in rows:
            self.assertLess(int(vertex), report["input"]["vertices"])
            self.assertLess(int(face), report["input"]["faces"])
            self.assertAlmostEqual(sum(map(float, weights)), 1, 9)
            self.assertNotIn("-0", weights)

    def test_creases_stay(self):
        for sample in ("cube.obj", "block.ply", "cylinder.off"):
            for mode in ("fixed", "flip", "adapt"):
                with self.subTest(sample=sample, mode=mode):
                    report = self.report(DATA / sample, "-o", "out.off", "--connectivity", mode)
                    features = report["features"]
                    self.assertGreater(features["crease_edges"], 20)
                    self.assertLess(abs(report["geometry"]["volume_change"]), 1e-2 if "cyl" in sample else 1e-6)
                    self.assertEqual(report["geometry"]["flipped_faces"], 0)
                    self.assertEqual(report["after"]["self_intersections"], 0)
                    self.assertGreater(report["after"]["min_angle"]["min"], 18)

    def test_corners_stay_and_the_boundary_slides(self):
        original, faces = read_mesh(DATA / "patch.obj")
        moved, _ = self.optimized(DATA / "patch.obj", "out.obj")
        rim = boundary_vertices(faces)
        corners = [v for v in rim if original[v][:2] in ((0, 0), (1, 0), (1, 1), (0, 1))]
        self.assertEqual(len(corners), 4)
        for v in corners:
            self.assertEqual(moved[v], original[v])
        self.assertGreater(sum(moved[v] != original[v] for v in rim), len(rim) / 2)
        for v in rim:  # the sides of the square are straight in the plane
            self.assertLess(min(abs(moved[v][k] - side) for k in (0, 1) for side in (0, 1)), 1e-12)

    def test_fixed_boundary_keeps_every_bit(self):
        original, faces = read_mesh(DATA / "patch.obj")
        moved, _ = self.optimized(DATA / "patch.obj", "out.obj", "--boundary", "fixed")
        rim = boundary_vertices(faces)
        self.assertTrue(all(moved[v] == original[v] for v in rim))
        self.assertGreater(sum(p != q for p, q in zip(moved, original)), len(original) / 2)

    def test_fix_keeps_every_bit(self):
        original, _ = read_mesh(DATA / "blob.ply")
        ids = range(0, len(original), 7)
        self.write("ids", "".join("%d\n" % i for i in ids))
        report = self.report(DATA / "blob.ply", "-o", "out.ply", "--fix", "ids")
        moved, _ = read_mesh(self.folder / "out.ply")
        self.assertEqual(report["parameters"]["fixed_vertices"], len(ids))
        self.assertTrue(all(moved[v] == original[v] for v in ids))
        self.assertGreater(sum(p != q for p, q in zip(moved, original)), len(original) / 2)

    def test_paper_mode_runs_and_says_when_it_jams(self):
        out, err = self.run_command(DATA / "patch.obj", "-o", "out.obj", "--paper", "--max-outer", 1, "--max-steps", 50)
        self.assertIn("global time step", err)

    def test_time_steps_of_paper_mode_are_traced(self):
        self.run_command(DATA / "patch.obj", "-o", "out.obj", "--paper", "--max-outer", 2, "--max-steps", 200,
                         "--trace-steps", "steps.csv")
        with open(self.folder / "steps.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(int(r["outer"]), int(r["step"])) for r in rows],
                         [(outer, step) for outer in (1, 2) for step in range(1, 201)])
        self.assertTrue(all(float(r["dt"]) > 0 and float(r["greatest_force"]) > 0 for r in rows))
        self.assertTrue(all(set(r["bound"].split("+")) <= {"none", "angle", "expansion", "displacement", "area"}
                            for r in rows))


if __name__ == "__main__":
    unittest.main()

"""The JSON report: its keys, its figures, where it goes, and what standard error says beside it."""

import csv
import json
import os
import unittest
from math import cos, dist, pi, sin, tan
from re import search

from command import DATA, CommandTest, read_fields, read_mesh, write_off

TOP = {"schema", "tool", "status", "input", "output", "parameters", "before", "after", "geometry", "iterations",
       "gates", "warnings", "repairs", "paper", "resources"}
FILE = {"path", "sha256", "format", "vertices", "faces", "edges", "components", "boundary_loops", "euler",
        "isolated_vertices", "bbox", "bbox_diagonal", "area", "volume", "connectivity_sha256"}
QUANTITIES = {"min_angle", "max_angle", "shape", "radius_ratio", "aspect_ratio", "edge_ratio", "edge_length",
              "length_error"}
STATISTICS = {"min", "p01", "p05", "median", "mean", "p95", "max", "std", "histogram"}
COUNTS = {"folded_edges", "self_intersections", "degenerate_faces", "valence", "mean_curvature",
          "gaussian_curvature", "worst_faces"}
GEOMETRY = {"displacement", "distance_to_input", "distance_from_input", "normal_deviation", "area_change",
            "volume_change", "flipped_faces", "boundary_distance"}
STAGE = {"stage", "outer", "steps", "energy", "max_length_error", "rms_length_error", "min_angle", "field_evaluations", "t_s"}


class Report(CommandTest):
    def has(self, keys, part):
        self.assertLessEqual(keys, set(part))

    def test_all_keys_are_there(self):
        report = self.report(DATA / "patch.obj", "-o", "out.obj")
        self.has(TOP, report)
        self.assertEqual(report["schema"], "hooke-remesh/report/1")
        self.has({"version"}, report["tool"])
        self.has(FILE, report["input"])
        self.has(FILE, report["output"])
        self.has({"L", "L_spec", "L_natural", "integrator", "filter", "kernel", "boundary"}, report["parameters"])
        for state in ("before", "after"):
            self.has(QUANTITIES | COUNTS, report[state])
            for quantity in QUANTITIES:
                self.has(STATISTICS, report[state][quantity])
                histogram = report[state][quantity]["histogram"]
                self.assertEqual(len(histogram["edges"]), len(histogram["counts"]) + 1)
            self.assertEqual(sum(report[state]["shape"]["histogram"]["counts"]), report["input"]["faces"])
            self.has({"vertices", "least_angle_rad", "edge_length_sd", "mean_curvature", "gaussian_curvature"},
                     report["paper"][state])
        self.has(GEOMETRY, report["geometry"])
        for iteration in report["iterations"]:
            self.has(STAGE, iteration)
        self.has({"greatest_displacement"}, report["paper"])
        self.assertEqual(report["paper"]["evolution"], [])
        self.has({"threads", "wall_s", "cpu_s", "peak_rss_bytes"}, report["resources"])

    def test_creases_are_counted(self):
        report = self.report(DATA / "cube.obj", "-o", "out.obj")
        self.assertEqual(report["parameters"]["feature_angle"], 40)
        self.assertEqual(report["features"], {"chains": 12, "crease_edges": 96, "seam_edges": 0,
                                              "sharp_edges": 96, "sharp_edges_dropped": 0, "corners": 8, "curve_vertices": 84, "charts": 6})
        self.assertAlmostEqual(report["output"]["volume"], 1, places=6)
        report = self.report(DATA / "cube.obj", "-o", "out.obj", "--feature-angle", "off")
        self.assertIsNone(report["parameters"]["feature_angle"])
        self.assertIsNone(report["features"])
        self.assertIsNone(self.report(DATA / "torus.off", "-o", "out.off")["features"])

    def test_check_measures_and_writes_nothing(self):
        report = self.report("good.obj", "--check")
        self.assertEqual(report["status"], "checked")
        self.assertIsNone(report["after"])
        self.assertIsNone(report["output"])
        self.assertEqual(report["before"]["valence"]["interior"], {"3": 4})
        self.assertEqual(self.files(), ["good.obj"])
        self.assertAlmostEqual(report["input"]["volume"], 1 / 6)

    def test_after_is_what_a_check_of_the_output_measures(self):
        first = self.report(DATA / "blob.ply", "-o", "out.ply")
        again = self.report("out.ply", "--check")
        for quantity in QUANTITIES - {"length_error"}:  # L is the output's own there
            self.assertEqual(first["after"][quantity], again["before"][quantity])
        self.assertEqual(first["output"]["sha256"], again["input"]["sha256"])
        self.assertEqual(first["input"]["connectivity_sha256"], again["input"]["connectivity_sha256"])

    def test_file_and_standard_output_hold_the_same(self):
        self.run_command("good.obj", "--check", "--report", "report.json")
        from_file = json.loads((self.folder / "report.json").read_text())
        from_pipe = self.report("good.obj", "--check")
        del from_file["resources"], from_pipe["resources"]
        self.assertEqual(from_file, from_pipe)

    def test_states(self):
        regular = [(0, 0, 0), (1, 0, 0), (.5, 3 ** .5 / 2, 0)]
        write_off(self.folder / "regular.off", regular, [(0, 1, 2)])
        self.assertEqual(self.report("regular.off", "-o", "out.off")["status"], "converged")
        self.assertEqual(self.report(DATA / "patch.obj", "-o", "out.off")["status"], "stalled")
        limited = self.report(DATA / "patch.obj", "-o", "out.off", "--max-outer", 1, "--max-steps", 1)
        self.assertEqual(limited["status"], "iteration_limit")

    def test_limits_that_are_given_hold_for_each_effort(self):
        def steps(*options):
            report = self.report(DATA / "torus.off", "-o", "out.off", "-L", ".3x", "--connectivity", "adapt", "--effort",
                                 "fast", *options)
            self.assertGreater(report["adaptation"]["coarse_levels"], 0)
            return [i["steps"] for i in report["iterations"] if i["stage"] == "relax"]

        self.assertEqual(steps(), [0])  # a sweep
        more = steps("--max-outer", 3, "--max-steps", 4)
        self.assertGreater(more[0], 0)
        self.assertLessEqual(max(more), 4)

    def test_length_out_of_reach_is_a_warning(self):
        for length, warned in (("auto", False), ("mean", False), ("1.05x", False), ("1.2x", True), ("5%", True)):
            with self.subTest(length=length):
                report = self.report(DATA / "patch.obj", "-o", "out.off", "-L", length, "--max-outer", 1)
                codes = [w["code"] for w in report["warnings"]]
                self.assertEqual("length_out_of_reach" in codes, warned)
        _, err = self.run_command(DATA / "patch.obj", "-o", "out.off", "-L", "1.2x", "--max-outer", 1)
        self.assertIn("hooke-remesh: warning: ", err)

    def test_sizing(self):
        plain = self.report(DATA / "patch.obj", "-o", "plain.obj")
        count = plain["input"]["vertices"]
        self.write("same", "2.5\n" * count)
        self.report(DATA / "patch.obj", "-o", "same.obj", "--sizing", "same")
        self.assertEqual((self.folder / "same.obj").read_bytes(), (self.folder / "plain.obj").read_bytes())
        self.write("varied", "".join("%g\n" % (1 + i / count) for i in range(count)))
        report = self.report(DATA / "patch.obj", "-o", "out.obj", "--sizing", "varied", "-L", "20%", "--max-outer", 1)
        parameters = report["parameters"]
        self.assertEqual(parameters["sizing"], "varied")
        self.assertLess(parameters["L_min"], parameters["L"])
        self.assertLess(parameters["L"], parameters["L_max"])
        self.assertAlmostEqual(parameters["L"] / report["input"]["bbox_diagonal"], .2, 5)
        self.assertIn("length_out_of_reach", [w["code"] for w in report["warnings"]])
        report = self.report(DATA / "blob.ply", "--check", "--sizing", "curvature:1%", "--gradation", "off")
        self.assertIsNone(report["parameters"]["gradation"])
        self.assertLess(report["parameters"]["L_min"], report["parameters"]["L_max"])

    def test_edges_that_cannot_follow_a_sizing_are_a_warning(self):
        vertices = read_mesh(DATA / "torus.off")[0]
        lengths = [1 if i % 2 else 8 for i in range(len(vertices))]
        (self.folder / "lengths").write_text("\n".join(map(str, lengths)))
        options = (DATA / "torus.off", "-o", "out.off", "--sizing", "lengths", "--gradation", "off")
        codes = [w["code"] for w in self.report(*options)["warnings"]]
        self.assertIn("sizing_missed", codes)
        codes = [w["code"] for w in self.report(DATA / "torus.off", "-o", "out.off", "--sizing", "curvature")["warnings"]]
        self.assertNotIn("sizing_missed", codes)

    def test_parameters_are_those_in_effect(self):
        parameters = lambda *options: self.report(DATA / "patch.obj", "-o", "out.off", *options)["parameters"]
        plain, flip, adapt = (parameters("--connectivity", mode) for mode in ("fixed", "flip", "adapt"))
        self.assertEqual([plain[key] for key in ("effort", "torque", "friction", "polish_up_to", "near_regular_angle")],
                         ["default", None, None, 32, 35])
        for key in ("from", "step", "up_to", "edge_limit"):
            self.assertEqual(flip["polish_" + key], adapt["polish_" + key])
        self.assertEqual((flip["polish_up_to"], flip["near_regular_angle"]), (60, None))
        other = parameters("--integrator", "damped", "--polish", "off", "--filter", "closest", "--effort", "fast")
        self.assertEqual([other[key] for key in ("effort", "friction", "polish_up_to", "kernel", "rho", "refit")],
                         ["fast", 1000, None, None, None, None])
        paper = parameters("--paper", "--max-steps", 5)
        self.assertEqual((paper["filter"], paper["step_expansion"]), ("global", .01))
        report = self.report(DATA / "patch.obj", "-o", "out.off", "--paper", "--max-outer", 2, "--max-steps", 200)
        outers = report["paper"]["evolution"]
        self.assertEqual([(o["outer"], o["steps"]) for o in outers], [(1, 200), (2, 200)])
        for outer in outers:
            self.assertTrue(all(outer[key] > 0 for key in ("time", "dt", "string_energy", "altitude_energy",
                                                           "kinetic_energy", "greatest_force")))
            self.assertGreaterEqual(sum(outer["bound"].values()), 200)
        keys = ("filter_every", "refit", "altitude", "rho", "rho_unit")
        self.assertEqual([paper[key] for key in keys], ["step", "once", 1, .001, "file"])
        letter = parameters("--paper", "--max-steps", 5, "--filter-every", "outer", "--refit", "each", "--altitude", 0,
                            "--rho", .02, "--rho-unit", "edge")
        self.assertEqual([letter[key] for key in keys], ["outer", "each", 0, .02, "edge"])

    def test_limits_are_parameters(self):
        names = ("max_distance", "distance_limit", "accept_invalid", "time_limit")
        diagonal = self.report(DATA / "patch.obj", "--check")["input"]["bbox_diagonal"]
        for options, expected in (([], [None, "curvature", False, None]),
                                  (["--max-distance", "off", "--accept-invalid"], [None, "off", True, None]),
                                  (["--max-distance", ".25", "--time-limit", 100], [.25, "given", False, 100]),
                                  (["--max-distance", "50%"], [.5 * diagonal, "given", False, None]),
                                  (["--paper", "--max-outer", 1, "--max-steps", 5], [None, None, None, None])):
            parameters = self.report(DATA / "patch.obj", "-o", "out.off", *options)["parameters"]
            self.assertEqual([parameters[name] for name in names], expected)

    def test_the_paper_block_tells_energies_and_with_paper_fitted_curvatures(self):
        plain, paper = (self.report(DATA / "patch.obj", "-o", "out.off", *options)["paper"]
                        for options in ([], ["--paper", "--max-outer", 1]))
        for block in (plain, paper):
            for key in ("string_energy", "altitude_energy"):
                self.assertLess(block["after"][key], .7 * block["before"][key])
        self.assertIsNone(plain["after"]["fitted_mean_curvature"])
        for key in ("mean_curvature", "gaussian_curvature"):
            discrete, fitted = paper["before"][key], paper["before"]["fitted_" + key]
            self.assertLess(discrete["min"] - fitted["min"], fitted["max"] - fitted["min"])
            self.assertLess(fitted["max"], discrete["max"])  # bad triangles mislead the discrete one

    def test_fields_are_those_of_the_output(self):
        report = self.report(DATA / "patch.obj", "-o", "out.obj", "--fields", "fields.ply")
        self.assertEqual(read_mesh(self.folder / "fields.ply"), read_mesh(self.folder / "out.obj"))
        before, after = read_mesh(DATA / "patch.obj")[0], read_mesh(self.folder / "out.obj")[0]
        vertices, faces = read_fields(self.folder / "fields.ply")
        for moved, a, b in zip(vertices["displacement"], before, after):
            self.assertAlmostEqual(moved, dist(a, b), 12)
        geometry = report["geometry"]
        self.assertAlmostEqual(max(vertices["displacement"]), geometry["displacement"]["max"], 12)
        self.assertLessEqual(max(vertices["distance"]), geometry["distance_to_input"]["max"])
        self.assertGreater(max(vertices["distance"]), 0)
        self.assertAlmostEqual(min(faces["min_angle"]), report["after"]["min_angle"]["min"], 9)
        curvature = report["after"]["mean_curvature"]
        self.assertAlmostEqual(max(k for k in vertices["mean_curvature"] if k == k), curvature["max"], 9)
        worst = max(abs(report["after"]["length_error"][key]) for key in ("min", "max"))
        self.assertAlmostEqual(max(vertices["length_error"]), worst, 9)
        flipped = self.report(DATA / "patch.obj", "-o", "out.obj", "--fields", "flip.ply", "--connectivity", "flip")
        self.assertAlmostEqual(max(read_fields(self.folder / "flip.ply")[0]["displacement"]),
                               flipped["geometry"]["displacement"]["max"], 12)
        self.run_command(DATA / "patch.obj", "-o", "out.obj", "--fields", "adapt.ply", "--connectivity", "adapt", "-q")
        self.assertNotIn("displacement", read_fields(self.folder / "adapt.ply")[0])

    def test_edges_follow_lengths_of_their_own(self):
        self.run_command(DATA / "patch.obj", "-o", "wanted.obj", "-q")
        vertices, faces = read_mesh(self.folder / "wanted.obj")
        edges = sorted({tuple(sorted((face[k - 1], face[k]))) for face in faces for k in range(3)})
        lengths = {(a, b): dist(vertices[a], vertices[b]) for a, b in edges}
        self.write("lengths", "".join("%d %d %r\n" % (*edge, length) for edge, length in lengths.items()))
        report = self.report(DATA / "patch.obj", "-o", "out.obj", "--edge-lengths", "lengths")
        self.assertLess(report["after"]["length_error"]["std"], .01 * report["before"]["length_error"]["std"])
        parameters = report["parameters"]
        self.assertEqual([parameters[key] for key in ("edge_lengths", "altitude", "polish")], ["lengths", 0, False])
        self.assertEqual((parameters["L_min"], parameters["L_max"]), (min(lengths.values()), max(lengths.values())))
        self.write("one", "%d %d %r\n" % (*edges[0], lengths[edges[0]]))
        parameters = self.report(DATA / "patch.obj", "--check", "--edge-lengths", "one", "-L", ".05")["parameters"]
        self.assertEqual(parameters["L_max" if lengths[edges[0]] < .05 else "L_min"], .05)

    def test_iterations_are_numbered(self):
        iterations = self.report(DATA / "patch.obj", "-o", "out.off")["iterations"]
        relaxed = [i["outer"] for i in iterations if i["stage"] == "relax"]
        self.assertEqual(relaxed, list(range(1, len(relaxed) + 1)))
        self.assertEqual({i["outer"] for i in iterations if i["stage"] != "relax"}, {None})

    def test_a_surface_that_was_left_is_a_warning(self):
        codes = lambda *options: [w["code"] for w in self.report(*options)["warnings"]
                                  if w["code"] != "sharp_edges_dropped"]
        for sample in ("patch.obj", "blob.ply", "torus.off", "cube.obj"):
            self.assertEqual(codes(DATA / sample, "-o", "out.off"), [])
        coarse = (DATA / "torus.off", "-o", "out.off", "--connectivity", "adapt", "-L", "4x", "--accept-invalid")
        self.assertIn("surface_left", codes(*coarse))

    def test_a_thin_body_that_lost_volume_is_a_warning(self):
        around, along = 20, 80
        turn = lambda k, n: (cos(2 * pi * k / n), sin(2 * pi * k / n))
        ring = [(u * (4 + x), v * (4 + x), z) for u, v in (turn(i, along) for i in range(along))
                for x, z in (turn(j, around) for j in range(around))]
        at = lambda i, j: i % along * around + j % around
        quads = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(along) for j in range(around)]
        write_off(self.folder / "ring.off", ring, [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))])
        for length, expected in (("1x", []), (".9", ["surface_left"])):
            report = self.report("ring.off", "-o", "out.off", "--connectivity", "adapt", "-L", length)
            self.assertEqual([w["code"] for w in report["warnings"]], expected)
        self.assertLess(report["geometry"]["volume_change"], -.05)
        self.assertLess(report["geometry"]["distance_to_input"]["max"], .15)
        advised = search(r"; try --max-distance (\S+)%, for which", report["warnings"][0]["message"])[1]
        closer = self.report("ring.off", "-o", "out.off", "--connectivity", "adapt", "-L", ".9", "--max-distance", advised + "%")
        self.assertNotIn("surface_left", [w["code"] for w in closer["warnings"]])
        self.assertLess(100 * closer["geometry"]["distance_to_input"]["max_over_diagonal"], float(advised))

    def test_what_holds_angles_down_is_named(self):
        codes = lambda *options: [w["code"] for w in self.report(*options)["warnings"]]
        box = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 9)]
        quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        write_off(self.folder / "bar.off", box, [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))])
        self.assertIn("facets_without_inner_vertices", codes("bar.off", "-o", "out.off"))
        mended = ("bar.off", "-o", "out.off", "--connectivity", "adapt", "-L", ".4")
        self.assertEqual(codes(*mended), [])
        plate = [(x, y, 0) for x, y in ((0, 0), (9, 0), (9, 9), (8, 9), (0, 9))]
        write_off(self.folder / "plate.off", plate, [(0, 1, 2), (0, 2, 3), (0, 3, 4)])
        adapted = ("plate.off", "-o", "out.off", "--connectivity", "adapt", "-L", ".4", "--boundary")
        self.assertIn("boundary_holds_angles", codes(*adapted, "fixed"))
        self.assertNotIn("boundary_holds_angles", codes(*adapted, "slide"))

    def test_regions_with_one_row_of_vertices_between_creases_are_narrow_too(self):
        sides, length, bulge = 6, .52, .04  # of a prism, whose sides are two facets each
        turn, apothem = pi / sides, length / 2 / tan(pi / sides)
        radii = (length / 2 / sin(turn), apothem + bulge)
        ring = [(radii[k % 2] * cos(k * turn), radii[k % 2] * sin(k * turn)) for k in range(2 * sides)]
        n = len(ring)
        points = [(x, y, z) for z in (0, 2) for x, y in ring] + [(0, 0, 0), (0, 0, 2)]
        faces = [f for a, b in ((k, (k + 1) % n) for k in range(n))
                 for f in ((a, b, n + b), (a, n + b, n + a), (b, a, 2 * n), (n + a, n + b, 2 * n + 1))]
        write_off(self.folder / "letter.off", points, faces)
        adapted = ("letter.off", "-o", "out.off", "--connectivity", "adapt", "-L", "1.5")
        plain, finer = self.report(*adapted), self.report(*adapted, "--min-length", ".1")
        self.assertGreater(plain["after"]["faces_below_20"], 0)
        (advice,) = [w["message"] for w in plain["warnings"] if w["code"] == "narrow_regions"]
        advised = search(r"--min-length (\S+),", advice)[1]
        self.assertEqual(self.report(*adapted, "--min-length", advised)["after"]["faces_below_20"], 0)
        self.assertIn("narrow_regions", [w["code"] for w in plain["warnings"]])
        self.assertEqual(finer["after"]["faces_below_20"], 0)
        self.assertNotIn("narrow_regions", [w["code"] for w in finer["warnings"]])

    def test_welding_is_advised_where_bodies_overlap_by_a_little(self):
        outline = [(0, 0), (30, 0), (30, 5), (15, 5), (15, 5.004), (0, 5.004)]  # with a step
        n = len(outline)
        points = [(x, y, z) for z in (0, 20) for x, y in outline]
        sides = [f for a, b in ((k, (k + 1) % n) for k in range(n)) for f in ((a, b, n + b), (a, n + b, n + a))]
        ends = [f for k in range(1, n - 1) for f in ((0, k + 1, k), (n, n + k, n + k + 1))]
        write_off(self.folder / "step.off", points, sides + ends)
        adapted = ("step.off", "-o", "out.off", "--connectivity", "adapt", "-L", "3")
        plain = self.report(*adapted)
        self.assertGreater(plain["after"]["faces_below_20"], 0)
        (advice,) = [w["message"] for w in plain["warnings"] if w["code"] == "narrow_regions"]
        self.assertIn("--weld if a step so narrow is not meant", advice)
        welded = self.report(*adapted, "--weld", ".01")
        self.assertEqual(welded["after"]["faces_below_20"], 0)
        self.assertLess(abs(welded["output"]["volume"] / plain["input"]["volume"] - 1), 1e-3)

    def test_narrow_regions_get_shorter_edges_where_they_may(self):
        box = [(x, y, z) for z in (0, 20) for y in (0, .4) for x in (0, 30)]
        quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        write_off(self.folder / "plate.off", box, [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))])
        adapted = ("plate.off", "-o", "out.off", "--connectivity", "adapt", "-L", "3")
        plain, finer = self.report(*adapted), self.report(*adapted, "--min-length", ".1")
        self.assertIn("narrow_regions", [w["code"] for w in plain["warnings"]])
        self.assertLess(plain["after"]["min_angle"]["min"], 20)
        self.assertIsNone(plain["parameters"]["min_length"])
        self.assertEqual(finer["warnings"], [])
        self.assertGreater(finer["after"]["min_angle"]["min"], 30)
        self.assertEqual(finer["parameters"]["min_length"], .1)
        self.assertEqual(finer["parameters"]["gradation"], .3)
        self.assertLess(abs(finer["geometry"]["volume_change"]), 1e-9)
        faces = lambda report: report["adaptation"]["wanted_faces"]
        advice = lambda *more: [w["message"] for w in self.report(*adapted, *more)["warnings"] if w["code"] == "narrow_regions"]
        self.assertRegex(advice()[0], "; use --min-length 0\.(39|4), with which edges there may be as short, or")
        self.assertRegex(advice("--min-length", "2")[0], "closer than --min-length; try 0\.[2-4]\d?$")
        box = [(x, y / 100, z) for x, y, z in box]
        write_off(self.folder / "foil.off", box, [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))])
        adapted = ("foil.off", *adapted[1:])
        self.assertRegex(advice()[0], "edges there may be shorter, --weld if a step so narrow is not meant, or")
        self.assertRegex(advice("--min-length", "2")[0], "closer than --min-length; use a shorter one$")
        adapted = ("plate.off", *adapted[1:])
        results = []
        for threads in ("1", "2"):
            self.run_command(*adapted, "--min-length", ".1", "-j", threads, "-q")
            results.append((self.folder / "out.off").read_bytes())
        self.assertEqual(*results)
        steeper = self.report(*adapted, "--min-length", ".1", "--gradation", ".6")
        self.assertGreater(.9 * faces(finer), faces(steeper))
        self.assertGreater(faces(steeper), 2 * faces(plain))
        blob = (DATA / "blob.ply", "-o", "blob.ply", "--connectivity", "adapt", "-q")  # has no narrow regions
        self.run_command(*blob)
        before = (self.folder / "blob.ply").read_bytes()
        self.run_command(*blob, "--min-length", ".1x")
        self.assertEqual((self.folder / "blob.ply").read_bytes(), before)
        self.refused(8, *adapted, "--min-length", ".1", "--memory-limit", "13", names="plate.off", says="in the result")

    def test_a_seam_stays_closed_and_says_so(self):
        grid = lambda side: [(side * (i + .3 * (i == 1 and j == 1)) / 2, (j + .2 * (j == 1 and i == 1)) / 2, 0)
                             for j in range(3) for i in range(3)]
        faces = [f for a in (0, 1, 3, 4) for f in ((a, a + 1, a + 4), (a, a + 4, a + 3))]
        vertices = grid(1) + grid(-1)
        write_off(self.folder / "seam.off", vertices, faces + [(9 + a, 9 + c, 9 + b) for a, b, c in faces])
        report = self.report("seam.off", "-o", "out.off")
        (warning,) = report["warnings"]
        self.assertEqual(warning["code"], "coincident_boundary")
        self.assertIn("6 boundary vertices", warning["message"])
        moved = read_mesh(self.folder / "out.off")[0]
        for v in (0, 3, 6, 9, 12, 15):
            self.assertEqual(tuple(moved[v]), vertices[v])

    def test_names_that_are_not_utf8(self):
        name = b"l\xff\xfe"
        (self.folder / os.fsdecode(name)).write_text("1\n" * 4)
        report = self.report("good.obj", "--check", "--sizing", name)
        self.assertEqual(report["parameters"]["sizing"], "l\\xff\\xfe")

    def test_worst_faces_say_what_bounds_them(self):
        for mode in ("fixed", "flip"):
            worst = self.report(DATA / "patch.obj", "-o", "out.off", "--connectivity", mode)["after"]["worst_faces"]
            names = {"corner", "fixed", "crease", "boundary", "valence", "guard", "put_back", "lengths"}
            for face in worst:
                self.assertTrue(face["reasons"])
                self.assertLessEqual(set(face["reasons"]), names)
        self.assertIn("boundary", {name for face in worst for name in face["reasons"]})

    def test_a_result_is_near_regular_and_stays(self):
        self.run_command(DATA / "torus.off", "-o", "once.off", "--connectivity", "flip", "-q")
        report = self.report("once.off", "-o", "twice.off")
        self.assertTrue(report["near_regular"])
        self.assertGreaterEqual(report["after"]["min_angle"]["min"], report["before"]["min_angle"]["min"])
        self.assertLess(report["geometry"]["displacement"]["max"], .2 * report["parameters"]["L"])

    def test_trace_and_report_tell_the_same_of_every_stage(self):
        report = self.report(DATA / "patch.obj", "-o", "out.obj", "--trace", "trace.csv")
        with open(self.folder / "trace.csv", newline="") as lines:
            trace = {row.pop("stage"): {k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)}
        stages = report["resources"]["stages"]
        self.assertEqual(list(trace), list(stages))
        for name, stage in stages.items():
            self.assertEqual(set(stage), {"calls", "wall_s", "cpu_s", "peak_rss_bytes"})
            for key, value in stage.items():
                self.assertAlmostEqual(trace[name][key], value, places=5)
        for name in ("read/parse", "before/self_intersections", "remesh/fit", "remesh/relax/energy",
                     "remesh/relax/guards/projection", "remesh/polish", "remesh/deviation/to_reference", "write/file"):
            self.assertIn(name, stages)
        self.assertEqual((stages["seams"]["calls"], stages["boundary"]["calls"]), (1, 1))
        top = sum(stage["wall_s"] for name, stage in stages.items() if "/" not in name)
        self.assertLessEqual(top, report["resources"]["wall_s"])

    def test_quiet_prints_nothing(self):
        self.assertEqual(self.run_command(DATA / "blob.ply", "-o", "out.ply", "-q"), ("", ""))
        self.assertEqual(self.run_command("good.obj", "--check", "-q"), ("", ""))

    def test_summary_shows_before_and_after_on_standard_error(self):
        out, err = self.run_command(DATA / "patch.obj", "-o", "out.obj")
        self.assertEqual(out, "")
        for text in ("before", "after", "minimum angle 1.23 -> ", " degrees; ", "flipped faces", "out.obj written",
                     "--connectivity flip"):
            self.assertIn(text, err)
        for line in err.splitlines():
            if not line.startswith("hooke-remesh: ") and str(DATA) not in line: self.assertLessEqual(len(line), 80)

    def test_summary_names_every_file_that_was_written(self):
        files = ("--report", "r.json", "--trace", "t.csv", "--map", "m.txt")
        _, err = self.run_command(DATA / "patch.obj", "-o", "out.obj", *files)
        self.assertIn("out.obj, r.json, m.txt, t.csv written", err)
        _, err = self.run_command(DATA / "patch.obj", "-o", "out.obj", "--report", "-")
        self.assertIn("out.obj written", err)

    def test_help_and_version(self):
        self.assertIn("--check", self.run_command("--help")[0])
        self.assertRegex(self.run_command("--version")[0], r"hooke-remesh \d+\.\d+\.\d+")

    def test_threads_follow_the_environment_and_the_option(self):
        threads = lambda *options, **env: self.report("good.obj", "--check", *options, **env)["resources"]["threads"]
        self.assertEqual(threads("-j", 1), 1)
        self.assertEqual(threads(OMP_NUM_THREADS="1"), 1)
        self.assertEqual(threads(SLURM_CPUS_PER_TASK="1", OMP_NUM_THREADS="2"), 1)
        self.assertEqual(threads("-j", 1, SLURM_CPUS_PER_TASK="2"), 1)


if __name__ == "__main__":
    unittest.main()

"""Conditions on the report: exit code 6 if one does not hold, with all files written; a wrong one is refused at once."""

import json
import struct
import unittest

from command import DATA, CommandTest, read_mesh, write_off

PATCH = DATA / "patch.obj"


class Gates(CommandTest):
    def test_all_hold(self):
        report = self.report(PATCH, "-o", "out.obj", "--require", "after.min_angle.min >= 20", "--require=promises.kept == 1")
        self.assertEqual([gate["condition"] for gate in report["gates"]],
                         ["after.min_angle.min >= 20", "promises.kept == 1"])
        self.assertTrue(all(gate["passed"] for gate in report["gates"]))

    def test_one_fails_and_the_files_are_written(self):
        _, err = self.run_command(PATCH, "-o", "out.obj", "--report", "report.json", "-q", "--require",
                                  "after.min_angle.min > 50", "--require", "after.min_angle.min > 20", expect=6)
        gates = json.loads((self.folder / "report.json").read_text())["gates"]
        self.assertEqual([gate["passed"] for gate in gates], [False, True])
        self.assertEqual(self.files(), ["good.obj", "out.obj", "report.json"])
        self.assertIn(f"required after.min_angle.min > 50; it is {gates[0]['value']:.6g}", err)
        self.assertEqual(err.count("error"), 1)

    def test_yes_and_no(self):
        for condition, code in (("promises.kept == true", 0), ("promises.kept == false", 6)):
            self.run_command("good.obj", "-o", "out.obj", "-q", "--require", condition, expect=code)

    def test_of_a_check(self):
        self.run_command(PATCH, "--check", "--require", "before.min_angle.min > 1")
        self.run_command(PATCH, "--check", "--require", "before.min_angle.min > 2", expect=6)

    def test_what_is_no_number_of_the_report_is_refused(self):
        for condition, says in (("after.min_angel.min > 2", "did you mean after.min_angle.min?"),
                                ("after.min_angle > 2", "expected one such as after.min_angle.min"),
                                ("geometry.typo == 0", "did you mean geometry."), ("status == 1", "is not a number"),
                                ("min_angle", "expected METRIC"), ("a > b", "expected METRIC")):
            with self.subTest(condition=condition):
                self.refused(2, PATCH, "-o", "out.obj", "-q", "--require", condition, says=says)

    def test_a_check_has_no_result_to_judge(self):
        for key in ("after.min_angle.min", "geometry.flipped_faces", "promises.kept", "features.corners"):
            with self.subTest(key=key):
                self.refused(2, PATCH, "--check", "-q", "--require", f"{key} > 0", says="--check has none of")

    def test_what_the_report_has_no_value_for_fails(self):
        _, err = self.run_command(PATCH, "-o", "out.obj", "-q", "--require", "features.corners < 100", expect=6)
        self.assertIn("not there", err)


class Rounding(CommandTest):
    """The report is about what is in the file."""

    def same(self, after, before, exactly):
        for key, value in before.items():
            if key == "worst_faces" or key == "histogram" and not exactly:  # reasons are of the run
                continue
            if isinstance(value, dict):
                self.same(after[key], value, exactly)
            elif exactly or not isinstance(value, float):
                self.assertEqual(after[key], value, key)
            else:  # the digits of a float in a text are nearest to it, not it
                self.assertLessEqual(abs(after[key] - value), 1e-6 * max(1, abs(value)), key)

    def test_coordinates_of_a_float_ply(self):
        vertices, faces = read_mesh(PATCH)
        for form in ("ascii", "binary_little_endian"):
            header = (f"ply\nformat {form} 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
                      f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
            if form == "ascii":
                body = "".join("%r %r %r\n" % tuple(v) for v in vertices) + "".join("3 %d %d %d\n" % tuple(f) for f in faces)
                (self.folder / "in.ply").write_text(header + body)
            else:
                body = b"".join(struct.pack("<3f", *v) for v in vertices) + b"".join(struct.pack("<B3i", 3, *f) for f in faces)
                (self.folder / "in.ply").write_bytes(header.encode() + body)
            report = self.report("in.ply", "-o", "out.ply", "-q", "-L", ".05", "--fields", "fields.ply")
            self.assertTrue(report["output"]["preserved"])
            written = self.report("out.ply", "--check", "-q", "-L", ".05", "--feature-angle", "off")
            exactly = form != "ascii"
            self.same(report["after"], written["before"], exactly)
            self.same({key: report["output"][key] for key in ("area", "bbox_diagonal", "faces")},
                      {key: written["input"][key] for key in ("area", "bbox_diagonal", "faces")}, exactly)

    def test_a_gate_judges_the_coordinates_of_an_stl(self):
        vertices, faces = read_mesh(PATCH)
        write_off(self.folder / "far.off", [(x + 3000, y, z) for x, y, z in vertices], faces)
        report = self.report("far.off", "-o", "out.stl", "-q", "-L", ".05", "--accept-invalid")
        written = self.report("out.stl", "--check", "-q", "-L", ".05")
        angle = written["before"]["min_angle"]["min"]
        self.assertAlmostEqual(report["after"]["min_angle"]["min"], angle, 9)
        exact = self.report("far.off", "-o", "out.off", "-q", "-L", ".05")["after"]["min_angle"]["min"]
        self.assertGreater(exact - angle, 1e-3)
        self.assertEqual(report["promises"]["flipped_faces"], report["geometry"]["flipped_faces"])
        gate = ("--require", f"after.min_angle.min >= {(exact + angle) / 2!r}")
        self.run_command("far.off", "-o", "out.off", "-q", "-L", ".05", *gate)
        self.run_command("far.off", "-o", "out.stl", "-q", "-L", ".05", *gate, expect=6)

    def test_results_are_made_in_the_numbers_of_their_file(self):
        vertices, faces = read_mesh(PATCH)
        to_float = lambda x: struct.unpack("f", struct.pack("f", x))[0]
        write_off(self.folder / "rounded.off", [(to_float(x + 6e5), to_float(y), to_float(z)) for x, y, z in vertices],
                  faces)
        for mode in ("fixed", "flip", "adapt"):
            run = ("rounded.off", "-o", "out.stl", "-q", "--feature-angle", "off", "--connectivity", mode)
            report = self.report(*run)
            self.assertTrue(report["promises"]["kept"])
            self.assertIn("rounded_coarsely", [w["code"] for w in report["warnings"]])

    def test_near_the_origin_and_in_64_bits_numbers_are_fine(self):
        vertices, faces = read_mesh(PATCH)
        write_off(self.folder / "near.off", [(x + 3, y, z) for x, y, z in vertices], faces)
        write_off(self.folder / "far.off", [(x + 6e5, y, z) for x, y, z in vertices], faces)
        for run in (("near.off", "-o", "out.stl"), ("far.off", "-o", "out.ply", "--preserve", "off")):
            self.assertNotIn("rounded_coarsely", [w["code"] for w in self.report(*run, "-q")["warnings"]])

    def test_promises_that_rounding_breaks_are_not_kept(self):
        vertices, faces = read_mesh(PATCH)
        write_off(self.folder / "farther.off", [(x + 1e6, y, z) for x, y, z in vertices], faces)
        run = ("farther.off", "-q", "--feature-angle", "off")
        self.assertTrue(self.report(*run, "-o", "out.off")["promises"]["kept"])
        self.refused(9, *run, "-o", "out.stl", names="out.stl", says="whose numbers have 64 bits, not 32")
        report = self.report(*run, "-o", "out.stl", "--accept-invalid")
        self.assertFalse(report["promises"]["kept"])
        self.assertIn("promise_broken", [w["code"] for w in report["warnings"]])
        self.run_command(*run, "-o", "out.stl", "--accept-invalid", "--require", "promises.kept == 1", expect=6)

    def test_where_bodies_cross_in_the_input_rounding_may_add_pairs(self):
        vertices, faces = read_mesh(DATA / "blob.ply")
        shift = (.5, .25, .125)
        both = list(vertices) + [tuple(x + d for x, d in zip(v, shift)) for v in vertices]
        write_off(self.folder / "two.off", [tuple(x + 3e4 for x in v) for v in both],
                  list(faces) + [tuple(i + len(vertices) for i in f) for f in faces])
        report = self.report("two.off", "-o", "out.stl", "-q", "-L", ".9x")
        self.assertGreater(report["before"]["self_intersections"], 0)
        self.assertGreater(report["after"]["self_intersections"], report["before"]["self_intersections"])
        self.assertEqual(report["promises"]["new_self_intersections"], 0)


class Comparisons(CommandTest):
    def base(self, *options):
        self.run_command(PATCH, "-o", "base.obj", "--report", "base.json", "-q", *options)

    def test_a_run_is_not_worse_than_itself(self):
        self.base()
        _, err = self.run_command(PATCH, "-o", "out.obj", "--compare", "base.json", "--rtol", 0)
        self.assertRegex(err, r"base.json: none of \d+ figures got worse by more than 0 %")
        self.assertNotIn("is of another", err)

    def test_what_got_worse_is_told_and_written(self):
        self.base("--connectivity", "flip")
        out, err = self.run_command(PATCH, "-o", "out.obj", "--compare", "base.json", "--report", "-", expect=6)
        self.assertIn("out.obj", self.files())
        comparison = json.loads(out)["comparison"]
        worse = {w["key"]: w for w in comparison["worse"]}
        least = worse["after.min_angle.min"]
        self.assertLess(least["value"], least["base"])
        self.assertEqual(err.count("hooke-remesh: error: "), len(worse))
        self.assertRegex(err, r"worse than in base.json: after.min_angle.min: [\d.]+ -> [\d.]+ \([\d.]+ % worse\)")
        self.assertIn('parameters.connectivity was "flip", and is "fixed"', err)

    def test_a_base_without_the_figures_is_no_success(self):
        self.base()
        base = json.loads((self.folder / "base.json").read_text())
        base["before"] = base["after"] = base["geometry"] = base["promises"] = None
        for name, value in base.items():
            if isinstance(value, dict) and name not in ("input", "parameters"):
                base[name] = None
        self.write("base.json", json.dumps(base))
        _, err = self.run_command(PATCH, "-o", "out.obj", "-q", "--compare", "base.json", expect=6)
        self.assertIn("error: base.json: has no figure in common", err)

    def test_lost_figures_are_told_with_quiet_too(self):
        self.base()
        _, err = self.run_command(PATCH, "-o", "out.obj", "-q", "--compare", "base.json", "--feature-angle", "off")
        self.assertIn("warning: base.json: parameters.feature_angle was ", err)

    def test_another_input_is_told(self):
        self.run_command(PATCH, "--check", "--report", "base.json", "-q")
        _, err = self.run_command("good.obj", "--check", "--compare", "base.json", "--require", "input.faces == 4", expect=6)
        self.assertIn("base.json: it is of another input", err)
        self.assertNotIn("parameters.L", err)  # follow from it

    def test_what_is_no_report_is_refused(self):
        self.write("empty.json", "{}")
        for name, says in (("missing.json", "missing.json: "), ("good.obj", "is no JSON"), ("empty.json", "is no report")):
            self.refused(3, PATCH, "-o", "out.obj", "-q", "--compare", name, says=says)
        self.refused(2, PATCH, "-o", "out.obj", "-q", "--rtol", ".1", says="--rtol is of --compare only")
        self.base()
        self.refused(2, PATCH, "-o", "out.obj", "-q", "--compare", "base.json", "--report", "base.json", says="--compare")


if __name__ == "__main__":
    unittest.main()

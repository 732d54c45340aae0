"""Conditions on the report: exit code 6 if one does not hold, with all files written; a wrong one is refused at once."""

import json
import unittest

from command import DATA, CommandTest

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

    def test_of_a_check(self):
        self.run_command(PATCH, "--check", "--require", "before.min_angle.min > 1")
        self.run_command(PATCH, "--check", "--require", "before.min_angle.min > 2", expect=6)

    def test_what_is_no_number_of_the_report(self):
        for condition, says in (("after.min_angel.min > 2", "expected one of min_angle"), ("after.min_angle > 2", "its p"),
                                ("min_angle", "expected METRIC"), ("a > b", "expected METRIC")):
            with self.subTest(condition=condition):
                self.refused(2, PATCH, "-o", "out.obj", "-q", "--require", condition,
                             says=says if says != "its p" else "expected one of its min")

    def test_a_key_that_no_report_has_fails_and_the_result_is_written(self):
        for condition in ("status == 1", "geometry.typo == 0"):
            (self.folder / "out.obj").unlink(missing_ok=True)
            _, err = self.run_command(PATCH, "-o", "out.obj", "-q", "--require", condition, expect=6)
            self.assertIn("not there", err)
            self.assertIn("out.obj", self.files())

    def test_what_the_report_has_no_value_for_fails(self):
        _, err = self.run_command("good.obj", "--check", "-q", "--require", "features.corners < 100", expect=6)
        self.assertIn("not there", err)


if __name__ == "__main__":
    unittest.main()

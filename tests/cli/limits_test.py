"""--time-limit and --memory-limit: what is reached is valid, and what cannot be is said before the work."""

import json
import re
import unittest

from command import SANITIZED, CommandTest, irregular_torus, read_mesh, write_off


class Limits(CommandTest):
    def setUp(self):
        super().setUp()
        self.vertices, self.faces = irregular_torus(200, 100)
        write_off(self.folder / "torus.off", self.vertices, self.faces)

    def test_the_best_mesh_at_the_end_of_the_time_is_written(self):
        for mode in ("fixed", "flip", "adapt"):
            for seconds in (.05, .2, .6):
                with self.subTest(mode=mode, seconds=seconds):
                    out = self.folder / "out.off"
                    out.unlink(missing_ok=True)
                    process = self.start("torus.off", "-o", "out.off", "-q", "--report", "report.json", "--connectivity", mode,
                                         "--time-limit", seconds)
                    _, err = process.communicate()
                    if process.returncode == 8:  # nothing valid yet: only where faces change
                        self.assertNotEqual(mode, "fixed", err)
                        self.assertIn(b"--time-limit", err)
                        self.assertFalse(out.exists())
                        continue
                    self.assertEqual(process.returncode, 0, err)
                    report = json.loads((self.folder / "report.json").read_text())
                    self.assertIn(report["status"], ("time_limit", "stalled", "converged"))
                    self.assertTrue(report["promises"]["kept"])
                    self.assertEqual(report["geometry"]["flipped_faces"], 0)
                    if mode == "fixed":
                        self.assertEqual(read_mesh(out)[1], self.faces)

    def test_a_limit_that_is_not_reached_changes_nothing(self):
        self.run_command("torus.off", "-o", "a.off", "-q")
        self.run_command("torus.off", "-o", "b.off", "-q", "--time-limit", "1000", "--memory-limit", "4000")
        self.assertEqual((self.folder / "a.off").read_bytes(), (self.folder / "b.off").read_bytes())

    def test_the_time_is_up_at_once(self):
        report = self.report("torus.off", "-o", "out.off", "-q", "--time-limit", "1e-6")
        self.assertEqual(report["status"], "time_limit")
        self.assertIn("time_limit", [w["code"] for w in report["warnings"]])

    def test_a_mesh_beyond_the_memory_is_refused_with_what_would_fit(self):
        err = self.refused(8, "torus.off", "-o", "out.off", "--memory-limit", "40", names="torus.off", says="20000 vertices")
        self.assertIn("--memory-limit allows 40", err)
        err = self.refused(8, "torus.off", "-o", "out.off", "--connectivity", "adapt", "-L", ".2x", "--memory-limit", "200",
                           names="torus.off", says="in the result")
        self.run_command("torus.off", "-o", "out.off", "-q", "--memory-limit", "100")

    def test_more_new_faces_than_fit_into_the_machine_are_refused(self):
        err = self.refused(8, "torus.off", "-o", "out.off", "--connectivity", "adapt", "-L", ".0001x",
                           names="torus.off", says="80 % of what is free")
        self.assertRegex(err, r"expected a target length about [\d.]+ times as long")

    def test_a_file_too_large_is_refused_before_it_is_read(self):
        (self.folder / "broken.off").write_bytes(b"OFF no mesh" + bytes(2**20))
        for command in (["-o", "out.off"], ["--check"], ["-o", "out.off", "--connectivity", "adapt"]):
            self.refused(3, "broken.off", *command, "--memory-limit", "1000", names="broken.off:1")
            for file in ("broken.off", "torus.off"):
                err = self.refused(8, file, *command, "--memory-limit", "14", names=file, says="a file of ")
                fits = float(re.search(r"expected a file of at most about (\S+) MB, or a higher limit", err)[1])
                self.assertLess(fits * 2**20, (self.folder / file).stat().st_size)
                self.assertGreater(fits, .1)
        self.refused(8, "torus.off", "--check", "--memory-limit", "25", says="20000 vertices")
        self.run_command("torus.off", "--check", "-q", "--memory-limit", "35")

    def test_a_limit_that_no_mesh_fits_in_says_so(self):
        self.refused(8, "good.obj", "-o", "out.off", "--memory-limit", "1", says="expected at least that; the program takes 12 MB")

    def test_a_limit_beyond_all_machines_is_none(self):
        self.run_command("good.obj", "-o", "out.obj", "-q", "--filter", "global", "--memory-limit", "1e14")

    @unittest.skipIf(SANITIZED, "sanitizers take memory of their own")
    def test_half_of_what_is_taken_is_refused(self):
        for mode in ("fixed", "flip", "adapt"):
            report = self.report("torus.off", "-o", "out.off", "-q", "--connectivity", mode, "--memory-limit", "1000")
            taken = report["resources"]["peak_rss_bytes"] / 2**20
            self.refused(8, "torus.off", "-o", "no.off", "--connectivity", mode, "--memory-limit", max(1, taken / 2 - 12))

    def test_limits_are_numbers(self):
        for option in ("--time-limit", "--memory-limit"):
            for value in ("0", "-1", "x"):
                self.refused(2, "torus.off", "-o", "out.off", option, value, names=option)


if __name__ == "__main__":
    unittest.main()

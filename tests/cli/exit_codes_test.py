"""Every way to fail has its exit code, one message that names the culprit, and leaves no file behind."""

import os
import unittest

from command import DATA, CommandTest


class UsageErrors(CommandTest):
    def test_no_arguments(self):
        self.refused(2, says="INPUT is required")

    def test_unknown_option(self):
        self.refused(2, "good.obj", "-o", "out.obj", "--no-such-option", says="--no-such-option")

    def test_bad_values_of_options(self):
        for option in (["-L", "none"], ["-L", "-1"], ["-L", "0"], ["-L", "nan"], ["--tolerance", "1m"],
                       ["--sizing", "ply:"], ["--sizing", "curvature:0"], ["--gradation", "0", "--sizing", "curvature"],
                       ["--gradation", "1"], ["-L", "sizing"], ["--threads", "0"], ["--filter", "magic"],
                       ["--max-outer", "0"], ["--format", "stl"], ["--feature-angle", "0"],
                       ["--feature-angle", "180"], ["--feature-angle", "sharp"],
                       ["--feature-angle", "40", "--paper"]):
            with self.subTest(option=option):
                self.refused(2, "good.obj", "-o", "out.obj", *option,
                             says={"-L": "length", "--sizing": "izing"}.get(option[0], option[0]))

    def test_output_is_needed(self):
        self.refused(2, "good.obj", says="-o FILE")

    def test_check_takes_no_output(self):
        self.refused(2, "good.obj", "--check", "-o", "out.obj", says="--check")

    def test_output_of_unknown_format(self):
        self.refused(2, "good.obj", "-o", "out.xyz", names="out.xyz")
        self.refused(2, "good.obj", "-o", "out", names="out")


class InputErrors(CommandTest):
    def refused_text(self, code, text, name="bad.obj", **expected):
        self.write(name, text)
        return self.refused(code, name, "-o", "out.obj", names=name, **expected)

    def test_missing(self):
        self.refused(3, "gone.obj", "-o", "out.obj", names="gone.obj")

    def test_not_a_regular_file(self):
        self.refused(3, "/dev/null", "-o", "out.obj", names="/dev/null")

    def test_malformed_with_its_line(self):
        self.refused_text(3, "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\n", says="bad.obj:2")
        self.refused_text(3, "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", says="bad.obj:3")
        self.refused_text(3, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", says="bad.obj:4")

    def test_truncated(self):
        self.refused_text(3, "OFF\n3 1 0\n0 0 0\n1 0 0\n", name="bad.off")
        self.refused_text(3, "ply\nformat ascii 1.0\nelement vertex 3\n", name="bad.ply")

    def test_wrong_content(self):
        self.refused_text(3, "this is no mesh\n", name="bad.off")

    def test_lengths(self):
        self.write("lengths", "1\n1\n-1\n1\n")
        self.refused(3, "good.obj", "-o", "out.obj", "--sizing", "lengths", names="lengths:3")
        self.write("lengths", "1\n1\n1\n")
        self.refused(3, "good.obj", "-o", "out.obj", "--sizing", "lengths", names="lengths: 3 lengths for 4 vertices")
        self.refused(3, "good.obj", "-o", "out.obj", "--sizing", "gone", names="gone")
        self.refused(2, "good.obj", "-o", "out.obj", "--sizing", "ply:size", names="good.obj")
        self.refused(3, DATA / "blob.ply", "-o", "out.obj", "--sizing", "ply:size", names="blob.ply", says="'size'")

    def test_id_list(self):
        self.write("ids", "0\none\n")
        self.refused(3, "good.obj", "-o", "out.obj", "--fix", "ids", names="ids:2")
        self.write("ids", "4\n")
        self.refused(3, "good.obj", "-o", "out.obj", "--fix", "ids", names="ids:1")

    def test_not_acceptable(self):
        corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        self.refused_text(4, corner)
        three_at_an_edge = corner + "v 0 0 1\nv 0 0 -1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n"
        self.refused_text(4, three_at_an_edge)
        mixed = corner + "v 1 1 0\nf 1 2 3\nf 2 3 4\n"
        self.refused_text(4, mixed)

    def test_same_refusals_with_check(self):
        self.refused(3, "gone.obj", "--check", names="gone.obj")
        self.write("empty.obj", "v 0 0 0\n")
        self.refused(4, "empty.obj", "--check", names="empty.obj")


class OutputErrors(CommandTest):
    def test_missing_folder(self):
        self.refused(5, "good.obj", "-o", "no/such/out.obj", names="out.obj")

    def test_output_may_not_be_the_input(self):
        os.link(self.folder / "good.obj", self.folder / "hard.obj")
        os.symlink("good.obj", self.folder / "soft.obj")
        for name in ("good.obj", "./good.obj", "hard.obj", "soft.obj"):
            with self.subTest(name=name):
                self.refused(2, "good.obj", "-o", name, names=name)

    def test_report_may_not_be_a_mesh(self):
        self.refused(2, "good.obj", "-o", "out.obj", "--report", "good.obj", names="good.obj")
        self.refused(2, "good.obj", "-o", "out.obj", "--report", "out.obj", names="out.obj")

    def test_trace_is_a_file_of_its_own(self):
        for other in ("good.obj", "out.obj", "report.json"):
            self.refused(2, "good.obj", "-o", "out.obj", "--report", "report.json", "--trace", other, names=other)
        self.refused(5, "good.obj", "-o", "out.obj", "--trace", "no/trace.csv", names="trace.csv")

    def test_report_in_a_missing_folder(self):
        self.refused(5, "good.obj", "-o", "out.obj", "--report", "no/report.json", names="report.json")

    def test_full_device(self):
        out, err = self.run_command("good.obj", "--check", "--report", "/dev/full", expect=5)
        self.assertIn("/dev/full", err)

    def test_old_output_stays_when_the_input_is_refused(self):
        self.write("out.obj", "precious\n")
        self.write("bad.obj", "v 0 0 0\nf 1 2 3\n")
        self.refused(3, "bad.obj", "-o", "out.obj", names="bad.obj")

    def test_old_output_is_replaced_and_nothing_else_is_left(self):
        self.write("out.obj", "old\n")
        self.run_command("good.obj", "-o", "out.obj")
        self.assertEqual(self.files(), ["good.obj", "out.obj"])
        self.assertTrue((self.folder / "out.obj").read_text().startswith("v "))


if __name__ == "__main__":
    unittest.main()

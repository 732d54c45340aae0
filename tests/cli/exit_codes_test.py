"""Every way to fail has its exit code, one message that names the culprit, and leaves no file behind."""

import os
import resource
import subprocess
import unittest

from command import DATA, TETRAHEDRON, CommandTest, irregular_torus, write_off


class UsageErrors(CommandTest):
    def test_no_arguments(self):
        self.refused(2, says="INPUT is required")

    def test_unknown_option(self):
        self.refused(2, "good.obj", "-o", "out.obj", "--no-such-option", says="--no-such-option: unknown option; see")
        for typed, meant in (("--conectivity", "connectivity"), ("--lenght=1", "length"), ("--fetaure-angle", "feature-angle")):
            self.refused(2, "good.obj", "-o", "out.obj", typed, "flip", says="did you mean --%s?" % meant)

    def test_bad_values_of_options(self):
        for option in (["-L", "none"], ["-L", "-1"], ["-L", "0"], ["-L", "nan"], ["--tolerance", "1m"],
                       ["--sizing", "ply:"], ["--sizing", "curvature:0"], ["--gradation", "0", "--sizing", "curvature"],
                       ["--gradation", "1"], ["-L", "sizing"], ["--min-length", "0"], ["--min-length", "auto"],
                       ["--min-length", "1"], ["--min-length", "2x", "--connectivity", "adapt"],
                       ["--min-length", "1e-5x", "--connectivity", "adapt"],
                       ["--gradation", "off", "--min-length", ".1x", "--connectivity", "adapt"], ["--threads", "0"], ["--filter", "magic"],
                       ["--max-outer", "0"], ["--format", "vtp"], ["--feature-angle", "0"],
                       ["--feature-angle", "180"], ["--feature-angle", "sharp"],
                       ["--feature-angle", "40", "--paper"]):
            with self.subTest(option=option):
                self.refused(2, "good.obj", "-o", "out.obj", *option,
                             says={"-L": "--length"}.get(option[0], option[0]))

    def test_numbers_are_finite_and_in_range(self):
        for option in ("--altitude", "--rho", "--string", "--torque", "--friction", "--step-angle", "--step-expansion",
                       "--step-displacement", "--step-area", "--tolerance", "--gradation", "--min-length", "--feature-angle",
                       "--max-outer", "--max-steps", "--threads"):
            for value in ("nan", "inf", "1e999", "-2", "", "1z", "0x1p3"):
                with self.subTest(option=option, value=value):
                    message = self.refused(2, "good.obj", "-o", "out.obj", option + "=" + value, says=option)
                    self.assertLess(len(message), 150)
        self.refused(2, "good.obj", "-o", "out.obj", "--paper", "--step-angle", "1.5", says="--step-angle")

    def test_words_are_words(self):
        for option, words in (("--connectivity", "fixed|flip|adapt"), ("--polish", "on|off"), ("--filter", "local|"),
                              ("--integrator", "lbfgs|damped"), ("--boundary", "slide|fixed|free")):
            for value in ("7", "0", "true", "magic"):
                with self.subTest(option=option, value=value):
                    message = self.refused(2, "good.obj", "-o", "out.obj", option, value, names=option, says=words)
                    self.assertNotIn("{", message)

    def test_no_terminal_obeys_a_message(self):
        escape = "\x1b[31mred\n"
        for arguments in (["--connectivity", escape], ["--" + escape], ["-L", escape], ["--sizing", "curvature:" + escape],
                          ["--rho", escape], ["--tolerance", escape], ["--fix", escape], ["-o", escape]):
            with self.subTest(arguments=arguments):
                code = 3 if arguments[0] == "--fix" else 2
                output = [] if arguments[0] == "-o" else ["-o", "out.obj"]
                self.assertNotIn("\x1b", self.refused(code, "good.obj", *output, *arguments))

    def test_files_have_names(self):
        for option in ("--fix", "--report", "--trace", "--map", "--sizing", "--edge-lengths", "--fields", "--output"):
            for name in ("", "-"):
                if (option, name) != ("--report", "-"):
                    output = [] if option == "--output" else ["-o", "out.obj"]
                    with self.subTest(option=option, name=name):
                        self.refused(2, "good.obj", *output, option + "=" + name, says=option)

    def test_the_next_option_is_no_value(self):
        """As where a variable of a script is not set."""
        for option in ("--fix", "--report", "--map", "--sizing", "--output", "--table", "--suffix", "--config"):
            output = [] if option == "--output" else ["-o", "out.obj"]
            for value in ([option + "="], [option, ""], [option]):
                with self.subTest(value=value):
                    self.refused(2, "good.obj", *output, *value, "--repair", says=option + ": '")
        self.write("other.obj", TETRAHEDRON)
        self.refused(2, "good.obj", "-o", "out.obj", "--report=", "other.obj", says="--report: ''; expected a value")
        for name in ("--repair", "-q"):
            self.refused(2, "good.obj", "-o", "out.obj", "--report", name, says="a file of that name is './%s'" % name)
            self.run_command("good.obj", "-o", "out.obj", "-q", "--report", "./" + name)
            self.assertIn(name, self.files())
        self.refused(2, "good.obj", "-o", "-q", says="--output: '-q'; expected the name of a file, or -, not an option")
        self.refused(2, "good.obj", "-o", "out.obj", "--fix", "-V", says="--fix: '-V'")
        self.run_command("good.obj", "-o", "out/", "--suffix", "-better", "-q")
        self.assertTrue((self.folder / "out" / "good-better.obj").is_file())

    def test_a_short_option_has_no_equals_sign(self):
        for word, instead in (("-o=x.obj", "-o x.obj"), ("-L=2x", "-L 2x"), ("-j=", "-j "), ("-qo=x.obj", "-qo x.obj")):
            with self.subTest(word=word):
                self.refused(2, "good.obj", "--output=out.obj", word, names=word + ": a short option", says="write " + instead)
        self.refused(2, "good.obj", "-x=y", names="-x=y")  # which is no option
        self.run_command("-o", "out.obj", "-q", "./good.obj")

    def test_a_flag_that_is_off_is_as_good_as_none(self):
        self.write("lengths", "0 1 1\n")
        for options in (["--edge-lengths", "lengths", "--repair=off"], ["--paper", "--accept-invalid=false"],
                        ["--edge-lengths", "lengths", "--weld", "off"]):
            with self.subTest(options=options):
                self.run_command("good.obj", "-o", "out.obj", "-q", *options)
        self.refused(2, "good.obj", "-o", "out.obj", "--edge-lengths", "lengths", "--repair=on", names="--edge-lengths")

    def test_defaults_can_be_given(self):
        for options in (["--drop-components", "off"], ["--fill-holes", "off"], ["--weld", "off"], ["--sizing", "off"]):
            for repair in ([], ["--repair"]):
                with self.subTest(options=options, repair=repair):
                    self.run_command("good.obj", "-o", "out.obj", "-q", *options, *repair)
        report = self.report("good.obj", "-o", "out.obj", "--repair", "--drop-components=off", "--fill-holes=off")
        self.assertEqual((report["parameters"]["drop_components"], report["parameters"]["fill_holes"]), (0, 0))
        self.write("run.toml", "repair = true\nfill-holes = 'off'\ndrop-components = 'off'\n")
        self.run_command("good.obj", "-o", "out.obj", "--config", "run.toml")

    def test_options_that_would_do_nothing(self):
        for option in (["--effort", "fast"], ["--map", "map"], ["--integrator", "damped"], ["--polish", "on"],
                       ["--filter", "local"], ["--connectivity", "flip"]):
            with self.subTest(option=option):
                self.refused(2, "good.obj", "-o", "out.obj", "--paper", *option, names=option[0], says="--paper")
        for option in ("--step-angle", "--step-expansion", "--step-displacement", "--step-area", "--string", "--torque",
                       "--friction"):
            with self.subTest(option=option):
                self.refused(2, "good.obj", "-o", "out.obj", option, ".5", names=option)
        for option in (["--filter-every", "step"], ["--trace-steps", "steps.csv"], ["--rho-unit", "file"]):
            with self.subTest(option=option):
                self.refused(2, "good.obj", "-o", "out.obj", *option, names=option[0], says="--paper")
        self.write("lengths", "0 1 1\n")
        for mode in ("flip", "adapt"):
            self.refused(2, "good.obj", "-o", "out.obj", "--edge-lengths", "lengths", "--connectivity", mode,
                         names="--edge-lengths")
        self.refused(2, "good.obj", "-o", "out.obj", "--connectivity", "adapt", "--refit", "each", names="--refit")
        self.refused(2, "good.obj", "--check", "--fields", "fields.ply", names="--fields")
        for option in (["--kernel", "r3"], ["--rho", ".1"]):
            self.refused(2, "good.obj", "-o", "out.obj", "--filter", "closest", *option, names=option[0])

    def test_lengths_out_of_all_proportion(self):
        for length in ("1e-7x", "1e7x", "1e-300", "1e300", "1e-320", "1e-9%"):
            with self.subTest(length=length):
                self.refused(2, "good.obj", "-o", "out.obj", "-L", length, names="--length '" + length)
        self.write("lengths", "1\n1e9\n1\n1\n")
        self.refused(2, "good.obj", "-o", "out.obj", "--sizing", "lengths", "-L", "sizing", "--gradation", "off",
                     names="--sizing 'lengths'")

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
        for text, problem in (("0 1 1\n2 9 1\n", "lengths:2: vertex id 9"), ("0 0 1\n", "lengths:1: vertex id 0 twice"),
                              ("0 1 1\n\n1 0 1\n", "lengths:3: edge 1 0 a second time, after line 1"),
                              ("0 1 1\n0 2 1\n1 2 2\n", "lengths: lengths 1, 2 and 1 for the edges of face 0 (0 2 1)"),
                              ("0 1 -1\n", "lengths:1: length -1")):
            self.write("lengths", text)
            self.refused(3, "good.obj", "-o", "out.obj", "--edge-lengths", "lengths", says=problem)
        self.write("two.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n")
        self.write("lengths", "0 3 1\n")
        self.refused(3, "two.off", "-o", "out.obj", "--edge-lengths", "lengths",
                     says="lengths:1: no edge from vertex 0 to 3; expected an edge of the mesh")
        self.write("lengths", "0 1 1e9\n1 2 1e9\n2 0 1e9\n")
        self.refused(2, "two.off", "-o", "out.obj", "--edge-lengths", "lengths", says="--edge-lengths 'lengths'")
        self.refused(2, "good.obj", "-o", "out.obj", "--sizing", "ply:size", names="good.obj")
        self.refused(3, DATA / "blob.ply", "-o", "out.obj", "--sizing", "ply:size", names="blob.ply", says="'size'")

    def test_id_list(self):
        self.write("ids", "0\none\n")
        self.refused(3, "good.obj", "-o", "out.obj", "--fix", "ids", names="ids:2")
        self.write("ids", "4\n")
        self.refused(3, "good.obj", "-o", "out.obj", "--fix", "ids", names="ids:1")

    def test_empty_files(self):
        self.write("empty", "")
        for option, expected in (("--edge-lengths", "two vertex ids and a length a line"), ("--fix", "one vertex id a line"),
                                 ("--sizing", "one length a line, for each vertex"), ("--compare", "a report that --report wrote")):
            with self.subTest(option=option):
                self.refused(3, "good.obj", "-o", "out.obj", option, "empty", says="empty: the file is empty; expected " + expected)
        (self.folder / "empty.obj").touch()
        self.refused(3, "empty.obj", "-o", "out.obj", says="empty.obj: the file is empty; expected a mesh")

    def test_not_acceptable(self):
        corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        self.refused_text(4, corner)
        three_at_an_edge = corner + "v 0 0 1\nv 0 0 -1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n"
        self.refused_text(4, three_at_an_edge)
        mixed = corner + "v 1 1 0\nf 1 2 3\nf 2 3 4\n"
        self.refused_text(4, mixed)

    def test_sizes_beyond_the_range_of_numbers(self):
        for scale in ("1e-60", "1e-300", "1e60", "1e300"):
            self.refused_text(4, TETRAHEDRON.replace("1 ", scale + " ", 2).replace("v 0 0 1", "v 0 0 " + scale),
                              says="scale the mesh")

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
        self.write("out.obj", "precious\n")
        with open("/dev/full", "wb") as full:
            for stream in (full, subprocess.DEVNULL):
                closed = stream == subprocess.DEVNULL
                self.refused(5, "good.obj", "-o", "out.obj", "--report", "-", names="standard output",
                             streams={"stdout": stream}, prepare=(lambda: os.close(1)) if closed else None)
            self.refused(5, "--help", names="standard output", streams={"stdout": full})

    def test_who_reads_the_report_finds_the_files(self):
        reading, writing = os.pipe()
        os.set_inheritable(writing, True)
        process = self.start("good.obj", "-o", "out.obj", "--map", "map", "--report", "-", "-q", streams={"stdout": writing})
        os.close(writing)
        first = os.read(reading, 1)
        there = self.files()
        while os.read(reading, 1 << 16):
            continue
        os.close(reading)
        process.communicate()
        self.assertEqual((process.returncode, first, there), (0, b"{", ["good.obj", "map", "out.obj"]))

    def test_a_report_that_nobody_can_read_takes_the_files_back(self):
        for name in ("out.obj", "map"):
            self.write(name, "precious\n")
        with open("/dev/full", "wb") as full:
            self.refused(5, "good.obj", "-o", "out.obj", "--map", "map", "--fields", "new.ply", "--report", "-",
                         names="standard output", streams={"stdout": full})

    def test_no_older_file_is_replaced_unless_all_can_be_written(self):
        for name in ("out.obj", "report.json", "map"):
            self.write(name, "precious\n")
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))  # the report is larger
        self.refused(5, "good.obj", "-o", "out.obj", "--report", "report.json", "--map", "map", names="report.json",
                     prepare=limit)

    def test_no_output_is_another_file_of_the_command(self):
        self.write("ids", "0\n")
        self.write("lengths", "1\n1\n1\n1\n")
        os.symlink(".", self.folder / "link")
        here = str(self.folder.resolve())
        for arguments, roles in ((["--fix", "ids", "--map", "ids"], ("--fix", "--map")),
                                 (["--fix", "ids", "--map", "link/ids"], ("--fix", "--map")),
                                 (["--sizing", "lengths", "--trace", "lengths"], ("--sizing", "--trace")),
                                 (["--report", here + "/out.obj"], ("--output", "--report")),
                                 (["--report", "link/out.obj"], ("--output", "--report")),
                                 (["--report", "new", "--map", "link/link/new"], ("--report", "--map")),
                                 (["--trace", "link/good.obj"], ("INPUT", "--trace"))):
            with self.subTest(arguments=arguments):
                message = self.refused(2, "good.obj", "-o", "out.obj", *arguments)
                for role in roles:
                    self.assertIn(role, message)

    def test_old_output_stays_when_the_input_is_refused(self):
        self.write("out.obj", "precious\n")
        self.write("bad.obj", "v 0 0 0\nf 1 2 3\n")
        self.refused(3, "bad.obj", "-o", "out.obj", names="bad.obj")

    def test_old_output_is_replaced_and_nothing_else_is_left(self):
        self.write("out.obj", "old\n")
        self.run_command("good.obj", "-o", "out.obj")
        self.assertEqual(self.files(), ["good.obj", "out.obj"])
        self.assertTrue((self.folder / "out.obj").read_text().startswith("v "))


class DeafReaders(CommandTest):
    """A result is not lost because nobody can read what is said about it."""

    def written(self, code=0, **how):
        self.run_command(DATA / "patch.obj", "-o", "out.obj", "-L", "1.5x", expect=code, **how)
        self.assertEqual(self.files(), ["good.obj", "out.obj"])
        self.assertTrue((self.folder / "out.obj").read_text().startswith("v "))
        (self.folder / "out.obj").unlink()

    def test_closed_standard_error(self):
        self.written(prepare=lambda: os.close(2))
        self.written(prepare=lambda: os.closerange(0, 3))

    def test_full_device(self):
        with open("/dev/full", "wb") as full:
            self.written(streams={"stderr": full})
            self.run_command("gone.obj", "-o", "out.obj", expect=3, streams={"stderr": full})
            self.run_command("--nothing", expect=2, streams={"stderr": full})

    def test_closed_pipe(self):
        reading, writing = os.pipe()
        os.close(reading)
        with open(writing, "wb") as pipe:
            self.run_command(DATA / "patch.obj", "-o", "out.obj", "--progress", "bar", streams={"stderr": pipe})
            self.assertTrue((self.folder / "out.obj").is_file())
            self.run_command("--nothing", expect=2, streams={"stderr": pipe})


class Limits(CommandTest):
    def test_a_dense_spline_beyond_the_memory(self):
        vertices, faces = irregular_torus(80, 80)
        write_off(self.folder / "torus.off", vertices, faces)
        gigabyte = lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
        probe = self.start("--version", prepare=gigabyte)
        probe.communicate()
        if probe.returncode != 0:
            self.skipTest("this build needs more address space than the test leaves it")
        for option in (["--filter", "global"], ["--paper"]):
            self.refused(8, "torus.off", "-o", "out.off", *option, names="torus.off", says="local filter", prepare=gigabyte)


if __name__ == "__main__":
    unittest.main()

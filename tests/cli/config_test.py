"""Files of settings: they do what the command line does, which goes first, and what they hold wrongly is told."""

import shutil
import tomllib
import unittest

from command import DATA, CommandTest


class Config(CommandTest):
    def setUp(self):
        super().setUp()
        shutil.copy(DATA / "patch.obj", self.folder / "in.obj")

    def bytes_of(self, name, *arguments):
        self.run_command(*arguments, "-o", name)
        return (self.folder / name).read_bytes()

    def refused_file(self, text, **expected):
        self.write("bad.toml", text)
        self.refused(2, "in.obj", "-o", "out.obj", "--config", "bad.toml", **expected)

    def test_a_file_does_what_the_command_line_does(self):
        self.write("a.toml", "# finer\nlength = '1.1x'  # in natural lengths\n\nconnectivity = \"flip\"\nmax-outer = 2\n"
                             "repair = true\npaper = false\nrequire = [\n  'after.min_angle.min >= 1',  # both\n"
                             "  \"after.min_angle.min >= 2\" ,\n]\n")
        by_file = self.bytes_of("out1.obj", "in.obj", "--config", "a.toml")
        by_line = self.bytes_of("out2.obj", "in.obj", "-L", "1.1x", "--connectivity", "flip", "--max-outer", 2, "--repair")
        self.assertEqual(by_file, by_line)
        report = self.report("in.obj", "-o", "out3.obj", "--config", "a.toml")
        self.assertEqual(len(report["gates"]), 2)

    def test_the_command_line_goes_first(self):
        self.write("a.toml", "connectivity = 'flip'\noutput = 'there.obj'\n")
        self.assertEqual(self.bytes_of("here.obj", "in.obj", "--config", "a.toml", "--connectivity", "fixed"),
                         self.bytes_of("plain.obj", "in.obj"))
        self.assertNotIn("there.obj", self.files())

    def test_a_printed_file_reproduces_the_run(self):
        options = ["--connectivity", "flip", "-L", "1.2x", "--effort", "fast", "--feature-angle", "off",
                   "--require", "after.min_angle.min >= 1", "--require", "geometry.flipped_faces == 0", "-q",
                   "--max-outer", "3", "--repair"]
        shutil.copy(DATA / "patch.obj", self.folder / "in, 'it' # 1.obj")
        text, err = self.run_command("in, 'it' # 1.obj", "-o", "out.obj", *options, "--print-config")
        self.assertEqual(err, "")
        self.assertNotIn("out.obj", self.files())
        self.write("run.toml", text)
        self.assertEqual(tomllib.loads(text)["length"], "1.2x")
        self.assertEqual(self.run_command("--config", "run.toml", "--print-config")[0], text)
        self.run_command("--config", "run.toml")
        again = (self.folder / "out.obj").read_bytes()
        self.assertEqual(again, self.bytes_of("direct.obj", "in.obj", *options))

    def test_what_is_printed_is_refused_as_a_run_is(self):
        self.refused(2, "in.obj", "-o", "out.obj", "--paper", "--effort", "fast", "--print-config", says="--effort")
        self.refused(2, "in.obj", "-o", "a'\"b.obj", "--print-config", says="quotes")

    def test_unknown_names_get_the_nearest_known_one(self):
        self.refused_file("length = 1\nconectivity = 'flip'\n", says="bad.toml:2: conectivity: unknown option; did you mean connectivity?")
        self.refused_file("no-such-thing = 1\n", says="bad.toml:1: no-such-thing: unknown option; hooke-remesh --help-all")

    def test_what_belongs_to_the_command_line_is_refused(self):
        for name in ("config", "help", "help-all", "version", "print-config", "completion", "man-page"):
            self.refused_file(name + " = true\n", says="bad.toml:1: " + name)

    def test_bad_values_are_told_with_their_line(self):
        for text, says in (("\nconnectivity = 'magic'\n", "bad.toml:2: --connectivity: 'magic'; expected fixed|flip|adapt"),
                           ("length = 'none'\n", "bad.toml:1: --length"),
                           ("threads = 0\n", "bad.toml:1: -j,--threads: '0'"),
                           ("length = [1, 2]\n", "bad.toml:1: length: an array"),
                           ("repair = 'yes'\n", "bad.toml:1: repair: 'yes'; expected true or false"),
                           ("effort = 'fast'\npaper = true\n", "bad.toml:1: --effort")):
            with self.subTest(text=text):
                self.refused_file(text, says=says)

    def test_what_is_no_such_file_is_told_with_its_line(self):
        for text, line in (("[target]\nlength = 1\n", 1), ("length 1\n", 1), ("length = \n", 1), ("length = fast\n", 1),
                           ("length = '1x\n", 1), ("length = '1x' 2\n", 1), ("length = 1\nlength = 2\n", 2),
                           ("require = ['a >= 1',\n", 2), ("length = \"a\\n\"\n", 1), ("length = 01\n", 1),
                           ("length = 1.\n", 1), ("length = 1e\n", 1), ("length = +\n", 1), ("length = 1\n= 2\n", 2), ("q\n", 1), ("\x1b = 1\n", 1)):
            with self.subTest(text=text):
                self.refused_file(text, says="bad.toml:%d: " % line)

    def test_a_number_of_any_length(self):
        digits = "1" * 300000
        self.refused_file("max-outer = %s\n" % digits, says="bad.toml:1: --max-outer")
        self.refused_file("length = %s.\n" % digits, says="bad.toml:1: ")

    def test_a_missing_file(self):
        self.refused(2, "in.obj", "-o", "out.obj", "--config", "gone.toml", names="gone.toml")


if __name__ == "__main__":
    unittest.main()

"""The help, the completions and the manual page: they fit the terminal, tell of every option, and what they say works."""

import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from command import DATA, TOOL, CommandTest

SOURCE = Path(__file__).resolve().parents[2] / "apps" / "options.cpp"


def options_in_source():
    """The long names of all options but the hidden ones, as they stand in the table."""
    names = set(re.findall(r'"(?:-\w,)?--([a-z][a-z-]+)(?:\{\w+\})?"', SOURCE.read_text()))
    return names - {"man-page"}


class Help(CommandTest):
    def text(self, *request):
        out, err = self.run_command(*request)
        self.assertEqual(err, "")
        return out

    def test_help_fits_the_terminal(self):
        for request in ("--help", "-h", "--help-all"):
            text = self.text(request)
            self.assertLessEqual(max(map(len, text.splitlines())), 80)
            self.assertNotIn("\x1b", text)
        self.assertLess(len(self.text("--help").splitlines()), 50)

    def test_every_option_is_in_the_full_help(self):
        text, names = self.text("--help-all"), options_in_source()
        self.assertGreater(len(names), 50)
        for name in names:
            self.assertRegex(text, r"(?m)^  (-\w, )?--%s( |$)" % name)

    def test_what_help_names_is_there(self):
        text, names = self.text("--help"), options_in_source()
        for name in re.findall(r"--([a-z][a-z-]+)", text):
            self.assertIn(name, names)
        for mode in ("fixed", "flip", "adapt"):
            self.assertRegex(text, r"(?m)^  %s  " % mode)

    def test_the_examples_of_the_help_run(self):
        text = self.text("--help")
        examples = [line for line in text.splitlines() if line.startswith("  hooke-remesh ")]
        self.assertEqual(len(examples), 3)
        shutil.copy(DATA / "patch.obj", self.folder / "in.obj")
        environment = {**os.environ, "PATH": str(Path(TOOL).parent) + ":" + os.environ["PATH"]}
        for example in examples:
            with self.subTest(example=example):
                subprocess.run(example, shell=True, cwd=self.folder, env=environment, check=True, capture_output=True)

    def test_exit_codes_are_in_the_full_help(self):
        text = self.text("--help-all")
        header = (SOURCE.parent / "exit_codes.h").read_text()
        for code in re.findall(r"= (\d+),", header):
            self.assertRegex(text, r"(?m)^  %s +\w" % code)

    def test_version(self):
        self.assertRegex(self.text("--version"), r"^hooke-remesh \d+\.\d+\.\d+\n$")


class ShellFiles(CommandTest):
    def script(self, *request, name):
        out, _ = self.run_command(*request)
        self.write(name, out)
        return out

    def completed(self, *words):
        """What bash offers for the last word."""
        quoted = " ".join("'%s'" % word for word in words)
        program = ("source ./bash.sh; COMP_WORDS=(hooke-remesh %s); COMP_CWORD=%d; _hooke_remesh 2>&1; "
                   "printf '%%s\\n' \"${COMPREPLY[@]}\"" % (quoted, len(words)))
        run = subprocess.run(["bash", "-c", program], cwd=self.folder, capture_output=True, text=True, check=True)
        return run.stdout.split()

    def test_bash_completes_options_and_their_words(self):
        self.script("--completion", "bash", name="bash.sh")
        subprocess.run(["bash", "-n", "bash.sh"], cwd=self.folder, check=True)
        self.assertEqual(self.completed("in.obj", "--conn"), ["--connectivity"])
        self.assertEqual(self.completed("--connectivity", ""), ["fixed", "flip", "adapt"])
        self.assertEqual(self.completed("--connectivity", "=", "fl"), ["flip"])
        self.assertEqual(self.completed("--connectivity", "="), ["fixed", "flip", "adapt"])
        self.assertEqual(self.completed("--effort", "t"), ["thorough"])
        self.assertEqual(self.completed("-o", ""), [])  # files, by default
        self.assertEqual(set(self.completed("--")), {"--" + name for name in options_in_source()})

    def test_every_option_is_in_every_script(self):
        for shell, form in (("bash", "--%s"), ("zsh", "--%s"), ("fish", " -l %s ")):
            text = self.script("--completion", shell, name=shell)
            for name in options_in_source():
                self.assertIn(form % name, text)

    def test_other_shells_understand_their_scripts(self):
        for shell in ("zsh", "fish"):
            self.script("--completion", shell, name=shell)
            if shutil.which(shell):
                subprocess.run([shell, "-n", shell], cwd=self.folder, check=True)

    def test_man_page(self):
        text = self.script("--man-page", name="hooke-remesh.1")
        for name in options_in_source():
            self.assertIn("\\-\\-" + name.replace("-", "\\-"), text)
        for command in (["mandoc", "-T", "lint", "-W", "warning"], ["groff", "-man", "-ww", "-z"],
                        ["man", "--warnings", "-l"]):
            if shutil.which(command[0]):
                run = subprocess.run([*command, "hooke-remesh.1"], cwd=self.folder, capture_output=True, text=True,
                                     env={**os.environ, "MANPAGER": "cat", "LC_ALL": "C.UTF-8"})
                self.assertEqual(run.stderr, "")
                if command[0] == "man":
                    self.assertIn("--skip-existing", re.sub(".\b", "", run.stdout))


if __name__ == "__main__":
    unittest.main()

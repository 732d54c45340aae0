"""What the README shows runs: the command's lines and those of jq."""

import os
import shlex
import shutil
import subprocess
import unittest

from command import DATA, TOOL, CommandTest

LINES = [line[4:] for line in (DATA.parent / "README.md").read_text().split("\n") if line.startswith("    ")]


class Readme(CommandTest):
    def setUp(self):
        super().setUp()
        for name in ("in.obj", "in.ply", "in.stl", "in.off"):
            self.run_command(DATA / "patch.obj", "-o", name, "-q")
        self.run_command("in.obj", "-o", "out.obj", "-q", "--report", "last_week.json")
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "hooke-remesh").symlink_to(TOOL)

    def shell(self, line):
        path = f"{self.folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
        done = subprocess.run(line, shell=True, cwd=self.folder, env={**os.environ, "PATH": path}, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, line + "\n" + done.stdout + done.stderr)
        return done.stdout

    def test_its_commands(self):
        lines = [line for line in LINES if line.startswith("hooke-remesh ")]
        self.assertGreater(len(lines), 5)
        for line in lines:
            with self.subTest(line=line):
                self.shell(line)

    @unittest.skipUnless(shutil.which("jq"), "jq is not installed")
    def test_its_jq(self):
        shutil.copy(DATA / "patch.obj", self.folder / "in.obj")
        self.run_command("in.obj", "-o", "out.obj", "-q", "--report", "report.json")
        lines = [line for line in LINES if line.startswith("jq ")]
        self.assertGreater(len(lines), 3)
        for line in lines:
            with self.subTest(line=line):
                self.assertEqual(shlex.split(line)[-1], "report.json")
                self.assertNotIn("null", self.shell(line))
                self.assertTrue(self.shell(line).strip())
        self.run_command("in.obj", "--check", "-q", "--report", "report.json")
        for line in lines:
            if line.startswith("jq -r"):
                self.shell(line)


if __name__ == "__main__":
    unittest.main()

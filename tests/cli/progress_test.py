"""The line of progress: on a terminal only, with share and time left, gone at the end; never with --quiet."""

import os
import pty
import re
import unittest

from command import CommandTest, irregular_torus, write_off


class ProgressLine(CommandTest):
    def on_terminal(self, *arguments, **environment):
        """What the command writes to standard error where that is a terminal."""
        vertices, faces = irregular_torus(120, 60)
        write_off(self.folder / "torus.off", vertices, faces)
        ours, its = pty.openpty()
        process = self.start("torus.off", "-o", "out.off", *arguments, streams={"stderr": its}, **environment)
        os.close(its)
        seen = b""
        while True:
            try:
                block = os.read(ours, 1 << 16)
            except OSError:  # the terminal is closed
                break
            if not block:
                break
            seen += block
        os.close(ours)
        process.communicate()
        self.assertEqual(process.returncode, 0, seen)
        return seen.decode()

    def test_tells_stage_and_share_and_leaves_a_clean_line(self):
        seen = self.on_terminal("--connectivity", "flip", TERM="xterm", NO_COLOR="1")
        self.assertNotIn("\x1b", seen)
        lines = [line for line in re.split("[\r\n]", seen) if "%  " in line and line.startswith("[")]
        self.assertTrue(lines, seen)
        for line in lines:
            self.assertRegex(line, r"^\[#*\.*\] +\d+ %  [a-z]+")
            self.assertLess(len(line), 80)
        shares = [int(re.search(r"(\d+) %", line)[1]) for line in lines]
        self.assertEqual(shares, sorted(shares))
        self.assertLessEqual(shares[-1], 100)
        # After the last line of progress it is overwritten by spaces, and the next text begins at the left.
        rest = seen[seen.rindex(lines[-1]) + len(lines[-1]):]
        self.assertRegex(rest, r"^\r {%d,}\r\S" % len(lines[-1].rstrip()))

    def test_never_where_it_is_not_wanted(self):
        for arguments, environment in ((["-q"], {}), (["--progress", "none"], {}), ([], {"TERM": "dumb"})):
            with self.subTest(arguments=arguments):
                self.assertNotIn(" %  ", self.on_terminal(*arguments, **environment).split("before")[0])
        self.assertNotIn("\r", self.run_command("torus.off", "-o", "out.off")[1])


if __name__ == "__main__":
    unittest.main()

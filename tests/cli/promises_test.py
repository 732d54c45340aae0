"""The tests that the page of promises names are there."""

import re
import unittest
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
PAGE = TESTS.parent / "src" / "hooke" / "io" / "README.md"


class Promises(unittest.TestCase):
    def test_each_named_test_is_there(self):
        python = "".join(p.read_text() for p in (TESTS / "cli").glob("*_test.py"))
        laws = "".join(p.read_text() for p in TESTS.rglob("*_test.cpp"))
        names = re.findall(r"`([^`]+)`", PAGE.read_text().split("\n", 6)[6])
        self.assertGreater(len(names), 40)
        for name in names:
            with self.subTest(name=name):
                if match := re.fullmatch(r"(\w+_test): (\w+)", name):
                    self.assertIn(match[2], (TESTS / "cli" / (match[1] + ".py")).read_text())
                elif name.startswith("test_"):
                    self.assertIn("def %s(" % name, python)
                elif match := re.fullmatch(r"([A-Z]\w+)\.(\w+|\*)", name):
                    self.assertIn("(%s, %s" % (match[1], match[2].rstrip("*")), laws)
                elif name.endswith("_test"):
                    self.assertTrue((TESTS / "cli" / (name + ".py")).is_file())


if __name__ == "__main__":
    unittest.main()

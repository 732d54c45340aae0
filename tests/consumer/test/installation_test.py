"""An installation has all that programs need: by find_package(), by pkg-config and by add_subdirectory()."""

import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

CONSUMER = Path(__file__).resolve().parents[1]
ROOT = CONSUMER.parents[1]
CMAKE = os.environ["CMAKE"]


def run(*command, **how):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **how)
    if done.returncode != 0:
        raise AssertionError(f"{shlex.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.prefix = cls.folder / "prefix"
        run(CMAKE, "--install", os.environ["BUILD_FOLDER"], "--prefix", cls.prefix)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def find(self, name):
        found = sorted(self.prefix.rglob(name))
        self.assertEqual(len(found), 1, f"{name}: {found}")
        return found[0]

    def configure(self, source, name):
        run(CMAKE, "-S", source, "-B", self.folder / name, "-DCMAKE_BUILD_TYPE=Debug", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        return self.folder / name

    def check(self, program):
        """The program of the README does what is said there."""
        before, after = map(float, re.match(r"least angle (\S+) -> (\S+) degrees", run(program)).groups())
        self.assertLess(before, 13)
        self.assertGreater(after, 44)

    def test_command_and_licence(self):
        self.assertIn("hooke-remesh", run(self.prefix / "bin" / "hooke-remesh", "--version"))
        self.find("LICENSE")
        headers = [p.relative_to(self.prefix / "include") for p in self.prefix.rglob("*.h")]
        self.assertTrue(all(p.parts[0] == "hooke" for p in headers))

    def test_completions_and_manual_page(self):
        share = self.prefix / "share"
        for file, line in (("bash-completion/completions/hooke-remesh", "complete -o default"),
                           ("zsh/site-functions/_hooke-remesh", "#compdef hooke-remesh"),
                           ("fish/vendor_completions.d/hooke-remesh.fish", "complete -c hooke-remesh -l connectivity"),
                           ("man/man1/hooke-remesh.1", ".SH OPTIONS")):
            self.assertIn("\n" + line, "\n" + (share / file).read_text())

    def test_find_package(self):
        build = self.configure(CONSUMER, "consumer")
        run(CMAKE, "--build", build, "-j", "2")
        self.check(build / "optimize_arrays")
        run(build / "optimize_file", ROOT / "data" / "torus.off", self.folder / "torus.ply")
        run(self.prefix / "bin" / "hooke-remesh", self.folder / "torus.ply", "--check")

    @unittest.skipUnless(shutil.which("pkg-config"), "pkg-config is not installed")
    def test_pkg_config(self):
        path = {**os.environ, "PKG_CONFIG_PATH": str(self.find("hooke_remesh.pc").parent)}
        static = ["--static"] if list(self.prefix.rglob("libhooke_remesh.a")) else []
        flags = shlex.split(run("pkg-config", "--cflags", "--libs", *static, "hooke_remesh", env=path))
        program = self.folder / "optimize_arrays"
        libraries = str(next(self.prefix.rglob("libhooke_remesh.*")).parent)
        run(os.environ["CXX"], CONSUMER / "optimize_arrays.cpp", "-o", program, *flags, f"-Wl,-rpath,{libraries}")
        self.check(program)

    def test_add_subdirectory_brings_the_library_and_nothing_else(self):
        source = self.folder / "outer"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(outer LANGUAGES CXX)\nenable_testing()\n"
            f"add_subdirectory({ROOT} hooke)\nadd_library(mine INTERFACE)\n"
            "target_link_libraries(mine INTERFACE hooke::remesh)\n")
        build = self.configure(source, "outer_build")
        targets = run(CMAKE, "--build", build, "--target", "help")
        self.assertIn("hooke", targets)
        self.assertNotIn("hooke_tests", targets)
        self.assertNotIn("hooke-remesh", targets)
        self.assertFalse((build / "hooke" / "tests").exists())

    def test_the_readme_shows_this_program(self):
        text = (CONSUMER / "optimize_arrays.cpp").read_text().split("\n", 1)[1].strip()
        shown = "\n".join(line.removeprefix("    ") for line in (ROOT / "README.md").read_text().split("\n"))
        self.assertIn(text, shown)


if __name__ == "__main__":
    unittest.main()

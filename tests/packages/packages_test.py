"""The Debian packages: lintian finds no error, and installed into an empty root they run there.

PACKAGES names the folder of the .deb files; cpack makes them in the build tree of the preset `package`."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAMES = {"hooke-remesh", "libhooke-remesh-dev", "python3-hooke-remesh"}
FILES = {p.name.split("_")[0]: p for p in Path(os.environ["PACKAGES"]).glob("*.deb")}


def run(*command, **how):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **how)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


def field(package, name):
    return run("dpkg-deb", "--field", FILES[package], name)


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = Path(folder.name) / "root"
        for name in ("info", "updates", "triggers"):
            (cls.root / "var" / "lib" / "dpkg" / name).mkdir(parents=True)
        (cls.root / "var" / "lib" / "dpkg" / "status").touch()
        as_root = [] if os.getuid() == 0 else ["fakeroot"]
        cls.dpkg = [*as_root, "dpkg", f"--root={cls.root}", "--force-depends", "--force-not-root", "--log=/dev/null"]
        run(*cls.dpkg, "--install", *FILES.values())

    def test_there_are_three(self):
        self.assertEqual(set(FILES), NAMES)

    @unittest.skipUnless(shutil.which("lintian"), "lintian is not installed")
    def test_lintian_finds_no_error(self):
        as_root = ["--allow-root"] if os.getuid() == 0 else []
        done = subprocess.run(["lintian", "--fail-on", "error", *as_root, *FILES.values()], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_they_name_what_they_need(self):
        self.assertIn("libc6", field("hooke-remesh", "Depends"))
        self.assertIn("libtbb12", field("hooke-remesh", "Depends"))
        self.assertIn("libopenmesh-dev", field("libhooke-remesh-dev", "Depends"))
        self.assertRegex(field("python3-hooke-remesh", "Depends"), r"python3 \(>= 3\.\d+\), python3 \(<< 3\.\d+\), python3-numpy")

    def test_each_has_its_licence(self):
        for name in NAMES:
            self.assertIn("BSD-3-Clause", (self.root / "usr/share/doc" / name / "copyright").read_text())

    def test_no_file_is_of_two(self):
        lists = [{line.split()[-1] for line in run("dpkg-deb", "--contents", file).splitlines() if line[0] != "d"}
                 for file in FILES.values()]
        self.assertEqual(sum(map(len, lists)), len(set().union(*lists)))

    def test_the_command_runs(self):
        out = self.root / "out.off"
        run(self.root / "usr/bin/hooke-remesh", ROOT / "data/torus.off", "-o", out, "--require", "promises.kept == 1")
        self.assertTrue(out.stat().st_size)
        self.assertTrue((self.root / "usr/share/hooke-remesh/report.schema.json").exists())

    def test_python_finds_the_package(self):
        program = ("import hooke_remesh as h; m = h.read('data/torus.off'); r = h.remesh(m.vertices, m.faces);"
                   "print(h.__file__, r.report['promises']['kept'])")
        path = self.root / "usr/lib/python3/dist-packages"
        where, kept = run("/usr/bin/python3", "-c", program, cwd=ROOT, env={"PYTHONPATH": str(path)}).split()
        self.assertTrue(where.startswith(str(path)))
        self.assertEqual(kept, "True")

    def test_a_program_is_built_with_the_library(self):
        build = self.root / "build"
        run("cmake", "-S", ROOT / "tests/consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={self.root / 'usr'}")
        run("cmake", "--build", build, "-j", "2")
        self.assertIn("least angle", run(build / "optimize_arrays"))

    def test_removing_them_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder) / "root"
            shutil.copytree(self.root / "var", root / "var")
            (root / "var/lib/dpkg/status").write_text("")
            dpkg = [argument.replace(str(self.root), str(root)) for argument in self.dpkg]
            run(*dpkg, "--install", *FILES.values())
            self.assertTrue((root / "usr/bin/hooke-remesh").exists())
            run(*dpkg, "--purge", *FILES)
            self.assertEqual([p for p in root.rglob("*") if not p.is_dir() and "var" not in p.parts], [])


if __name__ == "__main__":
    unittest.main()

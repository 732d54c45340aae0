"""Several inputs: each result as from a run of its own, one failure is no other's, and a table tells of all."""

import csv
import json
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from command import DATA, SANITIZED, TOOL, CommandTest, irregular_torus, write_off

SAMPLES = ["patch.obj", "cube.obj", "torus.off", "blob.ply"]


class Batch(CommandTest):
    def setUp(self):
        super().setUp()
        for sample in SAMPLES:
            shutil.copy(DATA / sample, self.folder / sample)
        self.write("bad.off", "this is no mesh\n")
        self.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n")

    def table(self, name="table.csv"):
        with open(self.folder / name, newline="") as file:
            return {row["file"]: row for row in csv.DictReader(file)}

    def content(self, name):
        return (self.folder / name).read_bytes()

    def test_results_are_those_of_single_runs(self):
        _, err = self.run_command(*SAMPLES, "-o", "out/", "--connectivity", "flip", "--report", "reports/", "--map", "maps/")
        self.assertIn("4 meshes: 4 done, in ", err)
        for sample in SAMPLES:
            self.run_command(sample, "-o", "alone-" + sample, "--connectivity", "flip", "--map", "map")
            self.assertEqual(self.content("out/" + sample), self.content("alone-" + sample))
            self.assertEqual(self.content("maps/%s.txt" % sample), self.content("map"))
            report = json.loads(self.content("reports/%s.json" % sample))
            self.assertEqual(report["output"]["path"], "out/" + sample)
        self.assertEqual(sorted(os.listdir(self.folder / "out")), sorted(SAMPLES))

    def test_one_failure_does_not_stop_the_others(self):
        inputs = ["patch.obj", "open.obj", "gone.obj", "bad.off", "torus.off"]
        _, err = self.run_command(*inputs, "-o", "out/", "--table", "table.csv", "--jobs", 3, expect=4)
        self.assertIn("5 meshes: 2 done, 3 not done (2 with exit code 3, 1 with exit code 4), in ", err)
        self.assertEqual(sorted(os.listdir(self.folder / "out")), ["patch.obj", "torus.off"])
        table = self.table()
        self.assertEqual(list(table), inputs)
        self.assertEqual([table[name]["exit_code"] for name in inputs], ["0", "4", "3", "3", "0"])
        self.assertEqual(table["bad.off"]["status"], "malformed_input")
        self.assertEqual(table["open.obj"]["status"], "unacceptable_mesh")
        self.assertIn("gone.obj", table["gone.obj"]["message"])
        row = table["patch.obj"]
        self.assertEqual((row["vertices_before"], row["faces_after"], row["flipped_faces"], row["message"]),
                         ("509", "928", "0", ""))
        self.assertGreater(float(row["least_angle_after"]), float(row["least_angle_before"]) + 20)
        self.assertLess(float(row["edge_cv_after"]), float(row["edge_cv_before"]))

    def test_the_exit_code_is_that_of_the_first_that_failed(self):
        self.run_command("patch.obj", "bad.off", "open.obj", "-o", "out/", expect=3)
        _, err = self.run_command("patch.obj", "cube.obj", "-o", "out/", "--require", "before.min_angle.min >= 2", expect=6)
        self.assertRegex(err, r"patch.obj: done in [\d.]+ s, but --require or --compare does not hold: least angle")

    def test_table_as_lines_of_json(self):
        self.run_command("cube.obj", "bad.off", "--check", "--table", "table.jsonl", expect=3)
        rows = [json.loads(line) for line in self.content("table.jsonl").splitlines()]
        self.assertEqual([row["file"] for row in rows], ["cube.obj", "bad.off"])
        self.assertEqual((rows[0]["status"], rows[0]["faces_before"], rows[0]["faces_after"]), ("checked", 912, None))
        self.assertIsNone(rows[1]["vertices_before"])

    def test_names(self):
        self.run_command("patch.obj", "cube.obj", "-o", "out/", "--suffix", "_better", "--format", "ply", "-q")
        self.assertEqual(sorted(os.listdir(self.folder / "out")), ["cube_better.ply", "patch_better.ply"])
        self.run_command("patch.obj", "-o", "single/", "-q")
        self.assertEqual(os.listdir(self.folder / "single"), ["patch.obj"])
        self.run_command("patch.obj", "cube.obj", "-o", "single", "-q")  # which is there
        self.assertEqual(sorted(os.listdir(self.folder / "single")), ["cube.obj", "patch.obj"])

    def test_what_cannot_be_is_refused_before_anything_is_run(self):
        (self.folder / "sub").mkdir()
        shutil.copy(DATA / "patch.obj", self.folder / "sub" / "patch.obj")
        two = ["patch.obj", "cube.obj"]
        for arguments, says in (
                (["patch.obj", "sub/patch.obj", "-o", "out/"], "out/patch.obj: would be an output of sub/patch.obj"),
                (["patch.obj", "sub/../patch.obj", "-o", "out/"], "would be an output of sub/../patch.obj"),
                (["patch.obj", "sub/patch.obj", "-o", "sub/"], "the input sub/patch.obj"),
                ([*two, "-o", "out.obj"], "expected a folder; write out.obj/"),
                ([*two, "-o", "-"], "--output -"),
                ([*two, "-o", "out/", "--report", "r.json"], "write r.json/"),
                ([*two, "-o", "out/", "--report", "-"], "--report -"),
                ([*two, "-", "-o", "out/"], "standard input"),
                ([*two, "-o", "out/", "--table", "t.txt"], ".csv or .jsonl"),
                ([*two, "-o", "out/", "--table", "patch.obj"], "--table patch.obj"),
                ([*two, "-o", "out/", "--suffix", "a/b"], "--suffix"),
                ([*two], "no output named"),
                (["patch.obj", "-o", "a.obj", "--suffix", "a"], "--suffix"),
                (["patch.obj", "-o", "a.obj", "--jobs", "2"], "--jobs"),
                (["patch.obj", "--check", "--skip-existing"], "--skip-existing")):
            with self.subTest(arguments=arguments):
                self.refused(2, *arguments, says=says)
        for name, says in (("*.nothing", "unknown format"), ("sub", "is a folder")):
            self.refused(3, name, "-o", "out/", says=f"error: {name}: {says}")
        self.refused(5, *two, "-o", "out/", "--table", "no/table.csv", names="table.csv")
        self.refused(5, *two, "-o", "patch.obj/", names="patch.obj")

    def test_no_output_takes_the_place_of_a_file_that_is_read(self):
        self.run_command("patch.obj", "--check", "--report", "base.json", "-q")
        for option, name, text in (("--fix", "fix.csv", "0\n"), ("--edge-lengths", "lengths.csv", "0 1 .1\n"),
                                   ("--sizing", "sizes.csv", ".1\n"), ("--compare", "base.csv", self.content("base.json").decode()),
                                   ("--config", "set.csv", "quiet = true\n")):
            self.write(name, text)
            with self.subTest(option=option):
                self.refused(2, "patch.obj", "-o", "out.obj", option, name, "--table", name, says="is the file of " + option)
                self.refused(2, "patch.obj", "-o", "out/", option, name, "--skip-existing", "--report", name,
                             says="is the file of " + option)
                self.refused(2, "patch.obj", "-o", "out.obj", option, name, "--report", name, says="of " + option)

    def test_a_record_of_other_content_is_no_record(self):
        run = ("patch.obj", "-o", "out.obj", "--skip-existing", "-q")
        self.run_command(*run)
        record = json.loads(self.content(".out.obj.hooke.json"))
        for broken in ({"work": 1}, {"work": None}, {"row": 1}, {"row": None}, {"outputs": "x"}, None, [], "text"):
            content = {**record, **broken} if isinstance(broken, dict) else broken
            self.write(".out.obj.hooke.json", json.dumps(content))
            before = (self.folder / "out.obj").stat().st_mtime_ns
            self.run_command(*run)
            self.assertNotEqual((self.folder / "out.obj").stat().st_mtime_ns, before, broken)
        self.assertEqual(json.loads(self.content(".out.obj.hooke.json"))["work"], record["work"])

    def test_what_is_done_is_skipped_until_something_changes(self):
        run = (*SAMPLES, "bad.off", "-o", "out/", "--table", "table.csv", "--skip-existing")
        self.run_command(*run, expect=3)
        first, results = self.table(), {name: self.content("out/" + name) for name in SAMPLES}
        times = {name: (self.folder / "out" / name).stat().st_mtime_ns for name in SAMPLES}

        def run_again(*options):
            _, err = self.run_command(*run, *options, expect=3)
            table = self.table()
            return {name for name in SAMPLES if table[name]["status"] != "skipped"}, table, err

        again, table, err = run_again("-j", 1, "-v")
        self.assertEqual(again, set())
        self.assertIn("5 meshes: 0 done, 4 skipped, 1 not done", err)
        self.assertEqual(times, {name: (self.folder / "out" / name).stat().st_mtime_ns for name in SAMPLES})
        for name in SAMPLES:
            self.assertEqual({k: v for k, v in table[name].items() if k != "status"},
                             {k: v for k, v in first[name].items() if k != "status"})
        self.write("patch.obj", (DATA / "patch.obj").read_text() + "# changed\n")
        (self.folder / "out" / "cube.obj").unlink()
        with open(self.folder / "out" / "blob.ply", "ab") as file:
            file.write(b"changed")
        self.assertEqual(run_again()[0], {"patch.obj", "cube.obj", "blob.ply"})
        self.assertEqual(self.content("out/blob.ply"), results["blob.ply"])
        self.assertEqual(run_again("-L", "1.1x")[0], set(SAMPLES))

    def test_a_single_mesh_is_skipped_too(self):
        run = ("patch.obj", "-o", "out.obj", "--report", "r.json", "--fix", "ids", "--skip-existing")
        self.write("ids", "0\n")
        _, err = self.run_command(*run)
        self.assertIn("minimum angle", err)
        self.assertIn("out.obj is there already", self.run_command(*run)[1])
        self.write("ids", "1\n")
        self.assertNotIn("is there already", self.run_command(*run)[1])

    def test_killed_and_resumed(self):
        names = []
        for k in range(6):
            names.append("torus%d.off" % k)
            write_off(self.folder / names[-1], *irregular_torus(100, 50, seed=k))
        run = (*names, "-o", "out/", "--jobs", 2, "--skip-existing", "--table", "table.csv")
        process = self.start(*run)
        out = self.folder / "out"
        limit = time.monotonic() + 60
        while not (out.exists() and len(list(out.glob(".*.hooke.json"))) >= 2) and time.monotonic() < limit:
            time.sleep(.01)
        process.kill()
        process.communicate()
        self.assertEqual(process.returncode, -signal.SIGKILL)
        time.sleep(.5)  # the processes of the meshes end by themselves
        before = len(list(out.glob(".*.hooke.json")))
        _, err = self.run_command(*run)
        skipped = [row for row in self.table().values() if row["status"] == "skipped"]
        self.assertEqual(len(skipped), before)
        self.assertGreaterEqual(before, 2)
        for name in names:
            self.run_command(name, "-o", "alone.off", "-q")
            self.assertEqual(self.content("out/" + name), self.content("alone.off"))
        self.assertEqual([p for p in os.listdir(out) if p.endswith(".tmp")], [])

    def test_a_signal_is_handed_on(self):
        write_off(self.folder / "big.off", *irregular_torus(240, 100))
        inputs = ["big.off", "torus.off", "patch.obj"]
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start(*inputs, "-o", "out/", "--jobs", 1, "--table", "table.csv", "-v", "--integrator", "damped")
            time.sleep(10 if SANITIZED else .7)
            process.send_signal(number)
            process.communicate()
            self.assertEqual(process.returncode, 128 + number)
            table = self.table()
            self.assertEqual(table["big.off"]["exit_code"], str(128 + number))
            self.assertEqual(table["big.off"]["status"], "interrupted")
            self.assertEqual(table["patch.obj"]["status"], "not_run")
            self.assertTrue((self.folder / "out" / "big.off").exists())

    def with_its_first_child(self, number, *arguments):
        """The messages of a batch in which the process of the first mesh, a slow one, gets a signal."""
        write_off(self.folder / "big.off", *irregular_torus(240, 100))
        process = self.start("big.off", "patch.obj", "-o", "out/", "--table", "table.csv", *arguments)
        children = Path("/proc/%d/task/%d/children" % (process.pid, process.pid))
        child, limit = [], time.monotonic() + 20
        while not child and children.exists() and time.monotonic() < limit:
            child = children.read_text().split()
        if not child:
            process.kill()
            process.communicate()
            self.skipTest("this system does not tell of children")
        time.sleep(.2)
        os.kill(int(child[0]), number)
        _, err = process.communicate()
        return process.returncode, err.decode()

    def test_a_crash_is_one_mesh_only(self):
        code, err = self.with_its_first_child(signal.SIGABRT, "--jobs", 1)
        self.assertEqual(code, 1)
        self.assertIn("hooke-remesh: error: big.off: ended by signal 6\n", err)
        table = self.table()
        self.assertIn("signal 6", table["big.off"]["message"])
        self.assertEqual((table["big.off"]["status"], table["patch.obj"]["exit_code"]), ("internal_error", "0"))

    def most_at_once(self, *arguments, prepare=None):
        """How many processes of meshes were seen at the same time."""
        process = self.start(*arguments, prepare=prepare, streams={"stderr": subprocess.DEVNULL})
        children = Path("/proc/%d/task/%d/children" % (process.pid, process.pid))
        most = 0
        while process.poll() is None:
            try:
                most = max(most, len(children.read_text().split()))
            except OSError:
                break
            time.sleep(.005)
        process.communicate()
        self.assertEqual(process.returncode, 0)
        return most

    def test_meshes_run_together_as_far_as_memory_goes(self):
        names = ["one.off", "two.off"]
        for name in names:
            write_off(self.folder / name, *irregular_torus(240, 100))
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (600 << 20, 600 << 20))
        if SANITIZED or not Path("/proc/self/task").exists():
            self.skipTest("needs a program without sanitizers, and Linux")
        run = (*names, "-o", "out/", "-j", 2, "--jobs", 2, "--effort", "fast")
        self.assertEqual(self.most_at_once(*run), 2)
        together = [self.content("out/" + name) for name in names]
        self.assertEqual(self.most_at_once(*run, prepare=limit), 1)
        self.assertEqual(together, [self.content("out/" + name) for name in names])

    def test_lack_of_memory_beside_others_gets_a_second_chance(self):
        """The system kills what it has no memory for."""
        code, err = self.with_its_first_child(signal.SIGKILL, "--jobs", 2)
        self.assertEqual(code, 0, err)
        self.assertEqual([row["exit_code"] for row in self.table().values()], ["0", "0"])
        code, err = self.with_its_first_child(signal.SIGKILL, "--jobs", 1)
        self.assertEqual(code, 8, err)
        self.assertEqual(self.table()["big.off"]["status"], "limit_reached")

    def test_loops_of_the_shell_do_the_same(self):
        """As apps/many_meshes.md shows them."""
        (self.folder / "out").mkdir()
        environment = {**os.environ, "PATH": str(Path(TOOL).parent) + ":" + os.environ["PATH"]}
        loops = ["printf '%s\\0' *.obj *.off | xargs -0 -P 2 -I{} hooke-remesh -q {} -o out/{}"]
        if shutil.which("parallel"):
            loops.append("parallel -j 2 hooke-remesh -q {} -o out/{} ::: *.obj *.off")
        readme = (DATA.parent / "apps" / "many_meshes.md").read_text()
        for name in ("bad.off", "open.obj"):
            (self.folder / name).unlink()
        for loop in loops:
            self.assertTrue(loop in readme, loop)
            subprocess.run(loop, shell=True, cwd=self.folder, env=environment, check=True, capture_output=True)
            self.assertEqual(sorted(os.listdir(self.folder / "out")), ["cube.obj", "good.obj", "patch.obj", "torus.off"])
            shutil.rmtree(self.folder / "out")
            (self.folder / "out").mkdir()


if __name__ == "__main__":
    unittest.main()

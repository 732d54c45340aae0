"""What goes wrong around the command: full and read-only disks, files that change, too little memory, signals. In each
case the exit code tells it, one message says what and where, and an older output is whole."""

import os
import resource
import signal
import subprocess
import threading
import time
import unittest

from command import SANITIZED, CommandTest, irregular_torus, read_mesh, write_off


class Disks(CommandTest):
    def mounted(self, *options):
        """A folder on a small disk of its own; the test is skipped where none may be mounted."""
        place = self.folder / "disk"
        place.mkdir(exist_ok=True)
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", ",".join(options), "tmpfs", place], capture_output=True)
        if done.returncode != 0:
            self.skipTest("no disk may be mounted here")
        self.addCleanup(subprocess.run, ["umount", place], check=True)
        return place

    def test_a_disk_that_fills_up_while_the_mesh_is_written(self):
        place = self.mounted("size=64k")
        write_off(self.folder / "torus.off", *irregular_torus(60, 40))  # larger than the disk
        (place / "out.off").write_text("older\n")
        self.refused(5, "torus.off", "-o", "disk/out.off", names="disk/out.off", says="No space left")
        self.assertEqual([p.name for p in place.iterdir()], ["out.off"])
        self.assertEqual((place / "out.off").read_text(), "older\n")

    def test_a_report_that_no_longer_fits_beside_the_mesh(self):
        place = self.mounted("size=16k")
        (place / "out.off").write_text("older\n")
        self.refused(5, "good.obj", "-o", "disk/out.off", "--report", "disk/report.json", says="No space left")
        self.assertEqual((place / "out.off").read_text(), "older\n")
        self.assertEqual([p.name for p in place.iterdir()], ["out.off"])

    def test_a_disk_that_is_read_only(self):
        place = self.mounted("ro")
        self.refused(5, "good.obj", "-o", "disk/out.off", names="disk/out.off", says="Read-only")
        self.assertEqual(list(place.iterdir()), [])


class Names(CommandTest):
    def test_a_folder_as_output(self):
        (self.folder / "out.off").mkdir()
        self.refused(5, "good.obj", "-o", "out.off", names="out.off")
        self.assertTrue((self.folder / "out.off").is_dir())

    def test_links_that_lead_to_each_other(self):
        (self.folder / "a.obj").symlink_to("b.obj")
        (self.folder / "b.obj").symlink_to("a.obj")
        self.refused(3, "a.obj", "-o", "out.off", names="a.obj", says="symbolic links")
        self.refused(5, "good.obj", "-o", "b.obj", names="b.obj", says="symbolic links")

    def test_a_link_to_the_output_stays_a_link(self):
        (self.folder / "place").mkdir()
        (self.folder / "place/mesh.off").write_text("older\n")
        (self.folder / "out.off").symlink_to("place/mesh.off")
        self.run_command("good.obj", "-o", "out.off")
        self.assertTrue((self.folder / "out.off").is_symlink())
        self.assertEqual(len(read_mesh(self.folder / "place/mesh.off")[1]), 4)

    def test_a_pipe_with_a_name_is_refused_at_once(self):
        os.mkfifo(self.folder / "pipe.obj")
        process = self.start("pipe.obj", "-o", "out.off")
        _, err = process.communicate(timeout=10)
        self.assertEqual(process.returncode, 3, err)
        self.assertIn(b"pipe.obj", err)


class Meanwhile(CommandTest):
    """The output's place changes while the mesh is optimized."""

    def running(self):
        write_off(self.folder / "torus.off", *irregular_torus(240, 100))
        return self.start_until(b"step", "torus.off", "-o", "out.off")

    def test_an_older_output_is_deleted(self):
        self.write("out.off", "older\n")
        process = self.running()
        (self.folder / "out.off").unlink()
        process.communicate()
        self.assertEqual(process.returncode, 0)
        self.assertEqual(len(read_mesh(self.folder / "out.off")[0]), 24000)

    def test_a_folder_takes_the_place_of_the_output(self):
        process = self.running()
        (self.folder / "out.off").mkdir()
        _, err = process.communicate()
        self.assertEqual(process.returncode, 5)
        self.assertIn(b"out.off", err)
        self.assertEqual(list((self.folder / "out.off").iterdir()), [])
        self.assertEqual(self.files(), ["good.obj", "out.off", "torus.off"])

    def test_the_folder_of_the_output_is_removed(self):
        (self.folder / "place").mkdir()
        write_off(self.folder / "torus.off", *irregular_torus(240, 100))
        process = self.start_until(b"step", "torus.off", "-o", "place/out.off")
        for p in (self.folder / "place").iterdir():
            p.unlink()
        (self.folder / "place").rmdir()
        _, err = process.communicate()
        self.assertEqual(process.returncode, 5)
        self.assertIn(b"place", err)


@unittest.skipIf(SANITIZED, "needs a program without sanitizers")
class Memory(CommandTest):
    def test_too_little_memory_is_said_and_an_older_output_stays(self):
        write_off(self.folder / "torus.off", *irregular_torus(300, 200))
        self.write("out.off", "older\n")
        codes = set()
        for megabytes in (40, 80, 120, 160, 240):
            limit = megabytes << 20
            process = self.start("torus.off", "-o", "out.off", "-q", "--threads", "1",
                                 prepare=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            _, err = process.communicate()
            codes.add(process.returncode)
            if process.returncode == 0:
                break
            self.assertEqual(process.returncode, 8, err)
            self.assertEqual(err.count(b"\n"), 1, err)
            self.assertIn(b"torus.off", err)
            self.assertIn(b"memory", err)
            self.assertEqual((self.folder / "out.off").read_text(), "older\n")
            self.assertEqual(self.files(), ["good.obj", "out.off", "torus.off"])
        self.assertIn(8, codes)


class Kills(CommandTest):
    def test_the_older_output_or_the_new_one_is_whole_whenever_the_process_is_killed(self):
        write_off(self.folder / "torus.off", *irregular_torus(200, 100))
        older = (self.folder / "torus.off").read_bytes()
        start = time.perf_counter()
        self.run_command("torus.off", "-o", "new.off", "-q")
        whole = time.perf_counter() - start
        new = (self.folder / "new.off").read_bytes()
        for i in range(12):
            (self.folder / "out.off").write_bytes(older)
            process = self.start("torus.off", "-o", "out.off", "-q")
            time.sleep(whole * (.6 + .5 * i / 12))  # the last part, where files are written
            process.kill()
            process.communicate()
            self.assertIn((self.folder / "out.off").read_bytes(), (older, new), i)


class Signals(CommandTest):
    """SIGINT and SIGTERM at moments spread over each mode: what is written is valid, and the exit code tells it."""

    def at_moments(self, *options, size=(60, 40), moments=6 if SANITIZED else 20):
        vertices, faces = irregular_torus(*size)
        write_off(self.folder / "torus.off", vertices, faces)
        start = time.perf_counter()
        self.run_command("torus.off", "-o", "out.off", "-q", *options)
        whole = time.perf_counter() - start
        counts = {0: 0}
        for i in range(moments):
            number = (signal.SIGINT, signal.SIGTERM)[i % 2]
            (self.folder / "out.off").unlink(missing_ok=True)
            process = self.start("torus.off", "-o", "out.off", "-q", *options)
            start = time.perf_counter()
            timer = threading.Timer(whole * (i + .5) / moments, lambda: process.send_signal(number))
            timer.start()
            _, err = process.communicate()
            if process.returncode == 0:  # the machine is less busy now
                whole = min(whole, time.perf_counter() - start)
            timer.cancel()
            timer.join()
            self.assertIn(process.returncode, (0, 128 + number, -number), err)
            counts[process.returncode] = counts.get(process.returncode, 0) + 1
            if process.returncode == -number:  # before the program had begun
                self.assertFalse((self.folder / "out.off").exists())
                continue
            result, kept = read_mesh(self.folder / "out.off")
            if "adapt" not in options:
                self.assertEqual(len(result), len(vertices))
            if "flip" not in options and "adapt" not in options:
                self.assertEqual(kept, faces)
            checked = self.report("out.off", "--check")
            self.assertEqual(checked["before"]["degenerate_faces"], 0)
        self.assertGreater(moments - counts[0], moments // 4, counts)  # signals do arrive

    def test_fixed(self):
        self.at_moments("--accept-invalid")

    def test_flip(self):
        self.at_moments("--connectivity", "flip", "--accept-invalid")

    def test_adapt(self):
        self.at_moments("--connectivity", "adapt", "--accept-invalid")

    def test_paper(self):
        self.at_moments("--paper", size=(30, 20))

    def test_damped(self):
        self.at_moments("--integrator", "damped", "--accept-invalid", size=(30, 20))


if __name__ == "__main__":
    unittest.main()

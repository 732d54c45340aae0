"""The first signal asks for the best mesh so far: it is written, valid, and the status says what happened."""

import json
import signal
import unittest

from command import CommandTest, irregular_torus, read_mesh, write_off


class Signals(CommandTest):
    def interrupt(self, number, *options):
        vertices, faces = irregular_torus(240, 100)
        write_off(self.folder / "torus.off", vertices, faces)
        process = self.start_until(b"step", "torus.off", "-o", "out.off", "--report", "report.json", *options)
        process.send_signal(number)
        _, err = process.communicate()
        self.assertEqual(process.returncode, 128 + number)
        self.assertEqual(err.count(b"\nhooke-remesh: stopping; once more ends at once, without a result\n"), 1)
        self.assertEqual(self.files(), ["good.obj", "out.off", "report.json", "torus.off"])
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["status"], "interrupted")
        self.assertEqual(report["geometry"]["flipped_faces"], 0)
        result, kept = read_mesh(self.folder / "out.off")
        self.assertEqual(kept, faces)
        self.assertEqual(len(result), len(vertices))

    def test_interrupt(self):
        self.interrupt(signal.SIGINT)

    def test_terminate(self):
        self.interrupt(signal.SIGTERM)

    def test_interrupted_damped_evolution(self):
        self.interrupt(signal.SIGINT, "--integrator", "damped")

    def test_interrupted_run_of_a_table(self):
        vertices, faces = irregular_torus(240, 100)
        write_off(self.folder / "torus.off", vertices, faces)
        process = self.start_until(b"step", "torus.off", "-o", "out.off", "--table", "table.csv")
        process.send_signal(signal.SIGINT)
        _, err = process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertEqual(err.count(b"stopping"), 1, err)


if __name__ == "__main__":
    unittest.main()

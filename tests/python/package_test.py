"""The Python package gives the command's results on arrays, its refusals as exceptions, and stops when it is asked to."""

import contextlib
import io
import itertools
import json
import signal
import sys
import textwrap
import threading
import unittest
import warnings

try:
    import numpy as np
except ImportError:
    sys.exit(77)

import hooke_remesh
from command import DATA, CommandTest, irregular_torus
from junctions_test import obj, two_boxes
from schema_test import SCHEMA, faults
from hooke_remesh import InputError, Interrupted, MeshError, MeshWarning, ResultError, UsageError, measure, read, remesh, write


def torus(around=30, across=12):
    vertices, faces = irregular_torus(around, across)
    return np.array(vertices), np.array(faces)


def without_times(value):
    """A report without what varies from run to run, or only files have."""
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items()
                if k not in ("resources", "path", "sha256", "format", "warnings", "preserve", "preserved", "reproject_uv", "keep") and not k.endswith("_s")}
    return [without_times(v) for v in value] if isinstance(value, list) else value


class TheCommandsResults(CommandTest):
    def same(self, sample, options=(), fields=(), **keywords):
        """The files of both, and their reports, are the same."""
        source = DATA / sample
        self.run_command(source, "-o", "command.ply", "--report", "report.json", *options)
        mesh = read(source)
        done = remesh(mesh.vertices, mesh.faces, **keywords)
        attributes = {name: mesh.attributes[name] for name in fields}
        write(self.folder / "python.ply", done.vertices, done.faces, attributes)
        self.assertEqual((self.folder / "python.ply").read_bytes(), (self.folder / "command.ply").read_bytes())
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(without_times(done.report), without_times(report))
        self.assertEqual(done.report.keys(), report.keys())
        return done

    def test_fixed(self):
        done = self.same("patch.obj")
        np.testing.assert_array_equal(done.faces, read(DATA / "patch.obj").faces)
        np.testing.assert_array_equal(done.map.vertices, np.arange(len(done.vertices)))

    def test_flip(self):
        self.same("torus.off", ["--connectivity", "flip", "--effort", "fast"], connectivity="flip", effort="fast")

    def test_adapt(self):
        done = self.same("block.ply", ["--connectivity", "adapt", "-L", "1.5x", "--feature-angle", "30"],
                         connectivity="adapt", length="1.5x", feature_angle=30)
        mesh = read(DATA / "block.ply")
        corners = mesh.vertices[mesh.faces[done.map.faces]]
        places = np.einsum("vk,vk...->v...", done.map.weights, corners)
        self.assertLess(np.abs(places - done.vertices).max(), .1 * done.report["input"]["bbox_diagonal"])
        self.assertTrue(np.allclose(done.map.weights.sum(axis=1), 1))

    def test_warnings(self):
        vertices, faces = torus()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            done = remesh(vertices, faces, length="20x")
        self.assertEqual([str(w.message) for w in caught], [w["message"] for w in done.report["warnings"]])
        self.assertIn("length_out_of_reach", [w["code"] for w in done.report["warnings"]])
        self.assertEqual({(w.category, w.filename) for w in caught}, {(MeshWarning, __file__)})
        with self.assertWarnsRegex(MeshWarning, "inside out"):
            measure(vertices, faces[:, ::-1])

    def test_numbers_words_and_flags(self):
        self.same("patch.obj", ["-L", "0.07", "--polish", "off", "--max-outer", "2", "--accept-invalid", "--boundary", "fixed"],
                  length=.07, polish=False, max_outer=2, accept_invalid=True, boundary="fixed")

    def test_paper(self):
        done = self.same("torus.off", ["--paper", "--max-outer", "1", "--max-steps", "20"], paper=True, max_outer=1,
                         max_steps=np.int64(20))
        self.assertIsNone(done.map)

    def test_fixed_vertices_in_an_array_and_in_a_file(self):
        self.write("ids.txt", "40\n41\n")
        ids = self.folder / "ids.txt"
        done = self.same("blob.ply", ["--fix", "ids.txt"], fix=np.array([40, 41]))
        np.testing.assert_array_equal(done.vertices[[40, 41]], read(DATA / "blob.ply").vertices[[40, 41]])
        self.same("blob.ply", ["--fix", "ids.txt"], fix=ids)

    def test_lengths_in_an_array(self):
        mesh = read(DATA / "torus.off")
        lengths = 1 + .2 * mesh.vertices[:, 0]
        self.write("lengths.txt", "".join(f"{float(x)!r}\n" for x in lengths))
        self.run_command(DATA / "torus.off", "-o", "command.ply", "--sizing", "lengths.txt", "--gradation", "off")
        done = remesh(mesh.vertices, mesh.faces, sizing=lengths, gradation="off")
        write(self.folder / "python.ply", done.vertices, done.faces)
        self.assertEqual((self.folder / "python.ply").read_bytes(), (self.folder / "command.ply").read_bytes())

    def test_gates(self):
        conditions = ["after.min_angle.min >= 20", "geometry.flipped_faces == 0", "after.min_angle.min > 60"]
        mesh = read(DATA / "patch.obj")
        done = remesh(mesh.vertices, mesh.faces, require=conditions)
        self.assertEqual([gate["passed"] for gate in done.report["gates"]], [True, True, False])
        self.assertEqual(done.report["gates"][2]["value"], done.report["after"]["min_angle"]["min"])

    def test_a_report_fits_the_schema_and_can_be_compared(self):
        mesh = read(DATA / "patch.obj")
        for options in ({}, {"connectivity": "adapt"}, {"paper": True}):
            report = remesh(mesh.vertices, mesh.faces, **options).report
            self.assertEqual(faults(report, SCHEMA), [])
        self.assertEqual(faults(measure(mesh.vertices, mesh.faces), SCHEMA), [])
        flipped = remesh(mesh.vertices, mesh.faces, connectivity="flip").report
        self.write("base.json", json.dumps(flipped))
        comparison = remesh(mesh.vertices, mesh.faces, compare=self.folder / "base.json").report["comparison"]
        self.assertIn("after.min_angle.min", [worse["key"] for worse in comparison["worse"]])
        self.assertNotIn("it is of another input", comparison["not_comparable"])

    def test_measures(self):
        mesh = read(DATA / "torus.off")
        self.assertEqual(without_times(measure(mesh.vertices, mesh.faces)),
                         without_times(self.report(DATA / "torus.off", "--check")))


    def test_lengths_of_edges_in_arrays(self):
        mesh = read(DATA / "patch.obj")
        edges = np.unique(np.sort(mesh.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
        lengths = np.linalg.norm(mesh.vertices[edges[:, 0]] - mesh.vertices[edges[:, 1]], axis=1)
        self.write("edges.txt", "".join(f"{a} {b} {l!r}\n" for (a, b), l in zip(edges.tolist(), lengths.tolist())))
        self.run_command(DATA / "patch.obj", "-o", "command.ply", "--edge-lengths", "edges.txt")
        done = remesh(mesh.vertices, mesh.faces, edge_lengths=(edges, lengths))
        write(self.folder / "python.ply", done.vertices, done.faces)
        self.assertEqual((self.folder / "python.ply").read_bytes(), (self.folder / "command.ply").read_bytes())
        self.assertEqual(without_times(measure(mesh.vertices, mesh.faces, edge_lengths=(edges, lengths))["before"]),
                         without_times(done.report["before"]))

    def test_no_lengths_of_edges(self):
        mesh = read(DATA / "patch.obj")
        self.write("none", "# none\n")
        self.run_command(DATA / "patch.obj", "-o", "command.ply", "--edge-lengths", "none")
        done = remesh(mesh.vertices, mesh.faces, edge_lengths=(np.empty((0, 2), int), []))
        write(self.folder / "python.ply", done.vertices, done.faces)
        self.assertEqual((self.folder / "python.ply").read_bytes(), (self.folder / "command.ply").read_bytes())

    def test_measures_take_arrays_too(self):
        vertices, faces = torus()
        lengths = 1 + .2 * vertices[:, 0]
        report = measure(vertices, faces, "sizing", sizing=lengths, gradation="off", fix=[3, 4])
        self.assertEqual((report["parameters"]["L_max"], report["parameters"]["fixed_vertices"]), (lengths.max(), 2))

    def test_repair(self):
        self.write("torn.obj", TORN)
        self.run_command("torn.obj", "-o", "command.ply", "--repair", "--report", "report.json", "-q")
        vertices, faces = torn()
        with self.assertRaises(MeshError):
            remesh(vertices, faces)
        done = remesh(vertices, faces, repair=True)
        write(self.folder / "python.ply", done.vertices, done.faces)
        self.assertEqual((self.folder / "python.ply").read_bytes(), (self.folder / "command.ply").read_bytes())
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual([(r["code"], r["count"]) for r in done.report["repairs"]],
                         [(r["code"], r["count"]) for r in report["repairs"]])
        self.assertEqual(measure(vertices, faces, repair=True)["before"]["min_angle"], done.report["before"]["min_angle"])
        with self.assertRaisesRegex(UsageError, "fix: vertex 0 was dropped"):
            remesh(vertices, faces, repair=True, fix=[1, 0])
        remesh(vertices, faces, repair=True, fix=[1, 2])


class Walls(CommandTest):
    """Meshes of several bodies, whose walls stay joined."""

    def setUp(self):
        super().setUp()
        vertices, faces, labels = two_boxes()
        self.write("boxes.obj", obj(vertices, faces, [(0, 1)] * len(faces)))
        self.vertices, self.faces = np.array(vertices), np.array(faces)

    def test_results_are_those_of_the_command(self):
        for mode in ("fixed", "flip", "adapt"):
            self.run_command("boxes.obj", "-o", "command.ply", "--keep", "non-manifold", "--connectivity", mode,
                             "--effort", "fast", "--map", "map", "--report", "report.json", "-q")
            done = remesh(self.vertices, self.faces, connectivity=mode, effort="fast", keep="non-manifold",
                          attributes={"place": self.vertices})
            write(self.folder / "python.ply", done.vertices, done.faces, keep="non-manifold")
            again = [read(self.folder / name, keep="non-manifold") for name in ("command.ply", "python.ply")]
            np.testing.assert_array_equal(again[0].vertices, again[1].vertices)
            np.testing.assert_array_equal(again[0].faces, again[1].faces)
            report = json.loads((self.folder / "report.json").read_text())
            self.assertEqual(without_times(done.report), without_times(report))
            self.assertEqual(done.report["parameters"]["keep"], "non-manifold")
            ids = np.loadtxt(self.folder / "map", dtype=int, usecols=(0, 1))
            np.testing.assert_array_equal(np.stack([done.map.vertices, done.map.faces], axis=1), ids)
            np.testing.assert_allclose(done.attributes["place"], self.vertices if mode == "fixed" else done.vertices, atol=1e-9)

    def test_attributes_of_their_vertices_are_kept_in_files(self):
        heat = self.vertices @ [1., 2, 3]
        write(self.folder / "walls.ply", self.vertices, self.faces, {"heat": heat}, keep="non-manifold")
        mesh = read(self.folder / "walls.ply", keep="non-manifold")
        np.testing.assert_array_equal(mesh.vertices, self.vertices)
        np.testing.assert_array_equal(mesh.faces, self.faces)
        np.testing.assert_array_equal(mesh.attributes["heat"], heat)

    def test_without_it_they_are_refused(self):
        for call in (lambda **keep: remesh(self.vertices, self.faces, **keep), lambda **keep: measure(self.vertices, self.faces, **keep),
                     lambda **keep: write(self.folder / "out.ply", self.vertices, self.faces, **keep),
                     lambda **keep: read(self.folder / "boxes.obj", **keep)):
            with self.assertRaisesRegex(MeshError, "--keep non-manifold"):
                call()
            with self.assertRaisesRegex(UsageError, "keep: 'seams'; expected 'non-manifold'"):
                call(keep="seams")
        self.assertEqual(measure(self.vertices, self.faces, keep="non-manifold")["input"]["vertices"], len(self.vertices))


# A tetrahedron with a face turned over, one listed twice, and a vertex in no face before the others.
TORN = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 4 3\nf 2 3 5\nf 3 4 5\nf 4 5 2\nf 4 5 2\n"


def torn():
    rows = [line.split() for line in TORN.splitlines()]
    return (np.array([row[1:] for row in rows if row[0] == "v"], float),
            np.array([row[1:] for row in rows if row[0] == "f"], int) - 1)


class Attributes(CommandTest):
    def test_stay_with_fixed_faces(self):
        vertices, faces = torus()
        given = {"label": np.arange(len(vertices)), "uv": np.random.default_rng(1).random((len(vertices), 2))}
        material = np.arange(len(faces)) % 3
        corners = np.arange(6 * len(faces)).reshape(-1, 3, 2)
        done = remesh(vertices, faces, attributes=given, face_attributes={"material": material},
                      corner_attributes={"uv": corners})
        for name, values in given.items():
            np.testing.assert_array_equal(done.attributes[name], values)
        np.testing.assert_array_equal(done.face_attributes["material"], material)
        np.testing.assert_array_equal(done.corner_attributes["uv"], corners)
        self.assertIsNot(done.face_attributes["material"], material)

    def test_are_interpolated_as_the_command_does(self):
        mesh = read(DATA / "torus.off")
        given = {"red": (127 * (1 + mesh.vertices[:, 0] / np.abs(mesh.vertices).max())).astype(np.uint8),
                 "quality": mesh.vertices[:, 1] ** 2}
        write(self.folder / "in.ply", mesh.vertices, mesh.faces, given)
        for mode in ("flip", "adapt"):
            self.run_command("in.ply", "-o", "out.ply", "--connectivity", mode, "--effort", "fast", "-q")
            done = remesh(mesh.vertices, mesh.faces, connectivity=mode, effort="fast", attributes=given, map=False)
            self.assertIsNone(done.map)
            expected = read(self.folder / "out.ply").attributes
            for name in given:
                np.testing.assert_array_equal(done.attributes[name], expected[name])
                self.assertEqual(done.attributes[name].dtype, given[name].dtype)

    def test_that_are_labels_stay_what_they_are(self):
        mesh = read(DATA / "torus.off")
        sides = np.where(mesh.vertices[:, 0] > 0, -3, 1004)
        flags = np.stack([mesh.vertices[:, 0] > 0, mesh.vertices[:, 1] > 0], axis=1).astype(np.uint8) * 7
        brightness = (100 * (1 + mesh.vertices[:, 0] / np.abs(mesh.vertices).max())).astype(np.uint16)
        given = {"side": sides, "flags": flags, "brightness": brightness}
        write(self.folder / "in.ply", mesh.vertices, mesh.faces, {"side": sides.astype(np.int32)})
        self.run_command("in.ply", "-o", "out.ply", "--connectivity", "adapt", "--effort", "fast", "-q")
        done = remesh(mesh.vertices, mesh.faces, connectivity="adapt", effort="fast", attributes=given)
        np.testing.assert_array_equal(done.attributes["side"], read(self.folder / "out.ply").attributes["side"])
        self.assertEqual(set(done.attributes["side"]), {-3, 1004})
        self.assertEqual(set(done.attributes["flags"].flat), {0, 7})
        self.assertGreater(len(set(done.attributes["brightness"]) - set(brightness)), 0)

    def test_of_vertices_that_stay_are_exact(self):
        vertices, faces = torus()
        ids, held = 2 ** 60 + np.arange(len(vertices)), np.arange(0, len(vertices), 5)
        done = remesh(vertices, faces, connectivity="flip", effort="fast", fix=held, attributes={"id": ids})
        np.testing.assert_array_equal(done.attributes["id"][held], ids[held])

    def test_of_several_columns_and_of_words(self):
        vertices, faces = torus()
        words = np.where(vertices[:, 0] > 0, "right", "left")
        done = remesh(vertices, faces, connectivity="adapt", attributes={"place": vertices, "side": words})
        np.testing.assert_allclose(done.attributes["place"], done.vertices, atol=.1)
        far = np.abs(done.vertices[:, 0]) > .3
        np.testing.assert_array_equal(done.attributes["side"][far] == "right", done.vertices[far, 0] > 0)

    def test_follow_a_repair(self):
        vertices, faces = torn()
        corners = np.stack([faces, 10 * faces], axis=-1)
        done = remesh(vertices, faces, repair=True, attributes={"id": np.arange(len(vertices))},
                      face_attributes={"id": np.arange(len(faces))}, corner_attributes={"vertex": corners})
        np.testing.assert_array_equal(done.attributes["id"], [1, 2, 3, 4])
        self.assertEqual(len(done.face_attributes["id"]), 4)
        old = done.attributes["id"][done.faces]
        np.testing.assert_array_equal(done.corner_attributes["vertex"], np.stack([old, 10 * old], axis=-1))

    def test_of_other_shapes_and_of_new_faces_are_refused(self):
        vertices, faces = torus()
        for options, says in (({"attributes": {"a": [1, 2]}}, r"attributes\['a'\] of shape"),
                              ({"corner_attributes": {"a": np.zeros(len(faces))}}, "x 3 x"),
                              ({"face_attributes": {"a": np.zeros(len(faces))}, "connectivity": "flip"}, "new faces"),
                              ({"edge_lengths": [1, 2, 3]}, "expected a pair"),
                              ({"edge_lengths": ([[0, 1]], [-1.])}, "expected a pair")):
            with self.subTest(options=options), self.assertRaisesRegex(UsageError, says):
                remesh(vertices, faces, **options)


class Arrays(unittest.TestCase):
    def test_types_and_layouts_make_no_difference_and_inputs_stay(self):
        vertices, faces = torus()
        before = vertices.copy(), faces.copy()
        one = remesh(vertices, faces)
        np.testing.assert_array_equal(vertices, before[0])
        np.testing.assert_array_equal(faces, before[1])
        for v, f in ((vertices, faces.astype(np.int32)), (np.asfortranarray(vertices), faces.astype(np.uint16)),
                     (vertices.tolist(), faces.tolist()), (np.repeat(vertices, 2, axis=0)[::2], faces[:, :])):
            other = remesh(v, f, threads=1)
            np.testing.assert_array_equal(other.vertices, one.vertices)
            np.testing.assert_array_equal(other.faces, one.faces)
        self.assertEqual((one.vertices.dtype, one.faces.dtype), (np.float64, np.int32))
        self.assertEqual(one.map.weights.shape, one.vertices.shape)

    def test_a_result_goes_in_again(self):
        done = remesh(*torus(), map=False)
        self.assertIsNone(done.map)
        self.assertEqual(done.report["status"], "stalled")
        self.assertEqual(measure(done.vertices, done.faces)["before"]["min_angle"], done.report["after"]["min_angle"])


class Refusals(unittest.TestCase):
    def test_what_is_off_is_not_refused(self):
        vertices, faces = torus()
        a, b = faces[0][:2]
        remesh(vertices, faces, edge_lengths=([[a, b]], [np.linalg.norm(vertices[a] - vertices[b])]), repair=False)
        remesh(vertices, faces, paper=True, accept_invalid=False, max_outer=1, max_steps=5)

    def test_options(self):
        vertices, faces = torus()
        for options, says in (({"effort": "much"}, "fast|default|thorough"), ({"length": -1}, "--length"),
                              ({"conectivity": "flip"}, "conectivity"), ({"paper": True, "effort": "fast"}, "--effort"),
                              ({"report": "a.json"}, "report"), ({"effort": {1}}, "set"), ({"require": "after.angle.min > 1"}, "min_angle"),
                              ({"sizing": [1., 2.]}, "each of the"), ({"sizing": ""}, "sizing"), ({"sizing": "ply:quality"}, "ply:"),
                              ({"length": 1e9}, "target lengths")):
            with self.subTest(options=options), self.assertRaisesRegex(UsageError, says.replace("|", r"\|")) as caught:
                remesh(vertices, faces, **options)
            self.assertIsInstance(caught.exception, ValueError)

    def test_what_is_of_the_command_only(self):
        vertices, faces = torus()
        for option in ("output", "config", "print_config", "print-config", "help-all", "completion", "man_page", "suffix",
                       "table", "skip_existing", "jobs"):
            for run in (remesh, measure):
                with self.assertRaisesRegex(UsageError, option + ": is for files and the terminal"):
                    run(vertices, faces, **{option: "x"})

    def test_arrays(self):
        vertices, faces = torus()
        for v, f, error in ((vertices[:, :2], faces, ValueError), (vertices, faces[:, :2], ValueError),
                            (vertices, faces.astype(float), TypeError), (vertices[0], faces, ValueError)):
            with self.assertRaises(error):
                remesh(v, f)

    def test_meshes(self):
        vertices, faces = torus()
        for wrong in (-1, len(vertices), 2**40):
            bad = faces.copy()
            bad[3, 1] = wrong
            with self.assertRaisesRegex(MeshError, rf"faces\[3, 1\] is {wrong}; expected"):
                remesh(vertices, bad)
        with self.assertRaisesRegex(MeshError, "no faces"):
            measure(vertices, np.empty((0, 3), int))
        with self.assertRaises(MeshError):
            measure(vertices, np.concatenate([faces, faces[:1]]))
        vertices[5, 2] = np.nan
        with self.assertRaisesRegex(MeshError, "5"):
            remesh(vertices, faces)

    def test_a_broken_promise(self):
        vertices, faces = torus()
        with self.assertRaises(ResultError):
            remesh(vertices, faces, connectivity="adapt", length="1.5x", max_distance=1e-9)
        done = remesh(vertices, faces, connectivity="adapt", length="1.5x", max_distance=1e-9, accept_invalid=True)
        self.assertFalse(done.report["promises"]["kept"])


class Files(CommandTest):
    def test_attributes_come_back(self):
        vertices, faces = torus()
        attributes = {"red": np.arange(len(vertices)).astype(np.uint8), "quality": np.linspace(0, 1, len(vertices))}
        for ascii in (False, True):
            write(self.folder / "mesh.ply", vertices, faces, attributes, ascii=ascii)
            mesh = read(self.folder / "mesh.ply")
            np.testing.assert_array_equal(mesh.vertices, vertices)
            np.testing.assert_array_equal(mesh.faces, faces)
            self.assertEqual(mesh.attributes.keys(), attributes.keys())
            for name, values in attributes.items():
                np.testing.assert_array_equal(mesh.attributes[name], values)
                self.assertEqual(mesh.attributes[name].dtype, values.dtype)
        with self.assertWarnsRegex(UserWarning, "quality"):
            write(str(self.folder / "mesh.obj"), vertices, faces, attributes)

    def test_refusals_leave_no_file(self):
        vertices, faces = torus()
        with self.assertRaises(InputError):
            read(self.folder / "none.ply")
        with self.assertRaises(UsageError):
            write(self.folder / "mesh.doc", vertices, faces)
        with self.assertRaises(UsageError):
            write(self.folder / "mesh.ply", vertices, faces, {"quality": [1.]})
        with self.assertRaises(UsageError):
            write(self.folder / "mesh.ply", vertices, faces, {"quality": np.zeros(len(vertices), complex)})
        with self.assertRaises(hooke_remesh.OutputError):
            write(self.folder / "none" / "mesh.ply", vertices, faces)
        self.assertEqual(self.files(), ["good.obj"])


class Stops(unittest.TestCase):
    def setUp(self):
        self.vertices, self.faces = torus(240, 100)

    def check(self, result):
        self.assertEqual(result.report["status"], "interrupted")
        self.assertEqual(result.report["geometry"]["flipped_faces"], 0)
        np.testing.assert_array_equal(result.faces, self.faces)

    def test_progress_is_told_and_may_stop(self):
        told = []

        def progress(stage, outer, step, energy):
            told.append((stage, outer, step, energy))
            return False

        self.check(remesh(self.vertices, self.faces, progress=progress))
        self.assertEqual(len(told), 1)
        self.assertEqual([type(x) for x in told[0]], [str, int, int, float])

    def test_interrupt_gives_the_best_so_far(self):
        told = []
        with self.assertRaises(KeyboardInterrupt) as caught:
            remesh(self.vertices, self.faces,
                   progress=lambda *_: told.append(1) or (len(told) == 1 and signal.raise_signal(signal.SIGINT)) or None)
        self.assertIsInstance(caught.exception, Interrupted)
        self.check(caught.exception.result)

    def test_exceptions_of_the_progress_function_come_through(self):
        with self.assertRaisesRegex(RuntimeError, "enough"):
            remesh(self.vertices, self.faces, progress=lambda *_: (_ for _ in ()).throw(RuntimeError("enough")))

    def test_other_threads_run_meanwhile(self):
        done = threading.Event()
        turns = []
        thread = threading.Thread(target=lambda: [turns.append(1) for _ in iter(lambda: done.wait(.01), True)])
        thread.start()
        remesh(*torus(120, 50))
        done.set()
        thread.join()
        self.assertGreater(len(turns), 3)


class Readme(CommandTest):
    def test_its_example_runs(self):
        lines = iter((DATA.parent / "README.md").read_text().split("\n"))
        example = [next(line for line in lines if line == "    import hooke_remesh")]
        example += itertools.takewhile(lambda line: not line or line.startswith("    "), lines)
        code = textwrap.dedent("\n".join(example)).replace("data/", f"{DATA}/").replace("out.ply", f"{self.folder}/out.ply")
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(code, {})
        before, after = map(float, printed.getvalue().split())
        self.assertGreater(after, 20 * before)
        self.assertEqual(len(read(self.folder / "out.ply").vertices), len(read(DATA / "patch.obj").vertices))


class OtherLibraries(CommandTest):
    """The lines of the README for them."""

    def run_lines(self, first, **modules):
        lines = iter((DATA.parent / "README.md").read_text().split("\n"))
        code = [next(line for line in lines if line.startswith("    " + first))]
        code += itertools.takewhile(lambda line: line.startswith("    "), lines)
        names = {"hooke_remesh": hooke_remesh, **modules}
        with contextlib.chdir(self.folder) if hasattr(contextlib, "chdir") else contextlib.nullcontext():
            exec(textwrap.dedent("\n".join(code)), names)
        return names

    def test_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("python3-meshio is not installed")
        vertices, faces = torus()
        heat = vertices @ np.array([[1., 0], [0, 2], [0, 0]])
        meshio.Mesh(vertices, [("triangle", faces)], point_data={"heat": heat}).write(self.folder / "in.vtu")
        done = self.run_lines("m = meshio.read", meshio=meshio)["done"]
        again = meshio.read(self.folder / "out.vtu")
        np.testing.assert_array_equal(again.points, done.vertices)
        np.testing.assert_array_equal(again.cells_dict["triangle"], faces)
        np.testing.assert_array_equal(again.point_data["heat"], heat)

    def test_trimesh(self):
        try:
            import trimesh
        except ImportError:
            self.skipTest("trimesh is not installed")
        write(self.folder / "in.ply", *torus())
        done = self.run_lines("t = trimesh.load", trimesh=trimesh)["done"]
        self.assertEqual(len(read(self.folder / "out.ply").vertices), len(done.vertices))


if __name__ == "__main__":
    unittest.main()

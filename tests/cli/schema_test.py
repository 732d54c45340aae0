"""Reports of every kind of run against the JSON Schema of the project, which is in step with the tool, and so is the
page about the report."""

import json
import signal
import unittest

from command import DATA, CommandTest, irregular_torus, write_off

REPORT = DATA.parent / "src" / "hooke" / "report"
SCHEMA = json.loads((REPORT / "report.schema.json").read_text())
TYPES = {"string": str, "number": (int, float), "integer": int, "boolean": bool, "object": dict, "array": list,
         "null": type(None)}

try:
    import jsonschema
except ImportError:
    jsonschema = None


def faults(value, schema, place="report"):
    """What is wrong with a value by a schema of types, closed objects and lists."""
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    fits = any(isinstance(value, TYPES[kind]) and (kind == "boolean") == isinstance(value, bool) for kind in kinds)
    if not fits:
        return [f"{place}: {value!r:.40} is no {' or '.join(kinds)}"]
    found = []
    if isinstance(value, dict):
        other = schema["additionalProperties"]
        found += [f"{place}: no {key}" for key in schema["required"] if key not in value]
        for key, member in value.items():
            if key not in schema["properties"] and other is False:
                found.append(f"{place}: unknown {key}")
            else:
                found += faults(member, schema["properties"].get(key, other), f"{place}.{key}")
    if isinstance(value, list):
        for member in value:
            found += faults(member, schema["items"], f"{place}[]")
    return found


class Schema(CommandTest):
    def holds(self, report):
        self.assertEqual(faults(report, SCHEMA), [])
        if jsonschema:
            jsonschema.Draft202012Validator(SCHEMA).validate(report)
        return report

    def test_runs_of_every_mode(self):
        for options in ((), ("--connectivity", "flip"), ("--connectivity", "adapt"), ("--paper",),
                        ("--integrator", "damped"), ("--filter", "none"), ("--sizing", "curvature:1%"),
                        ("--effort", "fast", "--polish", "off", "--feature-angle", "off"),
                        ("--connectivity", "adapt", "--max-outer", "2", "--max-steps", "50")):
            with self.subTest(options=options):
                self.holds(self.report(DATA / "patch.obj", "-o", "out.obj", "-q", *options))

    def test_other_meshes_and_formats(self):
        for mesh, output in (("cube.obj", "out.stl"), ("blob.ply", "out.ply"), ("torus.off", "out.msh")):
            with self.subTest(mesh=mesh):
                self.holds(self.report(DATA / mesh, "-o", output, "-q"))

    def test_checks(self):
        report = self.holds(self.report(DATA / "patch.obj", "--check", "-q"))
        for key in ("output", "promises", "after", "geometry", "projection", "held_back", "near_regular", "features",
                    "flips", "adaptation", "comparison"):
            self.assertIsNone(report[key], key)
        self.assertEqual((report["iterations"], report["paper"]["after"]), ([], None))

    def test_repaired(self):
        self.write("torn.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 4 1\nf 3 4 1\n")
        report = self.holds(self.report("torn.obj", "--check", "--repair", "-q"))
        self.assertTrue(report["repairs"])

    def test_failed_gates_and_comparisons(self):
        self.run_command(DATA / "patch.obj", "-o", "out.obj", "-q", "--report", "base.json", "--connectivity", "flip")
        report = self.holds(self.report(DATA / "patch.obj", "-o", "out.obj", "-q", "--require",
                                        "after.min_angle.min > 50", "--require", "adaptation.splits > 1",
                                        "--compare", "base.json", expect=6))
        self.assertTrue(report["comparison"]["worse"])
        self.assertTrue(report["comparison"]["not_comparable"])

    def test_interrupted(self):
        write_off(self.folder / "torus.off", *irregular_torus(300, 100))
        process = self.start_until(b"%", "torus.off", "-o", "out.off", "--report", "report.json", "--connectivity", "adapt", "-v",
                             "--effort", "thorough")
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 130)
        report = self.holds(json.loads((self.folder / "report.json").read_text()))
        self.assertEqual(report["status"], "interrupted")

    def test_an_unknown_and_a_missing_key_are_found(self):
        report = self.report("good.obj", "--check", "-q")
        report["after_all"] = 1
        del report["input"]["area"]
        report["before"]["folded_edges"] = True
        self.assertEqual(faults(report, SCHEMA), ["report.input: no area",
                                                  "report.before.folded_edges: True is no integer",
                                                  "report: unknown after_all"])

    def test_schema_and_page_are_those_of_the_tool(self):
        for form, file in (("schema", "report.schema.json"), ("markdown", "README.md")):
            out, err = self.run_command(f"--list-metrics={form}")
            self.assertEqual(err, "")
            self.assertEqual(out, (REPORT / file).read_text(), f"hooke-remesh --list-metrics={form} > {REPORT / file}")

    def test_the_list_needs_no_mesh(self):
        out, _ = self.run_command("--list-metrics")
        self.assertIn("after.min_angle.min ", out)
        self.assertEqual(out, self.run_command("--list-metrics=text")[0])
        self.refused(2, "--list-metrics=pdf", says="'pdf'; expected text, markdown or schema")


if __name__ == "__main__":
    unittest.main()

"""STL, Gmsh's MSH and VTP: read, optimized, written and read again, also by other programs; standard streams."""

import base64
import json
import random
import shutil
import struct
import subprocess
import unittest
import zlib

from command import DATA, TETRAHEDRON, CommandTest, read_mesh, write_off

BLOB = DATA / "blob.ply"


def stl_facets(data):
    """(corners, attribute) of each facet of a binary file."""
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    rows = [struct.unpack_from("<12fH", data, 84 + 50 * k) for k in range(count)]
    return [((row[3:6], row[6:9], row[9:12]), row[12]) for row in rows]


def msh_labels(text):
    """(nodes, [(group, nodes of the triangle)]) of a file of version 2.2."""
    rows = [line.split() for line in text.splitlines()]
    at = rows.index(["$Nodes"])
    nodes = [tuple(map(float, row[1:])) for row in rows[at + 2:at + 2 + int(rows[at + 1][0])]]
    at = rows.index(["$Elements"])
    elements = [list(map(int, row)) for row in rows[at + 2:at + 2 + int(rows[at + 1][0])]]
    return nodes, [(e[3], tuple(n - 1 for n in e[5:])) for e in elements]


def vtp_bytes(vertices, faces, form, order="<", sizes="I", packed=False):
    """A VTP file whose arrays are `form`: ascii, binary, base64 (appended) or raw (appended)."""
    numbers = lambda code, values: struct.pack("%s%d%s" % (order, len(values), code), *values)
    arrays = [("Points", "", "Float64", "d", [x for v in vertices for x in v]),
              ("Polys", "connectivity", "Int32", "i", [v for f in faces for v in f]),
              ("Polys", "offsets", "Int64", "q", [3 * (k + 1) for k in range(len(faces))])]

    def parts(data):
        """What stands before an array and the array, each of which is base64 of its own if it is packed."""
        if not packed:
            return [numbers(sizes, [len(data)]) + data]
        size = 1000
        blocks = [data[k:k + size] for k in range(0, len(data), size)]
        squeezed = [zlib.compress(block) for block in blocks]
        return [numbers(sizes, [len(blocks), size, len(blocks[-1]) % size] + list(map(len, squeezed))), b"".join(squeezed)]

    encode = lambda data: b"".join(base64.b64encode(part) for part in parts(data))
    appended = b""
    elements = {"Points": b"", "Polys": b""}
    for place, name, kind, code, values in arrays:
        start = '<DataArray type="%s" Name="%s" NumberOfComponents="%d" format="%s"' % (
            kind, name, 3 if place == "Points" else 1, "appended" if form in ("base64", "raw") else form)
        if form == "ascii":
            element = start + ">" + " ".join(map(repr, values)) + "</DataArray>"
        elif form == "binary":
            element = start + ">\n" + encode(numbers(code, values)).decode() + "\n</DataArray>"
        else:
            element = start + ' offset="%d"/>' % len(appended)
            appended += encode(numbers(code, values)) if form == "base64" else b"".join(parts(numbers(code, values)))
        elements[place] += element.encode()
    head = '<VTKFile type="PolyData" version="1.0" byte_order="%s" header_type="%s"%s><PolyData>' % (
        "LittleEndian" if order == "<" else "BigEndian", "UInt32" if sizes == "I" else "UInt64",
        ' compressor="vtkZLibDataCompressor"' if packed else "")
    piece = '<Piece NumberOfPoints="%d" NumberOfPolys="%d">' % (len(vertices), len(faces))
    body = b"".join(b"<%s>%s</%s>" % (k.encode(), v, k.encode()) for k, v in elements.items())
    tail = b"" if form in ("ascii", "binary") else b'<AppendedData encoding="%s">\n_%s</AppendedData>' % (form.encode(), appended)
    return b'<?xml version="1.0"?>\n' + head.encode() + piece.encode() + body + b"</Piece></PolyData>" + tail + b"</VTKFile>"


class Stl(CommandTest):
    def test_a_closed_mesh_goes_through_stl(self):
        out, err = self.run_command(BLOB, "-o", "a.stl", "--effort", "fast", "--report", "-")
        self.assertEqual(json.loads(out)["output"]["format"], "stl")
        report = self.report("a.stl", "-o", "b.stl", "--effort", "fast")
        before, after = report["input"], report["output"]
        for key in ("vertices", "faces", "edges", "components", "boundary_loops"):
            self.assertEqual(before[key], json.loads(out)["output"][key])
            self.assertEqual(before[key], after[key])
        self.assertEqual([r["code"] for r in report["repairs"]], ["corners_welded"])
        self.assertEqual(report["warnings"], [])
        self.assertEqual(len(stl_facets((self.folder / "b.stl").read_bytes())), after["faces"])

    def test_the_flavour_of_the_input_stays(self):
        self.run_command(BLOB, "-o", "binary.stl", "-q", "--effort", "fast")
        self.write("text.stl", "solid my part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                   "endloop\nendfacet\nendsolid my part\n")
        for source, start in (("binary.stl", b"binary STL"), ("text.stl", b"solid my part\nfacet normal 0 0 1\n")):
            self.run_command(source, "-o", "out.stl", "-q", "--effort", "fast")
            self.assertTrue((self.folder / "out.stl").read_bytes().startswith(start))

    def test_the_note_is_no_warning_and_quiet_hides_it(self):
        self.run_command("good.obj", "-o", "a.stl", "-q")
        _, err = self.run_command("a.stl", "--check")
        self.assertIn("hooke-remesh: note: a.stl: 12 corners of facets are 4 different points", err)
        _, err = self.run_command("a.stl", "--check", "-q")
        self.assertEqual(err, "")

    def test_attributes_of_facets_stay_and_are_named_where_they_cannot(self):
        self.run_command("good.obj", "-o", "a.stl", "-q")
        data = bytearray((self.folder / "a.stl").read_bytes())
        for k in range(4):
            data[84 + 50 * k + 48] = k + 1
        (self.folder / "b.stl").write_bytes(data)
        _, err = self.run_command("b.stl", "-o", "c.stl", "-q")
        self.assertEqual(err, "")
        self.assertEqual([a for _, a in stl_facets((self.folder / "c.stl").read_bytes())], [1, 2, 3, 4])
        _, err = self.run_command("b.stl", "-o", "c.obj", "-q")
        self.assertIn("c.obj: obj files cannot hold attribute; use STL", err)

    def test_vertices_that_only_differ_in_double_precision_are_told(self):
        vertices = [(100, 0, 0), (100 + 1e-9, 0, 0), (100, -1, 0), (100, 1, 0)]
        write_off(self.folder / "thin.off", vertices, [(0, 2, 1), (0, 1, 3)])
        _, err = self.run_command("thin.off", "-o", "out.stl", "-q", "--boundary", "fixed", "--accept-invalid")
        self.assertIn("out.stl: 1 vertices have the coordinates of another in this STL file", err)

    def test_numbers_beyond_32_bits_are_refused(self):
        write_off(self.folder / "far.off", [(0, 0, 0), (1e39, 0, 0), (0, 1e39, 0)], [(0, 1, 2)])
        self.refused(5, "far.off", "-o", "out.stl", "-q", names="out.stl: a coordinate of 1e+39", says="at most 3.4e38")

    def test_a_file_of_facets_in_one_place_is_refused(self):
        flat = "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n"
        self.write("flat.stl", "solid\n" + flat + "endsolid\n")
        self.refused(4, "flat.stl", "-o", "out.stl", says="no faces", names="flat.stl")
        self.refused(4, "flat.stl", "-o", "out.stl", says="faces_dropped 1")


class Msh(CommandTest):
    def setUp(self):
        super().setUp()
        vertices, faces = read_mesh(BLOB)
        self.groups = [1 + (sum(vertices[v][2] for v in face) > 0) for face in faces]
        rows = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '2 1 "low"', '2 2 "high"',
                "$EndPhysicalNames", "$Nodes", str(len(vertices))]
        rows += ["%d %r %r %r" % (7 * k + 3, *v) for k, v in enumerate(vertices)]
        rows += ["$EndNodes", "$Elements", str(len(faces))]
        rows += ["%d 2 2 %d %d %d %d %d" % (k + 1, g, g + 10, *(7 * v + 3 for v in face))
                 for k, (g, face) in enumerate(zip(self.groups, faces))]
        self.write("in.msh", "\n".join(rows + ["$EndElements"]) + "\n")
        self.faces = faces

    def test_groups_stay_with_their_faces(self):
        for target in ([], ["--format", "msh"], ["--format", "msh2"]):
            _, err = self.run_command("in.msh", "-o", "out.msh", "-q", "--effort", "fast", *target)
            self.assertRegex(err, r"^hooke-remesh: warning: in.msh: \d+ edges at borders of .* --keep materials holds these borders in their places\n$")
            text = (self.folder / "out.msh").read_text()
            self.assertIn('2 1 "low"\n2 2 "high"\n', text)
            self.assertEqual(text.splitlines()[1], "4.1 0 8" if target == ["--format", "msh"] else "2.2 0 8")
            if "msh" in target:
                self.run_command("out.msh", "-o", "again.msh", "-q", "--effort", "fast", "--format", "msh2")
                text = (self.folder / "again.msh").read_text()
            _, triangles = msh_labels(text)
            self.assertEqual([g for g, _ in triangles], self.groups)
            is_kept = "msh" not in target
            self.assertEqual([tuple((v - 2) // 7 for v in t) if is_kept else t for _, t in triangles], self.faces)

    def test_numbers_of_nodes_lines_and_values_stay_with_the_faces(self):
        text = (self.folder / "in.msh").read_text().replace("$PhysicalNames\n2\n", '$PhysicalNames\n3\n1 9 "clamp"\n')
        count = len(self.faces)
        text = text.replace(f"$Elements\n{count}\n", f"$Elements\n{count + 1}\n{count + 1} 1 2 9 1 {' '.join(str(7 * v + 3) for v in self.faces[0][:2])}\n")
        self.write("in.msh", text + '$NodeData\n1\n"T"\n1\n0\n3\n0\n1\n1\n3 .50\n$EndNodeData\n')
        _, err = self.run_command("in.msh", "-o", "out.msh", "-q", "--effort", "fast")
        self.assertNotIn("not kept", err)
        before, after = ((self.folder / name).read_text().split("\n") for name in ("in.msh", "out.msh"))
        nodes = range(before.index("$Nodes"), before.index("$EndNodes"))
        self.assertEqual([k for k, (a, b) in enumerate(zip(before, after, strict=True)) if a != b and k not in nodes], [])
        self.assertNotEqual(before, after)
        for held in self.faces[0][:2]:
            row = nodes[2 + held]
            self.assertTrue(before[row].startswith(f"{7 * held + 3} "))
            self.assertEqual(before[row], after[row], "an end of the line")
        self.assertEqual([before[k].split()[0] for k in nodes], [after[k].split()[0] for k in nodes])

    def test_groups_become_solids(self):
        self.run_command("in.msh", "-o", "a.msh", "-q", "--effort", "fast")
        facet = "facet normal 0 0 1\nouter loop\nvertex %d 0 0\nvertex %d 0 0\nvertex %d 1 0\nendloop\nendfacet\n"
        self.write("two.stl", "solid one\n" + facet % (0, 1, 0) + "endsolid\nsolid two\n" + facet % (5, 6, 5) + "endsolid\n")
        self.run_command("two.stl", "-o", "two.msh", "-q", "--format", "msh2")
        text = (self.folder / "two.msh").read_text()
        self.assertIn('2 1 "one"\n2 2 "two"\n', text)
        self.assertEqual([g for g, _ in msh_labels(text)[1]], [1, 2])

    def test_dropped_groups_are_named(self):
        for arguments, why in ((["out.obj"], "obj files cannot hold entity; use MSH"), (["out.off"], "off files cannot hold group, entity; use MSH"),
                               (["out.stl"], "stl files cannot hold group, entity; use MSH"), (["out.ply"], "ply files cannot hold names of groups; use MSH"),
                               (["out.msh", "--connectivity", "flip", "--keep", "groups"], "face data not kept: group, entity: new faces have none")):
            _, err = self.run_command("in.msh", "-q", "--effort", "fast", "-o", *arguments)
            self.assertIn(why, err)
            self.assertEqual(len([line for line in err.splitlines() if "--keep materials holds" not in line]), 1)


class Vtp(CommandTest):
    def test_every_way_to_store_the_arrays_gives_the_same_mesh(self):
        vertices, faces = read_mesh(BLOB)
        expected = None
        for form in ("ascii", "binary", "base64", "raw"):
            for order in "<>":
                for sizes in "IQ":
                    for packed in (False, True):
                        if form == "ascii" and (packed, order, sizes) != (False, "<", "I"):
                            continue
                        with self.subTest(form=form, order=order, sizes=sizes, packed=packed):
                            data = vtp_bytes(vertices, faces, form, order, sizes, packed)
                            (self.folder / "in.vtp").write_bytes(data)
                            report = self.report("in.vtp", "--check")
                            self.assertEqual(report["warnings"], [])
                            self.assertEqual(report["input"]["format"], "vtp")
                            found = {**report["input"], "sha256": None}
                            expected = expected or found
                            self.assertEqual(found, expected)
        self.run_command("in.vtp", "-o", "out.ply", "-q", "--effort", "fast")
        self.refused(2, "in.vtp", "-o", "out/", names="out/in.vtp: VTP can only be read", says="or give --format")
        self.run_command("in.vtp", "-o", "out/", "--format", "ply", "-q", "--effort", "fast")
        self.assertTrue((self.folder / "out" / "in.ply").is_file())
        self.assertEqual(read_mesh(self.folder / "out.ply")[1], faces)

    def test_labels_of_cells_go_along(self):
        vertices, faces = read_mesh(BLOB)
        labels = [3 if sum(vertices[v][2] for v in face) > 0 else 8 for face in faces]
        cells = '<CellData><DataArray type="Int64" Name="tissue" format="ascii">%s</DataArray></CellData></Piece>' % " ".join(map(str, labels))
        (self.folder / "in.vtp").write_bytes(vtp_bytes(vertices, faces, "ascii").replace(b"</Piece>", cells.encode()))
        report = self.report("in.vtp", "-o", "out.ply", "-q", "--connectivity", "adapt")
        self.assertEqual(report["warnings"], [])
        self.assertGreater(report["features"]["seam_edges"], 10)
        header = (self.folder / "out.ply").read_bytes().split(b"end_header")[0]
        self.assertIn(b"property int tissue", header)
        _, err = self.run_command("in.vtp", "-o", "out.off", "-q", "--effort", "fast")
        self.assertIn("tissue", err)

    def test_it_is_not_written(self):
        self.refused(2, "good.obj", "-o", "out.vtp", names="out.vtp", says="can only be read")
        self.refused(2, "good.obj", "-o", "out.obj", "--format", "vtp", says="--format")


class BrokenFiles(CommandTest):
    def test_bytes_changed_cut_or_repeated_at_random(self):
        """No crash, no lasting work, and no result but a valid mesh."""
        rng = random.Random(7)
        vertices, faces = read_mesh(BLOB)
        faces = [f for f in faces if max(f) < 100] or faces[:50]
        vertices = vertices[:100]
        write_off(self.folder / "part.off", vertices, faces)
        sources = {"raw.vtp": vtp_bytes(vertices, faces, "raw", packed=True), "text.vtp": vtp_bytes(vertices, faces, "ascii")}
        for name, target in (("a.stl", []), ("a.msh", []), ("b.msh", ["--format", "msh2"])):
            self.run_command("part.off", "-o", name, "-q", "--accept-invalid", *target)
            sources[name] = (self.folder / name).read_bytes()
        for name, data in sources.items():
            for k in range(25):
                broken = bytearray(data)
                for _ in range(rng.choice((1, 1, 3, 10))):
                    at = rng.randrange(len(broken))
                    kind = rng.randrange(4)
                    if kind == 0:
                        broken[at] = rng.randrange(256)
                    elif kind == 1:
                        del broken[at:at + rng.choice((1, 10, len(broken)))]
                    elif kind == 2:
                        broken[at:at] = broken[at // 2:at // 2 + rng.choice((1, 40))]
                    else:
                        broken[at:at + 4] = b"\xff\xff\xff\x7f"
                    broken = broken or bytearray(b"x")
                (self.folder / ("x" + name)).write_bytes(broken)
                process = self.start("x" + name, "--check", "-q", *rng.choice(([], ["--repair", "--weld", ".1%"])))
                _, err = process.communicate(timeout=20)
                self.assertIn(process.returncode, (0, 3, 4), err)


    def test_files_without_faces(self):
        (self.folder / "a.stl").write_bytes(b" " * 80 + bytes(4))
        self.write("b.stl", "solid\nendsolid\n")
        self.write("c.vtp", '<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="0"/></PolyData></VTKFile>')
        for name in ("a.stl", "b.stl", "c.vtp"):
            for options in ([], ["--repair", "--fill-holes", "9"], ["--weld", "1%"]):
                self.refused(4, name, "-o", "out.obj", *options, names=name, says="no faces")


class Streams(CommandTest):
    def piped(self, data, *arguments, expect=0):
        process = self.start(*arguments, streams={"stdin": subprocess.PIPE})
        out, err = process.communicate(data)
        self.assertEqual(process.returncode, expect, err)
        return out, err.decode()

    def test_the_mesh_goes_from_standard_input_to_standard_output(self):
        self.run_command("good.obj", "-o", "out.off", "-q")
        expected = (self.folder / "out.off").read_bytes()
        for source in ("-", "/dev/stdin"):
            out, err = self.piped(TETRAHEDRON.encode(), source, "--input-format", "obj", "-o", "-", "--format", "off")
            self.assertEqual(out, expected)
            self.assertIn("standard input: 4 vertices", err)
        self.assertEqual(self.files(), ["good.obj", "out.off"])
        out, _ = self.piped(TETRAHEDRON.encode(), "-", "--input-format", "obj", "-o", "x.obj", "--report", "-", "-q")
        self.assertEqual(json.loads(out)["input"]["path"], "standard input")

    def test_streams_need_formats_and_are_used_once(self):
        self.refused(2, "-", "-o", "out.obj", says="--input-format")
        self.refused(2, "good.obj", "-o", "-", says="--format")
        self.refused(2, "good.obj", "-o", "-", "--format", "obj", "--report", "-", says="--report")
        self.refused(2, "-", "--input-format", "ply", "-o", "out.obj", "--sizing", "ply:size", says="--sizing")

    def test_errors_name_the_stream(self):
        _, err = self.piped(b"v 0 0 x\n", "-", "--input-format", "obj", "--check", expect=3)
        self.assertIn("standard input:1: z is 'x'", err)
        _, err = self.piped(b"", "-", "--input-format", "obj", "--check", expect=3)
        self.assertIn("standard input: is empty", err)
        with open("/dev/full", "wb") as full:
            process = self.start("good.obj", "-o", "-", "--format", "obj", "-q", streams={"stdout": full})
            _, err = process.communicate()
        self.assertEqual(process.returncode, 5)
        self.assertIn(b"standard output: cannot be written: No space left", err)

    def test_the_format_may_differ_from_the_extension(self):
        self.write("mesh.txt", TETRAHEDRON)
        self.refused(3, "mesh.txt", "-o", "out.obj", names="mesh.txt: unknown format", says="meshio, gmsh or admesh")
        self.run_command("mesh.txt", "--input-format", "obj", "-o", "out.obj", "-q")
        self.refused(3, "mesh.txt", "--input-format", "ply", "--check", says="looks like obj; expected ply")


class OtherPrograms(CommandTest):
    def program(self, *command):
        if not shutil.which(command[0]):
            self.skipTest("no %s here" % command[0])
        run = subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(run.returncode, 0, run.stdout)
        return run.stdout

    def test_admesh_finds_nothing_to_mend_and_its_files_are_read(self):
        self.run_command(BLOB, "-o", "a.stl", "-q", "--effort", "fast")
        said = self.program("admesh", "--write-ascii-stl=text.stl", "--write-binary-stl=binary.stl", "a.stl")
        self.assertIn("All facets connected", said)
        for name in ("text.stl", "binary.stl"):
            report = self.report(name, "-o", "b" + name, "--effort", "fast", "-q")
            self.assertEqual(report["input"]["boundary_loops"], 0)
            self.assertIn("All facets connected", self.program("admesh", "b" + name))

    def test_gmsh_writes_what_is_read_and_reads_what_is_written(self):
        self.write("g.geo", 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 1, 1};\nPhysical Surface("lid", 7) = {6};\n'
                   'Physical Surface("rest", 9) = {1:5};\nPhysical Volume("all", 1) = {1};\nMesh.MeshSizeMax = .3;\n')
        for version in ("msh22", "msh41"):
            for binary in ([], ["-bin"]):
                self.program("gmsh", "-3", "g.geo", "-format", version, "-o", "g.msh", *binary)
                _, err = self.run_command("g.msh", "-o", "out.msh", "-q")
                self.assertRegex(err, r"not kept in the output: \d+ tetrahedra, \d+ nodes of no triangle\n")
                self.assertRegex(err, "its tetrahedra would not fit moved nodes")
                self.assertIn('2 7 "lid"\n2 9 "rest"\n', (self.folder / "out.msh").read_text())
                said = self.program("gmsh", "-check", "out.msh")
                self.assertNotIn("Error", said)
                self.assertNotIn("Warning", said)


if __name__ == "__main__":
    unittest.main()

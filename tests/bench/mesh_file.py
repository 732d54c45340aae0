"""Reads and writes the triangle meshes of the tests and benchmarks. Python 3 standard library only.

A mesh is (vertices, faces): a list of (x, y, z) and a list of (a, b, c), 0-based.
"""

import math
import struct
from pathlib import Path


def read_mesh(path):
    """The mesh of an OBJ, OFF or PLY file as hooke-remesh writes them. Raises ValueError for anything else."""
    path = Path(path)
    reader = {".obj": _read_obj, ".off": _read_off, ".ply": _read_ply}[path.suffix]
    vertices, faces = reader(path.read_bytes())
    for vertex in vertices:
        if len(vertex) != 3 or not all(map(math.isfinite, vertex)):
            raise ValueError("%s: bad vertex %r" % (path, vertex))
    for face in faces:
        if len(face) != 3 or not all(0 <= v < len(vertices) for v in face):
            raise ValueError("%s: bad face %r" % (path, face))
    return vertices, faces


def _read_obj(data):
    vertices, faces = [], []
    for line in data.decode().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            faces.append(tuple(int(w.split("/")[0]) - 1 for w in words[1:]))
    return vertices, faces


def _read_off(data):
    keyword, counts, *rows = [line.split() for line in data.decode().splitlines() if line.strip()]
    if not keyword[0].endswith("OFF"):
        raise ValueError("not an OFF file")
    nv, nf = int(counts[0]), int(counts[1])
    vertices = [tuple(map(float, row[:3])) for row in rows[:nv]]  # colours and the like may follow
    faces = [tuple(map(int, row[1:1 + int(row[0])])) for row in rows[nv:nv + nf]]
    return vertices, faces


_PLY_CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f",
              "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
              "float32": "f", "float64": "d"}


def read_fields(path):
    """The properties of the vertices and of the faces of a PLY file: two dicts of lists by name, without the corners."""
    rows = _ply_rows(Path(path).read_bytes())
    return tuple({name: [row[name] for row in rows[element]] for name in (rows[element] or [{}])[0] if name not in _CORNERS}
                 for element in ("vertex", "face"))


_CORNERS = ("vertex_indices", "vertex_index")


def _read_ply(data):
    rows = _ply_rows(data)
    vertices = [(row["x"], row["y"], row["z"]) for row in rows["vertex"]]
    faces = [tuple(row.get("vertex_indices", row.get("vertex_index"))) for row in rows["face"]]
    return vertices, faces


def _ply_rows(data):
    header, body = data.split(b"end_header\n", 1)
    lines = [line.split() for line in header.decode().splitlines()]
    layout = next(words[1] for words in lines if words[0] == "format")
    value = _ascii_values(body) if layout == "ascii" else _binary_values(body, "<" if "little" in layout else ">")
    elements = {}
    for words in lines:
        if words[0] == "element":
            properties = elements[words[1]] = [int(words[2])]
        elif words[0] == "property":
            properties.append(words[1:])
    rows = {}
    for name, (count, *properties) in elements.items():
        rows[name] = [_ply_row(properties, value) for _ in range(count)]
    return rows


def _ply_row(properties, value):
    row = {}
    for words in properties:
        if words[0] == "list":
            row[words[3]] = [value(words[2]) for _ in range(value(words[1]))]
        else:
            row[words[1]] = value(words[0])
    return row


def _ascii_values(body):
    words = iter(body.split())
    return lambda kind: (float if _PLY_CODES[kind] in "fd" else int)(next(words))


def _binary_values(body, order):
    position = 0

    def value(kind):
        nonlocal position
        code = order + _PLY_CODES[kind]
        (result,) = struct.unpack_from(code, body, position)
        position += struct.calcsize(code)
        return result

    return value


def write_off(path, vertices, faces):
    """Coordinates with all their digits."""
    lines = ["OFF", "%d %d 0" % (len(vertices), len(faces))]
    lines += ["%r %r %r" % tuple(map(float, v)) for v in vertices]
    lines += ["3 %d %d %d" % tuple(f) for f in faces]
    Path(path).write_text("\n".join(lines) + "\n")

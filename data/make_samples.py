#!/usr/bin/env python3
"""make_samples.py [FOLDER]   writes the sample meshes of this folder: badly shaped triangles on smooth surfaces.

Python 3 standard library only; the same files on every machine (coordinates are rounded to 1e-6).
Each mesh is the Delaunay triangulation of independent random points of its parameter domain: a square for the
open patch, the unit sphere for the blob, a periodic rectangle for the torus. Points are inserted one by one
and edges flipped until all are Delaunay again (C. L. Lawson, Software for C1 surface interpolation, 1977).
"""

import math
import random
import struct
import sys
from pathlib import Path


class Triangulation:
    """Faces in counter-clockwise order, and the face to the left of every directed edge."""

    def __init__(self, faces):
        self.faces = dict(enumerate(faces))
        self.left = {}
        for face in self.faces:
            self._register(face)

    def _register(self, face):
        a, b, c = self.faces[face]
        for edge in ((a, b), (b, c), (c, a)):
            self.left[edge] = face

    def _apex(self, edge):
        face = self.left.get(edge)
        return None if face is None else next(v for v in self.faces[face] if v not in edge)

    def insert(self, vertex, contains, inside_circle):
        """Puts a vertex into the face that contains it; `inside_circle(a, b, c, d)` decides the flips."""
        face = next(f for f, corners in self.faces.items() if contains(corners, vertex))
        a, b, c = self.faces[face]
        for slot, corners in ((face, (a, b, vertex)), (len(self.faces), (b, c, vertex))):
            self.faces[slot] = corners
        self.faces[len(self.faces)] = (c, a, vertex)
        for slot in (face, len(self.faces) - 2, len(self.faces) - 1):
            self._register(slot)
        suspects = [(a, b), (b, c), (c, a)]
        while suspects:
            suspects += self._flip_if_needed(suspects.pop(), inside_circle)

    def _flip_if_needed(self, edge, inside_circle):
        a, b = edge
        near, far = self._apex((a, b)), self._apex((b, a))
        if near is None or far is None or (near, far) in self.left or (far, near) in self.left:
            return []
        if not inside_circle(a, b, near, far):
            return []
        first, second = self.left.pop((a, b)), self.left.pop((b, a))
        self.faces[first], self.faces[second] = (a, far, near), (far, b, near)
        self._register(first)
        self._register(second)
        return [(a, far), (far, b)]


def det3(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))


def lifted_determinant(origin_to_b, origin_to_c, origin_to_d):
    """Negative when d lies inside the circle through the origin, b and c (counter-clockwise)."""
    return det3(*[(x, y, x * x + y * y) for x, y in (origin_to_b, origin_to_c, origin_to_d)])


def triangulate_flat(points, faces, difference):
    """Inserts the points that no face uses yet; `difference(p, q)` is q - p in the plane, wrapped or not."""

    def contains(corners, vertex):
        a, b, c = (points[v] for v in corners)
        ax, ay = difference(points[vertex], a)
        (bx, by), (cx, cy) = difference(a, b), difference(a, c)  # from a: a far face must not be torn by the wrap
        bx, by, cx, cy = ax + bx, ay + by, ax + cx, ay + cy
        return ax * by - ay * bx >= 0 and bx * cy - by * cx >= 0 and cx * ay - cy * ax >= 0

    def inside_circle(a, b, c, d):
        return lifted_determinant(*[difference(points[a], points[v]) for v in (b, c, d)]) < -1e-14

    mesh = Triangulation(faces)
    used = {v for face in faces for v in face}
    for vertex in range(len(points)):
        if vertex not in used:
            mesh.insert(vertex, contains, inside_circle)
    return list(mesh.faces.values())


def triangulate_sphere(points, faces):
    """The convex hull of points of the unit sphere; the given faces hold the origin."""

    def contains(corners, vertex):
        a, b, c = (points[v] for v in corners)
        p = points[vertex]
        return det3(a, b, p) >= 0 and det3(b, c, p) >= 0 and det3(c, a, p) >= 0

    def inside_circle(a, b, c, d):
        return det3(*[[points[v][k] - points[a][k] for k in range(3)] for v in (b, c, d)]) > 1e-14

    mesh = Triangulation(faces)
    for vertex in range(6, len(points)):
        mesh.insert(vertex, contains, inside_circle)
    return list(mesh.faces.values())


def bumpy_patch(seed=7, sides=22, inner=420):
    """An open patch with three hills over the unit square; its boundary points are irregular, too."""
    rng = random.Random(seed)
    along = [(i + .7 * (rng.random() - .5) * (i > 0)) / sides for i in range(sides)]
    ring = ([(t, 0.) for t in along] + [(1., t) for t in along] + [(1 - t, 1.) for t in along]
            + [(0., 1 - t) for t in along])
    points = ring + [(.5, .5)] + [(rng.uniform(.004, .996), rng.uniform(.004, .996)) for _ in range(inner)]
    fan = [(i, (i + 1) % len(ring), len(ring)) for i in range(len(ring))]
    faces = triangulate_flat(points, fan, lambda p, q: (q[0] - p[0], q[1] - p[1]))

    def height(x, y):
        hill = lambda cx, cy, width: math.exp(-((x - cx) ** 2 + (y - cy) ** 2) / width ** 2)
        return .32 * hill(.32, .36, .2) + .2 * hill(.72, .68, .17) - .12 * hill(.75, .25, .2)

    return [(x, y, height(x, y)) for x, y in points], faces


def blob(seed=11, count=650):
    """A closed pear-like blob: random points of the sphere, moved out along their rays."""
    rng = random.Random(seed)
    points = [(1., 0., 0.), (-1., 0., 0.), (0., 1., 0.), (0., -1., 0.), (0., 0., 1.), (0., 0., -1.)]
    octahedron = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    while len(points) < count:
        z, turn = rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
        r = math.sqrt(1 - z * z)
        points.append((r * math.cos(turn), r * math.sin(turn), z))
    faces = triangulate_sphere(points, octahedron)

    def radius(x, y, z):
        return 1 + .25 * z + .12 * math.sin(3 * x) * math.cos(2 * y) + .08 * math.cos(5 * z)

    return [tuple(c * radius(*p) for c in p) for p in points], faces


def torus(seed=3, around=8, across=4, count=800, major=1., minor=.42):
    """A torus; the rectangle of its two arc lengths is periodic in both directions."""
    rng = random.Random(seed)
    width, height = 2 * math.pi * major, 2 * math.pi * minor
    points = [(i * width / around, j * height / across) for i in range(around) for j in range(across)]
    vertex = lambda i, j: i % around * across + j % across
    faces = []
    for i in range(around):
        for j in range(across):
            a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
            faces += [(a, b, c), (a, c, d)]
    points += [(rng.random() * width, rng.random() * height) for _ in range(count - len(points))]

    def wrapped(p, q):
        x, y = q[0] - p[0], q[1] - p[1]
        return x - width * round(x / width), y - height * round(y / height)

    faces = triangulate_flat(points, faces, wrapped)
    vertices = []
    for x, y in points:
        u, v = x / major, y / minor
        r = major + minor * math.cos(v)
        vertices.append((r * math.cos(u), r * math.sin(u), minor * math.sin(v)))
    return vertices, faces


def rounded(vertices):
    return [tuple(round(c, 6) + 0. for c in v) for v in vertices]


def write_obj(path, vertices, faces):
    lines = ["v %.6f %.6f %.6f" % v for v in vertices] + ["f %d %d %d" % tuple(i + 1 for i in f) for f in faces]
    path.write_text("\n".join(lines) + "\n")


def write_off(path, vertices, faces):
    lines = ["OFF", "%d %d 0" % (len(vertices), len(faces))]
    lines += ["%.6f %.6f %.6f" % v for v in vertices] + ["3 %d %d %d" % f for f in faces]
    path.write_text("\n".join(lines) + "\n")


def write_ply(path, vertices, faces):
    header = ("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
              "property double z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n")
    body = b"".join(struct.pack("<3d", *v) for v in vertices)
    body += b"".join(struct.pack("<B3i", 3, *f) for f in faces)
    path.write_bytes((header % (len(vertices), len(faces))).encode() + body)


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    for name, write, make in (("patch.obj", write_obj, bumpy_patch), ("blob.ply", write_ply, blob),
                              ("torus.off", write_off, torus)):
        vertices, faces = make()
        write(folder / name, rounded(vertices), faces)
        print("%s: %d vertices, %d faces" % (folder / name, len(vertices), len(faces)))


if __name__ == "__main__":
    main()

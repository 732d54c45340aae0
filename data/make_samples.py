#!/usr/bin/env python3
"""make_samples.py [FOLDER]   writes the sample meshes of this folder: badly shaped triangles on smooth surfaces
and on solids with sharp edges.

Python 3 standard library only; the same files on every machine (coordinates are rounded to 1e-6).
Each mesh is the Delaunay triangulation of independent random points of its parameter domain: a square for the
open patch, the unit sphere for the blob, a periodic rectangle for the torus, each smooth piece for the solids. Points are inserted one by one
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


class Solid:
    """Vertices by place, so that faces share those of their common edges, and triangles."""

    def __init__(self, seed):
        self.rng = random.Random(seed)
        self.vertices, self.faces, self._ids, self._edges = [], [], {}, {}

    def vertex(self, point):
        key = tuple(round(c, 6) + 0. for c in point)
        if key not in self._ids:
            self._ids[key] = len(self.vertices)
            self.vertices.append(key)
        return self._ids[key]

    def edge(self, p, q, step):
        """Places from p to before q, irregular, the same from both ends."""
        if (p, q) not in self._edges:
            count = max(1, round(math.dist(p, q) / step))
            parts = [0.] + [(i + .8 * (self.rng.random() - .5)) / count for i in range(1, count)]
            points = [tuple(a + t * (b - a) for a, b in zip(p, q)) for t in parts]
            self._edges[p, q], self._edges[q, p] = points, [q] + points[:0:-1]
        return self._edges[p, q]

    def polygon(self, corners, to_plane, to_space, middle, step, inner):
        """A flat face, counter-clockwise, whose `middle` sees all of it; `inner` random points."""
        ring = []
        for p, q in zip(corners, corners[1:] + corners[:1]):
            ring += [to_plane(x) for x in self.edge(p, q, step)]
        points = ring + [middle] + inner
        fan = [(i, (i + 1) % len(ring), len(ring)) for i in range(len(ring))]
        self.add(points, triangulate_flat(points, fan, lambda p, q: (q[0] - p[0], q[1] - p[1])), to_space)

    def add(self, points, faces, to_space):
        ids = [self.vertex(to_space(p)) for p in points]
        self.faces += [tuple(ids[v] for v in face) for face in faces]


def prism(outline, height, middle, seed, step, density):
    """Walls over a counter-clockwise outline of axis-parallel edges, with a floor and a ceiling."""
    solid = Solid(seed)
    rng = solid.rng
    inside = lambda x, y: sum((y0 > y) != (y1 > y) and x < x0 for (x0, y0), (x1, y1)
                              in zip(outline, outline[1:] + outline[:1])) % 2 == 1
    low = [(float(x), float(y), 0.) for x, y in outline]
    high = [(float(x), float(y), float(height)) for x, y in outline]
    box = [max(c[k] for c in outline) for k in range(2)]

    def scattered():
        points = ((rng.uniform(.03, box[0] - .03), rng.uniform(.03, box[1] - .03))
                  for _ in range(int(density * box[0] * box[1])))
        return [p for p in points if all(inside(p[0] + dx, p[1] + dy) for dx in (-.02, .02) for dy in (-.02, .02))]

    solid.polygon(high, lambda p: p[:2], lambda q: (q[0], q[1], height), middle, step, scattered())
    turned = lambda p: (p[1], p[0])
    solid.polygon(low[::-1], turned, lambda q: (q[1], q[0], 0.), turned(middle), step, [turned(p) for p in scattered()])
    for i, p in enumerate(low):
        j = (i + 1) % len(low)
        length = math.dist(p, low[j])
        along = tuple((b - a) / length for a, b in zip(p, low[j]))
        to_plane = lambda x, p=p, along=along: (sum((a - b) * c for a, b, c in zip(x, p, along)), x[2])
        to_space = lambda q, p=p, along=along: (p[0] + q[0] * along[0], p[1] + q[0] * along[1], q[1])
        inner = [(rng.uniform(.03, length - .03), rng.uniform(.03, height - .03))
                 for _ in range(int(density * length * height))]
        solid.polygon([p, low[j], high[j], high[i]], to_plane, to_space, (.47 * length, .52 * height), step, inner)
    return solid.vertices, solid.faces


def cube(seed=5):
    """The unit cube."""
    return prism([(0, 0), (1, 0), (1, 1), (0, 1)], 1, (.48, .53), seed, .125, 60)


def step_block(seed=6):
    """A block with a step: two by two by one, one quarter missing."""
    return prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], 1, (.52, .47), seed, .17, 32)


def cylinder(seed=9, around=40, height=2., inner=420):
    """A closed cylinder of radius 1; the points of its rims are irregular, too."""
    solid = Solid(seed)
    rng = solid.rng
    turns = [2 * math.pi * (i + .7 * (rng.random() - .5)) / around for i in range(around)]
    ring = [(math.cos(t), math.sin(t)) for t in turns]
    fan = [(i, (i + 1) % around, around) for i in range(around)]
    plain = lambda p, q: (q[0] - p[0], q[1] - p[1])
    for z, to_space in ((height, lambda q: (q[0], q[1], height)), (0., lambda q: (q[0], -q[1], 0.))):
        rim = ring if z > 0 else [(x, -y) for x, y in ring[::-1]]
        radii = [(.97 * math.sqrt(rng.random()), rng.uniform(0, 2 * math.pi)) for _ in range(inner // 3)]
        points = rim + [(.02, -.03)] + [(r * math.cos(t), r * math.sin(t)) for r, t in radii]
        solid.add(points, triangulate_flat(points, fan, plain), to_space)

    def wrapped(p, q):
        x = q[0] - p[0]
        return x - 2 * math.pi * round(x / (2 * math.pi)), q[1] - p[1]

    points = [(t, 0.) for t in turns] + [(t, height) for t in turns]
    faces = []
    for i in range(around):
        j = (i + 1) % around
        faces += [(i, j, around + j), (i, around + j, around + i)]
    points += [(rng.uniform(0, 2 * math.pi), rng.uniform(.03, height - .03)) for _ in range(inner)]
    solid.add(points, triangulate_flat(points, faces, wrapped), lambda q: (math.cos(q[0]), math.sin(q[0]), q[1]))
    return solid.vertices, solid.faces


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
                              ("torus.off", write_off, torus), ("cube.obj", write_obj, cube),
                              ("block.ply", write_ply, step_block), ("cylinder.off", write_off, cylinder)):
        vertices, faces = make()
        write(folder / name, rounded(vertices), faces)
        print("%s: %d vertices, %d faces" % (folder / name, len(vertices), len(faces)))


if __name__ == "__main__":
    main()

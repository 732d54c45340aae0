"""artificial_meshes.py NAME SEED OUT.off   the artificial meshes of the paper, after its recipes.

NAME is G1, M1, M2, M3, S1, S2, or torus:N for an irregular bumpy torus with N vertices. Needs numpy and scipy
(Debian: python3-numpy python3-scipy). The same name and seed give the same mesh.

G1, M1-M3  graphs over the unit square: sqrt(n) equally spaced points on each side, uniform random points inside,
           Delaunay triangulation of the plane, lifted to the surface.
S1         222 points of the unit sphere by dart throwing: uniform, none nearer than .28 of the spacing h that a
           hexagonal arrangement would have; convex hull.
S2         1146 points of the Fibonacci lattice of the sphere, each displaced by Gaussian noise of .5 h; convex hull.
torus:N    independent uniform points of the rectangle of arc lengths, periodic Delaunay triangulation.
"""

import sys

import numpy as np
from scipy.spatial import ConvexHull, Delaunay

from mesh_file import write_off

PLANAR = {  # number of vertices, height of the surface
    "G1": (961, lambda x, y: np.exp(-10 * ((x - .5) ** 2 + (y - .5) ** 2))),
    "M1": (121, lambda x, y: 2 * (x - .5) ** 2 + 2 * (y - .5) ** 3),
    "M2": (441, lambda x, y: 2 * (x - .5) ** 2 + 2 * (y - .5) ** 3),
    "M3": (961, lambda x, y: 2 * (x - .5) ** 2 + 2 * (y - .5) ** 3),
}
SPHERES = {"S1": 222, "S2": 1146}
NAMES = [*PLANAR, *SPHERES]


def graph_over_square(rng, count, height, cut=0):
    """No inner vertex is in the triangles with two sides of length `cut` at the corners of the square."""
    side = np.linspace(0, 1, round(count ** .5))
    zero, one = np.zeros_like(side), np.ones_like(side)
    rim = np.unique(np.vstack([np.c_[side, zero], np.c_[side, one], np.c_[zero, side], np.c_[one, side]]), axis=0)
    inner = rng.uniform(size=(count - len(rim), 2))
    while (cut_off := np.minimum(inner, 1 - inner).sum(axis=1) < cut).any():
        inner[cut_off] = rng.uniform(size=(cut_off.sum(), 2))
    points = np.vstack([rim, inner])
    faces = Delaunay(points).simplices
    on_one_side = [(points[faces][:, :, axis] == value).all(axis=1) for axis in (0, 1) for value in (0., 1.)]
    faces = faces[~np.any(on_one_side, axis=0)]
    return np.c_[points, height(points[:, 0], points[:, 1])], wound(faces, signed_area(points, faces))


def sphere(rng, name, count):
    spacing = (8 * np.pi / (3 ** .5 * count)) ** .5
    points = dart_throwing(rng, count, .28 * spacing) if name == "S1" else noisy_lattice(rng, count, .5 * spacing)
    faces = ConvexHull(points).simplices
    a, b, c = points[faces[:, 0]], points[faces[:, 1]], points[faces[:, 2]]
    return points, wound(faces, np.einsum("ij,ij->i", np.cross(b - a, c - a), a))


def dart_throwing(rng, count, gap):
    kept = []
    while len(kept) < count:
        dart = rng.normal(size=3)
        dart /= np.linalg.norm(dart)
        if all(np.linalg.norm(dart - p) >= gap for p in kept):
            kept.append(dart)
    return np.array(kept)


def noisy_lattice(rng, count, noise):
    k = np.arange(count)
    z = 1 - (2 * k + 1) / count
    turn = k * np.pi * (3 - 5 ** .5)
    r = np.sqrt(1 - z * z)
    points = np.c_[r * np.cos(turn), r * np.sin(turn), z] + noise * rng.normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def bumpy_torus(rng, count, major=1., minor=.4):
    size = 2 * np.pi * np.array([major, minor])
    points = rng.uniform(size=(count, 2)) * size
    margin = 12 * (size.prod() / count) ** .5
    copies, origin = [], []
    for shift in np.ndindex(3, 3):
        moved = points + (np.array(shift) - 1) * size
        near = np.all((moved > -margin) & (moved < size + margin), axis=1)
        copies.append(moved[near])
        origin.append(np.flatnonzero(near))
    copies, origin = np.vstack(copies), np.concatenate(origin)
    tiles = Delaunay(copies).simplices
    centre = copies[tiles].mean(axis=1)  # of the copies of a face one has its centre in the rectangle
    tiles = tiles[np.all((centre >= 0) & (centre < size), axis=1)]
    faces = origin[wound(tiles, signed_area(copies, tiles))]
    u, v = points[:, 0] / major, points[:, 1] / minor
    tube = minor * (1 + .1 * np.sin(5 * u) * np.cos(3 * v))
    ring = major + tube * np.cos(v)
    return np.c_[ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)], faces


def signed_area(points, faces):
    a, b, c = points[faces[:, 0]], points[faces[:, 1]], points[faces[:, 2]]
    return (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]


def wound(faces, sign):
    """The faces without those of sign zero; those of negative sign turned over."""
    faces = np.where(sign[:, None] < 0, faces[:, [0, 2, 1]], faces)
    return faces[sign != 0]


def make(name, seed):
    """(vertices, faces) as numpy arrays."""
    rng = np.random.default_rng([seed, *name.encode()])
    if name in PLANAR:
        return graph_over_square(rng, *PLANAR[name])
    if name in SPHERES:
        return sphere(rng, name, SPHERES[name])
    kind, _, count = name.partition(":")
    if kind != "torus":
        raise SystemExit("unknown mesh '%s'; expected %s or torus:N" % (name, ", ".join(NAMES)))
    return bumpy_torus(rng, int(count))


def write(name, seed, path):
    vertices, faces = make(name, seed)
    write_off(path, vertices.tolist(), faces.tolist())


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    write(sys.argv[1], int(sys.argv[2]), sys.argv[3])

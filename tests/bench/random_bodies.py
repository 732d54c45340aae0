"""random_bodies.py TOOL [--count N] [--seed S] [--keep FOLDER] [--modes adapt,flip,fixed]

Remeshes small random bodies with flat and ruled faces and checks every result that the command ends with exit code 0
on: topology, volume, distance, sides of the faces, self-intersections as reported, and that sharp edges are where they
were. Bodies: convex hulls, extrusions of random polygons, unions of boxes on a random grid, prisms and truncated cones
of many sides; their faces are then cut up at random, so that there are slivers. Prints what failed, and how many
results were kept, refused and wrong. Exit code 1 if any was wrong. Needs numpy and scipy.
"""

import argparse
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from scipy.spatial import ConvexHull, cKDTree

import mesh_file

CUTS = 3  # random cuts per face, at most


# ---------------------------------------------------------------- bodies
def hull(rng):
    points = rng.normal(size=(rng.integers(4, 14), 3)) * rng.uniform(.4, 1.6, 3)
    h = ConvexHull(points)
    faces = [f if np.dot(np.cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]), n[:3]) > 0 else f[::-1]
             for f, n in zip(h.simplices, h.equations)]
    return compact(points, faces), "planar"


def extrusion(rng):
    """A star-shaped polygon, extruded; its caps are cut from the middle."""
    n = rng.integers(3, 12)
    angles = np.sort(rng.uniform(0, 2 * math.pi, n))
    while np.min(np.diff(np.r_[angles, angles[0] + 2 * math.pi])) < .15 or \
            np.max(np.diff(np.r_[angles, angles[0] + 2 * math.pi])) > 2.6:
        angles = np.sort(rng.uniform(0, 2 * math.pi, n))
    radii = rng.uniform(.5, 1.5, n)
    rim = np.c_[radii * np.cos(angles), radii * np.sin(angles)]
    return tube(rim, rim, rng.uniform(.3, 2)), "planar"


def tube(lower, upper, height):
    n = len(lower)
    points = np.r_[np.c_[lower, np.zeros(n)], np.c_[upper, np.full(n, height)], [[0, 0, 0], [0, 0, height]]]
    faces = []
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, n + j), (i, n + j, n + i), (j, i, 2 * n), (n + i, n + j, 2 * n + 1)]
    return compact(points, faces)


def round_body(rng):
    """A prism or a truncated cone of many sides."""
    angles = np.arange(rng.integers(12, 48)) 
    angles = angles * 2 * math.pi / len(angles)
    rim = np.c_[np.cos(angles), np.sin(angles)]
    top = rim * rng.choice([1, rng.uniform(.4, 1)])
    return tube(rim, top, rng.uniform(.5, 3)), "ruled"


def boxes(rng):
    """The union of cells of a random grid that hang together by faces, without edges or vertices that only touch."""
    while True:
        cuts = [np.cumsum(rng.uniform(.2, 1, 4)) for _ in range(3)]
        cells = np.zeros((5, 5, 5), bool)
        at = np.array([2, 2, 2])
        for _ in range(rng.integers(2, 9)):
            cells[tuple(at)] = True
            at = np.clip(at + np.eye(3, dtype=int)[rng.integers(3)] * rng.choice([-1, 1]), 1, 3)
        points, faces = boundary_of(cells, cuts)
        if is_manifold(faces):
            return (points, faces), "planar"


def boundary_of(cells, cuts):
    ids, points, faces = {}, [], []

    def vertex(corner):
        if corner not in ids:
            ids[corner] = len(points)
            points.append([cuts[k][corner[k] - 1] for k in range(3)])
        return ids[corner]

    for cell in np.argwhere(cells):
        for axis in range(3):
            for side in (0, 1):
                other = cell.copy()
                other[axis] += 2 * side - 1
                if cells[tuple(other)]:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                quad = []
                for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    corner = cell.copy()
                    corner[axis] += side
                    corner[u] += du
                    corner[v] += dv
                    quad.append(vertex(tuple(int(x) for x in corner)))
                if not side:
                    quad.reverse()
                faces += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    return np.array(points, float), np.array(faces)


def is_manifold(faces):
    edges = {}
    for f in faces:
        for k in range(3):
            edges.setdefault(tuple(sorted((f[k], f[(k + 1) % 3]))), []).append(1)
    if any(len(e) != 2 for e in edges.values()):
        return False
    fans = {}
    for f in faces:
        for k in range(3):
            fans.setdefault(f[k], {})[f[(k + 1) % 3]] = f[(k + 2) % 3]
    for fan in fans.values():
        start = next(iter(fan))
        at, count = fan[start], 1
        while at != start:
            at, count = fan[at], count + 1
        if count != len(fan):
            return False
    return True


def compact(points, faces):
    used = np.unique(np.asarray(faces))
    index = {v: i for i, v in enumerate(used)}
    return points[used], np.array([[index[v] for v in f] for f in faces])


def cut_up(points, faces, rng):
    """Splits edges and faces at random places, which stay on the faces."""
    points, faces = list(map(np.array, points)), [tuple(map(int, f)) for f in faces]
    for _ in range(rng.integers(0, CUTS * len(faces))):
        k = rng.integers(len(faces))
        a, b, c = faces[k]
        n = len(points)
        if rng.random() < .5:
            w = rng.dirichlet([1, 1, 1])
            points.append(w[0] * points[a] + w[1] * points[b] + w[2] * points[c])
            faces[k] = (a, b, n)
            faces += [(b, c, n), (c, a, n)]
            continue
        other = next(i for i, f in enumerate(faces) if (b, a) in ((f[0], f[1]), (f[1], f[2]), (f[2], f[0])))
        d = next(v for v in faces[other] if v not in (a, b))
        t = rng.uniform(.02, .98)
        points.append((1 - t) * points[a] + t * points[b])
        faces[k], faces[other] = (a, n, c), (b, n, d)
        faces += [(n, b, c), (n, a, d)]
    return np.array(points), np.array(faces)


def turned(points, rng):
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return points @ (q * np.sign(np.linalg.det(q))).T * rng.choice([1e-2, 1, 100]) + rng.normal(size=3)


def body(seed):
    rng = np.random.default_rng(seed)
    kind = rng.choice(4)
    (points, faces), surface = (hull, extrusion, round_body, boxes)[kind](rng)
    if surface == "planar" or rng.random() < .5:
        points, faces = cut_up(points, faces, rng)
    points = turned(points, rng)
    area = np.linalg.norm(crosses(points, faces), axis=1).sum() / 2
    length = math.sqrt(4 * area / math.sqrt(3) / rng.integers(600, 4000))
    return points, faces, surface, length


# ---------------------------------------------------------------- checks
def crosses(p, f):
    return np.cross(p[f[:, 1]] - p[f[:, 0]], p[f[:, 2]] - p[f[:, 0]])


def volume(p, f):
    return math.fsum(np.einsum("ij,ij->i", p[f[:, 0]], np.cross(p[f[:, 1]], p[f[:, 2]]))) / 6


def edges_of(f):
    """Edges and their two faces; a closed manifold is expected."""
    half = np.concatenate([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]])
    owner = np.tile(np.arange(len(f)), 3)
    half.sort(axis=1)
    order = np.lexsort((half[:, 1], half[:, 0]))
    half, owner = half[order], owner[order]
    if len(half) % 2 or (half[::2] != half[1::2]).any():
        return None
    return half[::2], np.c_[owner[::2], owner[1::2]]


def turns(p, f, pairs):
    n = crosses(p, f)
    n /= np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-300)
    return np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", n[pairs[:, 0]], n[pairs[:, 1]]), -1, 1))), n


def segment_distances(x, a, b):
    """Of each point from the nearest segment."""
    best = np.full(len(x), np.inf)
    for p, q in zip(a, b):
        d = q - p
        t = np.clip((x - p) @ d / max(d @ d, 1e-300), 0, 1)
        best = np.minimum(best, np.linalg.norm(x - p - t[:, None] * d, axis=1))
    return best


def plane_groups(p, f):
    n = crosses(p, f)
    size = np.linalg.norm(n, axis=1)
    ok = size > 1e-9 * size.max()
    n, f = n[ok] / size[ok, None], f[ok]
    return n, np.einsum("ij,ij->i", n, p[f[:, 0]])


def flaws(p, f, q, g, surface, length, crossings):
    """What is wrong with the result (q, g) for the body (p, f), which has no self-intersections."""
    found = []
    diagonal = np.linalg.norm(np.ptp(p, axis=0))
    before, after = edges_of(f), edges_of(g)
    if after is None:
        return ["not a closed manifold"]
    if len(np.unique(f)) - len(before[0]) + len(f) != len(np.unique(g)) - len(after[0]) + len(g):
        found.append("Euler number")
    change = volume(q, g) / volume(p, f) - 1
    turn_in, n_in = turns(p, f, before[1])
    turn_out, _ = turns(q, g, after[1])
    exact = surface == "planar" and not ((turn_in > .01) & (turn_in < 40)).any()
    if abs(change) > (1e-6 if exact else .01 if surface == "planar" else .03):
        found.append("volume %+.2g" % change)
    sharp_in, sharp_out = before[0][turn_in > 40], after[0][turn_out > 20]
    limit = 1e-6 * diagonal if exact else 2e-3 * diagonal if surface == "planar" else max(1e-6 * diagonal, .06 * length, .02 * diagonal)
    if len(sharp_in):
        x = np.concatenate([(1 - t) * p[sharp_in[:, 0]] + t * p[sharp_in[:, 1]] for t in (0, .31, .5, .77)])
        lost = segment_distances(x, q[sharp_out[:, 0]], q[sharp_out[:, 1]]) if len(sharp_out) else [diagonal]
        if max(lost) > limit:
            found.append("sharp edge lost by %.2g diagonals" % (max(lost) / diagonal))
    if surface == "planar":
        normals, offsets = plane_groups(p, f)
        distance = np.abs(q @ normals.T - offsets)
        off = 1e-6 * diagonal if exact else max(2e-3 * diagonal, .3 * length)
        if distance.min(axis=1).max() > off:
            found.append("vertex off the faces")
        m = crosses(q, g)
        m /= np.maximum(np.linalg.norm(m, axis=1, keepdims=True), 1e-300)
        on = (distance[g] < off).all(axis=1)  # planes through each face
        like = on.any(axis=1) & (np.where(on, m @ normals.T, -1).max(axis=1) < 0)
        if (like & (np.linalg.norm(crosses(q, g), axis=1) > 1e-9 * length ** 2)).any():
            found.append("%d faces turned over" % like.sum())
    else:
        tree = cKDTree(np.concatenate([p[f].mean(axis=1), p]))
        if tree.query(q)[0].max() > 1.5 * diagonal:
            found.append("vertex far away")
    if crossings > 0:
        found.append("%d self-intersections" % crossings)
    return found


def run(tool, seed, mode, keep):
    p, f, surface, length = body(seed)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(keep or scratch)
        source, target = folder / ("%d.off" % seed), folder / ("%d.%s.off" % (seed, mode))
        mesh_file.write_off(source, p.tolist(), f.tolist())
        command = [tool, source, "-o", target, "-q", "--connectivity", mode, "--report", "-"]
        command += ["-L", "%.17g" % length] if mode == "adapt" else []
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if done.returncode == 9:
            return seed, mode, "refused", [done.stderr.strip()[-200:]], 0
        if done.returncode != 0:
            return seed, mode, "wrong", ["exit code %d: %s" % (done.returncode, done.stderr.strip()[-200:])], 0
        q, g = mesh_file.read_mesh(target)
        report = json.loads(done.stdout)
        found = flaws(p, f, np.array(q), np.array(g), surface, length,
                      report["after"]["self_intersections"])
        return seed, mode, "wrong" if found else "kept", found, report["after"]["min_angle"]["min"]


def main():
    o = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    o.add_argument("tool")
    o.add_argument("--count", type=int, default=1000)
    o.add_argument("--seed", type=int, default=0, help="of the first body")
    o.add_argument("--keep", help="folder for the meshes")
    o.add_argument("--modes", default="adapt", help="comma-separated")
    o = o.parse_args()
    if o.keep:
        pathlib.Path(o.keep).mkdir(parents=True, exist_ok=True)
    jobs = [(seed, mode) for seed in range(o.seed, o.seed + o.count) for mode in o.modes.split(",")]
    counts, angles = {}, []
    with concurrent.futures.ProcessPoolExecutor() as pool:
        for seed, mode, verdict, found, angle in pool.map(run, *zip(*[(o.tool, s, m, o.keep) for s, m in jobs])):
            counts[verdict] = counts.get(verdict, 0) + 1
            if verdict == "kept" and mode == "adapt":
                angles.append(angle)
            if verdict != "kept":
                print(seed, mode, verdict, "; ".join(found), flush=True)
    print(", ".join("%s %d" % c for c in sorted(counts.items())), "of", len(jobs))
    if angles:
        print("minimum angle of adapt: median %.1f, 5 %% below %.1f" % (np.median(angles), np.quantile(angles, .05)))
    return 1 if counts.get("wrong") else 0


if __name__ == "__main__":
    sys.exit(main())

"""--keep non-manifold: surfaces of several bodies keep the walls that they share, in each mode, joined as they were."""

import json
import random
import unittest
from collections import Counter

from command import CommandTest, read_mesh, write_off

MODES = [["--connectivity", mode, "--effort", "fast"] for mode in ("fixed", "flip", "adapt")]
KEEP = ["--keep", "non-manifold"]


def walls(label, sizes, smoothing=0, noise=0.):
    """(vertices, faces, labels): the sides of cells with other labels than their neighbours, oriented from the smaller
    label to the larger; the labels are pairs of them. `label` is a function of a cell's place, 0 outside of `sizes`."""
    of_cell = lambda c: label(*c) if all(0 <= c[k] < sizes[k] for k in range(3)) else 0
    ids, vertices, faces, labels = {}, [], [], []

    def vertex(place):
        if place not in ids:
            ids[place] = len(vertices)
            vertices.append([float(x) for x in place])
        return ids[place]

    for axis in range(3):
        for i in range(-1, sizes[0] + 1):
            for j in range(-1, sizes[1] + 1):
                for k in range(-1, sizes[2] + 1):
                    low = (i, j, k)
                    high = tuple(x + (d == axis) for d, x in enumerate(low))
                    a, b = of_cell(low), of_cell(high)
                    if a == b:
                        continue
                    e, f = ([d == (axis + n) % 3 for d in range(3)] for n in (1, 2))
                    corner = lambda s, t: vertex(tuple(x + s * p + t * q for x, p, q in zip(high, e, f)))
                    ring = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
                    if b > a:
                        ring.reverse()
                    p, q, r, s = ring if (i + j + k) % 2 else ring[1:] + ring[:1]
                    faces += [(p, q, r), (p, r, s)]
                    labels += [(min(a, b), max(a, b))] * 2
    around = {}
    for face in faces:
        for v in face:
            around.setdefault(v, set()).update(face)
    for _ in range(smoothing):
        vertices = [[sum(vertices[w][d] for w in around[v]) / len(around[v]) for d in range(3)] for v in range(len(vertices))]
    rng = random.Random(1)
    flat = {}  # noise within flat pieces: moves inner vertices along their plane only
    for face in faces:
        normal = next(d for d in range(3) if vertices[face[0]][d] == vertices[face[1]][d] == vertices[face[2]][d]) if noise else None
        for v in face:
            flat.setdefault(v, set()).add((normal, vertices[v][normal] if noise else 0))
    for v, planes in flat.items():
        if noise and len(planes) == 1:
            normal = next(iter(planes))[0]
            vertices[v] = [x + (noise * (rng.random() - .5) if d != normal else 0) for d, x in enumerate(vertices[v])]
    return vertices, faces, labels


def two_boxes():
    return walls(lambda i, j, k: 1 if i < 6 else 2, (12, 6, 6), noise=.7)


def foam():
    seeds = [(3.1, 3.4, 4.2), (8.3, 3.7, 3.9), (5.2, 8.4, 3.6), (5.8, 5.1, 8.8)]

    def label(*cell):
        if sum((x - 5.5) ** 2 for x in cell) > 30:
            return 0
        return 1 + min(range(4), key=lambda n: sum((x - s) ** 2 for x, s in zip(cell, seeds[n])))

    return walls(label, (12, 12, 12), smoothing=6)


def touching_boxes():
    return walls(lambda i, j, k: int(max(i, j, k) < 4) + 2 * int(min(i, j, k) >= 4), (8, 8, 8), noise=.7)


def fin():
    """A grid, and a wall that stands on part of a line inside it."""
    n, rng = 10, random.Random(2)
    inner = lambda i, j: 0 < i < n and 0 < j < n and j != n // 2
    vertices = [[i + (.6 * (rng.random() - .5) if inner(i, j) else 0), j + (.6 * (rng.random() - .5) if inner(i, j) else 0), 0.]
                for j in range(n + 1) for i in range(n + 1)]
    at = lambda i, j: j * (n + 1) + i
    faces = [f for j in range(n) for i in range(n) for f in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))]
    labels = [(0, 1)] * len(faces)
    foot, ids = n // 2, {}

    def up(i, k):
        if k == 0:
            return at(i, foot)
        if (i, k) not in ids:
            ids[i, k] = len(vertices)
            vertices.append([i + (.5 * (rng.random() - .5) if 3 < i < 7 and k < 4 else 0), float(foot), float(k)])
        return ids[i, k]

    for i in range(3, 7):
        for k in range(4):
            faces += [(up(i, k), up(i + 1, k), up(i + 1, k + 1)), (up(i, k), up(i + 1, k + 1), up(i, k + 1))]
            labels += [(1, 2)] * 2
    return vertices, faces, labels


def half_discs():
    """Three halves of a disc that meet in its diameter."""
    from math import cos, pi, sin
    vertices, faces, labels, rings = [[x / 4 - 1, 0., 0.] for x in range(9)], [], [], 4
    for n in range(3):
        u, v = cos(2 * pi * n / 3), sin(2 * pi * n / 3)
        middle, ids = 4, {}

        def at(ring, k):
            if k in (0, 3 * ring):
                return middle + ring * (1 if k == 0 else -1)
            if (ring, k) not in ids:
                ids[ring, k] = len(vertices)
                turn = pi * k / (3 * ring) + (.15 / ring if k % 2 and ring < rings else 0)
                r = ring / 4
                vertices.append([r * cos(turn), r * sin(turn) * u, r * sin(turn) * v])
            return ids[ring, k]

        for ring in range(rings):
            for sector in range(3):
                for k in range(ring + 1):
                    a, b = at(ring + 1, sector * (ring + 1) + k), at(ring + 1, sector * (ring + 1) + k + 1)
                    faces.append((at(ring, sector * ring + k) if ring else middle, a, b))
                    if k < ring:
                        faces.append((at(ring, sector * ring + k), b, at(ring, sector * ring + k + 1)))
        labels += [(n, n + 1)] * (len(faces) - len(labels))
    return vertices, faces, labels


def strips(line, cells, rise=lambda x: 0.):
    """Three strips that meet in the curve y = rise(x) at these x, with `cells` cells beside it."""
    from math import cos, pi, sin
    vertices, faces, labels, rows, width = [[x, rise(x), 0.] for x in line], [], [], 4, 1.
    a, b, n = line[0], line[-1], cells
    for s in range(3):
        before = [(x, v) for v, x in enumerate(line)]
        for row in range(1, rows + 1):
            after = []
            for i in range(n + 1):
                x, d = a + (b - a) * i / n, width * row / rows
                after.append((x, len(vertices)))
                vertices.append([x, rise(x) + d * cos(2 * pi * s / 3), d * sin(2 * pi * s / 3)])
            i = j = 0
            while i + 1 < len(before) or j < n:
                if j == n or (i + 1 < len(before) and before[i + 1][0] <= after[j + 1][0]):
                    faces.append((before[i][1], before[i + 1][1], after[j][1]))
                    i += 1
                else:
                    faces.append((before[i][1], after[j + 1][1], after[j][1]))
                    j += 1
                labels.append((s, s + 1))
            before = after
    return vertices, faces, labels


def uneven_line():
    rng = random.Random(4)
    return strips([(i + .7 * (rng.random() - .5) * (0 < i < 8)) / 4 for i in range(9)], cells=8)


def label_volume(seed, n=9, bodies=5):
    rng = random.Random(seed)
    seeds = [[rng.uniform(0, n) for _ in range(3)] for _ in range(bodies)]

    def label(*cell):
        if sum((x - (n - 1) / 2) ** 2 for x in cell) > (n / 2 - .3) ** 2:
            return 0
        return 1 + min(range(bodies), key=lambda k: sum((x - s) ** 2 for x, s in zip(cell, seeds[k])))

    return walls(label, (n, n, n), smoothing=3)


MESHES = {"boxes": two_boxes, "foam": foam, "touching": touching_boxes, "fin": fin, "discs": half_discs}


def obj(vertices, faces, labels):
    lines = ["# walls", *("v %r %r %r" % tuple(v) for v in vertices)]
    last = None
    for face, pair in zip(faces, labels):
        if pair != last:
            lines.append("usemtl m%d_%d" % pair)
        last = pair
        lines.append("f %d %d %d" % tuple(v + 1 for v in face))
    return "\n".join(lines) + "\n"


def read_labels(path):
    labels, pair = [], None
    for line in path.read_text().splitlines():
        if line.startswith("usemtl"):
            pair = tuple(int(n) for n in line.split("m")[-1].split("_"))
        elif line.startswith("f "):
            labels.append(pair)
    return labels


def junctions(vertices, faces):
    """The edges of three faces and more, as places of their ends, and the number of their faces."""
    count = Counter(tuple(sorted((f[k], f[(k + 1) % 3]))) for f in faces for k in range(3))
    return Counter({(*sorted((tuple(vertices[a]), tuple(vertices[b]))), n): 1 for (a, b), n in count.items() if n > 2})


def edges_of_many(faces):
    """The edges of three faces and more, by ids, and the number of their faces."""
    count = Counter(tuple(sorted((f[k], f[(k + 1) % 3]))) for f in faces for k in range(3))
    return {edge: n for edge, n in count.items() if n > 2}


def length_of(edge, vertices):
    return sum((x - y) ** 2 for x, y in zip(vertices[edge[0]], vertices[edge[1]])) ** .5


def distance_to_edges(point, edges, vertices):
    def distance(a, b):
        along, to = ([y - x for x, y in zip(vertices[a], p)] for p in (vertices[b], point))
        t = sum(x * y for x, y in zip(along, to)) / sum(x * x for x in along)
        return sum((y - min(1, max(0, t)) * x) ** 2 for x, y in zip(along, to)) ** .5
    return min(distance(a, b) for a, b in edges)


def variation(lengths):
    mean = sum(lengths) / len(lengths)
    return (sum((x - mean) ** 2 for x in lengths) / len(lengths)) ** .5 / mean


def boundary_edges(faces):
    count = Counter(tuple(sorted((f[k], f[(k + 1) % 3]))) for f in faces for k in range(3))
    return sum(n == 1 for n in count.values())


def volumes(vertices, faces, labels):
    """Of each body, by the walls about it, whose faces look to the smaller label."""
    found = Counter()
    for face, (a, b) in zip(faces, labels):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[v] for v in face)
        six = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        found[a] -= six / 6
        found[b] += six / 6
    return found


class Junctions(CommandTest):
    def setUp(self):
        super().setUp()
        self.meshes = {name: make() for name, make in MESHES.items()}
        for name, mesh in self.meshes.items():
            self.write(name + ".obj", obj(*mesh))

    def test_such_meshes_are_refused_with_both_ways_out(self):
        for name in MESHES:
            err = self.refused(4, name + ".obj", "-o", "out.obj", says="--repair, which cuts the sheets apart")
            self.assertIn("--keep non-manifold, which keeps them joined", err)

    def test_sheets_stay_joined_in_each_mode(self):
        for name, (vertices, faces, labels) in self.meshes.items():
            for mode in MODES:
                with self.subTest(name, mode=mode[1]):
                    report = self.report(name + ".obj", "-o", "out.obj", *KEEP, *mode)
                    self.assertTrue(report["promises"]["kept"])
                    self.assertEqual(report["before"]["self_intersections"], report["after"]["self_intersections"])
                    after, new_faces = read_mesh(self.folder / "out.obj")
                    self.assert_same_network(vertices, faces, after, new_faces, mode)
                    self.assertEqual(len(set(map(tuple, after))), len(after))  # no copies are left
                    if mode[1] != "adapt":  # boundaries are split there
                        self.assertEqual(boundary_edges(faces), boundary_edges(new_faces))
                    for key in ("euler", "components", "boundary_loops"):
                        self.assertEqual(report["input"][key], report["output"][key], key)
                    self.assertEqual(report["output"]["vertices"], len(after))
                    before, now = volumes(vertices, faces, labels), volumes(after, new_faces, read_labels(self.folder / "out.obj"))
                    if name not in ("fin", "discs"):  # which are no bodies
                        self.assertEqual(set(before), set(now))
                        for body, volume in before.items():
                            self.assertAlmostEqual(now[body], volume, delta=(.03 if name == "foam" else 1e-9) * abs(volume), msg=body)
                    moved = sum(tuple(v) not in set(map(tuple, vertices)) for v in after)
                    self.assertGreater(moved, 0)

    def assert_same_network(self, vertices, faces, after, new_faces, mode):
        """The same edges, whose vertices have slid; with `adapt` other ones on the same lines, without a gap."""
        old, new = edges_of_many(faces), edges_of_many(new_faces)
        if mode[1] != "adapt":
            self.assertEqual(old, new)
        for v in {v for edge in new for v in edge}:
            self.assertLess(distance_to_edges(after[v], old, vertices), 1e-12 * max(map(abs, after[v])) + 1e-14)
        degree = Counter(v for edge in old for v in edge)
        places = set(map(tuple, after))
        for v, n in degree.items():
            if n != 2:
                self.assertIn(tuple(vertices[v]), places)
        for count in {*old.values(), *new.values()}:
            total = lambda edges, points: sum(length_of(edge, points) for edge, n in edges.items() if n == count)
            self.assertAlmostEqual(total(old, vertices), total(new, after), delta=.03 * total(old, vertices))

    def test_vertices_slide_along_their_line(self):
        vertices, faces, labels = uneven_line()
        self.write("line.obj", obj(vertices, faces, labels))
        before = variation([length_of(edge, vertices) for edge in edges_of_many(faces)])
        for mode in MODES:
            report = self.report("line.obj", "-o", "out.obj", *KEEP, *mode)
            after, new_faces = read_mesh(self.folder / "out.obj")
            self.assert_same_network(vertices, faces, after, new_faces, mode)
            self.assertLess(variation([length_of(edge, after) for edge in edges_of_many(new_faces)]), .75 * before, mode)
            self.assertGreater(report["after"]["min_angle"]["min"], report["before"]["min_angle"]["min"])

    def test_a_vertex_that_is_fixed_does_not_slide(self):
        vertices, faces, labels = uneven_line()
        self.write("line.obj", obj(vertices, faces, labels))
        self.write("fix.txt", "3\n")
        for mode in MODES[:2]:
            self.run_command("line.obj", "-o", "out.obj", "-q", *KEEP, *mode, "--fix", "fix.txt")
            after, _ = read_mesh(self.folder / "out.obj")
            self.assertEqual(after[3], tuple(vertices[3]))
            self.assertNotEqual(after[4], tuple(vertices[4]))

    def test_adapt_joins_what_is_much_finer_than_the_length(self):
        for rise in (lambda x: 0., lambda x: .2 * x * (2 - x)):
            for cells in (8, 40):  # beside it as coarse as is asked for, or as fine
                vertices, faces, labels = strips([i / 20 for i in range(41)], cells, rise)
                self.write("fine.obj", obj(vertices, faces, labels))
                report = self.report("fine.obj", "-o", "out.obj", "-L", ".25", *KEEP, *MODES[2])
                self.assertTrue(report["promises"]["kept"])
                self.assertEqual(report["input"]["euler"], report["output"]["euler"])
                after, new_faces = read_mesh(self.folder / "out.obj")
                self.assert_same_network(vertices, faces, after, new_faces, MODES[2])
                lengths = [length_of(edge, after) for edge in edges_of_many(new_faces)]
                self.assertTrue(7 <= len(lengths) <= 10, lengths)
                self.assertGreater(min(lengths), .15)
                self.assertGreater(report["after"]["min_angle"]["min"], 25)

    def test_label_volumes_keep_their_walls(self):
        for seed in range(3):
            vertices, faces, labels = label_volume(seed)
            self.write("labels.obj", obj(vertices, faces, labels))
            for mode in MODES:
                report = self.report("labels.obj", "-o", "out.obj", *KEEP, *mode)
                self.assertTrue(report["promises"]["kept"])
                after, new_faces = read_mesh(self.folder / "out.obj")
                self.assert_same_network(vertices, faces, after, new_faces, mode)
                for key in ("euler", "components", "boundary_loops"):
                    self.assertEqual(report["input"][key], report["output"][key], key)

    def test_long_edges_are_split_in_all_sheets(self):
        corners = [(x, y, z) for x in (0., 1., 3.) for y in (0., 1.) for z in (0., 1.)]
        sides = [((0, 1, 3, 2), (0, 1)), ((4, 5, 7, 6), (1, 2)), ((8, 10, 11, 9), (0, 2))]
        for n, pair in ((0, (0, 1)), (4, (0, 2))):
            sides += [((n, n + 2, n + 6, n + 4), pair), ((n + 1, n + 5, n + 7, n + 3), pair),
                      ((n, n + 4, n + 5, n + 1), pair), ((n + 2, n + 3, n + 7, n + 6), pair)]
        faces = [t for (a, b, c, d), _ in sides for t in ((a, b, c), (a, c, d))]
        labels = [pair for _, pair in sides for _ in range(2)]
        self.write("coarse.obj", obj(corners, faces, labels))
        report = self.report("coarse.obj", "-o", "out.obj", "-L", ".15", *KEEP, *MODES[2])
        after, new_faces = read_mesh(self.folder / "out.obj")
        self.assert_same_network(corners, faces, after, new_faces, MODES[2])
        lengths = [sum((x - y) ** 2 for x, y in zip(a, b)) ** .5 for a, b, _ in junctions(after, new_faces)]
        self.assertLess(max(lengths), .15 * 4 / 3)
        self.assertGreater(report["after"]["min_angle"]["min"], 20)
        before, now = volumes(corners, faces, labels), volumes(after, new_faces, read_labels(self.folder / "out.obj"))
        for body, volume in before.items():
            self.assertAlmostEqual(now[body], volume, delta=1e-9)
        again = self.report("out.obj", "--check", *KEEP)
        self.assertEqual(again["input"]["euler"], report["input"]["euler"])

    def test_a_web_between_two_lines_needs_no_vertex_in_its_middle(self):
        profile, walls = [(x, y) for y in (0, 2) for x in (-2, 0, 2)], ((0, 1), (1, 2), (3, 4), (4, 5), (1, 4))
        vertices = [(x, y, z) for z in (0, 6) for x, y in profile]
        faces = [f for a, b in walls for f in ((a, b, 6 + b), (a, 6 + b, 6 + a))]
        write_off(self.folder / "beam.off", vertices, faces)
        for length in ("2.5", "3.7"):
            report = self.report("beam.off", "-o", "out.off", *KEEP, "--connectivity", "adapt", "-L", length)
            self.assertGreater(report["after"]["min_angle"]["min"], 30)
            after, new_faces = read_mesh(self.folder / "out.off")
            self.assert_same_network(vertices, faces, after, new_faces, MODES[2])

    def test_fixed_changes_nothing_but_coordinates(self):
        for name, (vertices, faces, _) in self.meshes.items():
            report = self.report(name + ".obj", "-o", "out.obj", *KEEP, *MODES[0])
            self.assertTrue(report["output"]["preserved"])
            before, after = ((self.folder / file).read_text().splitlines() for file in (name + ".obj", "out.obj"))
            self.assertEqual([line for line in before if not line.startswith("v ")], [line for line in after if not line.startswith("v ")])
            self.assertGreater(sum(old != new for old, new in zip(before, after)), 10)
            self.assertGreaterEqual(report["after"]["min_angle"]["min"], report["before"]["min_angle"]["min"])

    def test_angles_rise_as_those_of_the_sheets_do(self):
        for mode in MODES:
            report = self.report("boxes.obj", "-o", "out.obj", *KEEP, *mode)
            self.assertGreater(report["after"]["min_angle"]["min"], report["before"]["min_angle"]["min"] + 5)

    def test_threads_change_no_byte(self):
        self.write("line.obj", obj(*uneven_line()))
        for name in ("foam.obj", "line.obj"):
            for mode in MODES:
                results = []
                for threads in (1, 2):
                    self.run_command(name, "-o", "out.obj", "-q", *KEEP, *mode, "--threads", threads)
                    results.append((self.folder / "out.obj").read_bytes())
                self.assertEqual(*results, mode)

    def test_each_format_holds_the_joined_mesh(self):
        vertices, faces, _ = self.meshes["boxes"]
        for extension in ("ply", "off", "msh", "stl"):
            for mode in MODES:
                out = "out." + extension
                _, err = self.run_command("boxes.obj", "-o", out, "-q", *KEEP, *mode)
                self.assertNotIn("have the coordinates of another", err)
                report = self.report(out, "--check", *KEEP)
                count = report["input"]["junction_edges"]
                self.assertGreaterEqual(count, len(junctions(vertices, faces)), (extension, mode))
                again = "again." + extension
                report = self.report(out, "-o", again, *KEEP, *MODES[0])
                self.assertEqual(report["output"]["junction_edges"], count, (extension, mode))

    def test_ids_are_those_of_the_file(self):
        vertices, faces, _ = self.meshes["boxes"]
        inner = next(v for v, p in enumerate(vertices) if 0 < p[1] < 5 and 0 < p[2] < 5 and p[0] == 0)
        self.write("fix.txt", "%d\n0\n" % inner)
        self.write("sizing.txt", "1\n" * len(vertices))
        self.run_command("boxes.obj", "-o", "out.obj", "-q", *KEEP, *MODES[0], "--fix", "fix.txt", "--sizing", "sizing.txt")
        self.assertEqual(read_mesh(self.folder / "out.obj")[0][inner], tuple(vertices[inner]))
        for mode in MODES[1:]:
            report = self.report("boxes.obj", "-o", "out.obj", *KEEP, *mode, "--map", "map.txt", "--fields", "fields.ply")
            after, new_faces = read_mesh(self.folder / "out.obj")
            entries = (self.folder / "map.txt").read_text().splitlines()
            self.assertEqual(len(entries), len(after))
            at_junction = {v for edge in junctions(vertices, faces) for v in edge[:2]}
            for entry, place in zip(entries, after):
                if tuple(place) in at_junction:
                    self.assertEqual(tuple(vertices[int(entry.split()[0])]), tuple(place))
            worst = report["after"]["worst_faces"]
            for face in worst:
                self.assertEqual(sorted(face["vertices"]), sorted(new_faces[face["face"]]))
            self.assertEqual(len(read_mesh(self.folder / "fields.ply")[0]), len(after))

    def test_a_repair_mends_the_rest_and_keeps_the_junctions(self):
        vertices, faces, labels = self.meshes["boxes"]
        rng = random.Random(3)
        turned = [f[::-1] if rng.random() < .2 else f for f in faces]
        self.write("dirty.obj", obj(vertices, turned + turned[:3], labels + labels[:3]))
        self.refused(4, "dirty.obj", "-o", "out.obj", *KEEP, says="--repair")
        for mode in MODES:
            report = self.report("dirty.obj", "-o", "out.obj", "--repair", *KEEP, *mode)
            codes = [change["code"] for change in report["repairs"]]
            self.assertEqual(codes, ["duplicate_faces_dropped", "faces_flipped"])
            after, new_faces = read_mesh(self.folder / "out.obj")
            self.assert_same_network(vertices, faces, after, new_faces, mode)

    def test_holes_and_crumbs_are_those_of_the_joined_mesh(self):
        vertices, faces, labels = self.meshes["boxes"]
        outer = next(n for n, pair in enumerate(labels) if pair == (0, 1) and all(0 < vertices[v][1] < 5 and 0 < vertices[v][2] < 5 for v in faces[n]))
        self.write("open.obj", obj(vertices, faces[:outer] + faces[outer + 1:], labels[:outer] + labels[outer + 1:]))
        report = self.report("open.obj", "-o", "out.obj", "--repair", "--fill-holes", "10", "--drop-components", "20%", *KEEP, *MODES[0])
        self.assertEqual([change["code"] for change in report["repairs"]], ["holes_filled"])
        self.assertEqual(report["output"]["boundary_loops"], 0)
        self.assertEqual(report["output"]["faces"], len(faces))

    def test_other_faults_are_refused_as_ever(self):
        vertices, faces, labels = self.meshes["boxes"]
        self.write("turned.obj", obj(vertices, [faces[0][::-1]] + faces[1:], labels))
        err = self.refused(4, "turned.obj", "-o", "out.obj", *KEEP, says="oriented against each other")
        self.assertNotIn("three or more", err)

    def test_manifolds_are_not_affected(self):
        vertices, faces, labels = walls(lambda i, j, k: 1, (6, 5, 4), noise=.7)
        self.write("box.obj", obj(vertices, faces, labels))
        for mode in MODES:
            results = []
            for keep in ([], KEEP):
                self.run_command("box.obj", "-o", "out.obj", "-q", *keep, *mode)
                results.append((self.folder / "out.obj").read_bytes())
            self.assertEqual(*results, mode)

    def test_it_says_what_stands_still(self):
        report = self.report("boxes.obj", "-o", "out.obj", *KEEP, *MODES[0])
        self.assertEqual(report["parameters"]["keep"], "non-manifold")
        self.assertEqual(report["warnings"], [])
        _, err = self.run_command("boxes.obj", "-o", "out.obj", "-q", *KEEP, "--paper")
        self.assertIn("24 edges with three faces or more, their vertices and those where sheets only touch stay where they are", err)
        old, new = ((self.folder / name).read_text().splitlines() for name in ("boxes.obj", "out.obj"))
        at_junction = {v for edge in edges_of_many(self.meshes["boxes"][1]) for v in edge}
        lines = lambda text: [tuple(map(float, line.split()[1:])) for line in text if line.startswith("v ")]
        for v in at_junction:
            self.assertEqual(lines(old)[v], lines(new)[v])
        _, err = self.run_command("touching.obj", "-o", "out.obj", "-q", *KEEP, *MODES[0])
        self.assertIn("touching.obj: vertices where sheets only touch stay where they are\n", err)

    def test_words_that_would_do_nothing(self):
        self.refused(2, "boxes.obj", "-o", "out.obj", "--keep", "non-manifold,materials", "--paper",
                     names="--keep 'non-manifold,materials'", says="write --keep non-manifold")

    def test_options_that_do_not_go_with_it(self):
        self.write("lengths.txt", "0 1 1\n")
        self.refused(2, "boxes.obj", "-o", "out.obj", *KEEP, "--edge-lengths", "lengths.txt", says="--edge-lengths")


if __name__ == "__main__":
    unittest.main()

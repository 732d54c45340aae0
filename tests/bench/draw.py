#!/usr/bin/env python3
"""draw.py BEFORE AFTER OUT.png [AZIMUTH [ELEVATION [HEIGHT]]]   two meshes side by side, coloured by their minimum angles.
draw.py --map FIELD FIELDS.ply OUT.png [AZIMUTH [ELEVATION [HEIGHT]]]   a mesh coloured by a value of --fields.

Python 3 standard library only. Flat shading, edges drawn, seen from far away (no perspective); angles in degrees,
HEIGHT of the picture in pixels. A face's colour says its minimum angle: red 0, yellow 25, green 38, blue 60 degrees;
the bar between the meshes is the scale, 60 degrees at its top.

FIELD is a property of the vertices or faces, as displacement or length_error: a map like those in figures 1 to 3 of
"Hooke's Optimization for 3D triangular mesh". Blue is the least value and red the greatest, which are printed, as the
bar at the right shows; values that do not exist are grey.
"""

import math
import struct
import sys
import zlib

from mesh_file import read_fields, read_mesh

OVERSAMPLING = 3
EDGE_WIDTH = .55  # half of it, in pixels of the picture
BACKGROUND, INK = (255, 255, 255), (38, 44, 56)
SCALE = [(0, (183, 28, 48)), (12, (232, 92, 58)), (25, (250, 205, 94)), (38, (126, 199, 138)), (60, (42, 112, 178))]
MAP_SCALE = [(0, (0, 0, 143)), (.125, (0, 0, 255)), (.375, (0, 255, 255)), (.625, (255, 255, 0)), (.875, (255, 0, 0)),
             (1, (128, 0, 0))]
NO_VALUE = (150, 150, 150)
LIGHT = (-.45, .62, .65)  # towards the light: x to the right, y up, z to the eye


def colour_of(value, scale=SCALE):
    for (low, a), (high, b) in zip(scale, scale[1:]):
        if value <= high:
            t = (value - low) / (high - low)
            return tuple(x + t * (y - x) for x, y in zip(a, b))
    return scale[-1][1] if value == value else NO_VALUE


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def min_angle(corners):
    """In degrees."""
    angles = []
    for k in range(3):
        u, v = subtract(corners[k - 2], corners[k]), subtract(corners[k - 1], corners[k])
        angles.append(math.atan2(math.hypot(*cross(u, v)), dot(u, v)))
    return math.degrees(min(angles))


def light_on(corners):
    """Brightness of a face in view coordinates, from .58 to 1."""
    normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]))
    length = math.hypot(*normal) or 1.
    facing = 1 if normal[2] >= 0 else -1  # both sides of an open surface are lit
    lambert = max(0., facing * dot(normal, LIGHT) / length / math.hypot(*LIGHT))
    return .58 + .42 * lambert


def angle_colours(vertices, faces):
    """Per face the colours of its corners: that of its minimum angle."""
    return [3 * [colour_of(min_angle([vertices[v] for v in face]))] for face in faces]


def map_colours(field, path, faces):
    """Per face the colours of its corners by a value of the vertices or faces; prints its range."""
    of_vertices, of_faces = read_fields(path)
    if field not in of_vertices and field not in of_faces:
        sys.exit("%s: no field '%s'; it has %s" % (path, field, ", ".join([*of_vertices, *of_faces])))
    values = of_vertices.get(field, of_faces.get(field))
    finite = [x for x in values if math.isfinite(x)]
    low, high = (min(finite), max(finite)) if finite else (0., 0.)
    print("%s: %.6g (blue) to %.6g (red)" % (field, low, high))
    colours = [colour_of((x - low) / (high - low or 1.), MAP_SCALE) for x in values]
    if field in of_vertices:
        return [[colours[v] for v in face] for face in faces]
    return [3 * [colour] for colour in colours]


def viewed(vertices, azimuth, elevation):
    """Coordinates with x to the right, y up and z to the eye."""
    a, e = math.radians(azimuth), math.radians(elevation)
    right = (math.cos(a), math.sin(a), 0.)
    eye = (math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e))
    up = cross(eye, right)
    return [(dot(p, right), dot(p, up), dot(p, eye)) for p in vertices]


class Panel:
    """A picture with a depth for each pixel; the last row is at the bottom."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.colour = [BACKGROUND] * (width * height)
        self.depth = [-math.inf] * (width * height)

    def draw_face(self, corners, colours):
        """Corners in pixels, and their colours; pixels near an edge take the edges' ink."""
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if abs(area) < 1e-9: return
        lengths = (math.hypot(cx - bx, cy - by), math.hypot(ax - cx, ay - cy), math.hypot(bx - ax, by - ay))
        heights = [abs(area) / length for length in lengths]
        reach = EDGE_WIDTH * OVERSAMPLING
        for y in range(max(0, math.ceil(min(ay, by, cy))), min(self.height - 1, math.floor(max(ay, by, cy))) + 1):
            for x in range(max(0, math.ceil(min(ax, bx, cx))), min(self.width - 1, math.floor(max(ax, bx, cx))) + 1):
                u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area
                v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area
                w = 1 - u - v
                if u < 0 or v < 0 or w < 0: continue
                z, slot = u * az + v * bz + w * cz, y * self.width + x
                if z <= self.depth[slot]: continue
                self.depth[slot] = z
                colour = tuple(u * a + v * b + w * c for a, b, c in zip(*colours))
                on_edge = min(u * heights[0], v * heights[1], w * heights[2]) < reach
                self.colour[slot] = tuple(.35 * c + .65 * i for c, i in zip(colour, INK)) if on_edge else colour

    def rows(self):
        """Rows of RGB bytes, each pixel the mean of OVERSAMPLING squared."""
        n = OVERSAMPLING
        for top in range(0, self.height, n):
            row = bytearray()
            for left in range(0, self.width, n):
                block = [self.colour[y * self.width + x] for y in range(top, top + n) for x in range(left, left + n)]
                # four levels a step: the eye sees no difference, the compressor does
                row += bytes(min(255, 4 * round(sum(channel) / (4 * n * n))) for channel in zip(*block))
            yield bytes(row)


def draw(vertices, faces, colours, box, height):
    """Rows of a panel with a mesh in view coordinates; `box` is what it shows, `colours` those of each face's corners."""
    (left, bottom), (right, top) = box
    scale = .96 * height * OVERSAMPLING / (top - bottom)
    panel = Panel(OVERSAMPLING * math.ceil((right - left) * scale / OVERSAMPLING / .96), height * OVERSAMPLING)
    middle = ((left + right) / 2, (bottom + top) / 2)
    placed = [(panel.width / 2 + (x - middle[0]) * scale, panel.height / 2 - (y - middle[1]) * scale, z)
              for x, y, z in vertices]
    for face, of_corners in zip(faces, colours):
        light = light_on([vertices[v] for v in face])
        panel.draw_face([placed[v] for v in face], [tuple(light * c for c in colour) for colour in of_corners])
    return list(panel.rows())


def scale_bar(height, scale=SCALE, width=14, margin=22):
    """Rows of a colour scale, its greatest value at the top."""
    blank = bytes(BACKGROUND)
    first, last = height // 4, height - height // 4
    for y in range(height):
        inside = first <= y < last
        bar = bytes(round(c) for c in colour_of(scale[-1][0] * (last - y) / (last - first), scale)) if inside else blank
        yield blank * margin + bar * width + blank * margin


def write_png(path, rows):
    """RGB, eight bits; see the PNG specification, ISO/IEC 15948."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b""))


def box_of(vertices):
    return [tuple(choose(p[k] for p in vertices) for k in (0, 1)) for choose in (min, max)]


def main():
    arguments = sys.argv[1:]
    field = arguments[1] if arguments[:1] == ["--map"] and len(arguments) > 3 else None
    names = arguments[2:4] if field else arguments[:3]
    if len(arguments) < 3 or arguments[0] == "--map" and not field:
        sys.exit(__doc__)
    numbers = list(map(float, arguments[4 if field else 3:]))
    azimuth, elevation, height = [*numbers, *(25, 38, 400)[len(numbers):]]
    meshes = [(viewed(vertices, azimuth, elevation), faces) for vertices, faces in map(read_mesh, names[:-1])]
    box, height = box_of([p for vertices, _ in meshes for p in vertices]), int(height)
    if field:
        (vertices, faces), = meshes
        panels = [draw(vertices, faces, map_colours(field, names[0], faces), box, height), scale_bar(height, MAP_SCALE)]
    else:
        left, right = (draw(vertices, faces, angle_colours(vertices, faces), box, height) for vertices, faces in meshes)
        panels = [left, scale_bar(height), right]
    write_png(names[-1], [b"".join(rows) for rows in zip(*panels)])


if __name__ == "__main__":
    main()

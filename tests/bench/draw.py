#!/usr/bin/env python3
"""draw.py BEFORE AFTER OUT.png [AZIMUTH [ELEVATION [HEIGHT]]]   two meshes side by side, coloured by their minimum angles.

Python 3 standard library only. Flat shading, edges drawn, seen from far away (no perspective); angles in degrees,
HEIGHT of the picture in pixels. A face's colour says its minimum angle: red 0, yellow 25, green 38, blue 60 degrees;
the bar between the meshes is the scale, 60 degrees at its top.
"""

import math
import struct
import sys
import zlib

from mesh_file import read_mesh

OVERSAMPLING = 3
EDGE_WIDTH = .55  # half of it, in pixels of the picture
BACKGROUND, INK = (255, 255, 255), (38, 44, 56)
SCALE = [(0, (183, 28, 48)), (12, (232, 92, 58)), (25, (250, 205, 94)), (38, (126, 199, 138)), (60, (42, 112, 178))]
LIGHT = (-.45, .62, .65)  # towards the light: x to the right, y up, z to the eye


def colour_of(angle):
    for (low, a), (high, b) in zip(SCALE, SCALE[1:]):
        if angle <= high:
            t = (angle - low) / (high - low)
            return tuple(x + t * (y - x) for x, y in zip(a, b))
    return SCALE[-1][1]


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


def shaded(corners):
    """Colour of a face in view coordinates: its minimum angle's, darker where it turns from the light."""
    normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]))
    length = math.hypot(*normal) or 1.
    facing = 1 if normal[2] >= 0 else -1  # both sides of an open surface are lit
    lambert = max(0., facing * dot(normal, LIGHT) / length / math.hypot(*LIGHT))
    return tuple((.58 + .42 * lambert) * c for c in colour_of(min_angle(corners)))


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

    def draw_face(self, corners, colour):
        """Corners in pixels; pixels near an edge take the edges' ink."""
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if abs(area) < 1e-9: return
        lengths = (math.hypot(cx - bx, cy - by), math.hypot(ax - cx, ay - cy), math.hypot(bx - ax, by - ay))
        heights = [abs(area) / length for length in lengths]
        dark = tuple(.35 * c + .65 * i for c, i in zip(colour, INK))
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
                on_edge = min(u * heights[0], v * heights[1], w * heights[2]) < reach
                self.colour[slot] = dark if on_edge else colour

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


def draw(vertices, faces, box, height):
    """A panel of a mesh in view coordinates; `box` is what both panels show."""
    (left, bottom), (right, top) = box
    scale = .96 * height * OVERSAMPLING / (top - bottom)
    panel = Panel(OVERSAMPLING * math.ceil((right - left) * scale / OVERSAMPLING / .96), height * OVERSAMPLING)
    middle = ((left + right) / 2, (bottom + top) / 2)
    placed = [(panel.width / 2 + (x - middle[0]) * scale, panel.height / 2 - (y - middle[1]) * scale, z)
              for x, y, z in vertices]
    for face in faces:
        panel.draw_face([placed[v] for v in face], shaded([vertices[v] for v in face]))
    return list(panel.rows())


def scale_bar(height, width=14, margin=22):
    """Rows of the colour scale between the two panels, 60 degrees at the top of it."""
    blank = bytes(BACKGROUND)
    first, last = height // 4, height - height // 4
    for y in range(height):
        inside = first <= y < last
        bar = bytes(round(c) for c in colour_of(60 * (last - y) / (last - first))) if inside else blank
        yield blank * margin + bar * width + blank * margin


def write_png(path, rows):
    """RGB, eight bits; see the PNG specification, ISO/IEC 15948."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    azimuth, elevation = (float(sys.argv[k]) if len(sys.argv) > k else default for k, default in ((4, 25), (5, 38)))
    height = int(sys.argv[6]) if len(sys.argv) > 6 else 400
    meshes = [(viewed(vertices, azimuth, elevation), faces) for vertices, faces in map(read_mesh, sys.argv[1:3])]
    corners = [p for vertices, _ in meshes for p in vertices]
    box = [tuple(choose(p[k] for p in corners) for k in (0, 1)) for choose in (min, max)]
    left, right = (draw(vertices, faces, box, height) for vertices, faces in meshes)
    write_png(sys.argv[3], [a + b + c for a, b, c in zip(left, scale_bar(height), right)])


if __name__ == "__main__":
    main()

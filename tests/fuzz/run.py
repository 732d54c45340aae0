#!/usr/bin/env python3
"""run.py BUILD SECONDS [TARGET...]   runs each fuzz target of a build that long, from small seeds of every kind of content.

The corpora stay in BUILD/corpus and grow from run to run; what breaks a target is left in BUILD/findings. Prints the
executions and the findings of each target; exits 1 if there is any. Environment: JOBS = targets at a time (default: all
processors, at most 4, as each may take 3 GB).
"""

import os
import re
import struct
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

DATA = Path(__file__).resolve().parents[2] / "data"

OBJ = b"""# a comment
mtllib m.mtl
o part
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 1 1 0 0 0 1
v 0 1 0 1 1 1
v 0 0 1\r
vt 0 0
vt 1 0
vt 1 1 0
vn 0 0 1
vn 0 1 0
g side
usemtl red
s 1
f 1/1/1 2/2/1 3/3/1 4/1/1
s off
f -5//2 -1//2 -4//2
f 2 5 3 \\
 4
l 1 2
"""
PLY = b"""ply
format %s 1.0
comment text
obj_info more
element vertex 4
property %s x
property float y
property double z
property uchar red
property list uchar int ring
element face 2
property list uchar int vertex_indices
property int label
element edge 1
property int a
property int b
end_header
"""
OFF = b"%s\n# text\n4 2 0\n0 0 0%s\n1 0 0%s\n1 1 0%s\n0 1 0%s\n3 0 1 2 255 0 0\n3 0 2 3\n"
STL = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
MSH2 = b"""$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 7 "skin"
$EndPhysicalNames
$Nodes
3
1 0 0 0
2 1 0 0
9 0 1 0
$EndNodes
$Elements
2
1 15 2 7 1 1
2 2 2 7 1 1 2 9
$EndElements
"""
MSH4 = b"""$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 0
1 0 0 0 1 1 0 1 7 0
$EndEntities
$Nodes
1 3 1 3
2 1 0 3
1
2
3
0 0 0
1 0 0
0 1 0
$EndNodes
$Elements
1 1 1 1
2 1 2 1
1 1 2 3
$EndElements
"""
VTP = b"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32">
<PolyData><Piece NumberOfPoints="3" NumberOfPolys="1">
<PointData><DataArray type="Float32" Name="t" format="ascii">0 1 2</DataArray></PointData>
<CellData><DataArray type="Int32" Name="label" format="ascii">7</DataArray></CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys>
</Piece></PolyData></VTKFile>
"""


def ply_seeds():
    vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    body = b"".join(b"%d %d %d 9 2 1 2\n" % v for v in vertices) + b"3 0 2 1 5\n3 0 1 3 6\n0 1\n"
    seeds = [PLY % (b"ascii", b"double") + body, PLY % (b"ascii", b"short") + body]
    for name, order in ((b"binary_little_endian", "<"), (b"binary_big_endian", ">")):
        data = b"".join(struct.pack(order + "dfdBBii", *v, 9, 2, 1, 2) for v in vertices)
        data += struct.pack(order + "BiiiiBiiii", 3, 0, 2, 1, 5, 3, 0, 1, 3, 6) + struct.pack(order + "ii", 0, 1)
        seeds.append(PLY % (name, b"double") + data)
    return seeds


def off_seeds():
    kinds = {b"OFF": b"", b"COFF": b" 255 0 0 255", b"NOFF": b" 0 0 1", b"STOFF": b" .5 .5", b"CNOFF": b" 0 0 1 1 1 1 1"}
    seeds = [OFF % ((kind,) + (more,) * 4) for kind, more in kinds.items()]
    binary = b"OFF BINARY\n" + struct.pack(">iii", 3, 1, 0) + struct.pack(">9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    return seeds + [binary + struct.pack(">iiiii", 3, 0, 1, 2, 0)]


def stl_seeds():
    binary = bytes(80) + struct.pack("<I", 1) + struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 5)
    return [STL, STL + STL, binary]


CONFIG = b"""# settings
length = '1.2x'  # text
connectivity = "flip"
tolerance = '0.1%'
max-outer = 3
rho = .5
repair = true
paper = false
require = ['after.min_angle.min >= 1', # both
  "geometry.flipped_faces == 0" ,
]
drop-components = 'off'
fill-holes = 9
weld = '1%'
keep = 'seams,non-manifold'
sizing = 'curvature:0.1%'
report = '-'
"""


def array_seeds():
    cube = [(x, y, z) for x in (0, 20) for y in (0, 20) for z in (0, 20)]
    faces = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2),
             (1, 3, 7), (1, 7, 5)]
    grid = [(4 * x, 4 * y, (x * y) % 5) for x in range(5) for y in range(5)]
    cells = [t for x in range(4) for y in range(4) for c in [5 * x + y] for t in ((c, c + 5, c + 6), (c, c + 6, c + 1))]
    pack = lambda choice, points, triangles: bytes([choice, len(points) - 4] + [i for p in points for i in p] +
                                                   [i for t in triangles for i in t])
    wall = grid + [(8, 4 * y, 12) for y in range(5)]
    junction = cells + [t for y in range(4) for t in ((10 + y, 11 + y, 26 + y), (10 + y, 26 + y, 25 + y))]
    return [pack(choice, *mesh) for choice in range(8) for mesh in ((cube, faces), (grid, cells))] + [
        pack(32 + choice, wall, junction) for choice in range(3)]


SEEDS = {"obj": lambda: [OBJ, (DATA / "cube.obj").read_bytes()], "ply": ply_seeds, "off": off_seeds, "stl": stl_seeds,
         "msh": lambda: [MSH2, MSH4], "vtp": lambda: [VTP], "repair": array_seeds, "pipeline": array_seeds,
         "config": lambda: [CONFIG, b"effort = 'fast'\nthreads = 2\nsuffix = '_b'\n"]}


def run(build, target, seconds):
    corpus, findings = build / "corpus" / target, build / "findings"
    corpus.mkdir(parents=True, exist_ok=True)
    findings.mkdir(parents=True, exist_ok=True)
    for i, seed in enumerate(SEEDS[target]()):
        (corpus / ("seed%d" % i)).write_bytes(seed)
    slow = 120 if target == "pipeline" else 20  # seconds for one input; `adapt` makes thousands of faces of long needles
    done = subprocess.run([build / "tests" / "fuzz" / ("fuzz_" + target), "-max_total_time=%d" % seconds, "-timeout=%d" % slow,
                           "-rss_limit_mb=3000", "-max_len=4096", "-artifact_prefix=%s/%s-" % (findings, target),
                           "-print_final_stats=1", "-verbosity=0", corpus], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    log = done.stderr.decode(errors="replace")
    executions = re.search(r"number_of_executed_units: (\d+)", log)
    passed = done.returncode == 0
    print("%-10s %9s executions in %d s, %s" % (target, executions[1] if executions else "?", seconds,
                                               "nothing found" if passed else "FOUND\n" + log[-3000:]), flush=True)
    return passed


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    build, seconds, targets = Path(sys.argv[1]).resolve(), int(sys.argv[2]), sys.argv[3:] or list(SEEDS)
    with ThreadPoolExecutor(min(4, int(os.environ.get("JOBS", os.cpu_count())))) as pool:
        sys.exit(not all(list(pool.map(lambda target: run(build, target, seconds), targets))))


if __name__ == "__main__":
    main()

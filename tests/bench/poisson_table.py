#!/usr/bin/env python3
"""poisson_table.py TOOL [SEEDS] [PEERS]   what better triangles are worth to a solver, as a Markdown table.

Linear finite elements, that is the cotangent stiffness matrix, on the paper's meshes (artificial_meshes.py) before
and after; needs numpy and scipy. Medians over SEEDS meshes (default 5) of a family:

condition  of the stiffness matrix: largest eigenvalue over smallest, without the boundary's unknowns on G1 and M1 to
           M3, without that of the constants on the spheres S1 and S2
error      of a Poisson problem with a known solution u, in percent of u, both in the L2 norm: u = xyz, an
           eigenfunction, on the unit sphere; u = sin(3x) cos(2y) above the square, given on the boundary

PEERS, the program built from peers.cpp, adds rows of CGAL and OpenMesh.
"""

import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as solvers

import artificial_meshes
from mesh_file import read_mesh

OURS = {
    "default": [],
    "`--connectivity flip`": ["--connectivity", "flip"],
    "`--connectivity adapt`": ["--connectivity", "adapt"],
}
PEERS = {"CGAL tangential relaxation, then angles": "cgal-relax-angle", "CGAL isotropic": "cgal-isotropic",
         "OpenMesh tangential smoother": "openmesh-smoother"}


def matrices(points, faces):
    """Stiffness and mass matrix of linear elements."""
    n, rows, columns, stiffness, mass = len(points), [], [], [], []
    normals = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    double_area = np.linalg.norm(normals, axis=1)
    for k in range(3):
        a, b, c = (faces[:, (k + j) % 3] for j in range(3))
        u, v = points[b] - points[a], points[c] - points[a]
        cotangent = np.einsum("ij,ij->i", u, v) / double_area
        for row, column, sign in ((b, c, -.5), (c, b, -.5), (b, b, .5), (c, c, .5)):
            rows.append(row), columns.append(column), stiffness.append(sign * cotangent)
            mass.append(double_area / 24)  # 1/12 of the area between two corners; twice that at one, from two edges
    place = (np.concatenate(rows), np.concatenate(columns))
    return tuple(sparse.csr_matrix((np.concatenate(values), place), shape=(n, n)) for values in (stiffness, mass))


def boundary_vertices(faces):
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, first, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    return np.unique(edges[first[count == 1]])


def solution_over_square(x, y):
    return np.sin(3 * x) * np.cos(2 * y)


def source_over_square(height, x, y, h=1e-3):
    """Minus the Laplace-Beltrami operator of the solution on the graph of the height, by central differences."""
    def gradient(f, x, y):
        return (f(x + h, y) - f(x - h, y)) / (2 * h), (f(x, y + h) - f(x, y - h)) / (2 * h)

    def flux(x, y, axis):
        (p, q), (u, v) = gradient(height, x, y), gradient(solution_over_square, x, y)
        root = np.sqrt(1 + p * p + q * q)  # of the determinant of the metric; times its inverse:
        return ((1 + q * q) * u - p * q * v) / root if axis == 0 else ((1 + p * p) * v - p * q * u) / root

    p, q = gradient(height, x, y)
    divergence = ((flux(x + h, y, 0) - flux(x - h, y, 0)) + (flux(x, y + h, 1) - flux(x, y - h, 1))) / (2 * h)
    return -divergence / np.sqrt(1 + p * p + q * q)


def figures(family, path):
    """(condition number, relative error in percent) on a mesh file."""
    vertices, triangles = read_mesh(path)
    points, faces = np.array(vertices), np.array(triangles)
    stiffness, mass = matrices(points, faces)
    x, y, z = points.T
    on_sphere = family in artificial_meshes.SPHERES
    known = np.array([0]) if on_sphere else boundary_vertices(faces)  # a sphere's solution is free by a constant
    free = np.setdiff1d(np.arange(len(points)), known)
    if on_sphere:
        exact = x * y * z / np.linalg.norm(points, axis=1) ** 3
        source = 12 * exact
    else:
        exact = solution_over_square(x, y)
        source = source_over_square(artificial_meshes.PLANAR[family][1], x, y)
    eigenvalues = np.linalg.eigvalsh(stiffness.toarray() if on_sphere else stiffness[free][:, free].toarray())
    condition = eigenvalues[-1] / eigenvalues[1 if on_sphere else 0]
    load = mass @ source
    if on_sphere: load -= load.sum() * (mass @ np.ones(len(points))) / mass.sum()  # orthogonal to the constants
    solved = exact.copy()
    solved[free] = solvers.spsolve(stiffness[free][:, free].tocsc(), (load - stiffness[:, known] @ exact[known])[free])
    error = solved - exact
    if on_sphere: error -= (mass @ error).sum() / mass.sum()
    norm = lambda values: np.sqrt(values @ (mass @ values))
    return condition, 100 * norm(error) / norm(exact)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tool, seeds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    peers = sys.argv[3] if len(sys.argv) > 3 else None
    runs = {name: lambda source, output, extra=extra: [tool, source, "-o", output, "-q", *extra]
            for name, extra in OURS.items()}
    if peers:
        runs.update({name: lambda source, output, method=method: [peers, method, source, output]
                     for name, method in PEERS.items()})
    columns = {name: {} for name in ["input", *runs]}
    with tempfile.TemporaryDirectory() as folder:
        source, output = Path(folder) / "in.off", Path(folder) / "out.off"
        for family in artificial_meshes.NAMES:
            for seed in range(1, seeds + 1):
                artificial_meshes.write(family, seed, source)
                columns["input"].setdefault(family, []).append(figures(family, source))
                for name, command in runs.items():
                    run = subprocess.run([str(word) for word in command(source, output)], capture_output=True, text=True)
                    if run.returncode != 0: sys.exit("%s on %s, seed %d: %s" % (name, family, seed, run.stderr))
                    columns[name].setdefault(family, []).append(figures(family, output))
    print("| who | %s |" % " | ".join("%s: condition, error" % family for family in artificial_meshes.NAMES))
    print("|---" * (1 + len(artificial_meshes.NAMES)) + "|")
    for name, of_family in columns.items():
        cells = ["%.3g, %.2f %%" % tuple(map(statistics.median, zip(*rows))) for rows in of_family.values()]
        print("| %s | %s |" % (name, " | ".join(cells)), flush=True)


if __name__ == "__main__":
    main()

"""Moves the vertices of a triangle mesh on its own surface until the triangles are well shaped.

    import hooke_remesh
    done = hooke_remesh.remesh(vertices, faces)
    done.vertices, done.report["after"]["min_angle"]["min"]

Meshes are numpy arrays: `vertices` n x 3 coordinates in any unit of length, `faces` m x 3 vertex ids (0-based,
counter-clockwise as seen from outside). Angles are in degrees. The results are those of the command hooke-remesh, bit by
bit, for any number of threads.
"""

from __future__ import annotations

import json
import os
import warnings as _warnings
from dataclasses import dataclass
from typing import Any, Callable, Literal, Mapping, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._attributes import carry_corners, carry_faces, carry_vertices
from ._core import __version__
from .errors import (Error, InputError, Interrupted, LimitError, MeshError, MeshWarning, NumericalError, OutputError,
                     ResultError, UsageError)

__all__ = ["remesh", "measure", "read", "write", "Result", "Map", "Mesh", "Error", "UsageError", "InputError",
           "MeshError", "OutputError", "LimitError", "NumericalError", "ResultError", "Interrupted", "MeshWarning",
           "__version__"]

Option = Union[None, bool, int, float, str, "os.PathLike[str]", "Sequence[str]"]
Progress = Callable[[str, int, int, float], Any]

# What the command does with its files, the data in them, and its terminal.
_OF_THE_COMMAND = {"output", "format", "map", "report", "fields", "trace", "trace_steps", "check", "quiet", "verbose",
                   "progress", "help", "help_all", "version", "config", "print_config", "completion", "man_page", "suffix",
                   "table", "skip_existing", "jobs", "input_format", "preserve", "reproject_uv", "list_metrics"}


@dataclass(frozen=True)
class Map:
    """Where the n vertices of a result lie on the input. Values at the input's vertices are carried over by
    `np.einsum("vk,vk...->v...", map.weights, values[faces[map.faces]])`."""

    vertices: NDArray[np.int32]  #: (n,) id of the vertex in the input; -1 for a new one
    faces: NDArray[np.int32]  #: (n,) face of the input; -1 for a vertex without faces
    weights: NDArray[np.float64]  #: (n, 3) of that face's corners, in their order; not negative, sum 1


@dataclass(frozen=True)
class Result:
    """A remeshed mesh."""

    vertices: NDArray[np.float64]  #: (n, 3) coordinates, in the unit of the input
    faces: NDArray[np.int32]  #: (m, 3) vertex ids
    map: Map | None  #: None with `map=False` and `paper=True`
    report: dict[str, Any]  #: as the command's JSON report
    attributes: dict[str, NDArray[Any]]  #: (n, ...) each
    face_attributes: dict[str, NDArray[Any]]  #: (m, ...) each
    corner_attributes: dict[str, NDArray[Any]]  #: (m, 3, ...) each


@dataclass(frozen=True)
class Mesh:
    """A mesh of a file."""

    vertices: NDArray[np.float64]  #: (n, 3) coordinates
    faces: NDArray[np.int32]  #: (m, 3) vertex ids; polygons are cut into triangles
    attributes: dict[str, NDArray[Any]]  #: (n,) each, by their PLY names: red, nx, s, quality
    format: str  #: "obj", "ply" or "off"
    warnings: list[tuple[str, str]]  #: code and message


def remesh(vertices: ArrayLike, faces: ArrayLike, length: Option = None,
           connectivity: Literal["fixed", "flip", "adapt"] = "fixed", *, sizing: Option | NDArray[Any] = None,
           edge_lengths: os.PathLike[str] | str | tuple[ArrayLike, ArrayLike] | None = None,
           fix: ArrayLike | os.PathLike[str] | str | None = None, attributes: Mapping[str, ArrayLike] | None = None,
           face_attributes: Mapping[str, ArrayLike] | None = None,
           corner_attributes: Mapping[str, ArrayLike] | None = None, map: bool = True, progress: Progress | None = None,
           **options: Option) -> Result:
    """Remeshes a mesh; the arrays given are not changed.

    vertices      n x 3 coordinates
    faces         m x 3 vertex ids, of any integer type
    length        target edge length in the unit of the vertices, or as the command takes it: "auto", "mean", "1%" of the
                  box's diagonal, "2x" the natural length; default "auto", as many triangles as there are
    connectivity  "fixed": the faces stay; "flip": edges are flipped too; "adapt": new vertices and faces
    sizing        n target lengths, one per vertex; or as the command takes it: "curvature:0.1%" or a file
    edge_lengths  target lengths of single edges, with "fixed": a pair of k x 2 vertex ids and k lengths, or a file
    fix           ids of vertices that stay where they are, or a file of them
    attributes    values of the vertices, n x ... each: "flip" and "adapt" interpolate them in the faces, integers
                  rounded; labels - integers but red, green, blue and alpha, and but those of one or two bytes that
                  differ at most sides of faces - and other types are those of the nearest corner
    face_attributes, corner_attributes
                  values of the faces, m x ..., and of their corners, m x 3 x ...; with "fixed", where faces stay
    map           whether to tell where the result's vertices lie on the input
    progress      is called at most twenty times a second with the stage, the outer iteration, the step, and the energy
                  in units of the mean target length; the run stops if it returns False, and the result is the best so
                  far, with the status "interrupted"
    options       every other option of the command but those for its files and its terminal, by the same name with _ for
                  -: effort="fast", feature_angle=30, max_distance="0.1%", polish=False, threads=2, paper=True;
                  None leaves it out; repair=True, weld="0.01%" and fill_holes=8 mend the mesh first, and what was done
                  is in report["repairs"]; require=["after.min_angle.min >= 20"] judges the report, with the outcomes in
                  report["gates"], and compare="base.json" compares it with an older one, in report["comparison"];
                  keep="non-manifold" takes a mesh with edges of three faces and more, as where bodies share walls:
                  the walls stay joined

    Other Python threads run meanwhile. Ctrl-C raises Interrupted, a KeyboardInterrupt with the best mesh so far as its
    `result`. Each of report["warnings"] is also emitted as a MeshWarning.

    Raises UsageError for options, MeshError for a mesh that is no oriented manifold, InputError for a file that an
    option names, ResultError for a result that would not keep the input's surface, LimitError for too little memory,
    NumericalError, and what `progress` raises. TypeError and ValueError for arrays of other types and shapes.
    """
    points, triangles = _arrays(vertices, faces)
    keeps_faces = connectivity == "fixed"
    of_vertices = _attributes("attributes", attributes, (len(points),))
    of_faces = _attributes("face_attributes", face_attributes, (len(triangles),))
    of_corners = _attributes("corner_attributes", corner_attributes, (len(triangles), 3))
    if (of_faces or of_corners) and not keeps_faces:
        raise UsageError(f"face_attributes and corner_attributes: new faces have none; expected connectivity='fixed', "
                         f"not {connectivity!r}")
    prepared = _prepared(len(points), sizing, edge_lengths, fix,
                         {"length": length, "connectivity": connectivity, **options})
    needs_map = map or bool(of_vertices) and not keeps_faces
    out_vertices, out_faces, places, text, origin, exception = _core.run(
        points, triangles, *prepared, needs_map, progress)
    report = _warned(json.loads(text))
    old_vertices, old_faces, swapped = origin or (None, None, None)
    where = None if keeps_faces else places
    result = Result(out_vertices, out_faces, Map(*places) if places and map else None, report,
                    {name: carry_vertices(name, values, triangles, old_vertices, where) for name, values in of_vertices.items()},
                    {name: carry_faces(values, old_faces) for name, values in of_faces.items()},
                    {name: carry_corners(values, old_faces, swapped) for name, values in of_corners.items()})
    if isinstance(exception, KeyboardInterrupt):
        raise Interrupted(result) from exception
    if exception is not None:
        raise exception
    return result


def measure(vertices: ArrayLike, faces: ArrayLike, length: Option = None, *, sizing: Option | NDArray[Any] = None,
            edge_lengths: os.PathLike[str] | str | tuple[ArrayLike, ArrayLike] | None = None,
            fix: ArrayLike | os.PathLike[str] | str | None = None, **options: Option) -> dict[str, Any]:
    """The report of a mesh as it is: `report["input"]` counts, `report["before"]` has the figures of its quality.

    vertices      n x 3 coordinates
    faces         m x 3 vertex ids, of any integer type
    length        target edge length, for the length errors; as for remesh(), and so are sizing, edge_lengths and fix
    options       threads, repair, and others that remesh() takes

    Raises and warns as remesh() does.
    """
    points, triangles = _arrays(vertices, faces)
    arguments, *lists = _prepared(len(points), sizing, edge_lengths, fix, {"length": length, **options})
    return _warned(json.loads(_core.run(points, triangles, arguments + ["--check"], *lists, False, None)[3]))


def read(path: str | os.PathLike[str], *, keep: Literal["non-manifold"] | None = None) -> Mesh:
    """Reads an OBJ, PLY or OFF file, with the values of its vertices. Raises InputError for a file that is missing or
    malformed, MeshError for one whose mesh is no oriented manifold; with keep="non-manifold" edges of three faces and
    more are none of its faults."""
    return Mesh(*_core.read(path, _keeps_junctions(keep)))


def write(path: str | os.PathLike[str], vertices: ArrayLike, faces: ArrayLike,
          attributes: Mapping[str, ArrayLike] | None = None, *, format: Literal["obj", "ply", "off"] | None = None,
          ascii: bool = False, keep: Literal["non-manifold"] | None = None) -> None:
    """Writes a mesh file, completely or not at all, so that coordinates read back exactly.

    vertices      n x 3 coordinates
    faces         m x 3 vertex ids
    attributes    n values each, by their PLY names: red, green and blue (0 to 255 as integers), nx, ny, nz, s, t; PLY
                  takes any other name too, for other formats a warning tells what was left out
    format        default: by the extension of the path
    ascii         writes PLY as text
    keep          "non-manifold" writes a mesh with edges of three faces and more too

    Raises MeshError for a mesh that is no oriented manifold, OutputError if it cannot be written, UsageError for another
    format or attributes of other shapes.
    """
    values = {name: np.asarray(value) for name, value in (attributes or {}).items()}
    left_out = _core.write(path, *_arrays(vertices, faces), values, format, ascii, _keeps_junctions(keep))
    if left_out:
        _warnings.warn(f"{os.fspath(path)}: its format cannot hold {', '.join(left_out)}; use PLY", MeshWarning,
                       stacklevel=2)


def _prepared(count: int, sizing: Any, edge_lengths: Any, fix: Any, options: Mapping[str, Option]) -> tuple[
        list[str], Sequence[float] | None, Sequence[int], Sequence[tuple[int, int, float]] | None]:
    """The options as the command takes them, and the lengths, fixed vertices and lengths of edges that come as arrays.
    `count`: of vertices."""
    _keeps_junctions(options.get("keep"))
    lengths = edges = None
    ids: Sequence[int] = []
    files = {"sizing": sizing, "edge_lengths": edge_lengths, "fix": fix}
    if isinstance(sizing, str) and sizing.startswith("ply:"):
        raise UsageError(f"sizing {sizing!r}; expected an array, a file of lengths or 'curvature'")
    if _is_array(sizing):
        files["sizing"], lengths = "values", _lengths(sizing, count)
    if _is_array(edge_lengths):
        files["edge_lengths"], edges = "edge_lengths", _edge_lengths(edge_lengths, count)
    if _is_array(fix):
        files["fix"], ids = None, _ids(fix, count)
    return _arguments({**options, **files}), lengths, ids, edges


def _keeps_junctions(keep: Any) -> bool:
    if keep not in (None, "non-manifold"):
        raise UsageError(f"keep: {keep!r}; expected 'non-manifold': arrays have no seams, materials and groups to keep")
    return keep is not None


def _is_array(value: Any) -> bool:
    return value is not None and not isinstance(value, (str, os.PathLike))


def _warned(report: dict[str, Any]) -> dict[str, Any]:
    """The report, whose warnings the caller of this package's function gets."""
    for warning in report["warnings"]:
        _warnings.warn(warning["message"], MeshWarning, stacklevel=3)
    return report


def _arrays(vertices: ArrayLike, faces: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """The mesh in the types that the compiled module takes; copies only what has others."""
    points = np.ascontiguousarray(vertices, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"vertices of shape {points.shape}; expected (n, 3)")
    triangles = np.asarray(faces)
    if triangles.ndim != 2 or triangles.shape[1] != 3:
        raise ValueError(f"faces of shape {triangles.shape}; expected (m, 3): triangles")
    if triangles.dtype.kind not in "iu":
        raise TypeError(f"faces of type {triangles.dtype}; expected integers")
    return points, _as_ids(triangles, len(points), "faces")


def _as_ids(ids: NDArray[Any], count: int, name: str) -> NDArray[np.int32]:
    """The ids as 32-bit integers, after a check that they are vertices."""
    wrong = np.argwhere((ids < 0) | (ids >= count)) if ids.size and (ids.min() < 0 or ids.max() >= count) else ()
    if len(wrong):
        place = tuple(int(i) for i in wrong[0])
        where = ", ".join(map(str, place))
        raise MeshError(f"{name}[{where}] is {ids[place]}; expected a vertex id from 0 to {count - 1}")
    return np.ascontiguousarray(ids, dtype=np.int32)


def _lengths(sizing: Any, count: int) -> Sequence[float]:
    lengths = np.asarray(sizing, dtype=np.float64)
    if lengths.shape != (count,) or not (np.isfinite(lengths) & (lengths > 0)).all():
        raise UsageError(f"sizing of shape {lengths.shape}; expected a positive length for each of the {count} vertices")
    return lengths.tolist()


def _edge_lengths(edge_lengths: Any, count: int) -> Sequence[tuple[int, int, float]]:
    expected = "expected a pair: k x 2 vertex ids, and k positive lengths"
    if not isinstance(edge_lengths, (tuple, list)) or len(edge_lengths) != 2:
        raise UsageError(f"edge_lengths of type {type(edge_lengths).__name__}; {expected}")
    ends, lengths = np.asarray(edge_lengths[0]), np.asarray(edge_lengths[1], dtype=np.float64)
    if ends.ndim != 2 or ends.shape[1] != 2 or ends.dtype.kind not in "iu" or lengths.shape != (len(ends),) or not (
            np.isfinite(lengths) & (lengths > 0)).all():
        raise UsageError(f"edge_lengths of shapes {ends.shape} and {lengths.shape}; {expected}")
    ids = _as_ids(ends, count, "edge_lengths[0]")
    return list(zip(ids[:, 0].tolist(), ids[:, 1].tolist(), lengths.tolist()))


def _attributes(name: str, attributes: Mapping[str, ArrayLike] | None, shape: tuple[int, ...]
                ) -> dict[str, NDArray[Any]]:
    """The arrays of these attributes, whose first axes must have this shape."""
    arrays = {key: np.asarray(values) for key, values in (attributes or {}).items()}
    for key, values in arrays.items():
        if values.shape[:len(shape)] != shape:
            raise UsageError(f"{name}[{key!r}] of shape {values.shape}; expected {' x '.join(map(str, shape))} x ...")
    return arrays


def _ids(fix: Any, count: int) -> Sequence[int]:
    ids = np.asarray(fix)
    if ids.size and (ids.ndim != 1 or ids.dtype.kind not in "iu"):
        raise UsageError(f"fix of shape {ids.shape} and type {ids.dtype}; expected a list of vertex ids")
    return _as_ids(ids.reshape(-1) if ids.size else np.empty(0, int), count, "fix").tolist()


def _arguments(options: Mapping[str, Option]) -> list[str]:
    """The options as the command takes them."""
    arguments = []
    for name, value in options.items():
        if name.replace("-", "_") in _OF_THE_COMMAND:
            raise UsageError(f"{name}: is for files and the terminal of the command; leave it out")
        option = name.replace("_", "-")
        if value is not None:
            values = value if isinstance(value, (list, tuple)) else [value]
            arguments += [f"--{option}={_text(name, v)}" for v in values]
    return arguments


def _text(name: str, value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (int, np.integer, str)):
        return str(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise UsageError(f"{name}: a value of type {type(value).__name__}; expected a number, a text, True or False")

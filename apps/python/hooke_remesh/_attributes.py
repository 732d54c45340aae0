"""Carries values of vertices, faces and corners of a mesh to the result."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


_COLOURS = ("red", "green", "blue", "alpha")


def _are_labels(name: str, values: NDArray[Any], faces: NDArray[np.int32]) -> bool:
    """Are these numbers labels, between which there is nothing? The rule of the command: integers but colours; those of
    one or two bytes may be brightness, and are labels if they are equal at most sides of faces."""
    if values.dtype.kind not in "fiu":
        return True  # words and others
    if values.dtype.kind == "f" or name in _COLOURS:
        return False
    if values.dtype.itemsize > 2:
        return True
    corners = values[faces]
    return bool(2 * np.count_nonzero(corners == np.roll(corners, 1, axis=1)) >= corners.size)


def carry_vertices(name: str, values: NDArray[Any], faces: NDArray[np.int32], old: NDArray[np.int32] | None,
                   places: tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]] | None) -> NDArray[Any]:
    """The values at the vertices of the result. `old`: the ids before a repair; `places`: the map, where vertices lie
    elsewhere on the input's faces."""
    if places is None:
        return values.copy() if old is None else values[old]
    vertices, on_face, weights = places
    corners = values[faces[on_face]]
    nearest = np.take_along_axis(corners, weights.argmax(axis=1).reshape((-1,) + (1,) * (corners.ndim - 1)), axis=1)[:, 0]
    if not _are_labels(name, values, faces):
        result = _interpolated(corners, weights)
        if values.dtype.kind != "f":
            result = np.sign(result) * np.floor(np.abs(result) + .5)
        result = result.astype(values.dtype)
        stays = weights.max(axis=1) == 1
        result[stays] = nearest[stays]  # exact, also where integers have more digits than float64
    else:
        result = nearest
    alone = on_face < 0  # of no face of the input: vertices without faces, and what fills holes
    result[alone] = values[vertices[alone]]
    result[alone & (vertices < 0)] = np.zeros((), values.dtype)
    return result


def _interpolated(corners: NDArray[Any], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Linear in the faces, never beyond the values of the corners that have weight, as the command does it."""
    w = weights.reshape(weights.shape + (1,) * (corners.ndim - 2))
    x = corners.astype(np.float64)
    counts = np.broadcast_to(w > 0, x.shape)
    terms = np.where(counts, w * x, 0)
    total = terms[:, 0] + terms[:, 1] + terms[:, 2]
    low, high = np.where(counts, x, np.inf).min(axis=1), np.where(counts, x, -np.inf).max(axis=1)
    return np.where(np.isfinite(total), np.clip(total, low, high), total)


def carry_faces(values: NDArray[Any], old: NDArray[np.int32] | None) -> NDArray[Any]:
    """The values at the faces of a result that has those of the input; `old`: their ids before a repair."""
    return values.copy() if old is None else values[old]


def carry_corners(values: NDArray[Any], old: NDArray[np.int32] | None, swapped: NDArray[np.bool_] | None) -> NDArray[Any]:
    """The same for values at the corners of faces; `swapped`: faces that a repair turned over."""
    result = carry_faces(values, old)
    if swapped is not None:
        result[swapped] = result[swapped][:, [0, 2, 1]]
    return result

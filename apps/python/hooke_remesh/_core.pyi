"""The compiled part of hooke_remesh; use the functions of the package."""

import os
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

__version__: str

def run(vertices: NDArray[np.float64], faces: NDArray[np.int32], options: list[str], sizing: list[float] | None,
        fixed_vertices: list[int], edge_lengths: list[tuple[int, int, float]] | None, map: bool,
        progress: Callable[[str, int, int, float], Any] | None, /
        ) -> tuple[NDArray[np.float64] | None, NDArray[np.int32] | None,
                   tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float64]] | None, str,
                   tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.bool_]] | None, BaseException | None]: ...

def read(path: str | os.PathLike[str], keep_junctions: bool, /
         ) -> tuple[NDArray[np.float64], NDArray[np.int32], dict[str, NDArray[Any]], str, list[tuple[str, str]]]: ...

def write(path: str | os.PathLike[str], vertices: NDArray[np.float64], faces: NDArray[np.int32],
          attributes: dict[str, NDArray[Any]], format: str | None, ascii: bool, keep_junctions: bool, /
          ) -> list[str]: ...

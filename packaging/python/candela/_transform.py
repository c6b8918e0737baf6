"""Transforms of objects and cameras, with the methods of Mitsuba's."""

from __future__ import annotations

import math
from typing import Any, List, Sequence, Union

from ._values import plain

Matrix = List[List[float]]


class Transform:
    """An affine transform; each method returns a new one.

    >>> Transform().translate([0, 1, 0]).rotate([0, 1, 0], 45).scale(2)

    As with Mitsuba's ``ScalarTransform4f``, the last one acts first: this scales, then rotates,
    then translates.
    """

    def __init__(self, matrix: Any = None) -> None:
        self.matrix: Matrix = _identity() if matrix is None else rows(matrix)

    def __matmul__(self, other: Any) -> "Transform":
        a, b = self.matrix, rows(other)
        size = range(4)
        return Transform([[sum(a[i][k] * b[k][j] for k in size) for j in size] for i in size])

    def translate(self, v: Sequence[float]) -> "Transform":
        x, y, z = v
        return self @ Transform([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]])

    def scale(self, v: Union[float, Sequence[float]]) -> "Transform":
        v = plain(v)
        x, y, z = v if hasattr(v, "__len__") else (v, v, v)  # type: ignore[misc]
        return self @ Transform([[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]])

    def rotate(self, axis: Sequence[float], angle: float) -> "Transform":
        """Counterclockwise about the axis, in degrees."""
        # Source: Rodrigues' rotation formula
        x, y, z = _unit(axis)
        s, c = math.sin(math.radians(angle)), math.cos(math.radians(angle))
        k = 1 - c
        return self @ Transform(
            [
                [x * x * k + c, x * y * k - z * s, x * z * k + y * s, 0],
                [x * y * k + z * s, y * y * k + c, y * z * k - x * s, 0],
                [x * z * k - y * s, y * z * k + x * s, z * z * k + c, 0],
                [0, 0, 0, 1],
            ]
        )

    def look_at(
        self, origin: Sequence[float], target: Sequence[float], up: Sequence[float]
    ) -> "Transform":
        """Of a camera at ``origin``: its z points to ``target``, and ``up`` is up."""
        z = _unit([t - o for t, o in zip(target, origin)])
        x = _unit(_cross(up, z))
        y = _cross(z, x)
        return self @ Transform([[x[i], y[i], z[i], origin[i]] for i in range(3)] + [[0, 0, 0, 1]])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Transform) and self.matrix == other.matrix

    def __repr__(self) -> str:
        return f"candela.Transform({self.matrix})"


def is_transform(value: Any) -> bool:
    """Whether it is one of Candela or Mitsuba; their points take any letters as components."""
    return hasattr(value, "matrix") and not hasattr(value, "__len__")


def rows(matrix: Any) -> Matrix:
    """The rows of a 4 × 4 matrix: lists, NumPy's, or those of Mitsuba. One of 3 × 3 is its upper
    left, as in Mitsuba's files; Mitsuba's transforms of u and v have their translation in the last
    column.
    """
    inner = plain(matrix.matrix if is_transform(matrix) else matrix)
    try:
        if isinstance(inner, list):
            found = [[float(x) for x in row] for row in inner]
        else:
            size = len(inner)
            found = [[float(inner[i, j]) for j in range(size)] for i in range(size)]
    except (TypeError, IndexError) as e:
        raise ValueError(f"not a matrix: {matrix!r}") from e
    if len(found) not in (3, 4) or any(len(row) != len(found) for row in found):
        raise ValueError(f"a transform needs a 4 × 4 or 3 × 3 matrix, found {matrix!r}")
    if len(found) == 4:
        return found
    if is_transform(matrix):
        found = [[a, b, 0.0, c] for a, b, c in found[:2]] + [[0.0, 0.0, 1.0, 0.0]]
    else:
        found = [[*row, 0.0] for row in found]
    return [*found, [0.0, 0.0, 0.0, 1.0]]


def _identity() -> Matrix:
    return [[float(i == j) for j in range(4)] for i in range(4)]


def _cross(a: Sequence[float], b: Sequence[float]) -> List[float]:
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def _unit(v: Sequence[float]) -> List[float]:
    length = math.sqrt(sum(x * x for x in v))
    if length == 0:
        raise ValueError(
            "a vector of length 0 has no direction: target equals origin, or up is parallel"
        )
    return [x / length for x in v]

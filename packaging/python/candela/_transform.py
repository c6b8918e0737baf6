"""Transforms of objects and cameras, with the methods of Mitsuba's."""

from __future__ import annotations

import math
import numbers
from typing import Any, List, Sequence, Union, overload

from ._values import described, np, plain

Matrix = List[List[float]]


class Transform:
    """An affine transform; each method returns a new one.

    >>> Transform().translate([0, 1, 0]).rotate([0, 1, 0], 45).scale(2)

    As with Mitsuba's ``ScalarTransform4f``, the last one acts first: this scales, then rotates,
    then translates.
    """

    def __init__(self, matrix: Any = None) -> None:
        self.matrix: Matrix = _identity() if matrix is None else rows(matrix)

    @overload
    def __matmul__(self, other: "Transform") -> "Transform": ...

    @overload
    def __matmul__(self, other: Any) -> Any: ...

    def __matmul__(self, other: Any) -> Any:
        """The transform that follows another one; or a point, as a list of three numbers."""
        a, point = self.matrix, plain(other)
        if isinstance(point, list) and all(isinstance(x, numbers.Real) for x in point):
            x, y, z = _three("a point", point)
            return [row[0] * x + row[1] * y + row[2] * z + row[3] for row in a[:3]]
        b = rows(other)
        size = range(4)
        return Transform([[sum(a[i][k] * b[k][j] for k in size) for j in size] for i in size])

    def translate(self, v: Sequence[float]) -> "Transform":
        x, y, z = _three("a translation", v)
        return self @ Transform([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]])

    def scale(self, v: Union[float, Sequence[float]]) -> "Transform":
        v = plain(v)
        x, y, z = _three("a scale", v if hasattr(v, "__len__") else [v] * 3)
        return self @ Transform([[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]])

    def rotate(self, axis: Sequence[float], angle: float) -> "Transform":
        """Counterclockwise about the axis, which should have length 1, in degrees; with another
        one, the matrix is Mitsuba's, which is no rotation.
        """
        # Source: Rodrigues' rotation formula
        x, y, z = _three("the axis of a rotation", axis)
        if x == y == z == 0:
            raise ValueError("the axis of a rotation has length 0")
        if not isinstance(angle, numbers.Real) or not math.isfinite(angle):
            raise ValueError(f"the angle of a rotation needs a number, found {described(angle)}")
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
        given = {"origin": origin, "target": target, "up": up}
        origin, target, up = (_three(f"`{name}`", point) for name, point in given.items())
        z = _unit([t - o for t, o in zip(target, origin)], "target equals origin")
        x = _unit(_cross(up, z), "up is parallel to the direction from origin to target")
        y = _cross(z, x)
        return self @ Transform([[x[i], y[i], z[i], origin[i]] for i in range(3)] + [[0, 0, 0, 1]])

    def inverse(self) -> "Transform":
        a = self.matrix
        # The rows of a 3 × 3 matrix's inverse are cross products of its columns
        columns = [[a[i][j] for i in range(3)] for j in range(3)]
        cofactors = [_cross(columns[(i + 1) % 3], columns[(i + 2) % 3]) for i in range(3)]
        determinant = sum(x * y for x, y in zip(columns[0], cofactors[0]))
        if determinant == 0:
            raise ValueError("a transform that maps volumes to 0 has no inverse")
        linear = Transform([[x / determinant for x in row] for row in cofactors])
        return linear.translate([-a[i][3] for i in range(3)])

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return np.array(self.matrix, dtype)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Transform) and self.matrix == other.matrix

    def __repr__(self) -> str:
        return f"candela.Transform({self.matrix})"


def is_transform(value: Any) -> bool:
    """Whether it is one of Candela or Mitsuba; their points take any letters as components."""
    return hasattr(value, "matrix") and not hasattr(value, "__len__")


def rows(matrix: Any) -> Matrix:
    """The rows of a 4 × 4 matrix: lists, NumPy's, or those of Mitsuba. One of 3 × 4 lacks the last
    row; one of 3 × 3 is the upper left, as in Mitsuba's files; Mitsuba's transforms of u and v have
    their translation in the last column.
    """
    inner = plain(matrix.matrix if is_transform(matrix) else matrix)
    try:
        if isinstance(inner, list):
            found = [[float(x) for x in row] for row in inner]
        else:
            size = len(inner)
            found = [[float(inner[i, j]) for j in range(size)] for i in range(size)]
    except (TypeError, IndexError) as e:
        raise ValueError(f"not a matrix: {described(matrix)}") from e
    if not all(math.isfinite(x) for row in found for x in row):
        raise ValueError(f"a transform needs numbers, found {described(matrix)}")
    sizes = {(len(found), len(row)) for row in found}
    if len(sizes) != 1 or not sizes <= {(4, 4), (3, 4), (3, 3)}:
        expected = "a matrix of 4 × 4, 3 × 4 or 3 × 3"
        raise ValueError(f"a transform needs {expected}, found {described(matrix)}")
    if len(found) == 4:
        if any(abs(x - y) > 1e-6 for x, y in zip(found[3], (0, 0, 0, 1))):
            raise ValueError(f"a transform needs the last row 0, 0, 0, 1, found {found[3]}")
        return found
    if sizes == {(3, 4)}:
        pass
    elif is_transform(matrix):
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


def _three(what: str, given: Any) -> List[float]:
    try:
        values = [float(x) for x in plain(given)]
    except (TypeError, ValueError):
        values = []
    if len(values) != 3 or not all(map(math.isfinite, values)):
        raise ValueError(f"{what} needs three numbers, found {described(given)}")
    return values


def _unit(v: Sequence[float], fault: str) -> List[float]:
    length = math.sqrt(sum(x * x for x in v))
    if length == 0:
        raise ValueError(fault)
    return [x / length for x in v]

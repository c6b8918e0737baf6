"""Values of other libraries as Python's own."""

from __future__ import annotations

import math
import numbers
import os
from typing import Any, List

from ._errors import UsageError

try:
    import numpy
except ImportError:  # images have memoryviews
    numpy = None  # type: ignore[assignment]


class _NoNumpy:
    def __bool__(self) -> bool:
        return False

    def __getattr__(self, name: str) -> Any:
        raise UsageError("arrays need NumPy, which is not installed")


np: Any = numpy or _NoNumpy()  # false without NumPy

_SHOWN = 16  # values of a list in a message


def plain(value: Any) -> Any:
    """Numbers, texts and lists instead of NumPy's scalars and arrays, tensors and paths.

    Raises ``TypeError`` for a set of numbers.
    """
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    if isinstance(value, (set, frozenset)) and any(isinstance(x, numbers.Number) for x in value):
        raise TypeError(f"numbers in a set have no order: write a list instead of {value}")
    return value


def described(value: Any) -> str:
    """A value in a message: of arrays and long lists, the size."""
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape:
        return f"an array of {' × '.join(map(str, shape))} {getattr(value, 'dtype', '')}".rstrip()
    sizes: List[int] = []
    inner = value
    while isinstance(inner, (list, tuple)) and inner:
        sizes.append(len(inner))
        inner = inner[0]
    if math.prod(sizes) > _SHOWN:
        return f"a list of {' × '.join(map(str, sizes))} values"
    try:
        return f"{value!r:.80}"
    except Exception:  # of a value that another library has emptied, for example
        return f"a {type(value).__module__}.{type(value).__qualname__}"

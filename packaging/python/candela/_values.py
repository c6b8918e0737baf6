"""Values of other libraries as Python's own."""

from __future__ import annotations

import os
from typing import Any


def plain(value: Any) -> Any:
    """Numbers, texts and lists instead of NumPy's scalars and arrays, tensors and paths."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value

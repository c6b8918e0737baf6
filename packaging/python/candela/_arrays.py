"""Meshes and textures from NumPy's arrays: files that last as long as a scene uses them."""

from __future__ import annotations

import hashlib
import os
import struct
import tempfile
import weakref
import zlib
from typing import Any, Dict

from ._image import Image, exr
from ._values import described, np


class ArrayFile:
    """A temporary file of an array, removed with the last scene that names it."""

    def __init__(self, suffix: str, data: bytes, array: Any = None) -> None:
        handle, self.path = tempfile.mkstemp(prefix="candela-", suffix=suffix)
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        self.array = array
        # Equal arrays have equal names where a scene is saved
        self.saved_name = hashlib.blake2b(data, digest_size=8).hexdigest() + suffix
        weakref.finalize(self, _remove, self.path, os.getpid())

    def __fspath__(self) -> str:
        return self.path

    def __deepcopy__(self, memo: Any) -> "ArrayFile":
        return self  # nobody changes it

    def __reduce__(self) -> Any:
        with open(self.path, "rb") as file:
            return ArrayFile, (os.path.splitext(self.path)[1], file.read(), self.array)

    def __repr__(self) -> str:
        return f"<candela array {self.saved_name}>"


def _remove(path: str, process: int) -> None:
    if process == os.getpid():  # a fork's parent may use it
        try:
            os.remove(path)
        except OSError:
            pass


def mesh(vertices: Any, faces: Any, normals: Any = None, texcoords: Any = None) -> Dict[str, Any]:
    """A shape of arrays, as the dict of a ``ply`` file: ``{**candela.mesh(v, f), "bsdf": …}``.

    :param vertices: n × 3
    :param faces: m × 3, indices of vertices from 0 on
    :param normals: n × 3, of the vertices; without them, ``"face_normals": True`` in the dict makes
        faces flat
    :param texcoords: n × 2, u and v of the vertices
    """
    points = _rows("vertices", vertices, 3)
    triangles = _rows("faces", faces, 3, kinds="iu")
    count = len(points)
    if not triangles.size:
        raise ValueError("faces must be n × 3 integers, found none")
    if triangles.min() < 0 or triangles.max() >= count:
        found = f"{triangles.min()} to {triangles.max()}"
        raise ValueError(f"faces need indices from 0 to {count - 1}, found {found}")
    columns, names = [points], ["x", "y", "z"]
    for name, values, parts in (
        ("normals", normals, ["nx", "ny", "nz"]),
        ("texcoords", texcoords, ["u", "v"]),
    ):
        if values is not None:
            columns.append(_rows(name, values, len(parts), count))
            names += parts
    header = "".join(
        [
            f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\n",
            *(f"property float {name}\n" for name in names),
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n",
        ]
    )
    polygons = np.empty(len(triangles), [("count", "u1"), ("indices", "<i4", 3)])
    polygons["count"], polygons["indices"] = 3, triangles
    data = header.encode() + np.hstack(columns).astype("<f4").tobytes() + polygons.tobytes()
    return {"type": "ply", "filename": ArrayFile(".ply", data)}


def _rows(name: str, values: Any, width: int, count: Any = "n", kinds: str = "fiu") -> Any:
    array = np.asarray(values)
    is_right = array.ndim == 2 and array.shape[1] == width and array.dtype.kind in kinds
    if not is_right or count not in ("n", len(array)):
        numbers = "numbers" if "f" in kinds else "integers"
        expected = f"{count} × {width} {numbers}"
        raise ValueError(f"{name} must be {expected}, found {described(values)}")
    odd = np.argwhere(~(np.abs(array) <= np.finfo("f4").max))
    for row, column in odd[:1]:
        raise ValueError(f"{name}[{row}, {column}] must be a finite float32, found {array[row, column]}")
    return array


def texture(values: Any, is_raw: bool = False) -> ArrayFile:
    """An image of a texture: linear floats; of 8 bits, sRGB, unless a ``mitsuba.Bitmap`` says
    otherwise.

    :param is_raw: whether its values are taken as they are
    """
    array = np.array(values)
    if array.size == 0 and type(values).__module__.startswith("drjit"):
        raise ValueError("the tensor is empty (Mitsuba's load_dict takes its values)")
    gamma = getattr(values, "srgb_gamma", None)
    if callable(gamma):
        if array.ndim == 3 and array.shape[2] in (2, 4):
            array = array[..., :-1]  # Mitsuba's textures have no alpha
        is_wide = array.dtype.kind == "u" and array.dtype.itemsize > 1
        if is_wide or array.dtype == np.uint8 and not (gamma() or is_raw):
            array = array / np.float32(np.iinfo(array.dtype).max)
        if array.dtype.kind == "f" and gamma() and not is_raw:
            array = linear(array)
    planes = array[..., None] if array.ndim == 2 else array
    is_bytes = array.dtype == np.uint8
    if not (
        planes.ndim == 3
        and planes.shape[2] in (1, 3)
        and planes.size
        and (is_bytes or array.dtype.kind == "f")
    ):
        expected = "height × width × 3, height × width × 1 or height × width, floats or uint8"
        raise ValueError(f"expected an array of {expected}, found {described(values)}")
    array.flags.writeable = False
    if is_bytes:
        return ArrayFile(".png", _png(planes), array)
    layer = "rgb" if planes.shape[2] == 3 else "Y"
    image = Image({layer: planes}, {}, {layer: [*"RGB"] if layer == "rgb" else ["Y"]})
    return ArrayFile(".exr", exr(image), array)


def grid(values: Any) -> ArrayFile:
    """A volume: a file of Mitsuba's, of the unit cube."""
    array = np.array(values)
    cells = array[..., None] if array.ndim == 3 else array
    if cells.ndim != 4 or cells.shape[3] not in (1, 3) or not cells.size or cells.dtype.kind != "f":
        expected = "depth × height × width, or that × 1 or × 3, floats"
        raise ValueError(f"expected an array of {expected}, found {described(values)}")
    odd = np.argwhere(~(np.abs(cells) <= np.finfo("f4").max))
    for place in odd[:1].tolist():
        found = cells[tuple(place)]
        raise ValueError(f"value {place} must be a finite float32, found {found}")
    array.flags.writeable = False
    depth, height, width, channels = cells.shape
    header = struct.pack("<3sBiiiii6f", b"VOL", 3, 1, width, height, depth, channels, *[0] * 3, *[1] * 3)
    return ArrayFile(".vol", header + cells.astype("<f4").tobytes(), array)


def linear(encoded: Any) -> Any:
    """Source: IEC 61966-2-1, sRGB."""
    toe, curve = encoded / 12.92, ((np.maximum(encoded, 0) + 0.055) / 1.055) ** 2.4
    return np.where(encoded <= 0.04045, toe, curve)


def _png(planes: Any) -> bytes:
    """Source: W3C, "Portable Network Graphics (PNG) Specification"."""
    height, width, channels = planes.shape
    rows = np.zeros((height, 1 + width * channels), "u1")  # each begins with filter 0
    rows[:, 1:] = planes.reshape(height, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    color_type = 0 if channels == 1 else 2
    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    pixels = zlib.compress(rows.tobytes(), 1)
    start = b"\x89PNG\r\n\x1a\n"
    return start + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")

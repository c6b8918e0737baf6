"""Images: the program's ``.npz`` files."""

from __future__ import annotations

import ast
import difflib
import json
import os
import re
import struct
import tempfile
import zipfile
from array import array
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple, Union

from ._errors import CandelaError, missing, warn
from ._values import described, np

PathLike = Union[str, "os.PathLike[str]"]


class Image:
    """A rendered image: linear light, rows from the top.

    ``layers`` has an array for each layer: ``rgb`` of height × width × 3, ``alpha`` of
    height × width, and the others by the names of their channels, such as ``Albedo`` and ``Z``.
    With ``denoise=True``, ``rgb`` is noisy, and ``Denoised`` is what pictures show.
    ``channels`` names the channels of each. ``metadata`` tells scene, seed and samples. ``window``
    is the place of a crop in the whole image: x, y, and the whole's width and height.

    Arrays are NumPy's, of float32; without NumPy, they are memoryviews: ``image.rgb[y, x, 0]``.
    ``Image(array)`` is one of height × width × 3, or × 4 with premultiplied alpha; a dict is that
    of its layers.
    """

    def __init__(
        self,
        layers: Any,
        metadata: Optional[Dict[str, str]] = None,
        channels: Optional[Dict[str, List[str]]] = None,
        window: Optional[Tuple[int, int, int, int]] = None,
    ) -> None:
        self.layers: Dict[str, Any] = layers if isinstance(layers, dict) else _layers(layers)
        self.metadata = metadata or {}
        self.channels = _channels(self.layers, channels or {})
        self.window = window

    @property
    def rgb(self) -> Any:
        """Red, green and blue, in float32; of a film in luminance or X, Y and Z, converted."""
        if "rgb" not in self.layers and "Y" not in self.layers:
            raise AttributeError(f"the image has no colours: its layers are {', '.join(self.layers)}")
        if "rgb" in self.layers or not np:
            return self["rgb"]
        if "X" in self.layers and "Z" in self.layers:
            xyz = np.dstack([self.layers[name] for name in "XYZ"])
            return (xyz @ np.array(_SRGB_OF_XYZ).T).astype("f4")
        return np.dstack([self.layers["Y"]] * 3)

    @rgb.setter
    def rgb(self, values: Any) -> None:
        layers = _layers(values)
        if layers["rgb"].shape != self.shape or "alpha" in layers:
            expected = " × ".join(map(str, self.shape))
            raise ValueError(f"the image needs an array of {expected}, found {described(values)}")
        self.layers["rgb"] = layers["rgb"]
        self.layers.pop("Denoised", None)  # pictures would show it

    @property
    def shape(self) -> Tuple[int, int, int]:
        """Of ``rgb``: height, width and 3."""
        return self.height, self.width, 3

    @property
    def alpha(self) -> Optional[Any]:
        """The opacity of each pixel, if the film has it."""
        return self.layers.get("alpha")

    @property
    def height(self) -> int:
        return int(self._any().shape[0])

    @property
    def width(self) -> int:
        return int(self._any().shape[1])

    def _any(self) -> Any:
        return next(iter(self.layers.values()))

    def __getitem__(self, name: Any) -> Any:
        """Values of ``rgb`` by their indices: ``image[:, :, 0]``; or a layer by its name, in upper or
        lower case, or by the name that ``aov`` gives it: ``depth`` is ``Z``, as in EXR files. What
        files have as several layers is one array, with their channels one after the other: ``uv``
        is ``u`` and ``v``.
        """
        if not isinstance(name, str):
            return np.asarray(self)[name]
        names = self._named(name)
        if not names:
            known = {*self.layers, *(word for word in _WORDS if self._named(word))}
            near = difflib.get_close_matches(name.lower(), [word.lower() for word in known], 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise KeyError(f"{name}: the layers are {', '.join(self.layers)}{hint}")
        return self.layers[names[0]] if len(names) == 1 else _joined(self, names)

    def __contains__(self, name: str) -> bool:
        return bool(self._named(name))

    def _named(self, name: str) -> List[str]:
        """The layers that a name stands for."""
        word = name.lower()
        exact = [layer for layer in self.layers if layer.lower() == word]
        pattern = re.compile(_WORDS.get(word, "(?!)"))
        return exact or [layer for layer in self.layers if pattern.fullmatch(layer)]

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> Any:
        values = np.asarray(self.rgb)
        values = values if dtype is None else values.astype(dtype)
        return values.copy() if copy else values

    def __add__(self, other: Any) -> Any:
        """The sum of ``rgb`` and numbers or another image, as an array; so are the others."""
        return np.asarray(self) + other

    def __sub__(self, other: Any) -> Any:
        return np.asarray(self) - other

    def __rsub__(self, other: Any) -> Any:
        return other - np.asarray(self)

    def __mul__(self, other: Any) -> Any:
        return np.asarray(self) * other

    def __truediv__(self, other: Any) -> Any:
        return np.asarray(self) / other

    def __rtruediv__(self, other: Any) -> Any:
        return other / np.asarray(self)

    def __pow__(self, other: Any) -> Any:
        return np.asarray(self) ** other

    def __neg__(self) -> Any:
        return -np.asarray(self)

    def __eq__(self, other: Any) -> Any:
        """Of each value, as NumPy's; so are the others."""
        return np.asarray(self) == other

    def __ne__(self, other: Any) -> Any:
        return np.asarray(self) != other

    def __lt__(self, other: Any) -> Any:
        return np.asarray(self) < other

    def __gt__(self, other: Any) -> Any:
        return np.asarray(self) > other

    __radd__, __rmul__, __hash__ = __add__, __mul__, object.__hash__

    def mean(self, *axis: Any, **options: Any) -> Any:
        """Of ``rgb``, as NumPy's."""
        return np.asarray(self).mean(*axis, **options)

    def save(self, path: PathLike) -> None:
        """Writes a file in the format of its name, as ``candela image`` does: ``.exr`` and ``.npz``
        with all layers in 32-bit floats, ``.png``, ``.jpg``, ``.qoi`` and ``.tga`` as shown on a screen, ``.pfm``.
        """
        from ._session import execute

        target = _word(path)
        if target.lower().endswith(".npz"):
            try:
                _write_npz(self, target)
            except FileNotFoundError:
                raise missing(target) from None
            return
        with tempfile.TemporaryDirectory(prefix="candela-") as folder:
            source = Path(folder) / "image.exr"
            source.write_bytes(exr(self))
            try:
                warn(execute(["image", str(source), "--outfile", target])[1])
            except CandelaError as e:
                raise e.renamed(str(source), "the image") from None

    def _repr_png_(self) -> Optional[bytes]:
        """The picture that notebooks show, if there are colours."""
        if not hasattr(self, "rgb"):
            return None
        with tempfile.TemporaryDirectory(prefix="candela-") as folder:
            picture = Path(folder) / "image.png"
            self.save(picture)
            return picture.read_bytes()

    def __repr__(self) -> str:
        return f"<candela.Image {self.width}x{self.height}: {', '.join(self.layers)}>"


def _layers(values: Any) -> Dict[str, Any]:
    """Those of an array."""
    array = np.asarray(values)
    if array.ndim != 3 or array.shape[2] not in (3, 4) or array.dtype.kind != "f":
        expected = "height × width × 3 or height × width × 4, floats of linear light"
        raise ValueError(f"an image needs an array of {expected}, found {described(values)}")
    copy = np.array(array, "f4")
    return {"rgb": copy} if copy.shape[2] == 3 else {"rgb": copy[..., :3], "alpha": copy[..., 3]}


_FIXED = {"rgb": [*"RGB"], "alpha": ["A"]}


def _channels(layers: Dict[str, Any], known: Dict[str, List[str]]) -> Dict[str, List[str]]:
    """The names of each layer's channels, by OpenEXR's convention unless they are known."""
    if not layers:
        raise ValueError("an image needs at least one layer")
    size = tuple(getattr(next(iter(layers.values())), "shape", ()))[:2]
    sides = " × ".join(map(str, size if len(size) == 2 and all(size) else ("height", "width")))
    found = {}
    for name, values in layers.items():
        if not isinstance(name, str) or name in ["", *"RGBA"] or "\0" in name:
            raise ValueError(f"a layer needs a name, other than R, G, B and A, found {name!r}")
        shape = tuple(getattr(values, "shape", ()))
        names = known.get(name, _FIXED.get(name, []))
        count = (*shape, 1)[2] if len(shape) in (2, 3) else 0
        is_known = len(names) == count or name not in _FIXED
        is_number = getattr(getattr(values, "dtype", None), "kind", "f") in "fiub"
        if shape[:2] != size or not all(shape) or not count or not is_known or not is_number:
            own = {"rgb": f"{sides} × 3", "alpha": sides}
            expected = own.get(name, f"{sides} or {sides} × channels")
            given = described(values)
            raise ValueError(f"the layer {name!r} needs numbers of {expected}, found {given}")
        found[name] = names if len(names) == count else _default_channels(name, count)
    return found


def _default_channels(name: str, count: int) -> List[str]:
    if count == 1:
        return [f"{name}.Y" if "." in name else name]  # what is before the last dot is the layer
    digits = len(str(count - 1))  # they are sorted as texts
    suffixes = "RGBA"[:count] if count in (3, 4) else [f"{i:0{digits}}" for i in range(count)]
    return [f"{name}.{suffix}" for suffix in suffixes]


# Source: IEC 61966-2-1, sRGB
_SRGB_OF_XYZ = [
    [3.2404542, -1.5371385, -0.4985314],
    [-0.9692660, 1.8760108, 0.0415560],
    [0.0556434, -0.2040259, 1.0572252],
]

# Layers by the names that the option gives them, where those of files are others
_WORDS = {
    "depth": "Z",
    "normal": "N",
    "shadingnormal": "Ns",
    "position": "P",
    "uv": "[uv]",
    "gradient": "dzd[xy]",
    "lights": "Combined_.*",
    "cryptoobject": r"CryptoObject\d+",
    "cryptomaterial": r"CryptoMaterial\d+",
}


def _joined(image: Image, names: List[str]) -> Any:
    """An array of the channels of several layers, one after the other."""
    if np:
        return np.dstack([image.layers[name] for name in names])
    planes: List["array[float]"] = []
    channels = _channels(image.layers, image.channels)
    for name in names:
        flat, count = _flat(image.layers[name]), len(channels[name])
        planes += [flat[i::count] for i in range(count)]
    values = array("f", (x for pixel in zip(*planes) for x in pixel))
    shape = [image.height, image.width, len(planes)]
    return memoryview(values).cast("B").cast("f", shape=shape)


def _word(path: PathLike) -> str:
    """The name of a file, which is no option."""
    name = os.fspath(path)
    return os.path.join(".", name) if name.startswith("-") else name


def load(path: PathLike) -> Image:
    """Reads an image file: ``.npz`` and all that ``candela image`` reads, such as ``.exr``; or the
    image of a film, ``.film``.
    """
    source = _word(path)
    if not os.path.exists(source):
        raise missing(source)
    if not source.lower().endswith(".npz"):
        from ._session import execute

        with tempfile.TemporaryDirectory(prefix="candela-") as folder:
            arrays = Path(folder) / "image.npz"
            command = "merge" if source.lower().endswith(".film") else "image"
            warn(execute([command, source, "--outfile", str(arrays)])[1])
            return load(arrays)
    try:
        with zipfile.ZipFile(source) as archive:
            if "metadata.json" not in archive.namelist():
                advice = "candela.Image(array) makes an image of an array of numpy.load"
                raise CandelaError(f"{source} is no image of `Image.save`: {advice}")
            about = json.loads(archive.read("metadata.json"))
            layers = {
                name[: -len(".npy")]: _array(archive.read(name))
                for name in archive.namelist()
                if name.endswith(".npy")
            }
    except (zipfile.BadZipFile, OSError) as e:
        raise CandelaError(f"can't read {source}: {e}") from e
    window = tuple(about["window"]) if "window" in about else None
    return Image(layers, about["texts"], about["channels"], window)


# Source: NumPy reference, "numpy.lib.format", version 1.0
_NPY = b"\x93NUMPY\x01\x00"


def _array(data: bytes) -> Any:
    (length,) = struct.unpack_from("<H", data, len(_NPY))
    start = len(_NPY) + 2
    shape = ast.literal_eval(data[start : start + length].decode("latin-1").strip())["shape"]
    values = bytearray(data[start + length :])  # which may be written to
    if np:
        return np.frombuffer(values, "<f4").reshape(shape)
    return memoryview(values).cast("f", shape=list(shape))


def _write_npz(image: Image, path: str) -> None:
    channels = _channels(image.layers, image.channels)
    about: Dict[str, Any] = {"channels": channels, "texts": image.metadata}
    if image.window is not None:
        about["window"] = list(image.window)
    with zipfile.ZipFile(path, "w") as archive:
        for name, values in image.layers.items():
            text = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {tuple(values.shape)}, }}"
            length = -(-(len(text) + 11) // 64) * 64 - 10
            header = _NPY + struct.pack("<H", length) + text.ljust(length - 1).encode() + b"\n"
            data = header + _flat(values).tobytes()
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), data)  # of no time
        archive.writestr(zipfile.ZipInfo("metadata.json"), json.dumps(about))


def _flat(values: Any) -> "array[float]":
    """All values, one after the other."""
    data = array("f")
    contiguous = np.ascontiguousarray(values, "<f4") if np else values
    data.frombytes(contiguous.tobytes())
    return data


def exr(image: Image) -> bytes:
    """A file of 32-bit floats, not packed. Source: OpenEXR, "OpenEXR File Layout"."""
    width, height = image.width, image.height
    planes: Dict[bytes, "array[float]"] = {}
    for layer, names in _channels(image.layers, image.channels).items():
        flat = _flat(image.layers[layer])
        for i, name in enumerate(names):
            planes[name.encode()] = flat[i :: len(names)]
    channel_names = sorted(planes)
    has_long_names = 0x400 * any(len(n) > 31 for n in [*channel_names, *image.metadata])
    x, y, whole_width, whole_height = image.window or (0, 0, width, height)

    def attribute(name: str, kind: str, data: bytes) -> bytes:
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data

    channels = b"".join(n + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for n in channel_names) + b"\0"
    data = struct.pack("<iiii", x, y, x + width - 1, y + height - 1)
    display = struct.pack("<iiii", 0, 0, whole_width - 1, whole_height - 1)
    header = b"".join(
        [
            struct.pack("<ii", 20000630, 2 | has_long_names),
            attribute("channels", "chlist", channels),
            attribute("compression", "compression", b"\0"),
            attribute("dataWindow", "box2i", data),
            attribute("displayWindow", "box2i", display),
            attribute("lineOrder", "lineOrder", b"\0"),
            attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
            attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
            attribute("screenWindowWidth", "float", struct.pack("<f", 1)),
            *(attribute(n, "string", text.encode()) for n, text in sorted(image.metadata.items())),
            b"\0",
        ]
    )
    size = 4 * width * len(channel_names)
    first = len(header) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + row * (8 + size) for row in range(height)))
    rows = [
        struct.pack("<ii", y + row, size)
        + b"".join(planes[n][row * width : (row + 1) * width].tobytes() for n in channel_names)
        for row in range(height)
    ]
    return header + offsets + b"".join(rows)

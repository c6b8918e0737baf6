"""Images: the program's ``.npz`` files."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np


class Image:
    """A rendered image: linear light, rows from the top.

    ``layers`` has an array for each layer: ``rgb`` of height × width × 3, ``alpha`` of
    height × width, and the others by the names of their channels, such as ``Albedo`` and ``Z``.
    ``channels`` names the channels of each. ``metadata`` tells scene, seed and samples. ``window``
    is the place of a crop in the whole image: x, y, and the whole's width and height.
    """

    def __init__(
        self,
        layers: Dict[str, np.ndarray],
        metadata: Dict[str, str],
        channels: Dict[str, List[str]],
        window: Optional[Tuple[int, int, int, int]] = None,
    ) -> None:
        self.layers = layers
        self.metadata = metadata
        self.channels = channels
        self.window = window

    @property
    def rgb(self) -> np.ndarray:
        """Red, green and blue, in float32."""
        return self["rgb"]

    @property
    def alpha(self) -> Optional[np.ndarray]:
        """The opacity of each pixel, if the film has it."""
        return self.layers.get("alpha")

    @property
    def height(self) -> int:
        return int(self._any().shape[0])

    @property
    def width(self) -> int:
        return int(self._any().shape[1])

    def _any(self) -> np.ndarray:
        return next(iter(self.layers.values()))

    def __getitem__(self, name: str) -> np.ndarray:
        """A layer by its name, in upper or lower case; ``depth`` is ``Z``, as in EXR files."""
        wanted = _ALIASES.get(name.lower(), name.lower())
        for layer, array in self.layers.items():
            if layer.lower() == wanted:
                return array
        raise KeyError(f"{name}: the layers are {', '.join(self.layers)}")

    def __contains__(self, name: str) -> bool:
        wanted = _ALIASES.get(name.lower(), name.lower())
        return any(layer.lower() == wanted for layer in self.layers)

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        array = self.rgb if dtype is None else self.rgb.astype(dtype)
        return array.copy() if copy else array

    def __repr__(self) -> str:
        return f"<candela.Image {self.width}x{self.height}: {', '.join(self.layers)}>"


_ALIASES = {"depth": "z", "normal": "n", "shadingnormal": "ns", "position": "p"}


def load(path: Union[str, "os.PathLike[str]"]) -> Image:
    """Reads an image that the program has written as ``.npz``."""
    with np.load(path, allow_pickle=False) as archive:
        about = json.loads(archive["metadata.json"])
        layers = {name: archive[name] for name in archive.files if name != "metadata.json"}
    window = tuple(about["window"]) if "window" in about else None
    return Image(layers, about["texts"], about["channels"], window)

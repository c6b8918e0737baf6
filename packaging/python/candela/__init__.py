"""Candela, a physically based renderer for pbrt and Mitsuba scenes.

>>> import candela
>>> image = candela.render("scene.pbrt", spp=64, aov=["albedo", "depth"])
>>> image.rgb.shape
(720, 1280, 3)
>>> image["albedo"].mean()
0.42

The module runs the program ``candela``, which is part of the package, and returns what it
rendered as NumPy arrays. All options of ``candela help render`` are arguments.
"""

from ._errors import (
    CandelaError,
    CandelaWarning,
    InternalError,
    Problem,
    SceneError,
    UsageError,
)
from ._image import Image, load
from ._program import Progress, program, run
from ._render import check, render, version

__all__ = [
    "CandelaError",
    "CandelaWarning",
    "Image",
    "InternalError",
    "Problem",
    "Progress",
    "SceneError",
    "UsageError",
    "check",
    "load",
    "program",
    "render",
    "run",
    "version",
]

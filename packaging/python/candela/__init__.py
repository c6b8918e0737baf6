"""Candela, a physically based renderer for pbrt and Mitsuba scenes.

>>> import candela
>>> image = candela.render("scene.pbrt", spp=64, aov=["albedo", "depth"])
>>> image.rgb.shape
(720, 1280, 3)
>>> image["albedo"].mean()
0.42

Scenes may also be made in Python, changed, and rendered again:

>>> scene = candela.load_dict({"type": "scene", "ball": {"type": "sphere", "radius": 1}, ...})
>>> scene.parameters()["ball.radius"] = 2
>>> scene.render(spp=64)

The program ``candela``, which is part of the package, renders in a process that stays until Python
ends. Images are NumPy arrays if NumPy is installed. All options of ``candela help render`` are
arguments.
"""

from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as _version_of

from ._arrays import mesh
from ._errors import (
    CandelaError,
    CandelaWarning,
    InternalError,
    MissingFileError,
    Problem,
    SceneError,
    UsageError,
)
from ._image import Image, load
from ._parameters import Parameters
from ._render import check, render, version
from ._scene import Scene, load_dict, load_file, load_string, traverse
from ._session import Progress, close, program, run
from ._transform import Transform

try:
    __version__ = _version_of("candela-renderer")
except PackageNotFoundError:  # a folder on the path, not the wheel
    __version__ = "0.dev0"

__all__ = [
    "CandelaError",
    "CandelaWarning",
    "Image",
    "InternalError",
    "MissingFileError",
    "Parameters",
    "Problem",
    "Progress",
    "Scene",
    "SceneError",
    "Transform",
    "UsageError",
    "check",
    "close",
    "load",
    "load_dict",
    "load_file",
    "load_string",
    "mesh",
    "program",
    "render",
    "run",
    "traverse",
    "version",
]

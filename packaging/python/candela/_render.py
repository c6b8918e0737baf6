"""Rendering and checking of scenes."""

from __future__ import annotations

import os
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Dict, Iterable, List, Optional, Union

from ._errors import CandelaWarning, Problem, SceneError, UsageError
from ._image import Image, load
from ._scene import Scene, load_file
from ._session import Listener, execute

PathLike = Union[str, "os.PathLike[str]"]
Plain = Union[str, int, float]
Value = Union[Plain, bool, None, Iterable[Plain], Dict[str, Plain]]

# What names no option of a rendering that returns one image
_OTHERS = {
    "checkpoint", "shard", "watch_after", "debug", "skip_done", "frames", "help", "pixelmaterial",
    "spark",
}


def render(
    scene: Union[PathLike, Scene],
    *,
    spp: Optional[int] = None,
    aov: Iterable[str] = (),
    outfile: Union[None, PathLike, Iterable[PathLike]] = None,
    progress: Optional[Listener] = None,
    **options: Value,
) -> Image:
    """Renders a scene and returns the image.

    :param scene: a file in pbrt's or Mitsuba's format, or a ``Scene``
    :param spp: samples per pixel, instead of the scene's
    :param aov: layers beside the colours, such as ``"albedo"``, ``"normal"``, ``"depth"``
    :param outfile: image files to write, too, such as ``"x.exr"``
    :param progress: is called several times a second with a ``Progress``; an exception from it
        ends the rendering
    :param options: all other options of ``candela help render``, with ``_`` for ``-``:
        ``seed=1``, ``time="90s"``, ``denoise=True``, ``cropwindow=(0, 0.5, 0, 0.5)``,
        ``define={"name": 3}`` for ``$name`` in the scene

    Errors are exceptions: ``SceneError`` with the place in the scene, ``UsageError`` for
    options. Warnings are Python's, of the class ``CandelaWarning``. ``KeyboardInterrupt`` ends
    the rendering.
    """
    for name in sorted(_OTHERS.intersection(options)):
        raise UsageError(f"`{name}` does not go with `render`; candela.run takes any option")
    with tempfile.TemporaryDirectory(prefix="candela-") as folder:
        file = Path(folder) / "image.npz"
        name, text, keys = _scene(scene).source()
        words = ["render", name]
        for path in [file, *_paths(outfile)]:
            words += ["--outfile", os.fspath(path)]
        for layer in [aov] if isinstance(aov, str) else aov:
            words += ["--aov", layer]
        words += _words({"spp": spp, **options})
        _, problems = execute(words, None if text is None else (name, text), keys, progress)
        _warn(problems)
        return load(file)


def check(scene: Union[PathLike, Scene], **options: Value) -> List[Problem]:
    """Parses and builds a scene without rendering it, and returns its errors and warnings."""
    name, text, keys = _scene(scene).source()
    try:
        given = None if text is None else (name, text)
        return execute(["check", name, *_words(options)], given, keys)[1]
    except SceneError as error:
        return list(error.problems)


def version() -> str:
    """What ``candela --version`` prints: version, commit, Java and kernels."""
    return execute(["--version"])[0].rstrip("\n")


def _scene(scene: Union[PathLike, Scene]) -> Scene:
    return scene if isinstance(scene, Scene) else load_file(scene)


def _paths(outfile: Union[None, PathLike, Iterable[PathLike]]) -> List[PathLike]:
    if outfile is None:
        return []
    if isinstance(outfile, (str, os.PathLike)):
        return [outfile]
    return list(outfile)


def _words(options: "dict[str, Value]") -> List[str]:
    words: List[str] = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is None or value is False:
            continue
        elif isinstance(value, (str, int, float)):
            words.append(f"{option}={value}")
        elif isinstance(value, dict):
            words += [f"{option}={key}={each}" for key, each in value.items()]
        else:
            words.append(f"{option}={','.join(str(v) for v in value)}")
    return words


def _user_frame() -> int:
    """How far above ``_warn`` the call is that is not of this package."""
    frame, level = sys._getframe(2), 2
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        frame, level = frame.f_back, level + 1
    return level


def _warn(problems: List[Problem]) -> None:
    for problem in problems:
        if problem.severity == "warning":
            warnings.warn(problem.text, CandelaWarning, stacklevel=_user_frame())

"""Rendering and checking of scenes."""

from __future__ import annotations

import os
import tempfile
import warnings
from pathlib import Path
from typing import Iterable, List, Optional, Union

from ._errors import CandelaWarning, Problem, SceneError, UsageError, problems_in
from ._image import Image, load
from ._program import Listener, execute

PathLike = Union[str, "os.PathLike[str]"]
Value = Union[str, int, float, bool, None, Iterable[Union[str, int, float]]]

# What names no option of a rendering that returns one image
_OTHERS = {
    "checkpoint", "shard", "watch_after", "debug", "skip_done", "frames", "help", "pixelmaterial"
}


def render(
    scene: PathLike,
    *,
    spp: Optional[int] = None,
    aov: Iterable[str] = (),
    outfile: Union[None, PathLike, Iterable[PathLike]] = None,
    progress: Optional[Listener] = None,
    **options: Value,
) -> Image:
    """Renders a scene and returns the image.

    :param scene: a file in pbrt's or Mitsuba's format
    :param spp: samples per pixel, instead of the scene's
    :param aov: layers beside the colours, such as ``"albedo"``, ``"normal"``, ``"depth"``
    :param outfile: image files to write, too, such as ``"x.exr"``
    :param progress: is called several times a second with a ``Progress``; an exception from it
        ends the rendering
    :param options: all other options of ``candela help render``, with ``_`` for ``-``:
        ``seed=1``, ``time="90s"``, ``denoise=True``, ``cropwindow=(0, 0.5, 0, 0.5)``

    Errors are exceptions: ``SceneError`` with the place in the scene, ``UsageError`` for
    options. Warnings are Python's, of the class ``CandelaWarning``. ``KeyboardInterrupt`` ends
    the rendering.
    """
    for name in sorted(_OTHERS.intersection(options)):
        raise UsageError(f"`{name}` does not go with `render`; candela.run takes any option")
    with tempfile.TemporaryDirectory(prefix="candela-") as folder:
        file = Path(folder) / "image.npz"
        words = [os.fspath(scene)]
        for path in [file, *_paths(outfile)]:
            words += ["--outfile", os.fspath(path)]
        for layer in [aov] if isinstance(aov, str) else aov:
            words += ["--aov", layer]
        _, messages = execute([*words, *_words({"spp": spp, **options})], progress)
        _warn(problems_in(messages))
        return load(file)


def check(scene: PathLike, **options: Value) -> List[Problem]:
    """Parses and builds a scene without rendering it, and returns its errors and warnings."""
    try:
        _, messages = execute(["check", os.fspath(scene), *_words(options)])
    except SceneError as error:
        return list(error.problems)
    return problems_in(messages)


def version() -> str:
    """What ``candela --version`` prints: version, commit, Java and kernels."""
    return execute(["--version"])[0].rstrip("\n")


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
        else:
            words.append(f"{option}={','.join(str(v) for v in value)}")
    return words


def _warn(problems: List[Problem]) -> None:
    for problem in problems:
        if problem.severity == "warning":
            warnings.warn(problem.text, CandelaWarning, stacklevel=3)

"""Rendering and checking of scenes."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from typing import Any, Dict, Iterable, List, Optional, Tuple, Union

from ._errors import Problem, SceneError, UsageError, in_python, warn
from ._image import Image, load
from ._scene import Scene, scene_of
from ._session import Listener, execute
from ._values import described, plain

PathLike = Union[str, "os.PathLike[str]"]
Plain = Union[str, int, float, "os.PathLike[str]"]
Value = Union[Plain, bool, None, Iterable[Plain], Dict[str, Plain], Any]  # and those of NumPy

# What names no option of a rendering that returns one image
_OTHERS = {
    "checkpoint", "shard", "watch_after", "debug", "skip_done", "frames", "help", "pixelmaterial",
    "spark", "thumbnail", "sample", "turntable",
}
_INSTEAD = {
    "checkpoint": "outfile='x.film' saves the rendering",
    "thumbnail": "notebooks show the image",
    "sample": "spp is the number of samples",
}
_REPEATED = ("aov", "define", "outfile")


def render(
    scene: Union[PathLike, Scene, Dict[str, Any]],
    *,
    spp: Optional[int] = None,
    aov: Iterable[str] = (),
    outfile: Union[None, PathLike, Iterable[PathLike]] = None,
    progress: Optional[Listener] = None,
    **options: Value,
) -> Image:
    """Renders a scene and returns the image.

    :param scene: a file in pbrt's or Mitsuba's format, a ``Scene``, or a dict of ``load_dict``
    :param spp: samples per pixel, instead of the scene's
    :param aov: layers beside the colours, such as ``"albedo"``, ``"normal"``, ``"depth"``
    :param outfile: image files to write, too, such as ``"x.exr"``
    :param progress: is called several times a second with a ``Progress``; an exception from it
        ends the rendering
    :param options: all other options of ``candela help render``, with ``_`` for ``-``:
        ``seed=1``, ``time="90s"``, ``denoise=True``, ``cropwindow=(0, 0.5, 0, 0.5)``,
        ``define={"name": 3}`` for ``$name`` in the scene, ``sensor=1`` for its second sensor

    Errors are exceptions: ``SceneError`` with the place in the scene, ``UsageError`` for
    options. Warnings are Python's, of the class ``CandelaWarning``. ``KeyboardInterrupt`` ends
    the rendering.
    """
    is_file = not isinstance(scene, (Scene, dict))
    saving = "" if is_file else ", of a file: scene.save('scene.xml') writes it"
    for name in sorted(_OTHERS.intersection(options)):
        instead = _INSTEAD.get(name, "candela.run takes any option" + saving)
        raise UsageError(f"`{name}` does not go with `render`; {instead}")
    if options.get("sensor") == "all":
        raise UsageError(
            "`render` returns one image: call it with sensor=0, sensor=1, …; or "
            "candela.run(\"render\", file, \"--sensor\", \"all\") writes a file of each"
        )
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function of a Progress, found {described(progress)}")
    with tempfile.TemporaryDirectory(prefix="candela-") as folder:
        file = Path(folder) / "image.npz"
        loaded = scene_of(scene)  # whose files of arrays last as long as it
        if loaded.has_arrays and any(
            os.fspath(x).lower().endswith(".film") for x in _items(outfile)
        ):
            raise UsageError(
                "a film names the files of its scene, and those of arrays are temporary: "
                "scene.save('scene.xml') writes them; then render that file"
            )
        files = {"outfile": [file, *_items(outfile)], "aov": aov, "spp": spp}
        _, problems = _execute("render", loaded, {**files, **options}, progress, file)
        warn(problems)
        return load(file)


def check(scene: Union[PathLike, Scene, Dict[str, Any]], **options: Value) -> List[Problem]:
    """Parses and builds a scene without rendering it, and returns its errors and warnings."""
    try:
        printed, problems = _execute("check", scene_of(scene), options)
    except SceneError as error:
        return list(error.problems)
    if options.get("explain") or options.get("verbose"):
        print(in_python(printed), end="", file=sys.stderr)
    return problems


def version() -> str:
    """What ``candela --version`` prints: version, commit, Java and kernels."""
    return execute(["--version"])[0].rstrip("\n")


def checked(scene: Scene) -> None:
    """Raises the scene's errors."""
    _execute("check", scene, {})


def _execute(
    command: str, scene: Scene, options: Dict[str, Value], *how: Any
) -> Tuple[str, List[Problem]]:
    """What a command prints, and the warnings of the scene."""
    name, text, keys = scene.source()
    given = None if text is None else (name, text)
    printed, problems = execute([command, name, *_words(options)], given, keys, *how)
    return printed, scene.range_warnings() + problems


def _words(options: "dict[str, Value]") -> List[str]:
    words: List[str] = []
    for name, given in options.items():
        option = "--" + name.replace("_", "-")
        value = plain(given)
        if value is True:
            words.append(option)
        elif value is None or value is False:
            continue
        elif isinstance(value, dict):
            pairs = [f"{key}={','.join(map(_word, _items(plain(each))))}" for key, each in value.items()]
            words += [f"{option}={x}" for x in (pairs if name in _REPEATED else [",".join(pairs)])]
        else:
            try:
                items = [_word(item) for item in _items(value)]
            except TypeError:
                message = f"{name} can't be {described(given)}: expected a number, a text or a list"
                raise UsageError(message) from None
            words += [f"{option}={x}" for x in (items if name in _REPEATED else [",".join(items)])]
    return words


def _items(value: Any) -> List[Any]:
    """Those of a list; a value itself."""
    if value is None:
        return []
    return [value] if isinstance(value, (str, int, float, os.PathLike)) else list(value)


def _word(value: Any) -> str:
    value = plain(value)
    if isinstance(value, float) and value.is_integer():
        return str(int(value))  # what counts may come of a computation
    return str(value).lower() if isinstance(value, bool) else str(value)

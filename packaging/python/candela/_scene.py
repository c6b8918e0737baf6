"""Scenes that stay in Python: from a text, a dict or a file, changed and rendered again."""

from __future__ import annotations

import os
import re
import shutil
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple, Union
from xml.etree.ElementTree import Element, ParseError

from . import _files, _xml
from ._errors import CandelaError, Keys, Problem, SceneError, UsageError, missing
from ._parameters import Parameters
from ._values import described

if TYPE_CHECKING:
    from ._image import Image

PathLike = Union[str, "os.PathLike[str]"]


def _is_text(name: str) -> bool:
    """Whether it is that of a scene, and no name of a file."""
    return "\n" in name or name.lstrip().startswith("<")


def _missing(path: str) -> CandelaError:
    if _is_text(path):
        return UsageError("that is the text of a scene, and no file: candela.load_string reads it")
    return missing(path, "scene file", "E0101")


class Scene:
    """A scene, of ``load_dict``, ``load_string`` or ``load_file``.

    ``parameters()`` has its values, which may be changed; ``render`` and ``check`` take the options
    of ``candela.render`` and ``candela.check``.
    """

    def __init__(self, name: str, text: Optional[str], tree: Optional[Element] = None) -> None:
        self._given = name  # the file, or the name in messages
        self._start = os.getcwd()  # the folder that relative names are of
        self._text = text  # None: that of the file, or of the tree
        self._tree = tree
        self._of_dict = tree is not None
        self._parameters: Optional[Parameters] = None

    @property
    def _name(self) -> str:
        """A name for the program, which is in the current folder."""
        if os.getcwd() == self._start:
            given = self._given
            return os.path.join(".", given) if given.startswith("-") else given
        return os.path.join(self._start, self._given)

    @property
    def is_mitsuba(self) -> bool:
        """Whether it has Mitsuba's format; otherwise it has pbrt's."""
        return self._of_dict or self._name.lower().endswith((".xml", ".xml.gz"))

    @property
    def has_arrays(self) -> bool:
        return bool(_xml.arrays(self._tree))

    def range_warnings(self) -> List[Problem]:
        return [] if self._tree is None else _xml.range_warnings(self._tree)

    def source(self) -> Tuple[str, Optional[str], Optional[Keys]]:
        """The name, the text unless it is a file, and the keys of its lines if it is a dict's."""
        if self._of_dict and self._tree is not None:
            text, keys = _xml.in_lines(self._tree)
            return self._name, text, keys
        return self._name, self._text, None

    def parameters(self) -> Parameters:
        """The values of the scene by their names; see ``candela.traverse``."""
        if not self.is_mitsuba:
            is_pbrt = self._name.lower().endswith((".pbrt", ".pbrt.gz"))
            raise UsageError(
                "scenes of pbrt's format have no parameters: write $name in the text, and give its "
                "value to render, as define={'name': 3}"
                if is_pbrt
                else f"`{self._name}` has no parameters: Mitsuba's XML files and dicts have them"
            )
        if self._tree is None:
            try:
                self._tree = _xml.of_text(self._whole())
            except ParseError as e:
                self._refuse()
                line, column = e.position  # what the program reads, Python doesn't
                message = f"{self._name}:{line}:{column + 1}: error: {e.msg}"
                fault = Problem("error", str(e.msg), message, self._name, line, column + 1)
                raise SceneError(message, (fault,)) from None
        self._parameters = self._parameters or Parameters(self._tree, self._changed)
        return self._parameters

    def _whole(self) -> str:
        if self._text is not None:
            return self._text
        if self._name.lower().endswith(".gz"):
            raise UsageError(f"{self._name} is packed: unpack it first")
        try:
            with open(self._name, encoding="utf-8") as file:
                return file.read()
        except FileNotFoundError:
            raise _missing(self._name) from None
        except UnicodeDecodeError:
            raise UsageError(f"{self._name} is no text in UTF-8") from None

    def _refuse(self) -> None:
        """Raises the program's error, if it finds one."""
        from ._render import checked

        checked(self)

    def read(self) -> None:
        """Reads the file, if it is Mitsuba's; a folder and a picture are no scenes."""
        if not os.path.exists(self._name):
            raise _missing(self._name)
        if os.path.isdir(self._name) or _is_picture(self._name):
            self._refuse()
        elif self._name.lower().endswith(".xml"):
            try:
                text = self._whole()
                _xml.of_text(text)
                self._text = text
            except (OSError, UsageError, ParseError):
                self._refuse()

    def _changed(self) -> None:
        if not self._of_dict and self._tree is not None:
            self._text = _xml.to_text(self._tree)

    def save(self, path: PathLike) -> None:
        """Writes its text, Mitsuba's XML if it is a dict's, and its arrays, to files beside it.
        Files that it names are not copied: names that are relative to its folder are so to the
        new one, or absolute; files of pbrt's format that it includes, and that name others, are
        written beside it, too.
        """
        target = os.fspath(path)
        text = self.source()[1] or self._whole()
        suffix = os.path.splitext(self._name)[1]
        if not target.lower().endswith(suffix.lower()):
            raise UsageError(f"the scene needs a name that ends with {suffix}, found `{target}`")
        files = _xml.arrays(self._tree)
        folders = [os.path.dirname(name) or "." for name in (self._name, target)]
        text, copies = _files.moved(text, self.is_mitsuba, *folders)
        try:
            with open(target, "w", encoding="utf-8") as file:
                file.write(_xml.saved(text, files))
        except FileNotFoundError:
            raise missing(target) from None
        for each in files:
            shutil.copyfile(each, os.path.join(folders[1], each.saved_name))
        for name, data in copies.items():
            with open(os.path.join(folders[1], name), "wb") as copy:
                copy.write(data)

    def render(self, **options: Any) -> Image:
        """The image; see ``candela.render``."""
        from ._render import render

        return render(self, **options)

    def check(self, **options: Any) -> List[Problem]:
        """Its errors and warnings; see ``candela.check``."""
        from ._render import check

        return check(self, **options)

    def __repr__(self) -> str:
        return f"<candela.Scene {self._name}>"


def load_dict(scene: Dict[str, Any]) -> Scene:
    """The scene of a dict as Mitsuba's ``load_dict`` takes it.

    >>> scene = candela.load_dict({
    ...     "type": "scene",
    ...     "sensor": {"type": "perspective", "fov": 40, "to_world": candela.Transform().look_at(
    ...         origin=[0, 1, -5], target=[0, 0, 0], up=[0, 1, 0])},
    ...     "sky": {"type": "constant"},
    ...     "ball": {"type": "sphere", "bsdf": {"type": "diffuse", "reflectance": 0.5}},
    ... })
    >>> scene.parameters()["ball.bsdf.reflectance"] = [0.8, 0.2, 0.1]
    >>> scene.render(spp=64)

    Raises ``SceneError`` if the dict has faults, with what the renderer finds in the rest of it;
    what it finds in a dict without faults comes with ``render`` and ``check``. A problem's ``key``
    names its place, such as ``ball.bsdf``.
    """
    tree, faults = _xml.of_dict(scene)
    made = Scene("scene.xml", None, tree)
    if faults:
        raise _xml.error_of_faults(faults + _others(made, faults, list(scene)))
    return made


def _others(scene: Scene, faults: List[Problem], ids: List[str]) -> List[Problem]:
    """The renderer's errors that don't come of the faults.

    :param ids: names of objects, which others may refer to
    """
    try:
        found = scene.check()
    except CandelaError:  # the faults are to be told, whatever else is wrong
        return []
    keys = {fault.key or "" for fault in faults}

    def follows(p: Problem) -> bool:
        if p.number == "E0403":  # an object that is not defined
            return any(f"`{name}`" in p.message for name in ids)
        lacks = p.number == "E0305"  # a parameter that is missing
        return p.key in keys or lacks and any(k.startswith(f"{p.key}.") for k in keys)

    return [p for p in found if p.severity == "error" and p.key and not follows(p)]


def load_string(text: str, folder: Optional[PathLike] = None) -> Scene:
    """The scene of a text in pbrt's format, or in Mitsuba's XML.

    :param folder: of the files that it names, instead of the current one
    """
    if not isinstance(text, str):
        raise TypeError(f"load_string takes a text, found {described(text)}")
    if _FILE_NAME.fullmatch(text):
        raise UsageError(f"`{text}` is the name of a file: candela.load_file reads it")
    name = "scene.xml" if text.lstrip("\ufeff \t\r\n").startswith("<") else "scene.pbrt"
    return Scene(name if folder is None else os.path.join(os.fspath(folder), name), text)


def _is_picture(path: str) -> bool:
    try:
        with open(path, "rb") as file:
            return file.read(4) in _PICTURES
    except OSError:
        return False


# The first bytes of PNG, EXR, JPEG
_PICTURES = (b"\x89PNG", b"\x76\x2f\x31\x01", b"\xff\xd8\xff\xe0", b"\xff\xd8\xff\xe1")

# No scene consists of this
_FILE_NAME = re.compile(r"[^\n\"<#]+\.(pbrt|xml|gltf|glb|obj|ply|stl)(\.gz)?", re.I)


def load_file(path: PathLike) -> Scene:
    """The scene of a file. Mitsuba's XML is read at once, without the files that it names; all
    others whenever they are rendered.
    """
    scene = Scene(os.fsdecode(path), None)
    scene.read()
    return scene


def scene_of(scene: Union[PathLike, Scene, Dict[str, Any]]) -> Scene:
    """That of a file or a dict; a scene itself."""
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, dict):
        return load_dict(scene)
    name = os.fsdecode(scene)
    if not os.path.exists(name) and _is_text(name):
        raise _missing(name)
    return Scene(name, None)


def traverse(scene: Scene) -> Parameters:
    """The values of a scene by their names, as Mitsuba's ``traverse`` has them: what its text or
    dict says, without defaults.

    >>> values = candela.traverse(scene)
    >>> values["light.intensity.value"] = [1, 2, 3]
    >>> values["ball.to_world"] = candela.Transform().translate([0, 1, 0])
    """
    if not isinstance(scene, Scene):
        load = "load_dict" if isinstance(scene, dict) else "load_file"
        raise UsageError(f"its changes would be lost: traverse a scene of candela.{load}(…)")
    return scene.parameters()

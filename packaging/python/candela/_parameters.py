"""The values of a scene by their names."""

from __future__ import annotations

import difflib
import math
import numbers
import re
import xml.etree.ElementTree as ET
from collections.abc import MutableMapping
from typing import Any, Callable, Dict, Iterator, List, Set, Tuple

from ._arrays import ArrayFile
from ._elements import OBJECTS, FileElement, is_object, keys_of
from ._errors import Problem
from ._transform import Transform
from ._values import described, plain
from ._xml import array_of, element_of, error_of_faults, fault, is_matrix, is_raw

Path = Tuple[ET.Element, ET.Element]  # an element, with its parent


class Parameters(MutableMapping):  # type: ignore[type-arg]
    """The values of a scene by their names, such as ``ball.bsdf.reflectance.value``.

    A change counts from the next rendering on; ``update`` takes several, and no call of it is
    needed. Values are numbers, texts, lists of three numbers, a ``Transform``, or the array of a
    bitmap. What a dict describes, such as ``ball`` or ``ball.bsdf``, is no value, but another dict
    may take its place.
    """

    def __init__(self, root: ET.Element, changed: Callable[[], None]) -> None:
        self._root = root
        self._changed = changed
        self._keys = keys_of(root)  # which stay when others are taken out
        self._deleted: Dict[str, Path] = {}  # which may be set again

    def _all(self, objects: bool = False) -> Dict[str, Path]:
        """Values, and objects if asked for."""
        found: Dict[str, Path] = {}
        for parent in self._root.iter():
            for child in parent:
                key = self._keys.get(child)
                if key is None:
                    continue  # a comment, or a part of a transform
                if is_object(child):
                    if objects:
                        found[key] = (parent, child)
                else:
                    found[key + (".value" if child.tag in _SUFFIXED else "")] = (parent, child)
        return found

    def _path(self, key: str, changes: bool = True) -> Path:
        """Of a value; if it changes, also that of an object, or of what was deleted."""
        if not isinstance(key, str):
            raise KeyError(f"expected the name of a value, found {described(key)}")
        found = {**(self._deleted if changes else {}), **self._all(objects=changes)}
        # A colour may have taken the place of a texture, or a texture that of a colour
        names = (key, f"{key}.value", key[: -len(".value")] if key.endswith(".value") else key)
        path = next((found[name] for name in names if name in found), None)
        if path is not None:
            return path
        everything = self._all(objects=True)
        if key in everything:
            raise KeyError(f"{key!r} is no value; its values are {key + '.'!r}…")
        near = difflib.get_close_matches(key, found, 1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        if key.rpartition(".")[0] in everything:
            start = " Give" if near else "; give"
            hint += f"{start} it where the scene is made, if its default is to change"
        raise KeyError(f"the scene has no parameter {key!r}{hint}")

    def __getitem__(self, key: str) -> Any:
        return _value(self._path(key, changes=False)[1])

    def __setitem__(self, key: str, value: Any) -> None:
        self._set(key, value)
        self._changed()

    def update(self, *others: Any, **named: Any) -> None:
        """Sets several values, or none if one of them is wrong."""
        values = dict(*others, **named)
        keys, deleted = self._keys, self._deleted
        children = {parent: list(parent) for parent in self._root.iter()}
        try:
            for key, value in values.items():
                self._set(key, value)
        except BaseException:
            self._keys, self._deleted = keys, deleted
            for parent, before in children.items():
                parent[:] = before
            raise
        if values:
            self._changed()

    def _set(self, key: str, value: Any) -> None:
        parent, old = self._path(key)
        faults: List[Problem] = []
        if isinstance(old, FileElement) and old.is_array:
            new = array_of(parent.get("type", ""), value, key, faults, is_raw(parent))
        elif isinstance(value, str) and _DEFINE.fullmatch(value) and "value" in old.attrib:
            new = ET.Element(old.tag, old.attrib, value=value)
        else:
            new = element_of(old.get("name", ""), _like(old, value, key), key, faults)
        is_count = old.tag in _NUMBERS and parent.tag not in _COLORED
        alike = _NUMBERS if is_count else _alike(old.tag)
        if new is not None and new.tag not in alike and old.tag != "ref":
            expected = "a number" if is_count else _KINDS.get(old.tag, f"`{old.tag}`")
            found = described(value) if new.tag in _KINDS else f"`{new.tag}`"
            faults.append(fault(key, f"expected {expected}, found {found}"))
        if faults or new is None:
            raise error_of_faults(faults)
        new.tail = old.tail
        if "name" not in old.attrib:
            new.attrib.pop("name", None)
        if "id" in old.attrib and "ref" not in (old.tag, new.tag):
            new.set("id", old.attrib["id"])  # others may refer to it
        if old in parent:
            parent[list(parent).index(old)] = new
        else:
            parent.append(new)
        inside = set(self._root.iter())
        self._deleted = {
            k: p for k, p in self._deleted.items() if p[1] is not old and p[0] in inside
        }
        for _, taken_out in self._deleted.values():
            inside.update(taken_out.iter())
        start = self._keys[old]
        self._keys = {each: key for each, key in self._keys.items() if each in inside}
        self._keys.update(keys_of(new, start, self._keys.values()))

    def __delitem__(self, key: str) -> None:
        """Takes its value out of the scene: the default is used."""
        path = self._path(key)
        parent, old = path
        self._deleted.update((k, p) for k, p in self._all(objects=True).items() if p == path)
        parent.remove(old)
        self._changed()

    def __contains__(self, key: object) -> bool:
        found = self._all()
        return key in found or f"{key}.value" in found

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def __repr__(self) -> str:
        texts = {k: described(v) if hasattr(v, "shape") else repr(v) for k, v in self.items()}
        lines = [f"  {key!r}: {text}" for key, text in texts.items()]
        return "\n".join(["candela.Parameters:", *lines])


_DEFINE = re.compile(r"\$\w+")  # given where the scene is rendered

_SUFFIXED = {"rgb", "spectrum"}  # as Mitsuba's, `.value`

# What may take each other's places
_COLORS = {"float", "integer", "rgb", "spectrum", "texture", "volume"}
_POINTS = {"vector", "point"}
_NUMBERS = {"float", "integer"}

# Objects whose numbers may be colours or textures
_COLORED = set("bsdf emitter texture spectrum medium phase volume subsurface".split())

# The elements of values, in words
_KINDS = {
    **{tag: "a number, a colour or a texture" for tag in _COLORS},
    **{tag: "three numbers" for tag in _POINTS},
    "boolean": "True or False",
    "string": "a text",
    "transform": "a transform",
}


def _alike(tag: str) -> Set[str]:
    """The elements that may take the place of another one."""
    alike = next((tags for tags in (_COLORS, _POINTS) if tag in tags), {tag})
    return alike | {"ref"} if tag in OBJECTS or tag in _COLORS else alike


def _like(old: ET.Element, value: Any, key: str) -> Any:
    """A new value, as what the element has been."""
    if isinstance(value, ArrayFile):
        return value
    value = plain(value)
    is_number = isinstance(value, numbers.Real) and not isinstance(value, bool)
    is_list = hasattr(value, "__len__") and not isinstance(value, (str, dict))
    is_whole = key.endswith(".value")  # what a colour has been stays one
    if isinstance(value, str) and is_whole and old.tag in ("rgb", "spectrum"):
        return {"type": old.tag, "value": value}
    if (is_number or is_list) and not is_matrix(value):
        if is_list and old.tag in ("rgb", "spectrum", "float", "integer", "texture"):
            return {"type": "rgb", "value": value}
        if is_whole and old.tag in ("rgb", "spectrum") and "type" not in old.attrib:
            return {"type": old.tag, "value": value}
    return value


class _Numbers(List[float]):
    """Those of a value, which is set as a whole."""

    def __setitem__(self, *_: Any) -> None:
        raise TypeError("a copy of the scene's numbers: change a list, and set the value to it")


def _value(element: ET.Element) -> Any:
    if isinstance(element, FileElement):
        return element.file.array if element.is_array else element.file
    text = element.get("value", "")
    try:
        if element.tag == "transform":
            return _transform(element)
        if element.tag == "integer":
            return int(text)
        if element.tag == "float":
            return float(text)
        if element.tag == "boolean":
            return {"true": True, "false": False}[text.strip().lower()]
        if element.tag in ("vector", "point", "rgb"):
            numbers = [float(x) for x in text.replace(",", " ").split()]
            if not text:
                numbers = [float(element.get(axis, 0)) for axis in "xyz"]
            return _Numbers(numbers * 3 if len(numbers) == 1 else numbers)
        if element.tag == "spectrum" and text:
            return float(text)
    except (ValueError, KeyError):
        pass  # such as `$name`, which is given where the scene is loaded
    return text or element.get("filename", "")


def _transform(element: ET.Element) -> Transform:
    whole = Transform()
    for step in element:

        def triple(name: str) -> List[float]:
            return [float(x) for x in step.attrib[name].replace(",", " ").split()]

        def axes(default: float) -> List[float]:
            if "value" in step.attrib:
                given = triple("value")
                return given * 3 if len(given) == 1 else given
            return [float(step.get(axis, default)) for axis in "xyz"]

        one = Transform()
        if step.tag == "translate":
            one = one.translate(axes(0))
        elif step.tag == "scale":
            one = one.scale(axes(1))
        elif step.tag == "rotate":
            one = one.rotate(axes(0), float(step.attrib["angle"]))
        elif step.tag == "lookat":
            one = one.look_at(triple("origin"), triple("target"), triple("up"))
        elif step.tag == "matrix":
            flat = triple("value")
            side = math.isqrt(len(flat))
            one = Transform([flat[i * side : (i + 1) * side] for i in range(side)])
        whole = one @ whole
    return whole

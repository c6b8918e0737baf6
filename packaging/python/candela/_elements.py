"""Elements of Mitsuba's XML, and their keys."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import count
from typing import Any, Dict, Iterable, List, Tuple

from ._arrays import ArrayFile
from ._plugins import ELEMENTS

OBJECTS = set(ELEMENTS.values())
_VALUES = set("float integer boolean string vector point rgb spectrum transform".split())


class FileElement(ET.Element):
    """The file name of an array, whose file lasts as long as the element."""

    def __init__(self, file: ArrayFile) -> None:
        super().__init__("string", name="filename", value=file.path)
        self.file = file

    def __deepcopy__(self, memo: Any) -> "FileElement":
        return FileElement(self.file)

    def __reduce__(self) -> Any:
        return FileElement, (self.file,)

    @property
    def is_array(self) -> bool:
        """Whether its values are data of a texture or a volume, not a mesh."""
        return self.file.array is not None


# Objects whose children of one kind Mitsuba numbers from 0 on, and their names
_NUMBERED = {
    "blendbsdf": "bsdf",
    "mixturebsdf": "bsdf",
    "twosided": "brdf",
    "blendphase": "phase",
    "mixturephase": "phase",
}


def keys_of(
    root: ET.Element, start: str = "", reserved: Iterable[str] = ()
) -> Dict[ET.Element, str]:
    """The key of each element that has one: no two are the same, and none is a reserved one.

    The name or id that an element has is its own; an object without one is named by its element,
    and numbered if that is taken: ``shape``, ``shape_1``.
    """
    keys = {root: start}
    taken = set(reserved)
    last: Dict[str, int] = {}  # numbers of keys

    def unique(key: str) -> str:
        if key not in taken:
            return key
        last[key] = next(n for n in count(last.get(key, 0) + 1) if f"{key}_{n}" not in taken)
        return f"{key}_{last[key]}"

    for parent in root.iter():  # before its children
        if parent in keys:
            for child, name in _names(parent):
                keys[child] = unique(f"{keys[parent]}.{name}" if keys[parent] else name)
                taken.add(keys[child])
    return keys


def _names(parent: ET.Element) -> List[Tuple[ET.Element, str]]:
    """Of its children, first those whose name is their own, then references, then all others."""
    attributes = ("id", "name") if parent.tag == "scene" else ("name", "id")
    word = _NUMBERED.get(parent.get("type", ""))
    number = 0
    names: List[List[Tuple[ET.Element, str]]] = [[], [], []]
    for child in parent:
        if not is_object(child) and child.tag not in _VALUES:
            continue  # a comment, a part of a transform, a `default`
        given = next((child.attrib[x] for x in attributes if child.get(x)), "")
        if isinstance(child, FileElement) and child.is_array:
            given = "data"
        if given:
            names[child.tag == "ref"].append((child, given))
        elif is_object(child):
            is_numbered = word is not None and child.tag in ("bsdf", "phase")
            names[2].append((child, f"{word}_{number}" if is_numbered else str(child.tag)))
        is_unnamed = child.tag == "ref" and "name" not in child.attrib
        number += is_unnamed or child.tag in ("bsdf", "phase")
    return [each for some in names for each in some]


def is_object(element: ET.Element) -> bool:
    """Whether it is an object, or refers to one."""
    return element.tag == "ref" or element.tag in OBJECTS and "type" in element.attrib

"""Scenes as trees of Mitsuba's XML elements: made from a dict, and changed by name."""

from __future__ import annotations

import difflib
import math
import numbers
import xml.etree.ElementTree as ET
from collections.abc import MutableMapping
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple

from ._arrays import ArrayFile, texture
from ._errors import Keys, Problem, SceneError
from ._plugins import ELEMENTS
from ._transform import Transform, is_transform, rows
from ._values import described, plain


def of_dict(scene: Dict[str, Any]) -> Tuple[ET.Element, List[Problem]]:
    """The tree of a dict as Mitsuba's ``load_dict`` takes it, without what is wrong with it."""
    faults: List[Problem] = []
    if not isinstance(scene, dict) or scene.get("type") != "scene":
        raise error_of_faults([_fault("", "expected a dict with 'type': 'scene'")])
    root = ET.Element("scene", version="3.0.0")
    for name, value in scene.items():
        if name == "type":
            continue
        element = _element(name, value, str(name), faults)
        if element is None:
            continue
        if element.tag not in _OBJECTS and element.tag != "ref":
            faults.append(_fault(name, f"a scene takes no {element.tag} `{name}`: expected a dict"))
        del element.attrib["name"]
        element.attrib.setdefault("id", name)
        root.append(element)
    return root, faults


_OBJECTS = set(ELEMENTS.values())

# Parameters of Mitsuba's meshes, which its `traverse` names
_MESH = {"vertex_positions", "faces", "vertex_normals", "vertex_texcoords"}


class FileElement(ET.Element):
    """The file name of an array, whose file lasts as long as the element."""

    def __init__(self, file: ArrayFile) -> None:
        super().__init__("string", name="filename", value=file.path)
        self.file = file

    @property
    def is_texture(self) -> bool:
        return self.file.array is not None


def _element(name: str, value: Any, key: str, faults: List[Problem]) -> Optional[ET.Element]:
    """The element of a value; what is wrong with it is added to the faults."""

    def wrong(message: str) -> None:
        faults.append(_fault(key, message))

    def leaf(tag: str, text: str) -> ET.Element:
        return ET.Element(tag, name=name, value=text)

    if not isinstance(name, str):
        wrong(f"a name must be a text, found {described(name)}")
        return None
    if isinstance(value, ArrayFile):
        return FileElement(value)
    given = value
    value = {"type": "rgb", "value": value} if _is_color(value) else plain(value)
    if isinstance(value, dict):
        return _object(name, value, key, faults)
    if isinstance(value, bool):
        return leaf("boolean", "true" if value else "false")
    if isinstance(value, str):
        return leaf("string", value)
    if isinstance(value, numbers.Integral):
        return leaf("integer", str(int(value)))
    if isinstance(value, numbers.Real):
        if math.isfinite(value):
            return leaf("float", repr(float(value)))
        wrong(f"expected a number, found {value}")
        return None
    if _is_transform(value):
        try:
            matrix = rows(given)
        except ValueError as e:
            wrong(str(e))
            return None
        element = ET.Element("transform", name=name)
        element.append(ET.Element("matrix", value=_numbers(sum(matrix, []))))
        return element
    try:
        items = [float(x) for x in value]
    except (TypeError, ValueError):
        hint = ": use its dict" if type(value).__module__.startswith("mitsuba") else ""
        wrong(f"expected a number, a text, a dict or a transform, found {described(given)}{hint}")
        return None
    if len(items) == 1:
        return leaf("float", repr(items[0]))
    return leaf("vector" if len(items) == 3 else "string", _numbers(items))


def _object(
    name: str, value: Dict[str, Any], key: str, faults: List[Problem]
) -> Optional[ET.Element]:
    kind = value.get("type")
    if kind == "ref":
        if isinstance(value.get("id"), str):
            return ET.Element("ref", name=name, id=value["id"])
        faults.append(_fault(key, "a reference needs the 'id' of an object"))
        return None
    if kind in ("rgb", "spectrum"):
        return _color(name, kind, value, key, faults)
    element = ELEMENTS.get(kind) if isinstance(kind, str) else None
    if element is None:
        near = difflib.get_close_matches(str(kind), [*ELEMENTS, "rgb", "spectrum", "ref"], 1)
        message = "a dict needs a 'type'" if kind is None else f"unknown type `{kind}`"
        faults.append(_fault(key, message, "E0401", f"did you mean `{near[0]}`?" if near else None))
        element = ELEMENTS.get(near[0]) if near else None
        if element is None:
            return None
        kind = near[0]  # so that what is wrong within it is told, too
    tree = ET.Element(element, type=str(kind), name=name)
    if isinstance(value.get("id"), str):
        tree.set("id", value["id"])
    for inner, each in value.items():
        if inner in ("type", "id"):
            continue
        if element == "shape" and inner in _MESH:
            advice = "candela.mesh(vertices, faces) is a mesh of arrays"
            message = f"unknown parameter `{inner}`: {advice}"
            faults.append(_fault(f"{key}.{inner}", message, "E0308"))
            continue
        if kind in ("bitmap", "envmap") and inner in ("data", "bitmap"):
            child = _array(each, f"{key}.{inner}", faults)
        else:
            child = _element(inner, each, f"{key}.{inner}", faults)
        if child is not None:
            tree.append(child)
    return tree


def _array(value: Any, key: str, faults: List[Problem]) -> Optional[ET.Element]:
    """The element of the array of a texture or an environment."""
    try:
        return FileElement(texture(value))
    except ValueError as e:
        faults.append(_fault(key, str(e)))
        return None


def _color(
    name: str, kind: str, value: Dict[str, Any], key: str, faults: List[Problem]
) -> Optional[ET.Element]:
    element = ET.Element(kind, name=name)
    given: Any = plain(value.get("value"))
    if kind == "spectrum" and "filename" in value:
        element.set("filename", str(plain(value["filename"])))
        return element
    try:
        if isinstance(given, str):
            text = given
        elif isinstance(given, numbers.Real):
            text = repr(float(given))
        elif kind == "rgb":
            text = _numbers([float(x) for x in given])
        else:  # pairs of a wavelength and a value
            text = ", ".join(f"{float(w)!r}:{float(x)!r}" for w, x in given)
    except (TypeError, ValueError):
        pairs = "a number, or pairs of wavelength and value"
        expected = "three numbers" if kind == "rgb" else pairs
        shown = described(value.get("value"))
        message = f"`{kind}` needs a 'value': expected {expected}, found {shown}"
        faults.append(_fault(key, message))
        return None
    element.set("value", text)
    return element


def _is_color(value: Any) -> bool:
    """Whether it is one of Mitsuba's."""
    kind = type(value)
    return kind.__name__ == "Color3f" and kind.__module__.startswith("mitsuba")


def _is_transform(value: Any) -> bool:
    nested = isinstance(value, list) and any(isinstance(x, list) for x in value)
    return is_transform(value) or nested


def _numbers(values: List[float]) -> str:
    return ", ".join(repr(float(x)) for x in values)


def _fault(key: str, message: str, number: str = "E0304", help: Optional[str] = None) -> Problem:
    first = f"{key}: error: {message} [{number}]" if key else f"error: {message} [{number}]"
    text = first if help is None else f"{first}\n {help}"
    return Problem("error", message, text, number=number, key=key or None)


def error_of_faults(faults: List[Problem]) -> SceneError:
    return SceneError("\n".join(f.text for f in faults), tuple(faults))


# --- texts ---------------------------------------------------------------------------------------


def of_text(text: str) -> ET.Element:
    """The tree of a text, with its comments."""
    parser = ET.XMLParser(target=ET.TreeBuilder(insert_comments=True))
    return ET.fromstring(text, parser)


def to_text(root: ET.Element) -> str:
    return ET.tostring(root, encoding="unicode")


def in_lines(root: ET.Element) -> Tuple[str, Keys]:
    """The text of a dict's tree, an element a line, with the keys of the lines."""
    lines: List[str] = []
    keys: Keys = []

    def write(element: ET.Element, key: str) -> None:
        attributes = "".join(f" {n}={_quoted(v)}" for n, v in element.attrib.items())
        children = list(element)
        lines.append(f"<{element.tag}{attributes}{'' if children else '/'}>")
        keys.append((key, _size(element)))
        for child in children:
            write(child, _joined(key, _name(child)))
        if children:
            lines.append(f"</{element.tag}>")
            keys.append((key, 0))

    write(root, "")
    return "\n".join(lines) + "\n", keys


def _size(element: ET.Element) -> int:
    """How many values a list has that is a string of XML."""
    try:
        return len([float(x) for x in element.get("value", "").split(",")])
    except ValueError:
        return 0


def arrays(root: Optional[ET.Element]) -> List[ArrayFile]:
    elements = [] if root is None else root.iter("string")
    return [each.file for each in elements if isinstance(each, FileElement)]


def saved(text: str, files: List[ArrayFile]) -> str:
    """A text with the names that files of arrays have beside it."""
    for file in files:
        text = text.replace(_quoted(file.path), _quoted(file.saved_name))
    return text


def _quoted(text: str) -> str:
    escaped = text.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    return f'"{escaped}"'


# --- parameters ----------------------------------------------------------------------------------

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
        self._deleted: Dict[str, Path] = {}  # which may be set again

    def _all(self, objects: bool = False) -> Dict[str, Path]:
        """Values, and objects if asked for."""
        found: Dict[str, Path] = {}

        def collect(parent: ET.Element, key: str) -> None:
            for child in parent:
                name = _name(child) if isinstance(child.tag, str) else ""
                if not name:
                    continue  # a comment, or a part of a transform
                inner = _joined(key, name)
                if child.tag in _OBJECTS and "type" in child.attrib:
                    if objects:
                        found.setdefault(inner, (parent, child))
                    collect(child, inner)
                elif child.tag == "ref" and objects:
                    found.setdefault(inner, (parent, child))
                elif child.tag in _VALUES:
                    suffix = ".value" if child.tag in ("rgb", "spectrum") else ""
                    found.setdefault(inner + suffix, (parent, child))

        collect(self._root, "")
        return found

    def _path(self, key: str, changes: bool = True) -> Path:
        """Of a value; if it changes, also that of an object, or of what was deleted."""
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
            hint += "; give it where the scene is made, if its default is to change"
        raise KeyError(f"the scene has no parameter {key!r}{hint}")

    def __getitem__(self, key: str) -> Any:
        return _value(self._path(key, changes=False)[1])

    def __setitem__(self, key: str, value: Any) -> None:
        parent, old = self._path(key)
        faults: List[Problem] = []
        if isinstance(old, FileElement) and old.is_texture:
            new = _array(value, key, faults)
        else:
            new = _element(old.get("name", ""), _like(old, value), key, faults)
        if new is not None and not _fits(old, new):
            faults.append(_fault(key, f"expected a {old.tag}, found a {new.tag}"))
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
        inside = {id(each) for each in self._root.iter()}
        self._deleted = {
            k: p for k, p in self._deleted.items() if p[1] is not old and id(p[0]) in inside
        }
        self._changed()

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
        lines = [f"  {key!r}: {value!r}" for key, value in self.items()]
        return "\n".join(["candela.Parameters:", *lines])


_VALUES = set("float integer boolean string vector point rgb spectrum transform".split())

# What may take each other's places
_COLORS = {"float", "integer", "rgb", "spectrum", "texture", "volume"}


def _fits(old: ET.Element, new: ET.Element) -> bool:
    """Whether a new element may take the place of an object."""
    if old.tag in _COLORS and new.tag in _COLORS:
        return True
    return old.tag not in _OBJECTS or new.tag in (old.tag, "ref")


def _name(element: ET.Element) -> str:
    if isinstance(element, FileElement) and element.is_texture:
        return "data"
    given = element.get("name") or element.get("id")
    return given or (element.tag if "type" in element.attrib else "")


def _joined(key: str, name: str) -> str:
    return f"{key}.{name}" if key and name else key or name


def _like(old: ET.Element, value: Any) -> Any:
    """A new value, as what the element has been."""
    if isinstance(value, ArrayFile):
        return value
    value = plain(value)
    is_number = isinstance(value, numbers.Real) and not isinstance(value, bool)
    is_list = hasattr(value, "__len__") and not isinstance(value, (str, dict))
    if (is_number or is_list) and not _is_transform(value):
        if old.tag == "rgb" or (is_list and old.tag in ("spectrum", "float", "texture")):
            return {"type": "rgb", "value": value}
        if old.tag == "spectrum" and "type" not in old.attrib:
            return {"type": "spectrum", "value": value}
    return value


def _value(element: ET.Element) -> Any:
    if isinstance(element, FileElement):
        return element.file.array if element.is_texture else element.file
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
            return numbers * 3 if len(numbers) == 1 else numbers
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

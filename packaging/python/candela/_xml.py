"""Scenes as trees of Mitsuba's XML elements, made from a dict."""

from __future__ import annotations

import difflib
import math
import numbers
import re
import xml.etree.ElementTree as ET
from typing import Any, Dict, Iterator, List, Optional, Tuple

from ._arrays import ArrayFile, grid, texture
from ._elements import OBJECTS, FileElement, keys_of
from ._errors import OF_DEFINE, Keys, Problem, SceneError
from ._plugins import ELEMENTS
from ._transform import is_transform, rows
from ._values import described, plain


def of_dict(scene: Dict[str, Any]) -> Tuple[ET.Element, List[Problem]]:
    """The tree of a dict as Mitsuba's ``load_dict`` takes it, without what is wrong with it."""
    faults: List[Problem] = []
    if not isinstance(scene, dict) or scene.get("type") != "scene":
        raise error_of_faults([fault("", "expected a dict with 'type': 'scene'")])
    root = ET.Element("scene", version="3.0.0")
    ids: Dict[str, str] = {}  # by key
    for name, value in scene.items():
        if name == "type" or _is_dotted(name, name, faults):
            continue
        element = element_of(name, value, str(name), faults)
        if element is None:
            continue
        if element.tag not in OBJECTS and element.tag != "ref":
            faults.append(fault(name, f"a scene takes no {element.tag} `{name}`: expected a dict"))
        del element.attrib["name"]
        ids[name] = element.attrib.setdefault("id", name)
        root.append(element)
    own = set(ids.values())
    for ref in root.iter("ref"):
        if ref.get("id") not in own:
            ref.set("id", ids.get(ref.get("id", ""), ref.get("id", "")))
    return root, faults


# Parameters of Mitsuba's meshes, which its `traverse` names
_MESH = {"vertex_positions", "faces", "vertex_normals", "vertex_texcoords"}


def element_of(name: str, value: Any, key: str, faults: List[Problem]) -> Optional[ET.Element]:
    """The element of a value; what is wrong with it is added to the faults."""
    count = len(faults)
    try:
        return _element(name, value, key, faults)
    except RecursionError:
        faults[count:] = [fault(key, "it contains itself, or is nested too deep")]
        return None


def _element(name: str, value: Any, key: str, faults: List[Problem]) -> Optional[ET.Element]:
    def wrong(message: str) -> None:
        faults.append(fault(key, message))

    def leaf(tag: str, text: str) -> ET.Element:
        return ET.Element(tag, name=name, value=text)

    if not isinstance(name, str):
        wrong(f"a name must be a text, found {described(name)}")
        return None
    if isinstance(value, ArrayFile):
        return FileElement(value)
    given = value
    try:
        value = {"type": "rgb", "value": value} if _is_color(value) else plain(value)
    except TypeError as e:
        wrong(str(e))
        return None
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
    if is_matrix(value):
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
        if not items:
            raise ValueError
    except Exception:  # other libraries have their own
        hint = ": use its dict" if type(value).__module__.startswith("mitsuba") else ""
        wrong(f"expected a number, a text, a dict or a transform, found {described(given)}{hint}")
        return None
    if not all(map(math.isfinite, items)):
        wrong(f"expected finite numbers, found {described(given)}")
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
        faults.append(fault(key, "a reference needs the 'id' of an object"))
        return None
    if kind in ("rgb", "spectrum"):
        return _color(name, kind, value, key, faults)
    element = ELEMENTS.get(kind) if isinstance(kind, str) else None
    if element is None:
        near = difflib.get_close_matches(str(kind), [*ELEMENTS, "rgb", "spectrum", "ref"], 1)
        message = "a dict needs a 'type'" if kind is None else f"unknown type `{kind}`"
        faults.append(fault(key, message, "E0401", f"did you mean `{near[0]}`?" if near else None))
        element = ELEMENTS.get(near[0]) if near else None
        if element is None:
            return None
        kind = near[0]  # so that what is wrong within it is told, too
    tree = ET.Element(element, type=str(kind), name=name)
    if isinstance(value.get("id"), str):
        tree.set("id", value["id"])
    for inner, each in value.items():
        if inner in ("type", "id") or _is_dotted(inner, f"{key}.{inner}", faults):
            continue
        if element == "shape" and inner in _MESH:
            advice = "candela.mesh(vertices, faces) is a mesh of arrays"
            message = f"unknown parameter `{inner}`: {advice}"
            faults.append(fault(f"{key}.{inner}", message, "E0308"))
            continue
        if inner in ARRAYS.get(kind, ()):
            child = array_of(kind, each, f"{key}.{inner}", faults, value.get("raw") is True)
        else:
            child = _element(inner, each, f"{key}.{inner}", faults)
        if child is not None:
            tree.append(child)
    return tree


def _is_dotted(name: Any, key: str, faults: List[Problem]) -> bool:
    """Whether a name has a dot, which is a fault."""
    is_dotted = isinstance(name, str) and "." in name
    if is_dotted:
        help = f"write `{name.replace('.', '_')}`"
        faults.append(fault(key, f"`{name}` has a `.`, which separates names", help=help))
    return is_dotted


def range_warnings(root: ET.Element) -> List[Problem]:
    """As Mitsuba's: textures that reflect more light than they get, or less than none."""
    of_lights = {ref.get("id") for light in root.iter("emitter") for ref in light.iter("ref")}
    rest = (x for x in root if x.tag != "emitter" and x.get("id") not in of_lights)
    keys = keys_of(root)
    return [x for each in rest for x in _range_warnings(each, keys)]


def _range_warnings(parent: ET.Element, keys: Dict[ET.Element, str]) -> Iterator[Problem]:
    for child in parent:
        if isinstance(child, FileElement) and parent.tag == "texture" and not is_raw(parent):
            array = child.file.array
            low, high = f"{array.min():g}", f"{array.max():g}"  # without rounding errors
            if array.dtype.kind == "f" and not 0 <= float(low) <= float(high) <= 1:
                message = f"values from {low} to {high}, expected 0 to 1"
                yield problem("warning", keys[child], message)
        elif child.tag != "emitter":
            yield from _range_warnings(child, keys)


def is_raw(texture: ET.Element) -> bool:
    return any(x.get("name") == "raw" and x.get("value") == "true" for x in texture)


# Parameters that are arrays, as Mitsuba's dicts have them
ARRAYS = {
    "bitmap": ("data", "bitmap"),
    "envmap": ("data", "bitmap"),
    "gridvolume": ("data", "grid"),
}


def array_of(
    kind: str, value: Any, key: str, faults: List[Problem], is_raw: bool = False
) -> Optional[ET.Element]:
    """The element of the array of a texture, an environment or a volume."""
    try:
        return FileElement(grid(value) if kind == "gridvolume" else texture(value, is_raw))
    except ValueError as e:
        faults.append(fault(key, str(e)))
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
            text = str(given) if isinstance(given, bool) else repr(float(given))
        elif kind == "rgb":
            text = _numbers([float(x) for x in given])
        else:  # pairs of a wavelength and a value
            text = ", ".join(f"{float(w)!r}:{float(x)!r}" for w, x in given)
        if not _is_color_text(kind, text):
            raise ValueError
    except (TypeError, ValueError):
        pairs = "a number, or pairs of wavelength and value"
        expected = "three numbers" if kind == "rgb" else pairs
        shown = described(value.get("value"))
        message = f"`{kind}` needs a 'value': expected {expected}, found {shown}"
        faults.append(fault(key, message))
        return None
    element.set("value", text)
    return element


def _is_color_text(kind: str, text: str) -> bool:
    if "$" in text or kind == "rgb" and _HEXADECIMAL.fullmatch(text.strip()):
        return True
    try:
        values = [float(x) for x in text.replace(",", " ").replace(":", " ").split()]
    except ValueError:
        return False
    is_pairs = ":" in text and kind == "spectrum"
    is_complete = len(values) % 2 == 0 if is_pairs else len(values) in _COUNTS[kind]
    return bool(values) and is_complete and all(map(math.isfinite, values))


_HEXADECIMAL = re.compile("#[0-9a-fA-F]{6}")
_COUNTS = {"rgb": (1, 3), "spectrum": (1,)}


def _is_color(value: Any) -> bool:
    """Whether it is one of Mitsuba's."""
    kind = type(value)
    return kind.__name__ == "Color3f" and kind.__module__.startswith("mitsuba")


def is_matrix(value: Any) -> bool:
    nested = isinstance(value, list) and any(isinstance(x, list) for x in value)
    return is_transform(value) or nested


def _numbers(values: List[float]) -> str:
    return ", ".join(repr(float(x)) for x in values)


def fault(key: str, message: str, number: str = "E0304", help: Optional[str] = None) -> Problem:
    return problem("error", key, message, number, help)


def problem(
    severity: str, key: str, message: str, number: str = "E0304", help: Optional[str] = None
) -> Problem:
    place = f"{key}: " if key else ""
    below = "" if help is None else f"\n {help}"
    text = f"{place}{severity}: {message} [{number}]{below}"
    return Problem(severity, message, text, number=number, key=key or None)


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
    pairs = list(_lines(root, "", keys_of(root)))
    return "".join(f"{line}\n" for line, _ in pairs), [key for _, key in pairs]


def _lines(
    element: ET.Element, key: str, named: Dict[ET.Element, str]
) -> Iterator[Tuple[str, Tuple[str, int]]]:
    attributes = "".join(f" {n}={_quoted(v)}" for n, v in element.attrib.items())
    children = list(element)
    yield f"<{element.tag}{attributes}{'' if children else '/'}>", (key, _size(element))
    for child in children:
        yield from _lines(child, named.get(child, key), named)
    if children:
        yield f"</{element.tag}>", (key, 0)


def _size(element: ET.Element) -> int:
    """How many values a list has that is a string of XML; one of three would be a vector."""
    if element.tag == "string" and element.get("value", "").startswith("$"):
        return OF_DEFINE
    try:
        size = len([float(x) for x in element.get("value", "").split(",")])
    except ValueError:
        return 0
    return 0 if element.tag == "string" and size == 3 else size


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

"""Writes the open scene as glTF by Blender's exporter; `extras.candela` has what that lacks."""

import json
import shutil
import struct
from pathlib import Path

import bpy

from . import cameras, geometry, lights, materials, media, surfaces, unread, volumes, world

FILE = "scene.glb"
_LIGHTS = "KHR_lights_punctual"


class ExportError(Exception):
    """The scene can't be exported."""


class _Export:
    """The export in progress: what the hooks below need."""

    def __init__(self, found, warn):
        self.names, self.materials, self.warn = found.names, found.materials, warn
        self.unassigned = None  # the material of what has none
        self.failure = None  # the exporter only logs exceptions of hooks
        self._thin = {}

    def thin(self, material):
        """The material for a mesh that is open: light would stay within it."""
        if surfaces.is_filled(material) and id(material) not in self._thin:
            self._thin[id(material)] = surfaces.thin(material)
        return self._thin.get(id(material), material)


_current = None


class glTF2ExportUserExtension:
    """Adds to the exporter's materials and meshes; other exports are left as they are."""

    def gather_material_hook(self, gltf_material, blender_material, export_settings):
        _run(_add_to_material, gltf_material, blender_material)

    def gather_mesh_hook(self, mesh, blender_mesh, *_):
        _run(_add_to_mesh, mesh, blender_mesh)


def _run(hook, *words):
    if _current is not None and _current.failure is None:
        try:
            hook(*words)
        except Exception as failure:
            _current.failure = failure


def _add_to_material(gltf_material, blender_material):
    gltf_material.double_sided = True  # Cycles culls no faces
    if blender_material is None:
        return
    material = _current.materials[blender_material.name]
    gltf_material.name = material.name
    surfaces.mend(gltf_material, material)
    medium = media.of(material, (), _current.warn)
    if medium is not None:
        emission = {"emission": list(medium.emission)} if any(medium.emission) else {}
        surface = {} if media.is_surface(material) else {"surface": False}
        gltf_material.extras = _extras("medium", {**medium.fields(), **emission, **surface})


def _add_to_mesh(mesh, blender_mesh):
    mesh.name = _current.names[blender_mesh.name]
    slots = [each and _current.materials[each.name].name for each in blender_mesh.materials]
    is_open = {slots[k] for k in geometry.open_slots(blender_mesh) if k < len(slots)}
    for primitive in mesh.primitives:
        if primitive.material is None:
            _current.unassigned = _current.unassigned or surfaces.unassigned()
            primitive.material = _current.unassigned
        elif primitive.material.name in is_open:
            primitive.material = _current.thin(primitive.material)


def _extras(name, fields):
    return {"candela": {name: fields}}


def write(scene, view_layer, depsgraph, folder: Path, warn) -> Path:
    """Exports the scene as its view layer is rendered; the file is in the folder.

    :param depsgraph: evaluated for rendering
    :param warn: is called with what is left out
    """
    camera = scene.camera
    if camera is None:
        raise ExportError(f"scene '{scene.name}' has no camera")
    if camera.type != "CAMERA" or camera.data.type not in ("PERSP", "ORTHO"):
        raise ExportError(f"camera '{camera.name}' must be perspective or orthographic")
    override = view_layer.material_override
    sky = world.of(scene, view_layer)
    unread.check(scene, view_layer, sky, depsgraph, warn)
    materials.check(depsgraph, override, warn)
    path, bare = folder / FILE, folder / "meshes.glb"
    with geometry.meshes(depsgraph, override) as found:
        for each in found.scene.objects:
            materials.check_attributes(each.data, found.names[each.data.name], warn)
        _export(found, bare, warn)
        root, rest = _opened(bare)
        _place(root, found.places)
    _add_camera(root, scene, camera.evaluated_get(depsgraph), warn)
    _add_lights(root, depsgraph, warn)
    for name, matrix, medium in volumes.nodes(depsgraph, override, folder, warn):
        _add_node(root, {"name": name, "matrix": matrix, "extras": _extras("medium", medium)})
    environment = world.environment(sky, folder, warn)
    root["scenes"][0]["extras"] = _extras("environment", environment)
    _save(root, rest, path)
    return path


def _export(found, path: Path, warn):
    """Writes the meshes and their materials."""
    global _current
    _current = _Export(found, warn)
    place = {"scene": found.scene, "view_layer": found.scene.view_layers[0]}
    if bpy.context.window is None:
        place["window"] = bpy.context.window_manager.windows[0]
    try:
        with bpy.context.temp_override(**place):
            bpy.ops.export_scene.gltf(
                filepath=str(path),
                export_format="GLB",
                use_active_scene=True,
                export_cameras=False,
                export_lights=False,
                export_all_vertex_colors=False,
                export_active_vertex_color_when_no_material=False,
                export_animations=False,
                export_current_frame=True,
                export_skins=False,
                export_morph=False,
                export_tangents=False,
                export_yup=True,
                export_extras=False,
            )
    except RuntimeError as error:
        raise ExportError(f"Blender's glTF export failed: {error}") from error
    finally:
        failure, _current = _current.failure, None
    if failure is not None:
        raise failure


def _opened(path: Path):
    """The JSON of a file, and where what follows begins."""
    with open(path, "rb") as file:
        file.seek(12)
        (length,) = struct.unpack("<I4x", file.read(8))
        return json.loads(file.read(length)), (path, 20 + length)


def _save(root, rest, path: Path):
    source, start = rest
    text = json.dumps(root, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    size = 20 + len(text) + source.stat().st_size - start
    with open(source, "rb") as old, open(path, "wb") as new:
        new.write(struct.pack("<4sII", b"glTF", 2, size))
        new.write(struct.pack("<I4s", len(text), b"JSON") + text)
        old.seek(start)
        shutil.copyfileobj(old, new)
    source.unlink()


def _add_node(root, node):
    root["scenes"][0]["nodes"].append(len(root["nodes"]))
    root["nodes"].append(node)


def _place(root, places):
    """Puts an instance of its mesh at each place, instead of the exporter's nodes."""
    meshes = {node["name"]: node["mesh"] for node in root.get("nodes", ()) if "mesh" in node}
    root["nodes"], root["scenes"][0]["nodes"] = [], []
    for made, name, matrix in places:
        if made in meshes:
            _add_node(root, {"name": name, "mesh": meshes[made], "matrix": matrix})


def _add_camera(root, scene, camera, warn):
    described, more = cameras.fields(scene, camera, warn)
    root["cameras"] = [described]
    matrix = geometry.numbers(geometry.UPRIGHT @ camera.matrix_world.normalized())
    node = {"name": camera.name, "camera": 0, "matrix": matrix, "extras": _extras("camera", more)}
    _add_node(root, node)


def _add_lights(root, depsgraph, warn):
    entries = []
    for instance in geometry.rendered(depsgraph):
        lamp = instance.object
        if lamp.type != "LIGHT":
            continue
        described, more = lights.fields(lamp, instance.matrix_world, warn)
        if more is None:
            continue
        matrix = geometry.numbers(geometry.UPRIGHT @ instance.matrix_world)
        node = {"name": lamp.name, "matrix": matrix, "extras": _extras("light", more)}
        if described is not None:
            node["extensions"] = {_LIGHTS: {"light": len(entries)}}
            entries.append(described)
        _add_node(root, node)
    if entries:
        root.setdefault("extensions", {})[_LIGHTS] = {"lights": entries}
        root.setdefault("extensionsUsed", []).append(_LIGHTS)


def names(path: Path):
    """A function: what a JSON pointer into the file refers to, in Blender's words."""
    root, _ = _opened(path)

    def name(pointer: str):
        words = pointer.strip("/").split("/")
        if len(words) < 2 or not words[1].isdigit():
            return None
        entries = root.get(words[0], [])
        index = int(words[1])
        found = entries[index].get("name") if index < len(entries) else None
        return f"{words[0][:-1] if words[0] != 'meshes' else 'mesh'} '{found}'" if found else None

    return name

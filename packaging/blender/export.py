"""Writes the open scene as glTF by Blender's exporter; `extras.candela` has what that lacks."""

import json
import logging
import math
import struct
from contextlib import contextmanager
from pathlib import Path

import bpy

from . import lights, materials, media, surfaces, volumes, world

FILE = "scene.glb"


class ExportError(Exception):
    """The scene can't be exported."""


class _Export:
    """The export in progress: what the hooks below need."""

    def __init__(self, scene, folder: Path, warn, volumes):
        self.scene, self.folder, self.warn, self.volumes = scene, folder, warn, volumes
        self.has_camera = False
        # The exporter fails on temperatures and on power by area: it sees none
        self.lights = {light.name: lights.Power(light) for light in bpy.data.lights}
        self.unassigned = None  # the material of what has none
        self.failure = None  # the exporter only logs exceptions of hooks


_current = None


class glTF2ExportUserExtension:
    """Adds to the exporter's nodes; other exports are left as they are."""

    def gather_node_hook(self, node, blender_object, export_settings):
        if blender_object is not None:
            _run(_add_to_node, node, blender_object)

    def gather_material_hook(self, gltf_material, blender_material, export_settings):
        _run(_add_to_material, gltf_material, blender_material)

    def gather_mesh_hook(self, mesh, *_):
        _run(_add_to_mesh, mesh)

    def gather_scene_hook(self, scene, blender_scene, export_settings):
        _run(_add_to_scene, scene, blender_scene)


def _run(hook, *words):
    if _current is not None and _current.failure is None:
        try:
            hook(*words)
        except Exception as failure:
            _current.failure = failure


def _add_to_node(node, blender_object):
    if blender_object.type == "CAMERA":
        if blender_object == _current.scene.camera and not _current.has_camera:
            _current.has_camera = True
            _add(node, "camera", _camera(node, blender_object))
        else:
            node.camera = None
    elif blender_object.type == "LIGHT":
        _light(node, blender_object)


def _add_to_material(gltf_material, blender_material):
    gltf_material.double_sided = True  # Cycles culls no faces
    if blender_material is None:
        return
    surfaces.mend(gltf_material, blender_material)
    medium = media.of(blender_material, (), _current.warn)
    if medium is not None:
        emission = {"emission": list(medium.emission)} if any(medium.emission) else {}
        surface = {} if media.is_surface(blender_material) else {"surface": False}
        _add(gltf_material, "medium", {**medium.fields(), **emission, **surface})


def _add_to_mesh(mesh):
    for primitive in mesh.primitives:
        if primitive.material is None:
            _current.unassigned = _current.unassigned or surfaces.unassigned()
            primitive.material = _current.unassigned


def _add_to_scene(scene, blender_scene):
    from io_scene_gltf2.io.com.gltf2_io import Node

    for name, matrix, medium in _current.volumes:
        node = Node(None, [], None, None, matrix, None, name, *[None] * 5)
        _add(node, "medium", medium)
        scene.nodes.append(node)
    found = world.environment(blender_scene.world, _current.folder, _current.warn)
    _add(scene, "environment", found)


def _add(owner, name, fields):
    extras = dict(owner.extras or {})
    extras["candela"] = {**extras.get("candela", {}), name: fields}
    owner.extras = extras


def _light(node, blender_object):
    light, matrix = blender_object.data, blender_object.matrix_world
    watts = _current.lights[light.name].watts(matrix, _current.warn)
    if light.type == "AREA":
        fields = lights.area(light, watts, matrix, _current.warn)
        if fields is None:
            return
    else:
        described, fields = lights.punctual(light, watts, _current.warn)
        of_gltf = node.extensions["KHR_lights_punctual"].extension["light"].extension
        of_gltf.update(described)
    if light.use_custom_distance:
        _current.warn(f"the custom distance of light '{light.name}' is ignored")
    if not light.use_shadow:
        _current.warn(f"light '{light.name}' casts shadows in Candela")
    _add(node, "light", {**fields, "inView": blender_object.visible_camera})


def _camera(node, blender_object):
    """The view, by its frame one unit before the camera: `sensor_fit` and shift are in it."""
    camera = blender_object.data
    corners = camera.view_frame(scene=_current.scene)
    is_perspective = camera.type == "PERSP"
    depth = -corners[0].z if is_perspective else 1.0
    xs = [c.x / depth for c in corners]
    ys = [c.y / depth for c in corners]
    width, height = max(xs) - min(xs), max(ys) - min(ys)
    if is_perspective:
        node.camera.perspective.yfov = 2 * math.atan(height / 2)
        node.camera.perspective.aspect_ratio = width / height
    else:
        node.camera.orthographic.xmag = width / 2
        node.camera.orthographic.ymag = height / 2
    fields = {"shift": [(max(xs) + min(xs)) / 2 / width, (max(ys) + min(ys)) / 2 / height]}
    dof = camera.dof
    if dof.use_dof and dof.aperture_fstop > 0:
        length = camera.lens / 1000 if is_perspective else 1.0
        fields["apertureRadius"] = length / (2 * dof.aperture_fstop)
        fields["focusDistance"] = max(1e-5, _focus(blender_object))
        if dof.aperture_blades > 2 or dof.aperture_ratio != 1:
            _current.warn(f"the aperture of camera '{camera.name}' is round in Candela")
    return fields


def _focus(blender_object):
    dof = blender_object.data.dof
    if dof.focus_object is None:
        return dof.focus_distance
    target = dof.focus_object.matrix_world
    if dof.focus_subtarget and dof.focus_object.type == "ARMATURE":
        bone = dof.focus_object.pose.bones.get(dof.focus_subtarget)
        target = target @ bone.matrix if bone else target
    place = blender_object.matrix_world.normalized()
    return abs((place.inverted() @ target.translation).z)


def write(scene, view_layer, depsgraph, folder: Path, warn) -> Path:
    """Exports the scene as its view layer is rendered; the file is in the folder.

    :param depsgraph: evaluated for rendering
    :param warn: is called with what is left out
    """
    global _current
    camera = scene.camera
    if camera is None:
        raise ExportError(f"scene '{scene.name}' has no camera")
    if camera.type != "CAMERA" or camera.data.type not in ("PERSP", "ORTHO"):
        raise ExportError(f"camera '{camera.name}' must be perspective or orthographic")
    render = scene.render
    if render.use_motion_blur:
        warn("motion blur is not supported; rendering the frame's moment")
    if render.pixel_aspect_x != render.pixel_aspect_y:
        warn("pixels that are not square are not supported; the picture is stretched")
    materials.check(depsgraph, warn)
    path = folder / FILE
    _current = _Export(scene, folder, warn, volumes.nodes(depsgraph, folder, warn))
    try:
        place = {"scene": scene, "view_layer": view_layer}
        if bpy.context.window is None:
            place["window"] = bpy.context.window_manager.windows[0]
        with bpy.context.temp_override(**place), _as_rendered(scene, view_layer), _quiet():
            bpy.ops.export_scene.gltf(
                filepath=str(path),
                export_format="GLB",
                use_active_scene=True,
                use_renderable=True,
                export_apply=True,
                export_cameras=True,
                export_lights=True,
                export_import_convert_lighting_mode="SPEC",
                export_gn_mesh=True,
                export_gpu_instances=True,
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
    return path


@contextmanager
def _quiet():
    """The exporter logs area lights as unsupported; `extras.candela` has them."""
    logger = logging.getLogger("glTFImporter")

    def is_right(record):
        return not record.getMessage().startswith("Unsupported light source")

    logger.addFilter(is_right)
    try:
        yield
    finally:
        logger.removeFilter(is_right)


@contextmanager
def _as_rendered(scene, view_layer):
    """The exporter reads what the viewport shows: for its time, that is what is rendered."""
    changes = []
    mode = _mode(view_layer)

    def put(owner, name, value):
        old = getattr(owner, name)
        if old != value:
            changes.append(lambda: setattr(owner, name, old))
            setattr(owner, name, value)

    try:
        for collection in scene.collection.children_recursive:
            put(collection, "hide_viewport", collection.hide_render)
        for layer in _layer_collections(view_layer.layer_collection):
            put(layer, "hide_viewport", False)
        for each in view_layer.objects:
            if not each.hide_render and each.hide_get(view_layer=view_layer):
                each.hide_set(False, view_layer=view_layer)
                changes.append(lambda each=each: each.hide_set(True, view_layer=view_layer))
        for each in scene.objects:
            if not each.hide_render:
                put(each, "hide_viewport", False)
            for modifier in each.modifiers:
                put(modifier, "show_viewport", modifier.show_render)
                if modifier.type in ("SUBSURF", "MULTIRES"):
                    put(modifier, "levels", modifier.render_levels)
            if each.type == "LIGHT":
                put(each.data, "use_temperature", False)
                if hasattr(each.data, "normalize"):
                    put(each.data, "normalize", True)
        put(scene.camera, "hide_render", False)
        yield
    finally:
        for undo in reversed(changes):
            undo()
        if mode is not None and bpy.ops.object.mode_set.poll():
            bpy.ops.object.mode_set(mode=mode)


def _mode(view_layer):
    """The mode to return to: the exporter leaves it."""
    active = view_layer.objects.active
    return active.mode if active is not None and active.mode != "OBJECT" else None


def _layer_collections(top):
    for layer in top.children:
        yield layer
        yield from _layer_collections(layer)


def names(path: Path):
    """A function: what a JSON pointer into the file refers to, in Blender's words."""
    with open(path, "rb") as file:
        file.seek(12)
        (length,) = struct.unpack("<I4x", file.read(8))
        root = json.loads(file.read(length))

    def name(pointer: str):
        words = pointer.strip("/").split("/")
        if len(words) < 2 or not words[1].isdigit():
            return None
        entries = root.get(words[0], [])
        index = int(words[1])
        found = entries[index].get("name") if index < len(entries) else None
        return f"{words[0][:-1] if words[0] != 'meshes' else 'mesh'} '{found}'" if found else None

    return name

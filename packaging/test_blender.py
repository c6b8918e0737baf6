"""Tests of the add-on for Blender, in PyPI's module bpy: python packaging/test_blender.py

CANDELA_PROGRAM names the program. Without it, or without bpy, nothing is tested.
"""

import contextlib
import io
import json
import math
import os
import struct
import sys
import tempfile
import threading
import types
import unittest
import zipfile
from pathlib import Path
from unittest import mock

PACKAGING = Path(__file__).resolve().parent
_HOME = tempfile.TemporaryDirectory(prefix="candela test ")
os.environ["BLENDER_USER_RESOURCES"] = _HOME.name

try:
    import bpy
    import bmesh
    import numpy as np
    from mathutils import Vector
except ImportError as missing:
    print(f"skipped: {missing}", file=sys.stderr)
    sys.exit(0)
if not os.path.isfile(os.environ.get("CANDELA_PROGRAM", "")):
    print("skipped: CANDELA_PROGRAM names no program", file=sys.stderr)
    sys.exit(0)

MODULE = "bl_ext.user_default.candela"
SIZE = (36, 24)


def zipped(path: Path):
    """The add-on, as `./sbt dist` makes it."""
    with zipfile.ZipFile(path, "w") as archive:
        for name, inside in (("blender", ""), ("python/candela", "candela/")):
            folder = PACKAGING / name
            for file in sorted(folder.glob("*")):
                if file.is_file():
                    archive.write(file, inside + file.name)


def setUpModule():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    file = Path(os.environ.get("CANDELA_ADDON", "")) if "CANDELA_ADDON" in os.environ else None
    if file is None:
        file = Path(_HOME.name) / "candela-blender.zip"
        zipped(file)
    bpy.ops.extensions.package_install_files(
        filepath=str(file), repo="user_default", enable_on_install=True
    )


def tearDownModule():
    part("candela").close()
    _HOME.cleanup()


def part(name):
    return sys.modules[f"{MODULE}.{name}"]


def material(name, color, emission=None):
    """Diffuse, or a light."""
    made = bpy.data.materials.new(name)
    if made.node_tree is None:
        made.use_nodes = True
    shader = next(n for n in made.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = 1
    shader.inputs["Specular IOR Level"].default_value = 0
    if emission is not None:
        shader.inputs["Emission Color"].default_value = (*emission, 1)
        shader.inputs["Emission Strength"].default_value = 8
    return made


def painted(*color, emission=None):
    """Paints the last object that was made."""
    made = bpy.context.object
    made.data.materials.clear()
    made.data.materials.append(material(made.name, color, emission))
    return made


class Scene:
    """A ball on a floor before a camera, and a dim world."""

    def __init__(self, world=0.0):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        for name in (MODULE, "cycles"):
            if name not in bpy.context.preferences.addons:
                bpy.ops.preferences.addon_enable(module=name)
        self.scene = bpy.context.scene
        render = self.scene.render
        render.resolution_x, render.resolution_y = SIZE
        render.threads_mode, render.threads = "FIXED", 1
        self.scene.world = bpy.data.worlds.new("World")
        if self.scene.world.node_tree is None:
            self.scene.world.use_nodes = True
        self.nodes = self.scene.world.node_tree.nodes
        self.background = next(n for n in self.nodes if n.type == "BACKGROUND")
        self.background.inputs["Color"].default_value = (0.5, 0.7, 1, 1)
        self.background.inputs["Strength"].default_value = world
        bpy.ops.mesh.primitive_plane_add(size=20)
        self.floor = painted(0.6, 0.5, 0.4)
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.8, location=(0, 0, 0.8))
        self.ball = painted(0.3, 0.5, 0.7)
        self.camera = bpy.data.cameras.new("Camera")
        self.scene.camera = self.put("Camera", self.camera, (0, -6, 3))

    def put(self, name, data, place, aim=(0, 0, 0.5)):
        made = bpy.data.objects.new(name, data)
        made.location = place
        towards = Vector(aim) - Vector(place)
        made.rotation_euler = towards.to_track_quat("-Z", "Y").to_euler()
        self.scene.collection.objects.link(made)
        return made

    def light(self, kind, place=(2, -2, 4), **fields):
        data = bpy.data.lights.new(kind, kind)
        for name, value in {"energy": 300, **fields}.items():
            setattr(data, name, value)
        return self.put(kind, data, place)

    def render(self, engine, samples=128, **wanted):
        """Red, green, blue and alpha, rows from below."""
        self.scene.render.engine = engine
        self.scene.candela.samples = self.scene.cycles.samples = samples
        for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "volume_bounces"):
            setattr(self.scene.cycles, name, 16)
        self.scene.cycles.use_denoising = self.scene.cycles.use_adaptive_sampling = False
        self.scene.cycles.sample_clamp_indirect = 0
        output = self.scene.render.image_settings
        output.file_format, output.color_mode, output.color_depth = "OPEN_EXR", "RGBA", "32"
        file = os.path.join(_HOME.name, "image.exr")
        self.scene.render.filepath = file
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(file, check_existing=False)
        image.alpha_mode = "CHANNEL_PACKED"
        pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
        image.pixels.foreach_get(pixels)
        shape = (image.size[1], image.size[0], 4)
        bpy.data.images.remove(image)
        return pixels.reshape(shape)

    def export(self):
        """The JSON of the exported scene, and the warnings."""
        warnings, models = [], []
        write, engine = part("export").write, part("engine")

        def keep(scene, view_layer, depsgraph, folder, warn):
            data = write(scene, view_layer, depsgraph, folder, warnings.append).read_bytes()
            (length,) = struct.unpack_from("<I", data, 12)
            models.append(json.loads(data[20 : 20 + length]))
            raise engine.Cancelled

        self.scene.render.engine = "CANDELA"
        with mock.patch.object(part("export"), "write", keep):
            bpy.ops.render.render()
        return models[0], warnings


def image_node(made, size):
    """On the floor: the shader and the node of an image, not linked."""
    tree = made.floor.data.materials[0].node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("wood", size, size, alpha=True)
    return next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), node


def papered(made):
    shader, node = image_node(made, 16)
    pixels = np.random.default_rng(1).random((16, 16, 4), np.float32)
    pixels[..., 3] = 1
    node.image.pixels.foreach_set(pixels.ravel())
    node.interpolation = "Closest"
    shader.id_data.links.new(node.outputs["Color"], shader.inputs["Base Color"])


def map_of_patches():
    """An environment of gradients with two lamps."""
    rows = 256
    y, x = np.mgrid[0:rows, 0 : 2 * rows] / rows
    pixels = np.dstack([0.2 + 0.4 * x, 0.3 + 0.5 * y, np.full_like(x, 0.6), np.ones_like(x)])
    pixels[160:192, 80:128, :3] = (40, 30, 20)
    pixels[96:112, 320:352, :3] = (2, 20, 3)
    image = bpy.data.images.new("sky", 2 * rows, rows, float_buffer=True)
    image.pixels.foreach_set(pixels.astype(np.float32).ravel())
    return image


def surrounded(kind):
    made = Scene(world=0.7)
    tree = made.scene.world.node_tree
    texture, mapping, place = (
        tree.nodes.new(f"ShaderNode{name}") for name in ("TexEnvironment", "Mapping", "TexCoord")
    )
    texture.image = map_of_patches()
    mapping.vector_type = kind
    mapping.inputs["Rotation"].default_value = (0.2, 0.1, 1)
    tree.links.new(place.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs[0], texture.inputs[0])
    tree.links.new(texture.outputs[0], made.background.inputs["Color"])
    return made


def instanced(made):
    """Cubes of a collection, in a row."""
    collection = bpy.data.collections.new("Cubes")
    bpy.ops.mesh.primitive_cube_add(size=0.4)
    cube = painted(0.8, 0.2, 0.2)
    made.scene.collection.objects.unlink(cube)
    collection.objects.link(cube)
    for k in range(6):
        holder = made.put(f"Cube {k}", None, (-2 + 0.8 * k, -1, 0.3))
        holder.instance_type, holder.instance_collection = "COLLECTION", collection
        holder.rotation_euler, holder.scale = (0, 0, 0.3 * k), (1, 1, 1 + 0.2 * k)


def scattered(made):
    """Cubes of geometry nodes, on a grid."""
    bpy.ops.mesh.primitive_cube_add(size=0.3)
    cube = painted(0.8, 0.2, 0.2)
    cube.hide_render = True
    grid = {"x_subdivisions": 4, "y_subdivisions": 4, "size": 4}
    bpy.ops.mesh.primitive_grid_add(location=(0, 0, 0.2), **grid)
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    scatter = tree.nodes.new("GeometryNodeInstanceOnPoints")
    source = tree.nodes.new("GeometryNodeObjectInfo")
    source.inputs["Object"].default_value = cube
    source.inputs["As Instance"].default_value = True
    tree.links.new(start.outputs[0], scatter.inputs["Points"])
    tree.links.new(source.outputs["Geometry"], scatter.inputs["Instance"])
    tree.links.new(scatter.outputs[0], end.inputs[0])
    bpy.context.object.modifiers.new("Scatter", "NODES").node_group = tree


def subdivided(made):
    bpy.ops.mesh.primitive_cube_add(size=1.5, location=(1.6, 0, 0.8))
    modifier = painted(0.8, 0.5, 0.1).modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = 0, 3


def lit(world=0.6, **fields):
    made = Scene(world)
    made.light("POINT")
    for name, value in fields.items():
        setattr(made.camera, name, value)
    return made


def tall(made):
    made.scene.render.resolution_x, made.scene.render.resolution_y = SIZE[::-1]
    return made


def lamp(kind, world=0.0, **fields):
    made = Scene(world)
    made.light(kind, **fields)
    return made


def changed(made, change):
    change(made)
    return made


def focused(made):
    made.camera.dof.use_dof = True
    made.camera.dof.aperture_fstop, made.camera.dof.focus_distance = 0.1, 4


def glowing(made):
    bpy.ops.mesh.primitive_cube_add(size=0.5, location=(1.5, -0.5, 0.6))
    painted(0, 0, 0, emission=(1, 0.5, 0.2))


def glowing_in_part(made):
    glowing(made)
    shader = bpy.context.object.active_material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Alpha"].default_value = 0.5


def without_floor(made):
    bpy.data.objects.remove(made.floor)
    made.scene.render.film_transparent = True


def bordered(made):
    render = made.scene.render
    render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x = 0.25, 0.75
    render.border_min_y, render.border_max_y = 0.1, 0.6


def stretched(made):
    made.light("AREA", size=1, energy=150).scale = (2, 1, 1)


def in_view(made):
    made.light("AREA", place=(0, 1.5, 1.5), size=1).visible_camera = True


def graded(made):
    made.scene.view_settings.exposure = 2


def openvdb():
    part("volumes")._openvdb()
    return sys.modules["openvdb"]


def stored(grid, name="density"):
    """A volume of a file of one grid. Blender keeps what it has read, by the file's name."""
    grid.name = name
    file = os.path.join(_HOME.name, f"{len(os.listdir(_HOME.name))}.vdb")
    openvdb().write(file, grids=[grid])
    data = bpy.data.volumes.new("Cloud")
    data.filepath = file
    return data


def cloud(name="density"):
    """A lumpy grid in a file, away from its origin, its rows of different lengths."""
    vdb = openvdb()
    z, y, x = np.meshgrid(*(np.linspace(0, 1, n) for n in (21, 17, 33)), indexing="ij")
    lumps = np.sin(7 * x) * np.cos(9 * y) * np.sin(5 * z) + 0.4 * x - 0.2 * z
    grid = vdb.FloatGrid()
    grid.copyFromArray(np.maximum(0, 3 * lumps).astype(np.float32).transpose(2, 1, 0), (-9, 5, -30))
    grid.transform = vdb.createLinearTransform(voxelSize=0.06)
    return stored(grid, name)


def tiled():
    """Slabs of equal voxels, in several nodes, in a turned grid."""
    vdb = openvdb()
    grid = vdb.FloatGrid()
    grid.fill((-150, -20, -140), (150, 60, 40), 0.8)
    grid.fill((-90, 4100, -200), (100, 4300, -64), 1.7)
    rows = [[0.006, 0.003, 0, 0], [-0.0002, 0.0004, 0, 0], [0, 0, 0.006, 0], [0.1, 0.1, -0.3, 1]]
    grid.transform = vdb.createLinearTransform(rows)
    return stored(grid)


def filled(data, kind, **inputs):
    """Gives the data a material of one node."""
    made = bpy.data.materials.new("Matter")
    if made.node_tree is None:
        made.use_nodes = True
    tree = made.node_tree
    node = tree.nodes.new(f"ShaderNode{kind}")
    for name, value in inputs.items():
        node.inputs[name.replace("_", " ")].default_value = value
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    tree.links.new(node.outputs[0], output.inputs["Volume"])
    tree.links.remove(output.inputs["Surface"].links[0])
    data.materials.clear()
    data.materials.append(made)
    return node, tree


def clouded(make=cloud, **inputs):
    made = lit(world=1)
    data = make()
    filled(data, "VolumePrincipled", **inputs)
    made.cloud = made.put("Cloud", data, (-0.2, -1.2, 2.4))
    made.cloud.rotation_euler = (0.3, 0.5, 1)
    return made


def scaled(made):
    made.cloud.scale = (1.5, 0.7, 1.2)


def of_world(made):
    scaled(made)
    made.cloud.data.render.space = "WORLD"


def within(made):
    made.cloud.scale = (8, 8, 8)
    made.cloud.location = (0, -8, 10)


def several(made):
    """The cloud of a collection, twice."""
    collection = bpy.data.collections.new("Clouds")
    made.scene.collection.objects.unlink(made.cloud)
    collection.objects.link(made.cloud)
    made.cloud.location = (0, 0, 0)
    for k in range(2):
        holder = made.put(f"Holder {k}", None, (3.4 * k - 1.2, -1, 2 - k / 2))
        holder.instance_type, holder.instance_collection = "COLLECTION", collection
        holder.rotation_euler, holder.scale = (0, 0, 1 + k), (0.8, 0.8, 1 + 0.5 * k)


def generated(made):
    """A volume of geometry nodes, around a cube."""
    bpy.ops.mesh.primitive_cube_add(size=1.2, location=(1.2, -1, 1.2))
    tree = bpy.data.node_groups.new("Fill", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    fill = tree.nodes.new("GeometryNodeMeshToVolume")
    fill.inputs["Density"].default_value = 2
    tree.links.new(start.outputs[0], fill.inputs[0])
    tree.links.new(fill.outputs[0], end.inputs[0])
    bpy.context.object.modifiers.new("Fill", "NODES").node_group = tree


def fog(**inputs):
    """A cube of fog."""
    made = lit(world=1)
    bpy.ops.mesh.primitive_cube_add(size=1.6, location=(0.8, -1, 1.2), rotation=(0.2, 0.4, 1))
    made.node, _ = filled(bpy.context.object.data, "VolumePrincipled", **inputs)
    return made


def added(made):
    """Scattering and absorption, each by a part of the density."""
    tree = filled(made.cloud.data, "VolumeScatter", Color=(0.2, 0.6, 0.9, 1), Density=2)[1]
    scatter = next(n for n in tree.nodes if n.type == "VOLUME_SCATTER")
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    absorb, add, info, times = (
        tree.nodes.new(f"ShaderNode{name}")
        for name in ("VolumeAbsorption", "AddShader", "VolumeInfo", "Math")
    )
    scatter.inputs["Anisotropy"].default_value = 0.5
    absorb.inputs["Color"].default_value = (0.9, 0.5, 0.3, 1)
    times.operation = "MULTIPLY"
    times.inputs[1].default_value = 1.5
    tree.links.new(info.outputs["Density"], times.inputs[0])
    for node in (scatter, absorb):
        tree.links.new(times.outputs[0], node.inputs["Density"])
    tree.links.new(scatter.outputs[0], add.inputs[0])
    tree.links.new(absorb.outputs[0], add.inputs[1])
    tree.links.new(add.outputs[0], output.inputs["Volume"])


def on_floor(made, kind, factor=0.5):
    """Gives the floor a surface: a shader, or its own mixed with that one."""
    tree = made.floor.data.materials[0].node_tree
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    shader = tree.nodes.new(f"ShaderNode{kind}")
    if factor is not None:
        mix = tree.nodes.new("ShaderNodeMixShader")
        mix.inputs[0].default_value = factor
        tree.links.new(output.inputs["Surface"].links[0].from_socket, mix.inputs[1])
        tree.links.new(shader.outputs[0], mix.inputs[2])
        shader = mix
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return tree


def emitting(made):
    """Adds light to the floor."""
    tree = on_floor(made, "Emission", None)
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    add = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(output.inputs[0].links[0].from_socket, add.inputs[0])
    tree.links.new(tree.nodes["Principled BSDF"].outputs[0], add.inputs[1])
    tree.links.new(add.outputs[0], output.inputs[0])


def unpainted(made):
    """A ball without a material, and one with an empty slot."""
    made.ball.data.materials.clear()
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, location=(1.5, 0, 0.5))
    bpy.context.object.data.materials.append(None)


def without_surface(made):
    tree = made.floor.data.materials[0].node_tree
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    tree.links.remove(output.inputs["Surface"].links[0])


def principled(made, **inputs):
    """The ball, smooth."""
    tree = made.ball.data.materials[0].node_tree
    shader = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    for name, value in {"Specular IOR Level": 0.5, "Roughness": 0, **inputs}.items():
        shader.inputs[name.replace("_", " ")].default_value = value
    for face in made.ball.data.polygons:
        face.use_smooth = True
    made.ball.modifiers.new("Subdivision", "SUBSURF").render_levels = 2
    return made


def glass(**inputs):
    inputs = {"Transmission_Weight": 1, "IOR": 1.45, **inputs}
    return principled(lit(world=1, lens=90), **inputs)


def with_output(made):
    """Another of EEVEE, which is active."""
    tree = made.floor.data.materials[0].node_tree
    shader, output = (tree.nodes.new(f"ShaderNode{n}") for n in ("Emission", "OutputMaterial"))
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    output.target, output.is_active_output = "EEVEE", True


def muted(made):
    made.floor.data.materials[0].node_tree.nodes["Principled BSDF"].mute = True
    made.background.inputs["Strength"].default_value = 5
    made.background.mute = True


def without_image(made):
    shader, node = image_node(made, 2)
    node.image = None
    shader.id_data.links.new(node.outputs["Color"], shader.inputs["Base Color"])


def keyed(made):
    """A ball that a shape key moves, and one that shows a shape key alone."""
    made.ball.shape_key_add(name="Basis")
    for shown in ("value", "show_only_shape_key"):
        key = made.ball.shape_key_add(name=shown, from_mix=False)
        for point in key.data:
            point.co.x += 1
    made.ball.data.shape_keys.key_blocks["value"].value = 0.7
    other = bpy.data.objects.new("Other", made.ball.data)
    other.location = (-2, 1, 0.8)
    made.scene.collection.objects.link(other)
    other.show_only_shape_key, other.active_shape_key_index = True, 2


def held(made, bone=(1.5, 0, 0)):
    """The ball on a posed bone."""
    bpy.ops.object.armature_add(location=(0, 0, 0))
    armature = bpy.context.object
    armature.pose.bones[0].location = bone
    made.ball.parent, made.ball.parent_type = armature, "BONE"
    made.ball.parent_bone = "Bone"


def sheared(made):
    """The ball turned below a scaled parent."""
    parent = made.put("Parent", None, (0, 0, 0))
    parent.rotation_euler, parent.scale = (0, 0, 0), (3, 1, 1)
    made.ball.parent, made.ball.rotation_euler = parent, (0, 0.8, 0)
    made.ball.scale = (1, 1, 0.1)


def collected(made, *members):
    """The layer's view of a collection within another, and the outer collection."""
    outer, inner = bpy.data.collections.new("Outer"), bpy.data.collections.new("Inner")
    made.scene.collection.children.link(outer)
    outer.children.link(inner)
    for each in members:
        made.scene.collection.objects.unlink(each)
        inner.objects.link(each)
    layer = bpy.context.view_layer.layer_collection.children["Outer"]
    return layer.children["Inner"], outer


def excluded(made):
    """A ball and a light that aren't rendered, but for the ball's instance."""
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, location=(0, 0, 0.5))
    layer, _ = collected(made, bpy.context.object, made.light("POINT", (-2, -2, 3)))
    holder = made.put("Holder", None, (1.6, 0, 0))
    holder.rotation_euler = (0, 0, 0)
    holder.instance_type, holder.instance_collection = "COLLECTION", layer.collection
    layer.exclude = True


def hidden(made):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, location=(1.6, 0, 0.5))
    _, outer = collected(made, bpy.context.object, made.light("POINT", (-2, -2, 3)))
    outer.hide_render = True


def grown(made):
    """Boxes on the ball, of geometry that no object has."""
    tree = bpy.data.node_groups.new("Grow", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    box, paint, scatter = (
        tree.nodes.new(f"GeometryNode{name}")
        for name in ("MeshCube", "SetMaterial", "InstanceOnPoints")
    )
    box.inputs["Size"].default_value = (0.1, 0.1, 0.3)
    paint.inputs["Material"].default_value = material("Box", (0.8, 0.2, 0.2))
    tree.links.new(box.outputs[0], paint.inputs["Geometry"])
    tree.links.new(start.outputs[0], scatter.inputs["Points"])
    tree.links.new(paint.outputs[0], scatter.inputs["Instance"])
    tree.links.new(scatter.outputs[0], end.inputs[0])
    made.ball.modifiers.new("Grow", "NODES").node_group = tree


def edited(made):
    """The ball, moved in edit mode."""
    bpy.context.view_layer.objects.active = made.ball
    bpy.ops.object.mode_set(mode="EDIT")
    mesh = bmesh.from_edit_mesh(made.ball.data)
    bmesh.ops.translate(mesh, verts=mesh.verts, vec=(1, 0, 0))
    bmesh.update_edit_mesh(made.ball.data)


def animated(made):
    """The ball's color is red at the frame that is rendered alone."""
    tree = made.ball.data.materials[0].node_tree
    socket = tree.nodes["Principled BSDF"].inputs["Base Color"]
    for frame, color in ((1, (0.1, 0.1, 0.8, 1)), (5, (0.8, 0.1, 0.1, 1))):
        socket.default_value = color
        socket.keyframe_insert("default_value", frame=frame)
    made.scene.frame_set(1)
    made.scene.frame_current = 5


def mapped_thrice(made):
    """The floor's image by the last of three UV maps."""
    papered(made)
    mesh = made.floor.data
    for name in ("second", "third"):
        mesh.uv_layers.new(name=name)
    for corner in mesh.uv_layers["third"].data:
        corner.uv = 4 * corner.uv
    tree = mesh.materials[0].node_tree
    node = tree.nodes.new("ShaderNodeUVMap")
    node.uv_map = "third"
    texture = next(n for n in tree.nodes if n.type == "TEX_IMAGE")
    tree.links.new(node.outputs[0], texture.inputs["Vector"])


def sheared_camera(made):
    parent = made.put("Parent", None, (0, 0, 0))
    parent.rotation_euler, parent.scale = (0, 0, 0), (2, 1, 1)
    made.scene.camera.parent = parent
    made.scene.camera.rotation_euler = (1.2, 0.5, 0.2)


def without_sky(made):
    bpy.context.view_layer.use_sky = False


def mirrored(made):
    glowing(made)
    made.scene.camera.scale = (-2, 2, 2)


def exposed(made):
    made.scene.cycles.film_exposure = 2


def overridden(made):
    layer = bpy.context.view_layer
    layer.material_override = material("Override", (0.8, 0.2, 0.1))
    if hasattr(layer, "world_override"):
        layer.world_override = made.scene.world.copy()
        nodes = layer.world_override.node_tree.nodes
        nodes["Background"].inputs["Color"].default_value = (0.2, 0.9, 0.1, 1)


def with_portal(made):
    made.light("AREA", (0, 0, 4), size=2).data.cycles.is_portal = True


SCENES = {
    "world": lambda: Scene(0.6),
    "sensor fitted": lambda: lit(lens=35),
    "sensor fitted to a tall image": lambda: tall(lit(lens=40, shift_x=-0.1)),
    "sensor's height, shifted": lambda: lit(
        sensor_fit="VERTICAL", lens=30, shift_x=0.15, shift_y=-0.1
    ),
    "sensor's width in a tall image": lambda: tall(
        lit(sensor_fit="HORIZONTAL", lens=25, shift_y=0.1)
    ),
    "orthographic": lambda: lit(type="ORTHO", ortho_scale=5, shift_x=0.1),
    "depth of field": lambda: changed(lit(), focused),
    "point": lambda: lamp("POINT", color=(1, 0.8, 0.6)),
    "point with a radius": lambda: lamp("POINT", shadow_soft_size=0.5, use_soft_falloff=False),
    "spot": lambda: lamp("SPOT", energy=900, spot_size=0.9, spot_blend=0.5),
    "spot with a radius": lambda: lamp(
        "SPOT", energy=900, spot_size=0.9, spot_blend=0.3, shadow_soft_size=0.4,
        use_soft_falloff=False,
    ),
    "sun": lambda: lamp("SUN", energy=3, color=(1, 0.9, 0.7)),
    "sun with an angle": lambda: lamp("SUN", energy=3, angle=0.5),
    "square": lambda: lamp("AREA", size=1.5),
    "rectangle": lambda: lamp("AREA", world=0.3, shape="RECTANGLE", size=2, size_y=0.5),
    "disk": lambda: lamp("AREA", shape="DISK", size=1.5),
    "ellipse": lambda: lamp("AREA", shape="ELLIPSE", size=2, size_y=0.6),
    "spread": lambda: lamp("AREA", size=1, spread=math.radians(60)),
    "scaled area": lambda: changed(Scene(), stretched),
    "area in view": lambda: changed(Scene(), in_view),
    "temperature": lambda: lamp("AREA", size=1, use_temperature=True, temperature=3500),
    "world of an image": lambda: surrounded("POINT"),
    "world of an image, turned back": lambda: surrounded("TEXTURE"),
    "collection instances": lambda: changed(lit(), instanced),
    "geometry nodes": lambda: changed(lit(), scattered),
    "subdivision": lambda: changed(lit(), subdivided),
    "transparent film": lambda: changed(lit(), without_floor),
    "emission": lambda: changed(Scene(), glowing),
    "emission of a half": lambda: changed(Scene(), glowing_in_part),
    "image": lambda: changed(lit(world=1), papered),
    "no material": lambda: changed(lit(), unpainted),
    "no surface": lambda: changed(lit(), without_surface),
    "glass": lambda: glass(Base_Color=(1, 1, 1, 1)),
    "tinted glass": lambda: glass(Base_Color=(0.8, 0.4, 0.2, 1)),
    "partial glass": lambda: glass(Base_Color=(0.5, 0.5, 0.5, 1), Transmission_Weight=0.5),
    "index of refraction": lambda: principled(lit(world=1, lens=90), Roughness=0.2, IOR=3),
    "emission, added": lambda: changed(lit(), emitting),
    "another output": lambda: changed(lit(), with_output),
    "muted nodes": lambda: changed(lit(), muted),
    "no image": lambda: changed(lit(), without_image),
    "transparent": lambda: changed(lit(), lambda made: on_floor(made, "BsdfTransparent", None)),
    "mixed with transparent": lambda: changed(
        lit(), lambda made: on_floor(made, "BsdfTransparent", 0.7)
    ),
    "shape keys": lambda: changed(lit(), keyed),
    "posed bone": lambda: changed(lit(), held),
    "sheared": lambda: changed(lit(), sheared),
    "excluded collection": lambda: changed(lit(), excluded),
    "hidden collection": lambda: changed(lit(), hidden),
    "geometry of nodes, instanced": lambda: changed(lit(), grown),
    "edit mode": lambda: changed(lit(), edited),
    "animated material": lambda: changed(lit(), animated),
    "three UV maps": lambda: changed(lit(), mapped_thrice),
    "sheared camera": lambda: changed(lit(), sheared_camera),
    "no sky": lambda: changed(lit(), without_sky),
    "mirrored camera": lambda: changed(lit(), mirrored),
    "overrides": lambda: changed(lit(), overridden),
    "portal": lambda: changed(lit(), with_portal),
    "exposure": lambda: changed(lit(), exposed),
    "exposure of the view": lambda: changed(lit(), graded),
    "border": lambda: changed(lit(), bordered),
    "volume": lambda: clouded(Color=(0.9, 0.6, 0.3, 1), Density=3),
    "volume without a material": lambda: changed(
        clouded(), lambda made: made.cloud.data.materials.clear()
    ),
    "volume that absorbs": lambda: clouded(
        Color=(0.3, 0.5, 0.7, 1), Absorption_Color=(0.5, 0.2, 0.1, 1), Density=4, Anisotropy=0.6
    ),
    "volume of tiles": lambda: clouded(tiled, Density=4),
    "volume, scaled": lambda: changed(clouded(Density=3), scaled),
    "volume, scaled, of the world": lambda: changed(clouded(Density=3), of_world),
    "volume around the camera": lambda: changed(clouded(Density=2), within),
    "volume of two nodes": lambda: changed(clouded(), added),
    "volumes of a collection": lambda: changed(clouded(Density=3), several),
    "volume of geometry nodes": lambda: changed(lit(world=1), generated),
    "fog in a mesh": lambda: fog(Color=(0.9, 0.6, 0.3, 1), Density=1.5, Anisotropy=-0.4),
    "fog that emits": lambda: fog(
        Color=(0.3, 0.3, 0.3, 1), Emission_Strength=0.5, Emission_Color=(1, 0.5, 0.1, 1)
    ),
}


class AgainstCycles(unittest.TestCase):
    def test_each_scene_is_as_bright_as_in_cycles(self):
        for name, make in SCENES.items():
            with self.subTest(name):
                made = make()
                expected, found = made.render("CYCLES"), made.render("CANDELA")
                self.assertEqual(found.shape, expected.shape)
                # Both have noise of 1 % of the mean at most
                means, limits = found.mean((0, 1)), expected.mean((0, 1))
                np.testing.assert_allclose(means, limits, rtol=0.03, atol=1e-3)
                # Quarters of the image, so that nothing is mirrored
                for half in np.array_split(np.arange(found.shape[0]), 2):
                    for side in np.array_split(np.arange(found.shape[1]), 2):
                        at = np.ix_(half, side)
                        near = 0.06 * expected.mean()
                        np.testing.assert_allclose(
                            found[at].mean((0, 1)), expected[at].mean((0, 1)), rtol=0.06, atol=near
                        )


class Rendering(unittest.TestCase):
    def test_passes_are_those_of_cycles(self):
        made = lit()
        layer = bpy.context.view_layer
        layer.use_pass_z = layer.use_pass_normal = layer.candela.use_pass_albedo = True
        images = {}
        for engine in ("CYCLES", "CANDELA"):
            made.render(engine)
            settings = made.scene.render.image_settings
            if hasattr(settings, "media_type"):
                settings.media_type = "MULTI_LAYER_IMAGE"
            settings.file_format = "OPEN_EXR_MULTILAYER"
            if hasattr(settings, "use_exr_interleave"):
                settings.use_exr_interleave = True  # one part
            made.scene.render.filepath = os.path.join(_HOME.name, "layers.exr")
            bpy.ops.render.render(write_still=True)
            images[engine] = part("candela").load(made.scene.render.filepath)
            if hasattr(settings, "media_type"):
                settings.media_type = "IMAGE"

        def values(engine, name):
            found = images[engine].layers
            return next(v for key, v in found.items() if f"{name}." in f"{key}.")

        for name in ("Depth", "Normal"):
            expected, found = values("CYCLES", name), values("CANDELA", name)
            # Edges of the ball are where the filters put them, and the horizon is far
            near = np.isclose(found, expected, rtol=0.02, atol=0.05)
            self.assertGreater(near.mean(), 0.8, name)
        self.assertAlmostEqual(float(values("CANDELA", "Albedo")[-1, 0, 0]), 0.6, delta=0.02)

    def test_each_frame_is_the_scene_at_its_time(self):
        made = Scene(1.0)
        made.ball.location.x = -9
        made.ball.keyframe_insert("location", frame=1)
        made.ball.location.x = 0
        made.ball.keyframe_insert("location", frame=2)
        made.scene.frame_start, made.scene.frame_end = 1, 2
        made.render("CANDELA", samples=4)
        made.scene.render.filepath = os.path.join(_HOME.name, "frame####")
        bpy.ops.render.render(animation=True)
        means = []
        for frame in ("frame0001", "frame0002"):
            image = part("candela").load(os.path.join(_HOME.name, f"{frame}.exr"))
            means.append(float(image.rgb[..., 0].mean()))
        self.assertGreater(abs(means[0] / means[1] - 1), 0.02)

    def test_what_ends_a_rendering_is_said(self):
        made = Scene(1.0)
        made.scene.render.engine = "CANDELA"
        made.scene.camera = None
        with self.assertRaisesRegex(RuntimeError, "no camera"):
            bpy.ops.render.render()
        made.scene.camera = bpy.data.objects["Camera"]
        preferences = bpy.context.preferences.addons[MODULE].preferences
        file = os.path.join(_HOME.name, "program")
        try:
            for text, mode, said in (
                (None, 0, "Preferences"),
                ("no program", 0o644, "can't start .*program: Permission denied"),
                ("no program", 0o755, "can't start .*program: Exec format error"),
                ("#!/bin/sh\nexit 3", 0o755, "has ended with exit code 3"),
                ("#!/bin/sh\nexit 0", 0o755, "Program in the add-on's preferences: .*program"),
            ):
                if text is not None:
                    Path(file).write_text(text)
                    os.chmod(file, mode)
                preferences.program = file
                with self.assertRaisesRegex(RuntimeError, said):
                    bpy.ops.render.render()
        finally:
            preferences.program = ""

    def test_an_exception_is_an_error_of_the_rendering(self):
        made = Scene(1.0)
        made.scene.render.engine = "CANDELA"
        with mock.patch.object(part("export"), "write", side_effect=OSError("the disk is full")):
            with contextlib.redirect_stderr(io.StringIO()) as printed:
                with self.assertRaisesRegex(RuntimeError, "OSError: the disk is full"):
                    bpy.ops.render.render()
        self.assertIn("Traceback", printed.getvalue())

    def test_escape_ends_a_rendering_and_keeps_its_image(self):
        made = lit()
        made.scene.render.engine = "CANDELA"
        made.scene.candela.samples = 1_000_000
        engine = Listener(after=1.0)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        with tempfile.TemporaryDirectory() as folder:
            part("engine")._Rendering(engine, depsgraph, Path(folder)).run()
        self.assertGreater(max(engine.progress), 0)
        self.assertGreater(engine.passes["Combined"].rect.values.mean(), 0)

    def test_what_reads_blender_runs_in_its_main_thread(self):
        run = part("engine")._on_main_thread
        self.assertIs(run(threading.current_thread, lambda: False), threading.main_thread())
        found, timers = [], []
        fake = types.SimpleNamespace(
            register=timers.append, is_registered=timers.__contains__, unregister=timers.remove
        )
        module = part("engine")
        real, module.bpy = module.bpy, types.SimpleNamespace(app=types.SimpleNamespace(timers=fake))
        try:
            words = (threading.current_thread, lambda: False)
            other = threading.Thread(target=lambda: found.append(run(*words)))
            other.start()
            while not timers:
                pass
            timers[0]()
            other.join()
        finally:
            module.bpy = real
        self.assertEqual(found, [threading.main_thread()])


class Listener:
    """A render engine that is ended after some seconds of rendering."""

    is_animation = False

    def __init__(self, after):
        self._after, self._line, self.progress = after, "", [0.0]
        fills = types.SimpleNamespace
        self.passes = {"Combined": fills(rect=fills(foreach_set=self._set, values=np.zeros(1)))}

    def _set(self, values):
        self.passes["Combined"].rect.values = values

    def test_break(self):
        return self.progress[-1] > 0

    def update_progress(self, done):
        self.progress.append(done)

    def update_stats(self, title, line):
        self._line = line

    def report(self, kind, text):
        pass

    def begin_result(self, *place, layer):
        return types.SimpleNamespace(layers=[types.SimpleNamespace(passes=self.passes)])

    def update_result(self, result):
        pass

    def end_result(self, result, cancel):
        pass


def blocks():
    """The names of all data-blocks."""
    kinds = [getattr(bpy.data, name) for name in dir(bpy.data)]
    return [
        [each.name_full for each in kind]
        for kind in kinds
        if isinstance(kind, bpy.types.bpy_prop_collection)
    ]


class Exporting(unittest.TestCase):
    def test_the_open_scene_is_as_it_was(self):
        made = lit()
        subdivided(made)
        cube, modifier = bpy.context.object, bpy.context.object.modifiers[0]
        made.ball.hide_set(True)
        made.floor.hide_viewport = True
        lamp = made.light("SPOT", use_temperature=True)
        bpy.ops.object.mode_set(mode="EDIT")
        made.export()  # Blender makes an image
        before = blocks()
        model, _ = made.export()
        self.assertEqual(blocks(), before)
        self.assertEqual(bpy.context.object, cube)
        self.assertEqual((modifier.levels, modifier.render_levels), (0, 3))
        self.assertTrue(made.ball.hide_get() and made.floor.hide_viewport)
        self.assertTrue(lamp.data.use_temperature)
        self.assertEqual(cube.mode, "EDIT")
        names = {node["name"] for node in model["nodes"] if "mesh" in node}
        self.assertEqual(names, {made.ball.name, made.floor.name, cube.name})

    def test_other_exports_have_no_extras(self):
        lit()
        file = os.path.join(_HOME.name, "plain.gltf")
        with contextlib.redirect_stdout(io.StringIO()):
            options = {"export_format": "GLTF_SEPARATE", "export_lights": True}
            bpy.ops.export_scene.gltf(filepath=file, **options)
        self.assertNotIn("extras", Path(file).read_text())

    def test_what_is_left_out_is_named(self):
        made = lit()
        tree = made.ball.data.materials[0].node_tree
        shader = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
        noise = tree.nodes.new("ShaderNodeTexNoise")
        tree.links.new(noise.outputs["Color"], shader.inputs["Base Color"])
        made.put("Smoke", bpy.data.volumes.new("Smoke"), (0, 0, 0))
        sky = made.nodes.new("ShaderNodeTexSky")
        made.scene.world.node_tree.links.new(sky.outputs[0], made.background.inputs["Color"])
        made.camera.dof.use_dof, made.camera.dof.aperture_blades = True, 5
        _, warnings = made.export()
        for name in (noise.name, "Smoke", sky.name, "camera 'Camera'"):
            self.assertTrue(any(name in text for text in warnings), (name, warnings))
        _, none = lit().export()
        self.assertEqual(none, [])

    def test_what_gltf_reads_otherwise_is_named_with_its_material_and_node(self):
        def warnings(change):
            made = lit()
            tree = made.floor.data.materials[0].node_tree
            shader = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
            change(made, tree, shader)
            return made.export()[1]

        def set_input(name, value):
            return lambda made, tree, shader: setattr(shader.inputs[name], "default_value", value)

        def linked(kind, name, output=0, **fields):
            def change(made, tree, shader):
                node = tree.nodes.new(f"ShaderNode{kind}")
                for field, value in fields.items():
                    setattr(node, field, value)
                tree.links.new(node.outputs[output], shader.inputs[name])

            return change

        def mapped(made, tree, shader):
            papered(made)
            mapping = tree.nodes.new("ShaderNodeMapping")
            mapping.inputs["Rotation"].default_value[0] = 1
            node = next(n for n in tree.nodes if n.type == "TEX_IMAGE")
            tree.links.new(mapping.outputs[0], node.inputs[0])

        def tinted(made, tree, shader):
            on_floor(made, "BsdfTransparent")
            node = next(n for n in tree.nodes if n.type == "BSDF_TRANSPARENT")
            node.inputs[0].default_value = (1, 0.5, 0.5, 1)

        def muted(made, tree, shader):
            papered(made)
            next(n for n in tree.nodes if n.type == "TEX_IMAGE").mute = True

        def muted_link(made, tree, shader):
            papered(made)
            next(link for link in tree.links if link.to_node == shader).is_muted = True

        def lost_file(made, tree, shader):
            papered(made)
            image = next(n for n in tree.nodes if n.type == "TEX_IMAGE").image
            image.source, image.filepath = "FILE", "//no such file.png"
            image.reload()

        def tinted_glass(made, tree, shader):
            papered(made)
            shader.inputs["Transmission Weight"].default_value = 1

        def cubic(made, tree, shader):
            papered(made)
            next(n for n in tree.nodes if n.type == "TEX_IMAGE").interpolation = "Cubic"

        def hot(made, tree, shader):
            node = image_node(made, 2)[1]
            node.image = bpy.data.images.new("hot", 2, 2, float_buffer=True)
            node.image.pixels.foreach_set([2.0] * 16)
            tree.links.new(node.outputs[0], shader.inputs["Emission Color"])

        def tiled_image(made, tree, shader):
            node = image_node(made, 2)[1]
            node.image = bpy.data.images.new("tiles", 2, 2, tiled=True)
            tree.links.new(node.outputs[0], shader.inputs["Emission Color"])

        def bent(made, tree, shader):
            linked("NormalMap", "Normal")(made, tree, shader)
            next(n for n in tree.nodes if n.type == "NORMAL_MAP").inputs[1].default_value[0] = 0.8

        def metal(made, tree, shader):
            shader.inputs["Metallic"].default_value = 0.5
            shader.inputs["Specular Tint"].default_value = (1, 0.5, 1, 1)
            shader.distribution = "MULTI_GGX"

        def sequence(made, tree, shader):
            papered(made)
            image = next(n for n in tree.nodes if n.type == "TEX_IMAGE").image
            image.filepath_raw = os.path.join(_HOME.name, "wood1.png")
            image.file_format = "PNG"
            image.save()
            image.source, image.alpha_mode = "SEQUENCE", "CHANNEL_PACKED"

        def within_world(made, tree, shader):
            linked("NormalMap", "Normal", space="WORLD")(made, tree, shader)

        def of_object(made, tree, shader):
            linked("Attribute", "Base Color", attribute_type="OBJECT")(made, tree, shader)

        def grouped(made, tree, shader):
            group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
            group.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
            color, end = group.nodes.new("ShaderNodeRGB"), group.nodes.new("NodeGroupOutput")
            color.outputs[0].keyframe_insert("default_value", frame=1)
            group.links.new(color.outputs[0], end.inputs[0])
            linked("Group", "Base Color", node_tree=group)(made, tree, shader)

        unread = "glTF has no node {}; rendered without".format
        lost = "{} of node 'Principled BSDF' is not supported".format
        is_muted = "{} is muted, but used".format
        for change, text in (
            (lambda made, *_: on_floor(made, "BsdfGlossy"), unread("'Glossy BSDF', 'Mix Shader'")),
            (lambda made, *_: on_floor(made, "Emission"), unread("'Mix Shader'")),
            (tinted, "the color of node 'Transparent BSDF' is not supported; white is used"),
            (linked("Math", "Roughness", operation="SUBTRACT"), unread("'Math'")),
            (linked("Mix", "Base Color", 2, data_type="RGBA"), unread("'Mix'")),
            (linked("VertexColor", "Emission Color"), unread("'Color Attribute'")),
            (mapped, unread("'Mapping'")),
            (muted, is_muted("node 'Image Texture'")),
            (muted_link, is_muted("a link to node 'Principled BSDF'")),
            (lambda made, *_: without_image(made), "node 'Image Texture': it has no image"),
            (tinted_glass, lost("a linked color of glass")),
            (cubic, "the interpolation of node 'Image Texture' is linear, not Cubic"),
            (hot, "image 'hot' is rendered with values of at most 1"),
            (tiled_image, "the tiles of image 'tiles' are no files of PNG, JPEG or WebP; left out"),
            (linked("NormalMap", "Normal"), None),
            (bent, unread("'Normal Map'")),
            (lambda made, *_: emitting(made), None),
            (sequence, "image 'wood' is not supported as a sequence"),
            (within_world, unread("'Normal Map'")),
            (of_object, unread("'Attribute'")),
            (grouped, "the animation within group 'Group' is not supported"),
            (lost_file, "node 'Image Texture': image 'wood' can't be read"),
            (set_input("Diffuse Roughness", 0.5), lost("Diffuse Roughness")),
            (set_input("Subsurface Weight", 0.5), lost("Subsurface Weight")),
            (set_input("Thin Film Thickness", 300), lost("Thin Film Thickness")),
            (set_input("Base Color", (2, 1, 1, 1)), lost("Base Color above 1")),
            (linked("Math", "IOR", operation="MULTIPLY"), lost("a linked IOR")),
            (linked("Value", "IOR"), lost("an IOR below 1")),
            (linked("Value", "Transmission Weight"), None),
            (set_input("Transmission Weight", 0.5), lost("the exact tint of partial glass")),
            (set_input("Emission Strength", 2), None),
            (set_input("Coat IOR", 2), None),
            (set_input("Alpha", 0.5), None),
            (lambda made, *_: on_floor(made, "BsdfTransparent"), None),
        ):
            with self.subTest(text):
                expected = [f"material 'Plane': {text}"] if text else []
                self.assertEqual(warnings(change), expected)

        with self.subTest("metal"):
            texts = [lost(name) for name in ("Multiscatter GGX", "Specular Tint of a metal")]
            self.assertEqual(warnings(metal), [f"material 'Plane': {text}" for text in texts])

    def test_glass_of_an_open_mesh_is_thin(self):
        made = glass()
        made.floor.data.materials[0] = made.ball.data.materials[0]
        model, _ = made.export()
        for mesh in model["meshes"]:
            material = model["materials"][mesh["primitives"][0]["material"]]
            is_thin = "KHR_materials_volume" not in material["extensions"]
            self.assertEqual(is_thin, mesh["name"] == "Plane", mesh)

    def test_samples_are_rounded_up_to_a_power_of_two(self):
        made = lit()
        for samples, expected in ((1, "1"), (48, "64"), (64, "64")):
            made.scene.candela.samples = samples
            depsgraph = bpy.context.evaluated_depsgraph_get()
            rendering = part("engine")._Rendering(Listener(after=0), depsgraph, Path())
            words = rendering._options()
            self.assertEqual(words[words.index("--spp") + 1], expected)

    def test_area_lights_are_not_logged_as_unsupported(self):
        made = lamp("AREA")
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            made.export()
        self.assertIn("Starting glTF", printed.getvalue())
        self.assertNotIn("Unsupported", printed.getvalue())

    def test_what_cycles_reads_alone_is_named(self):
        unread = part("unread")

        def owners():
            made = lit()
            made.scene.render.use_simplify = True
            subdivided(made)
            layer, _ = collected(made, made.ball)
            lamp = next(each for each in made.scene.objects if each.type == "LIGHT")
            return made, {
                "_SCENE": ("scene 'Scene'", made.scene),
                "_SIMPLIFIED": ("scene 'Scene'", made.scene),
                "_LAYER": ("view layer 'ViewLayer'", bpy.context.view_layer),
                "_COLLECTION": ("collection 'Inner'", layer),
                "_WORLD": ("world 'World'", made.scene.world),
                "_OBJECT": ("object 'Sphere'", made.ball),
                "_VISIBILITY": ("object 'POINT'", lamp),
                "_LIGHT": ("light 'POINT'", lamp.data),
                "_MODIFIER": ("modifier 'Subdivision'", bpy.context.object.modifiers[0]),
            }

        def texts_of(made):
            # Not by a rendering: Blender's Freestyle crashes after one that is cancelled
            texts, layer = [], bpy.context.view_layer
            depsgraph = bpy.context.evaluated_depsgraph_get()
            unread.check(made.scene, layer, made.scene.world, depsgraph, texts.append)
            return texts

        self.assertEqual(texts_of(owners()[0]), [])
        for table in owners()[1]:
            for path, usual in getattr(unread, table).items():
                made, found = owners()
                name, owner = found[table]
                *above, last = path.split(".")
                for each in above:
                    owner = getattr(owner, each)
                described = owner.bl_rna.properties.get(last)
                if described is None:
                    continue
                with self.subTest(f"{name}: {path}"):
                    if described.type == "BOOLEAN":
                        value = not usual
                    elif described.type == "ENUM":
                        values = [each.identifier for each in described.enum_items]
                        value = next(each for each in values if each != usual)
                    elif described.type == "POINTER":
                        value = bpy.data.collections.new("Some")
                    else:
                        value = 1
                    setattr(owner, last, value)
                    texts = texts_of(made)
                    self.assertEqual(len(texts), 1, texts)
                    self.assertTrue(texts[0].startswith(f"{name}: not supported: "), texts)

    def test_lights_that_differ_are_named(self):
        made = Scene()
        lamp = made.light("SPOT")
        parent = made.put("Parent", None, (0, 0, 0))
        parent.rotation_euler = (0, 0, 0)
        for kind, scale, above, energy, text in (
            ("SPOT", (2, 2, 2), (1, 1, 1), 1, None),
            ("SPOT", (1, 1, 2), (1, 1, 1), 1, "scale of light {} is ignored: its cone is round"),
            ("AREA", (1, 1, 2), (1, 1, 1), 1, None),
            ("AREA", (1, 1, 1), (2, 1, 1), 1, "shape of light {} is not sheared as in Cycles"),
            ("SUN", (1, 1, 2), (2, 1, 1), 1, None),
            ("SUN", (1, 1, 1), (1, 1, 1), -1, "negative power of light {} is not supported"),
        ):
            lamp.data = bpy.data.lights.new(kind.title(), kind)
            lamp.data.energy, lamp.scale, parent.scale, lamp.parent = energy, scale, above, parent
            texts = [f"the {text}".format(f"'{lamp.data.name}'")] if text else []
            with self.subTest(texts):
                self.assertEqual(made.export()[1], texts)

    def test_hair_is_named_also_if_its_object_is_hidden(self):
        made = lit()
        made.ball.modifiers.new("Hair", "PARTICLE_SYSTEM")
        hair = made.ball.particle_systems[0].settings
        hair.type, made.ball.show_instancer_for_render = "HAIR", False
        text = "the hair of object 'Sphere' is not supported; left out"
        self.assertEqual(made.export()[1], [text])
        hair.render_type, hair.instance_object = "OBJECT", made.floor
        self.assertEqual(made.export()[1], [])

    def test_what_materials_miss_in_a_mesh_is_named(self):
        def texts(kind, **fields):
            made = lit()
            tree = made.ball.data.materials[0].node_tree
            made.ball.data.attributes.new("by face", "FLOAT_COLOR", "FACE")
            node = tree.nodes.new(f"ShaderNode{kind}")
            for name, value in fields.items():
                setattr(node, name, value)
            tree.links.new(node.outputs[0], tree.nodes["Principled BSDF"].inputs["Base Color"])
            return made.export()[1]

        misses = "mesh 'Sphere' has no {}, which material 'Sphere' reads".format
        self.assertEqual(texts("VertexColor", layer_name="some"), [misses("color 'some'")])
        self.assertEqual(texts("Attribute", attribute_name="some"), [misses("color 'some'")])
        self.assertEqual(texts("Attribute", attribute_name="by face"), [misses("color 'by face'")])
        self.assertEqual(texts("UVMap", uv_map="some"), [misses("UV map 'some'")])
        self.assertEqual(texts("UVMap", uv_map="UVMap"), [])

    def test_of_several_colors_that_of_the_material_is_written(self):
        made = lit()
        for name in ("first", "second"):
            made.ball.data.color_attributes.new(name, "FLOAT_COLOR", "POINT")
        tree = made.ball.data.materials[0].node_tree
        node = tree.nodes.new("ShaderNodeVertexColor")
        node.layer_name = "second"
        tree.links.new(node.outputs[0], tree.nodes["Principled BSDF"].inputs["Base Color"])
        model, warnings = made.export()
        self.assertEqual(warnings, [])
        mesh = next(mesh for mesh in model["meshes"] if mesh["name"] == "Sphere")
        names = sorted(mesh["primitives"][0]["attributes"])
        self.assertEqual(names, ["COLOR_0", "NORMAL", "POSITION", "TEXCOORD_0"])

    def test_images_that_gltf_reads_in_another_way_are_named(self):
        made = lit()
        shader, node = image_node(made, 2)
        tree, image = shader.id_data, node.image

        def warnings(socket, alpha_mode="STRAIGHT", space="sRGB", alpha=0.5, is_linked=False):
            tree.links.clear()
            output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
            tree.links.new(shader.outputs[0], output.inputs["Surface"])
            tree.links.new(node.outputs["Color"], shader.inputs[socket])
            if is_linked:
                tree.links.new(node.outputs["Alpha"], shader.inputs["Alpha"])
            image.colorspace_settings.name, image.alpha_mode = space, alpha_mode
            image.pixels[:] = [0.5, 0.5, 0.5, alpha] * 4
            return made.export()[1]

        start = f"material '{made.floor.name}': image 'wood' is rendered with "
        straight = f"{start}alpha 'Channel Packed', not 'Straight'"
        ignored = f"{start}alpha 'Channel Packed', not 'None'"
        self.assertEqual(warnings("Base Color"), [straight])
        self.assertEqual(warnings("Base Color", is_linked=True), [])
        self.assertEqual(warnings("Base Color", alpha=1), [])
        self.assertEqual(warnings("Base Color", "CHANNEL_PACKED"), [])
        self.assertEqual(warnings("Base Color", "NONE"), [])
        self.assertEqual(warnings("Base Color", "NONE", is_linked=True), [ignored])
        encoded = f"{start}color space 'sRGB', not 'Non-Color'"
        linear = f"{start}color space 'Non-Color', not 'sRGB'"
        self.assertEqual(warnings("Base Color", space="Non-Color", alpha=1), [encoded])
        self.assertEqual(warnings("Roughness", alpha=1), [linear])
        self.assertEqual(warnings("Roughness", space="Non-Color", alpha=1), [])
        node.image = image = bpy.data.images.new("bright", 2, 2, float_buffer=True)
        self.assertEqual(warnings("Base Color", space="Linear Rec.709", alpha=1), [])

    def test_what_volumes_lose_is_named(self):
        def warnings(make=cloud, grid=None, **inputs):
            made = clouded(make, **inputs)
            node = next(
                n
                for n in made.cloud.data.materials[0].node_tree.nodes
                if n.type == "PRINCIPLED_VOLUME"
            )
            if grid is not None:
                node.inputs["Density Attribute"].default_value = grid
            return made.export()

        model, none = warnings(Density=2)
        self.assertEqual(none, [])
        extras = [n["extras"]["candela"] for n in model["nodes"] if "extras" in n]
        media = [fields["medium"] for fields in extras if "medium" in fields]
        self.assertEqual([medium["grid"] for medium in media], ["density"])
        for named, inputs in (
            ("blackbody", {"Blackbody_Intensity": 1}),
            ("emission", {"Emission_Strength": 1}),
            ("no density by one of its grids, 'density'", {"grid": "smoke"}),
            ("no density by one of its grids, 'smoke'", {"make": lambda: cloud("smoke")}),
        ):
            _, texts = warnings(**inputs)
            self.assertTrue(any(named in text for text in texts), (named, texts))
        made = fog()
        noise = made.node.id_data.nodes.new("ShaderNodeTexNoise")
        made.node.id_data.links.new(noise.outputs[0], made.node.inputs["Density"])
        _, texts = made.export()
        self.assertTrue(any("density of node" in text for text in texts), texts)

    def test_only_the_scenes_camera_is_exported(self):
        made = lit()
        made.put("Second", bpy.data.cameras.new("Second"), (1, 1, 1))
        model, _ = made.export()
        self.assertEqual([n["name"] for n in model["nodes"] if "camera" in n], ["Camera"])


if __name__ == "__main__":
    unittest.main()

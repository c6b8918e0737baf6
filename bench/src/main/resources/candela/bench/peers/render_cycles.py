"""Renders a scene that Candela has written with Cycles, of PyPI's package bpy."""

import math
import tempfile
from pathlib import Path

import numpy as np

from exchange import Scene, arguments, refuse, write_exr

options = arguments("render_cycles.py")
scene = Scene(options.scene)

import bpy
from mathutils import Matrix

bpy.ops.wm.read_factory_settings(use_empty=True)
view = bpy.context.scene
view.render.engine = "CYCLES"


def link(tree, source, output, target, entry):
    tree.links.new(source.outputs[output], target.inputs[entry])


def emission_nodes(tree, color):
    """Emission from the outside only."""
    emission = tree.nodes.new("ShaderNodeEmission")
    strength = max(float(max(color)), 1e-30)
    emission.inputs["Color"].default_value = [float(c) / strength for c in color] + [1]
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    outside = tree.nodes.new("ShaderNodeMath")
    outside.operation = "MULTIPLY_ADD"
    outside.inputs[1].default_value = -strength
    outside.inputs[2].default_value = strength
    link(tree, geometry, "Backfacing", outside, 0)
    link(tree, outside, 0, emission, "Strength")
    return emission


def image_of(pixels, name):
    height, width, _ = pixels.shape
    image = bpy.data.images.new(name, width, height, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    flat = np.ones((height, width, 4), np.float32)
    flat[:, :, :3] = pixels[::-1]
    image.pixels.foreach_set(flat.ravel())
    image.update()
    return image


def bsdf_nodes(tree, m):
    roughness = math.sqrt(m.roughness)
    if m.kind == "diffuse":
        node = tree.nodes.new("ShaderNodeBsdfDiffuse")
        node.inputs["Roughness"].default_value = 0
        if m.image is None:
            node.inputs["Color"].default_value = [float(c) for c in m.reflectance] + [1]
        else:
            texture = tree.nodes.new("ShaderNodeTexImage")
            texture.image = image_of(m.image.pixels, m.image.name)
            texture.interpolation, texture.extension = "Linear", "REPEAT"
            link(tree, texture, "Color", node, "Color")
    elif m.kind == "conductor":
        node = tree.nodes.new("ShaderNodeBsdfMetallic")
        node.distribution, node.fresnel_type = "GGX", "PHYSICAL_CONDUCTOR"
        node.inputs["IOR"].default_value = [float(x) for x in m.eta]
        node.inputs["Extinction"].default_value = [float(x) for x in m.k]
        node.inputs["Roughness"].default_value = roughness
    elif m.kind == "dielectric":
        node = tree.nodes.new("ShaderNodeBsdfGlass")
        node.distribution = "GGX"
        node.inputs["Color"].default_value = [1, 1, 1, 1]
        node.inputs["IOR"].default_value = m.ior
        node.inputs["Roughness"].default_value = roughness
    else:
        refuse(f'material "{m.kind}"')
    return node


def material_of(m, emission):
    made = bpy.data.materials.new(m.id)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    surface = bsdf_nodes(tree, m)
    if emission is not None:
        emitter = emission_nodes(tree, emission)
        both = tree.nodes.new("ShaderNodeAddShader")
        link(tree, surface, 0, both, 0)
        link(tree, emitter, 0, both, 1)
        surface = both
        made.cycles.emission_sampling = "FRONT"
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    link(tree, surface, 0, output, "Surface")
    return made


materials = {}
for number, shape in enumerate(scene.shapes):
    m = shape.mesh
    mesh = bpy.data.meshes.new(f"mesh{number}")
    mesh.vertices.add(len(m.points))
    mesh.vertices.foreach_set("co", m.points.ravel())
    corners = np.ascontiguousarray(m.triangles, np.int32).ravel()
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(m.triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, dtype=np.int32))
    if m.uvs is not None:
        mesh.uv_layers.new().uv.foreach_set("vector", m.uvs[corners].ravel())
    mesh.update(calc_edges=True)
    if m.normals is None:
        mesh.shade_flat()
    else:
        mesh.shade_smooth()
        mesh.normals_split_custom_set_from_vertices(m.normals)
    key = (shape.material, None if shape.emission is None else tuple(shape.emission))
    if key not in materials:
        materials[key] = material_of(scene.materials[shape.material], shape.emission)
    mesh.materials.append(materials[key])
    view.collection.objects.link(bpy.data.objects.new(f"shape{number}", mesh))

world = bpy.data.worlds.new("world")
world.use_nodes = True
view.world = world
world.node_tree.nodes.clear()
background = world.node_tree.nodes.new("ShaderNodeBackground")
background.inputs["Color"].default_value = [0, 0, 0, 1]
sky = world.node_tree.nodes.new("ShaderNodeOutputWorld")
link(world.node_tree, background, 0, sky, "Surface")
if sum(l.kind in ("constant", "envmap") for l in scene.lights) > 1:
    refuse("several skies")

for number, light in enumerate(scene.lights):
    if light.kind == "constant":
        strength = max(float(max(light.color)), 1e-30)
        background.inputs["Color"].default_value = [float(c) / strength for c in light.color] + [1]
        background.inputs["Strength"].default_value = strength
    elif light.kind == "envmap":
        height = 2 * light.image.pixels.shape[0]
        x, y = np.meshgrid(np.arange(2 * height) + 0.5, np.arange(height) + 0.5)
        azimuth, polar = (0.5 - x / (2 * height)) * 2 * np.pi, y / height * np.pi
        directions = np.stack(
            [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=2
        )
        picture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        picture.image = image_of(light.radiance(directions), "sky")
        link(world.node_tree, picture, "Color", background, "Color")
    else:
        kind = "POINT" if light.kind == "point" else "SUN"
        emitter = bpy.data.lights.new(f"light{number}", kind)
        strength = max(float(max(light.color)), 1e-30)
        emitter.color = [float(c) / strength for c in light.color]
        placed = bpy.data.objects.new(f"light{number}", emitter)
        if kind == "POINT":
            emitter.energy = 4 * math.pi * strength
            emitter.shadow_soft_size = 0
            placed.location = light.position
        else:
            emitter.energy = strength
            emitter.angle = 0
            from mathutils import Vector
            placed.rotation_mode = "QUATERNION"
            placed.rotation_quaternion = Vector(light.direction).to_track_quat("-Z", "Y")
        view.collection.objects.link(placed)

camera = bpy.data.cameras.new("camera")
camera.sensor_fit = "HORIZONTAL" if scene.width <= scene.height else "VERTICAL"
camera.sensor_width = camera.sensor_height = 36
camera.lens = 18 / math.tan(math.radians(scene.fov) / 2)
camera.clip_start, camera.clip_end = scene.near, scene.far
if scene.aperture > 0:
    camera.dof.use_dof = True
    camera.dof.focus_distance = scene.focus
    camera.dof.aperture_fstop = camera.lens * 1e-3 / (2 * scene.aperture)
eye = bpy.data.objects.new("camera", camera)
back = -scene.ahead
across = np.cross(scene.up, back)
eye.matrix_world = Matrix([
    [float(across[i]), float(scene.up[i]), float(back[i]), float(scene.eye[i])] for i in range(3)
] + [[0, 0, 0, 1]])
view.collection.objects.link(eye)
view.camera = eye

render, cycles = view.render, view.cycles
render.resolution_x, render.resolution_y, render.resolution_percentage = scene.width, scene.height, 100
render.threads_mode, render.threads = "FIXED", options.nthreads
render.use_motion_blur = render.use_compositing = render.use_sequencer = False
render.film_transparent = False
cycles.device = "CPU"
cycles.samples, cycles.seed = options.spp, options.seed
cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_fast_gi = False
cycles.use_guiding = False
cycles.use_auto_tile = False
cycles.pixel_filter_type = "BOX"
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.light_sampling_threshold = cycles.blur_glossy = 0
cycles.caustics_reflective = cycles.caustics_refractive = True
bounces = max(scene.depth - 1, 0)
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
cycles.transmission_bounces = cycles.transparent_max_bounces = bounces
settings = render.image_settings
if hasattr(settings, "media_type"):
    settings.media_type = "IMAGE"
settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
with tempfile.TemporaryDirectory() as folder:
    render.filepath = str(Path(folder) / "cycles.exr")
    bpy.ops.render.render(write_still=True)
    made = bpy.data.images.load(render.filepath)
    made.colorspace_settings.name = "Non-Color"
    pixels = np.empty(scene.width * scene.height * 4, np.float32)
    made.pixels.foreach_get(pixels)
pixels = pixels.reshape(scene.height, scene.width, 4)[::-1, :, :3]
write_exr(options.outfile, scene.finished(pixels))

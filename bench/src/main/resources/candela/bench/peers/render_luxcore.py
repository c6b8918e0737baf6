"""Renders a scene that Candela has written with LuxCore, of PyPI's package pyluxcore."""

import math
import os
import time

import numpy as np

from exchange import Scene, arguments, refuse, write_exr

options = arguments("render_luxcore.py")
scene = Scene(options.scene)

import pyluxcore

pyluxcore.Init()
world = pyluxcore.Scene()


def properties(values):
    made = pyluxcore.Properties()
    for name, value in values.items():
        items = list(value) if isinstance(value, (list, tuple, np.ndarray)) else [value]
        items = [float(x) if isinstance(x, np.floating) else x for x in items]
        made.Set(pyluxcore.Property(name, items))
    return made


def image_map(name, pixels):
    height, width, _ = pixels.shape
    flat = np.ascontiguousarray(pixels, np.float32)
    world.DefineImageMap(name, flat, 1.0, 3, width, height)


def material_of(m, name, emission):
    key = f"scene.materials.{name}."
    values = {}
    if m.kind == "diffuse":
        values[key + "type"] = "matte"
        if m.image is None:
            values[key + "kd"] = m.reflectance
        else:
            image_map(m.image.name, m.image.pixels)
            texture = f"scene.textures.{name}."
            values[texture + "type"] = "imagemap"
            values[texture + "file"] = m.image.name
            values[texture + "gamma"] = 1.0
            values[texture + "mapping.type"] = "uvmapping2d"
            values[texture + "mapping.uvscale"] = [1.0, -1.0]
            values[key + "kd"] = name
    elif m.kind == "conductor" and m.roughness == 0:
        refuse('material "conductor": mirrors here reflect alike at all angles')
    elif m.kind == "dielectric" and m.roughness == 0:
        values[key + "type"] = "glass"
        values[key + "kr"] = values[key + "kt"] = [1.0, 1.0, 1.0]
        values[key + "interiorior"], values[key + "exteriorior"] = m.ior, 1.0
    else:
        refuse(f'material "{m.kind}" with GGX roughness')
    if emission is not None:
        values[key + "emission"] = emission
    world.Parse(properties(values))


def column(values):
    return None if values is None else [tuple(float(x) for x in row) for row in values]


made = {}
for number, shape in enumerate(scene.shapes):
    m = shape.mesh
    triangles = [tuple(int(i) for i in t) for t in m.triangles]
    world.DefineMesh(f"mesh{number}", column(m.points), triangles, column(m.normals),
                     column(m.uvs), None, None)
    key = (shape.material, None if shape.emission is None else tuple(shape.emission))
    if key not in made:
        made[key] = f"m{len(made)}"
        material_of(scene.materials[shape.material], made[key], shape.emission)
    world.Parse(properties({
        f"scene.objects.o{number}.shape": f"mesh{number}",
        f"scene.objects.o{number}.material": made[key],
    }))

for number, light in enumerate(scene.lights):
    key = f"scene.lights.l{number}."
    if light.kind == "point":
        values = {"type": "point", "position": light.position, "color": light.color,
                  "gain": [4 * math.pi] * 3}
    elif light.kind == "directional":
        values = {"type": "sharpdistant", "direction": light.direction, "color": light.color,
                  "gain": [1.0, 1.0, 1.0]}
    elif light.kind == "constant":
        values = {"type": "constantinfinite", "color": light.color}
    else:
        height = 2 * light.image.pixels.shape[0]
        x, y = np.meshgrid(np.arange(2 * height) + 0.5, np.arange(height) + 0.5)
        azimuth, polar = x / (2 * height) * 2 * np.pi, y / height * np.pi
        directions = np.stack(
            [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=2
        )
        image_map("sky", light.radiance(directions))
        values = {"type": "infinite", "file": "sky", "gamma": 1.0}
    world.Parse(properties({key + name: value for name, value in values.items()}))

# LuxCore's field of view is along the shorter side, too
wide, high = max(1, scene.width / scene.height), max(1, scene.height / scene.width)
# Tiles are rendered one row too high
row = 2 * high / scene.height
world.Parse(properties({
    "scene.camera.type": "perspective",
    "scene.camera.lookat.orig": scene.eye,
    "scene.camera.lookat.target": scene.eye + scene.ahead,
    "scene.camera.up": scene.up,
    "scene.camera.fieldofview": scene.fov,
    "scene.camera.screenwindow": [-wide, wide, -high - row, high - row],
    "scene.camera.autofocus.enable": False,
    "scene.camera.lensradius": scene.aperture,
    "scene.camera.focaldistance": scene.focus if scene.aperture > 0 else 1.0,
    "scene.camera.cliphither": scene.near,
    "scene.camera.clipyon": scene.far,
}))
# The last vertex is lit by lights alone, and counts
bounces = scene.depth + 1
config = pyluxcore.RenderConfig(properties({
    "renderengine.type": "TILEPATHCPU",
    "sampler.type": "TILEPATHSAMPLER",
    "tilepath.sampling.aa.size": 1,
    "tile.multipass.enable": True,
    "tile.multipass.convergencetest.threshold": 0.0,
    "renderengine.seed": options.seed + 1,
    "native.threads.count": options.nthreads,
    "path.pathdepth.total": bounces,
    "path.pathdepth.diffuse": bounces,
    "path.pathdepth.glossy": bounces,
    "path.pathdepth.specular": bounces,
    "path.clamping.variance.maxvalue": 0.0,
    "path.forceblackbackground.enable": False,
    "film.width": scene.width,
    "film.height": scene.height,
    "film.filter.type": "NONE",
    "batch.haltspp": options.spp,
    "film.imagepipelines.0.0.type": "NOP",
}), world)
session = pyluxcore.RenderSession(config)
session.Start()
while not session.HasDone():
    time.sleep(0.005)
    session.UpdateStats()
session.Stop()
film = session.GetFilm()
pixels = np.zeros((scene.height, scene.width, 3), np.float32)
film.GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels, 0)
write_exr(options.outfile, scene.finished(pixels[::-1]))
# pyluxcore 2.11 may abort when the interpreter ends
os._exit(0)

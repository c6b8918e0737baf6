"""Reads the scenes that Candela writes for other renderers, and writes their images."""

import argparse
import struct
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np


def arguments(name):
    parser = argparse.ArgumentParser(prog=name)
    parser.add_argument("scene", type=Path)
    parser.add_argument("--outfile", type=Path, required=True)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--nthreads", type=int, default=1)
    return parser.parse_args(sys.argv[1:])


def refuse(what):
    """Ends the program: its last line says why."""
    print(f"no counterpart here for {what}", flush=True)
    sys.exit(1)


def _named(element, name):
    return next((e for e in element if e.get("name") == name), None)


def _number(element, name, default=0.0):
    found = _named(element, name)
    return default if found is None else float(found.get("value"))


def _text(element, name, default=""):
    found = _named(element, name)
    return default if found is None else found.get("value")


def _rgb(element, name):
    return np.array([float(x) for x in _named(element, name).get("value").split()])


def _point(element, name):
    found = _named(element, name)
    return np.array([float(found.get(axis)) for axis in "xyz"])


def _matrix(element):
    values = element.find("transform/matrix").get("value").split()
    return np.array([float(x) for x in values]).reshape(4, 4)


class Material:
    """kind: diffuse, conductor, dielectric, or thindielectric; roughness: GGX's alpha."""

    def __init__(self, element, folder):
        inner = element.find("bsdf") if element.get("type") == "twosided" else element
        kind = inner.get("type")
        self.id = element.get("id")
        self.kind = kind.removeprefix("rough")
        self.roughness = _number(inner, "alpha")
        self.image = None
        if self.kind == "diffuse":
            texture = _named(inner, "reflectance")
            if texture.tag == "texture":
                self.image = Image(folder, _text(texture, "filename"))
            else:
                self.reflectance = _rgb(inner, "reflectance")
        elif self.kind == "conductor":
            self.eta, self.k = _rgb(inner, "eta"), _rgb(inner, "k")
        else:
            self.ior = _number(inner, "int_ior")


class Image:
    """Linear pixels, height × width × 3, rows from the top."""

    def __init__(self, folder, name):
        self.name = name
        data = (folder / name).with_suffix(".pfm").read_bytes()
        kind, size, scale, rest = data.split(b"\n", 3)
        width, height = (int(x) for x in size.split())
        order = "<" if float(scale) < 0 else ">"
        channels = 3 if kind == b"PF" else 1
        pixels = np.frombuffer(rest, order + "f4").reshape(height, width, channels)
        self.pixels = np.repeat(pixels, 3 // channels, axis=2)[::-1].astype(np.float32)


class Mesh:
    """Triangles that turn counterclockwise seen from outside; normals and uvs may be None.
    v begins at the bottom of images."""

    def __init__(self, points, normals, uvs, triangles):
        self.points, self.normals, self.uvs, self.triangles = points, normals, uvs, triangles

    @staticmethod
    def of_file(path):
        data = path.read_bytes()
        end = data.index(b"end_header\n") + len(b"end_header\n")
        lines = data[:end].decode("ascii").splitlines()
        count = next(int(x.split()[2]) for x in lines if x.startswith("element vertex"))
        faces = next(int(x.split()[2]) for x in lines if x.startswith("element face"))
        fields = [x.split()[1:] for x in lines if x.startswith("property") and "list" not in x]
        kind = np.dtype([(name, "<f8" if t == "double" else "<f4") for t, name in fields])
        vertices = np.frombuffer(data, kind, count, end)
        corners = np.frombuffer(
            data, np.dtype([("n", "u1"), ("i", "<i4", 3)]), faces, end + count * kind.itemsize
        )["i"]

        def columns(*names):
            if names[0] not in kind.names:
                return None
            return np.stack([vertices[n] for n in names], axis=1).astype(np.float32)

        uvs = columns("u", "v")
        if uvs is not None:
            uvs[:, 1] = 1 - uvs[:, 1]
        return Mesh(columns("x", "y", "z"), columns("nx", "ny", "nz"), uvs, corners)

    @staticmethod
    def of_sphere(center, radius, is_flipped):
        across, along = 256, 128
        theta = np.linspace(0, np.pi, along + 1)[:, None]
        phi = np.linspace(0, 2 * np.pi, across, endpoint=False)[None, :]
        normals = np.stack(
            [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta) + 0 * phi],
            axis=2,
        ).reshape(-1, 3)
        j, i = np.meshgrid(np.arange(along), np.arange(across), indexing="ij")
        a, b = j * across + i, j * across + (i + 1) % across
        c, d = a + across, b + across
        upper = np.stack([a, c, b], axis=2)[1:].reshape(-1, 3)
        lower = np.stack([b, c, d], axis=2)[:-1].reshape(-1, 3)
        triangles = np.concatenate([upper, lower]).astype(np.int32)
        points = center + radius * normals
        if is_flipped:
            normals, triangles = -normals, triangles[:, ::-1]
        return Mesh(points.astype(np.float32), normals.astype(np.float32), None, triangles)


class Shape:
    """emission: radiance of its outside, or None."""

    def __init__(self, element, folder):
        if element.get("type") == "sphere":
            is_flipped = _text(element, "flip_normals") == "true"
            center, radius = _point(element, "center"), _number(element, "radius")
            self.mesh = Mesh.of_sphere(center, radius, is_flipped)
        else:
            self.mesh = Mesh.of_file(folder / _text(element, "filename"))
        self.material = element.find("ref").get("id")
        emitter = element.find("emitter")
        self.emission = None if emitter is None else _rgb(emitter, "radiance")


class Light:
    """kind: point, directional, constant, or envmap."""

    def __init__(self, element, folder):
        self.kind = element.get("type")
        if self.kind == "point":
            self.position, self.color = _point(element, "position"), _rgb(element, "intensity")
        elif self.kind == "directional":
            self.direction = _point(element, "direction")
            self.color = _rgb(element, "irradiance")
        elif self.kind == "constant":
            self.color = _rgb(element, "radiance")
        else:
            self.image = Image(folder, _text(element, "filename"))
            self.scale = _number(element, "scale", 1)
            self.to_world = _matrix(element)[:3, :3]

    def radiance(self, directions):
        """Of an envmap in directions of the world, … × 3."""
        d = directions @ np.linalg.inv(self.to_world).T
        d /= np.linalg.norm(d, axis=-1, keepdims=True)
        height, width, _ = self.image.pixels.shape
        azimuth = np.arctan2(d[..., 0], -d[..., 2]) / (2 * np.pi)
        x = (azimuth % 1) * width - 0.5
        y = np.arccos(np.clip(d[..., 1], -1, 1)) / np.pi * (height - 1)
        x0, y0 = np.floor(x).astype(int), np.minimum(np.floor(y).astype(int), height - 2)
        fx, fy = (x - x0)[..., None], (y - y0)[..., None]

        def at(dx, dy):
            return self.image.pixels[y0 + dy, (x0 + dx) % width]

        upper = at(0, 0) * (1 - fx) + at(1, 0) * fx
        lower = at(0, 1) * (1 - fx) + at(1, 1) * fx
        return self.scale * (upper * (1 - fy) + lower * fy)


class Scene:
    """fov: full angle along the shorter side of the film, in degrees. depth: number of surfaces
    at which a path scatters, at most. right, up, ahead: unit axes of the camera. is_mirrored:
    the picture of a camera that has only `ahead` and `up` must be mirrored."""

    def __init__(self, path):
        root = xml.parse(path).getroot()
        folder = path.parent
        self.depth = int(_number(root.find("integrator"), "max_depth")) - 1
        sensor = root.find("sensor")
        film = sensor.find("film")
        self.width, self.height = (int(_number(film, n)) for n in ("width", "height"))
        self.fov = _number(sensor, "fov")
        self.near, self.far = _number(sensor, "near_clip"), _number(sensor, "far_clip")
        self.aperture = _number(sensor, "aperture_radius")
        self.focus = _number(sensor, "focus_distance")
        to_world = _matrix(sensor)
        axes = to_world[:3, :3] / np.linalg.norm(to_world[:3, :3], axis=0)
        self.eye, self.right, self.up, self.ahead = to_world[:3, 3], -axes[:, 0], axes[:, 1], axes[:, 2]
        self.is_mirrored = np.dot(np.cross(self.right, self.up), self.ahead) > 0
        self.materials = {e.get("id"): Material(e, folder) for e in root.findall("bsdf")}
        self.shapes = [Shape(e, folder) for e in root.findall("shape")]
        self.lights = [Light(e, folder) for e in root.findall("emitter")]

    def finished(self, pixels):
        """Pixels of a camera without handedness, height × width × 3, rows from the top."""
        return pixels[:, ::-1] if self.is_mirrored else pixels


def write_exr(path, pixels):
    """Uncompressed, with channels of 32 bits."""
    height, width, _ = pixels.shape

    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value

    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(c + b"\0" + struct.pack("<iIii", 2, 0, 1, 1) for c in (b"B", b"G", b"R"))
    header = struct.pack("<II", 20000630, 2) + b"".join([
        attribute(b"channels", b"chlist", channels + b"\0"),
        attribute(b"compression", b"compression", b"\0"),
        attribute(b"dataWindow", b"box2i", box),
        attribute(b"displayWindow", b"box2i", box),
        attribute(b"lineOrder", b"lineOrder", b"\0"),
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)),
    ]) + b"\0"
    row = 12 * width
    first = len(header) + 8 * height
    offsets = [first + y * (8 + row) for y in range(height)]
    planes = np.ascontiguousarray(pixels[:, :, ::-1].transpose(0, 2, 1), "<f4")
    with open(path, "wb") as out:
        out.write(header + struct.pack(f"<{height}Q", *offsets))
        for y in range(height):
            out.write(struct.pack("<ii", y, row) + planes[y].tobytes())

"""The world, as `extras.candela.environment` of the scene: docs/MODELS.md."""

from pathlib import Path

import numpy as np
from mathutils import Euler, Matrix

from .candela import Image
from .candela._arrays import linear as of_srgb
from .candela._image import exr
from .nodes import linked, output_of, source, tree_of, unlinked

FILE = "world.exr"

# From z up to y up
_UPRIGHT = Matrix(((1, 0, 0), (0, 0, 1), (0, -1, 0)))

# From a map whose middle is at -z, with y up, to Blender's, whose middle is at +x, with z up
_MIDDLE = Matrix(((0, 0, -1), (-1, 0, 0), (0, 1, 0)))


def of(scene, view_layer):
    """The world that is rendered, or None."""
    if not view_layer.use_sky:
        return None
    return getattr(view_layer, "world_override", None) or scene.world


def environment(world, folder: Path, warn):
    """What lights the scene from everywhere; an image is written to the folder."""
    if world is None:
        return {"radiance": [0.0, 0.0, 0.0]}
    tree = tree_of(world)
    if tree is None:
        return {"radiance": list(world.color)}
    output = output_of(tree)
    if output is None:
        return {"radiance": [0.0, 0.0, 0.0]}
    if linked(output, "Volume") is not None:
        warn(f"the volume of world '{world.name}' is not supported; left out")
    node = linked(output, "Surface")
    if node is None:
        return {"radiance": [0.0, 0.0, 0.0]}
    if node.type not in ("BACKGROUND", "EMISSION"):
        warn(_unsupported(world, node, "black"))
        return {"radiance": [0.0, 0.0, 0.0]}
    power = unlinked(node.inputs["Strength"])
    if power is None:
        warn(_unsupported(world, source(node.inputs["Strength"]), "a strength of 1"))
        power = 1.0
    color = unlinked(node.inputs["Color"])
    if color is not None:
        return {"radiance": [max(0.0, c * power) for c in color[:3]]}
    texture = source(node.inputs["Color"])
    if texture.type == "TEX_ENVIRONMENT" and texture.image is not None:
        return _image(world, texture, max(0.0, power), folder, warn)
    warn(_unsupported(world, texture, "black"))
    return {"radiance": [0.0, 0.0, 0.0]}


def _unsupported(world, node, instead):
    return f"node '{node.name}' of world '{world.name}' is not supported; using {instead}"


def _image(world, texture, power, folder, warn):
    if texture.projection != "EQUIRECTANGULAR":
        warn(f"the projection of '{texture.image.name}' is not supported; using equirectangular")
    pixels = linear(texture.image, warn)
    if pixels is None:
        warn(f"the image '{texture.image.name}' of world '{world.name}' can't be read; left out")
        return {"radiance": [0.0, 0.0, 0.0]}
    (folder / FILE).write_bytes(exr(Image(np.ascontiguousarray(pixels[..., :3]))))
    # Directions are turned before the image is looked up
    turned = _UPRIGHT @ _turn(world, texture, warn).transposed() @ _MIDDLE
    w, x, y, z = turned.to_quaternion()
    return {"radiance": [power] * 3, "uri": FILE, "rotation": [x, y, z, w]}


def _turn(world, texture, warn):
    """The rotation of the texture's directions."""
    node = source(texture.inputs["Vector"])
    if node is None or node.type == "TEX_COORD":
        return Matrix.Identity(3)
    if node.type != "MAPPING":
        warn(_unsupported(world, node, "the image as it is"))
        return Matrix.Identity(3)
    below = source(node.inputs["Vector"])
    if below is not None and below.type != "TEX_COORD":
        warn(_unsupported(world, below, "the direction"))
    values = {name: unlinked(node.inputs[name]) for name in ("Location", "Rotation", "Scale")
              if name in node.inputs and node.inputs[name].enabled}
    if values.get("Rotation") is None:
        warn(_unsupported(world, source(node.inputs["Rotation"]), "the image as it is"))
        return Matrix.Identity(3)
    if any(values.get("Location") or ()) or any(s != 1 for s in values.get("Scale") or ()):
        warn(f"node '{node.name}' of world '{world.name}' moves or scales; it only turns")
    matrix = Euler(values["Rotation"], "XYZ").to_matrix()
    return matrix.transposed() if node.vector_type == "TEXTURE" else matrix


def linear(image, warn):
    """The pixels of an image in linear light, rows from the top; None if it has none."""
    width, height = image.size
    if not width or not height:
        return None
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1]
    if image.channels == 1:
        pixels = np.repeat(pixels, 3, axis=2)
    space = image.colorspace_settings.name
    if not image.is_float and space == "sRGB":
        return of_srgb(pixels)
    if not image.is_float and space != "Non-Color" and "Linear" not in space:
        warn(f"the colour space {space} of image '{image.name}' is not supported; using linear")
    return pixels

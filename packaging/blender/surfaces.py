"""Surfaces that Blender's glTF exporter writes otherwise than Cycles renders them."""

import os
from copy import copy
from typing import NamedTuple

import bpy

from .nodes import group_output, output_of, source, tree_of, unlinked

BLACK = (0.0, 0.0, 0.0)
_DEFAULT = (0.8, 0.8, 0.8)
# What Cycles has where an image is missing
_MISSING = [1.0, 0.0, 1.0]
_SPECULAR = "KHR_materials_specular"
_TRANSMISSION = "KHR_materials_transmission"
_VOLUME = "KHR_materials_volume"
_USUAL_INDEX = 1.5
_TILES = (".jpeg", ".jpg", ".png", ".webp")
# Shaders that the exporter reads
EXPORTED = ("BSDF_PRINCIPLED", "EMISSION")


class Surface(NamedTuple):
    """A shader and its opacity.

    :param shader: a node, or None if nothing is seen
    :param mixed: the nodes that give it its opacity
    """

    shader: object
    alpha: float
    mixed: tuple = ()


def of(material):
    """The surface of a material, or None if nothing is linked."""
    tree = tree_of(material)
    output = output_of(tree) if tree else None
    node = _entered(source(output.inputs["Surface"])) if output else None
    if node is None:
        return None
    if node.type == "BSDF_TRANSPARENT":
        return Surface(None, 0.0, (node,))
    if node.type == "ADD_SHADER":
        added = {each.type: each for each in map(_entered, map(source, node.inputs)) if each}
        base = added.get("BSDF_PRINCIPLED")
        # The exporter reads the light of one of them
        if "EMISSION" in added and base and unlinked(base.inputs["Emission Strength"]) == 0:
            return Surface(base, 1.0, (node,))
    factor = unlinked(node.inputs[0]) if node.type == "MIX_SHADER" else None
    if factor is not None:
        factor = min(max(factor, 0.0), 1.0)
        first, second = (_entered(source(socket)) for socket in node.inputs[1:3])
        for clear, shader, alpha in ((first, second, factor), (second, first, 1 - factor)):
            is_mixed = clear is not None and clear.type == "BSDF_TRANSPARENT"
            if is_mixed and shader is not None and shader.type in EXPORTED:
                return Surface(shader, alpha, (node, clear))
    return Surface(node, 1.0)


def _entered(node):
    """The node, or that which a group ends with."""
    while node is not None and node.type == "GROUP":
        end = group_output(node)
        node = source(end.inputs[0]) if end is not None else None
    return node


def is_missing(node):
    """Whether the node is an image texture without an image that can be read."""
    return node.type == "TEX_IMAGE" and (node.image is None or not all(node.image.size))


def has_lost_tiles(node):
    """Whether the node is a texture of tiles that the exporter can't read."""
    image = node.image if node.type == "TEX_IMAGE" else None
    if image is None or image.source != "TILED":
        return False
    path = bpy.path.abspath(image.filepath_raw, library=image.library)
    tiles = [path.replace("<UDIM>", str(tile.number)) for tile in image.tiles]
    return not path.lower().endswith(_TILES) or not all(map(os.path.isfile, tiles))


def unassigned():
    """What Cycles has where an object has no material, as glTF's material."""
    from io_scene_gltf2.io.com.gltf2_io import Material

    material = Material(*[None] * 2, True, *[None] * 8)
    _paint(material, _DEFAULT, roughness=0.5, specular=1.0)
    return material


def mend(gltf_material, material):
    """Makes the exported material what Cycles has."""
    if tree_of(material) is None:
        _paint(gltf_material, material.diffuse_color[:3])
        return
    surface = of(material)
    if surface is None:
        _paint(gltf_material, BLACK)
        return
    if surface.alpha < 1:
        if gltf_material.pbr_metallic_roughness is None:
            _paint(gltf_material, BLACK)
        pbr = gltf_material.pbr_metallic_roughness
        red, green, blue, alpha = pbr.base_color_factor or [1.0] * 4
        pbr.base_color_factor = [red, green, blue, alpha * surface.alpha]
        gltf_material.alpha_mode = "BLEND"
    color = surface.shader.inputs.get("Base Color") if surface.shader else None
    texture = source(color) if color else None
    if texture is not None and is_missing(texture):
        pbr = gltf_material.pbr_metallic_roughness
        pbr.base_color_factor = _MISSING + list(pbr.base_color_factor or [1.0] * 4)[3:]
    if surface.shader is not None and surface.shader.type == "BSDF_PRINCIPLED":
        _mend_index(gltf_material, surface.shader)
        _mend_glass(gltf_material, surface.shader)


def _mend_index(gltf_material, shader):
    """The exporter keeps it beside some extensions alone."""
    index = unlinked(shader.inputs["IOR"])
    if index is not None and index != _USUAL_INDEX:
        specular = _fields(gltf_material, _SPECULAR)
        _extend(gltf_material, _SPECULAR, {"specularFactor": 1.0, **specular})
        _extend(gltf_material, "KHR_materials_ior", {"ior": index})


def _mend_glass(gltf_material, shader):
    """Cycles refracts, and the root of the color tints light at each surface."""
    fields = _fields(gltf_material, _TRANSMISSION)
    weight = fields.get("transmissionFactor", 0.0)
    if not weight:
        return
    _extend(gltf_material, _VOLUME, {"thicknessFactor": 1.0})
    if not _is_constant(shader):
        return
    pbr = gltf_material.pbr_metallic_roughness
    *color, alpha = pbr.base_color_factor or [1.0] * 4
    passed = _passed(shader)
    # The one color of glTF is that of all that is scattered; its share that passes is gray
    mixed = [c * (1 - passed) + c**0.5 * passed for c in color]
    share = sum(c**0.5 for c in color) / (sum(mixed) or 1.0)
    fields["transmissionFactor"] = min(weight * share, 1.0)
    pbr.base_color_factor = [*mixed, alpha]


def is_filled(gltf_material):
    """Whether light is refracted into it."""
    return bool(_fields(gltf_material, _VOLUME))


def thin(gltf_material):
    """A copy that light passes straight."""
    made = copy(gltf_material)
    made.extensions = {k: v for k, v in made.extensions.items() if k != _VOLUME}
    return made


def _passed(shader):
    """The share of light that is not reflected and passes, of constants."""
    metallic, weight = (
        min(max(unlinked(shader.inputs[name]), 0.0), 1.0)
        for name in ("Metallic", "Transmission Weight")
    )
    return weight * (1 - metallic)


def _is_constant(shader):
    inputs = (shader.inputs[name] for name in ("Base Color", "Metallic", "Transmission Weight"))
    return all(unlinked(socket) is not None for socket in inputs)


def lost_tint(shader):
    """What differs of the tint of a Principled BSDF that is glass, or None."""
    if unlinked(shader.inputs["Transmission Weight"]) == 0:
        return None
    if not _is_constant(shader):
        return "a linked color of glass"
    is_gray = len(set(unlinked(shader.inputs["Base Color"])[:3])) == 1
    return None if is_gray or _passed(shader) in (0, 1) else "the exact tint of partial glass"


def _fields(gltf_material, name):
    """Of an extension."""
    extension = (gltf_material.extensions or {}).get(name)
    return extension.extension if extension is not None else {}


def _extend(gltf_material, name, fields):
    from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

    extensions = gltf_material.extensions or {}
    gltf_material.extensions = extensions | {name: Extension(name, fields, False)}


def _paint(gltf_material, color, roughness=1.0, specular=0.0):
    """Makes the exported material a dielectric of this color, by default diffuse."""
    from io_scene_gltf2.io.com.gltf2_io import MaterialPBRMetallicRoughness

    rgba = [*(min(max(c, 0.0), 1.0) for c in color), 1.0]
    gltf_material.pbr_metallic_roughness = MaterialPBRMetallicRoughness(
        rgba, None, None, None, 0.0, None, roughness
    )
    gltf_material.emissive_factor = gltf_material.emissive_texture = None
    gltf_material.extensions = None
    _extend(gltf_material, _SPECULAR, {"specularFactor": specular})

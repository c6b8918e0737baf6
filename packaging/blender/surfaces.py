"""Surfaces that Blender's glTF exporter writes otherwise than Cycles renders them."""

from typing import NamedTuple

from .nodes import group_output, output_of, source, tree_of, unlinked

BLACK = (0.0, 0.0, 0.0)
_DEFAULT = (0.8, 0.8, 0.8)
# What Cycles has where an image is missing
_MISSING = [1.0, 0.0, 1.0]
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
    output = output_of(tree, "OUTPUT_MATERIAL") if tree else None
    node = _entered(source(output.inputs["Surface"])) if output else None
    if node is None:
        return None
    if node.type == "BSDF_TRANSPARENT":
        return Surface(None, 0.0, (node,))
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


def _paint(gltf_material, color, roughness=1.0, specular=0.0):
    """Makes the exported material a dielectric of this color, by default diffuse."""
    from io_scene_gltf2.io.com.gltf2_io import MaterialPBRMetallicRoughness
    from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

    name = "KHR_materials_specular"
    rgba = [*(min(max(c, 0.0), 1.0) for c in color), 1.0]
    gltf_material.pbr_metallic_roughness = MaterialPBRMetallicRoughness(
        rgba, None, None, None, 0.0, None, roughness
    )
    gltf_material.emissive_factor = gltf_material.emissive_texture = None
    gltf_material.extensions = {name: Extension(name, {"specularFactor": specular}, False)}

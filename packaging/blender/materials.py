"""What Blender's glTF exporter loses of materials."""

import numpy as np

from . import surfaces
from .geometry import rendered, slots
from .nodes import linked, muted, of_surface, output_of, source, tree_of, unlinked, upstream

# Those that the exporter reads
_NODES = {
    "ATTRIBUTE", "BSDF_PRINCIPLED", "EMISSION", "GROUP", "GROUP_INPUT", "GROUP_OUTPUT", "MAPPING",
    "MATH", "MIX", "NORMAL_MAP", "OUTPUT_MATERIAL", "RGB", "SEPARATE_COLOR", "SEPRGB", "TEX_COORD",
    "TEX_IMAGE", "UVMAP", "VALUE", "VERTEX_COLOR",
}
# Inputs of Principled BSDF that glTF lacks, with the values that have no effect
_INPUTS = {"Diffuse Roughness": 0, "Subsurface Weight": 0, "Thin Film Thickness": 0}
_COAT_INPUTS = {"Coat IOR": 1.5, "Coat Tint": (1, 1, 1, 1)}
_FLAT = (0.5, 0.5, 1)  # of a normal map
_CLIPS = ("ROUND", "SUBTRACT", "LESS_THAN", "GREATER_THAN")  # of alpha
_FACTORS = ("RGB", "VALUE", "ATTRIBUTE", "VERTEX_COLOR")
_CHANGING = ("SEQUENCE", "MOVIE")
_DEPTHS_WITH_ALPHA = (32, 64, 128)  # bits of a pixel


def check(depsgraph, override, warn):
    """Names what is left out of the materials that are rendered.

    :param override: a material instead of all
    """
    checked = set()
    for instance in rendered(depsgraph):
        for material in slots(instance.object, override):
            if material is not None and material.original not in checked:
                checked.add(material.original)
                _check_material(material, warn)


def check_attributes(mesh, name, warn):
    """Names what materials read of a mesh, and it lacks.

    :param mesh: a copy of the one of that name
    """
    maps, colors = set(mesh.uv_layers.keys()), set(mesh.color_attributes.keys())
    for material in {each for each in mesh.materials if each is not None}:
        for node in of_surface(material):
            if node.type in ("UVMAP", "NORMAL_MAP"):
                wanted, kind, known = node.uv_map, "UV map", maps
            elif node.type == "TEX_IMAGE" and source(node.inputs["Vector"]) is None and not maps:
                wanted, kind, known = "UVMap", "UV map", maps
            elif node.type == "VERTEX_COLOR":
                wanted, kind, known = node.layer_name, "color", colors
            elif node.type == "ATTRIBUTE" and node.attribute_type == "GEOMETRY":
                wanted, kind, known = node.attribute_name, "color", colors | maps
            else:
                continue
            if wanted and wanted not in known:
                reader = f"material '{material.name}'"
                warn(f"mesh '{name}' has no {kind} '{wanted}', which {reader} reads")


def _check_material(material, warn):
    tree = tree_of(material)
    output = output_of(tree) if tree else None
    if output is None:
        return
    if linked(output, "Displacement") is not None:
        warn(f"the displacement of material '{material.name}' is not supported; left out")
    surface = surfaces.of(material)
    if surface is None:
        return

    def tell(text):
        warn(f"material '{material.name}': {text}")

    nodes = list(upstream(linked(output, "Surface")))
    names = {node.name for node in _unread(nodes) if node not in surface.mixed}
    if names:
        listed = ", ".join(f"'{name}'" for name in sorted(names))
        tell(f"glTF has no node {listed}; rendered without")
    for name in muted(linked(output, "Surface")):
        tell(f"{name} is muted, but used")
    for node in surface.mixed:
        if node.type == "BSDF_TRANSPARENT" and unlinked(node.inputs[0])[:3] != (1, 1, 1):
            tell(f"the color of node '{node.name}' is not supported; white is used")
    for node in nodes:
        if node.type == "GROUP" and node.node_tree.animation_data is not None:
            tell(f"the animation within group '{node.node_tree.name}' is not supported")
        if node.type == "TEX_IMAGE":
            for text in _lost_image(node):
                tell(text)
        for name in _lost_inputs(node) if node.type == "BSDF_PRINCIPLED" else ():
            tell(f"{name} of node '{node.name}' is not supported")
    changes = (_other_alphas(nodes), _other_spaces(nodes), _clipped(nodes))
    for name, change in sorted({each for found in changes for each in found}):
        tell(f"image '{name}' is rendered with {change}")


def _unread(nodes):
    """The nodes that the exporter reads otherwise than Cycles."""
    shaders = [node for node in nodes if node.type in surfaces.EXPORTED]
    yield from (node for node in nodes if node.type not in _NODES)
    for shader in shaders:
        for socket in shader.inputs:
            for node in upstream(source(socket)):
                if not _is_read(node, socket.name):
                    yield node


def _is_read(node, name):
    """Whether the exporter understands a node on the way to the input of that name."""
    if node.type == "MATH":
        if node.operation == "MULTIPLY":
            return _has_factor(node.inputs[:2])
        return name == "Alpha" and node.operation in _CLIPS
    if node.type == "MIX":
        colors = [socket for socket in node.inputs if socket.enabled and socket.type == "RGBA"]
        is_product = node.data_type == "RGBA" and node.blend_type == "MULTIPLY"
        return is_product and unlinked(node.inputs[0]) == 1 and _has_factor(colors)
    if node.type == "TEX_COORD":
        return not any(socket.is_linked and socket.name != "UV" for socket in node.outputs)
    if node.type == "MAPPING":
        turns = unlinked(node.inputs["Rotation"])
        return node.vector_type != "NORMAL" and turns is not None and turns[:2] == (0, 0)
    if node.type == "TEX_IMAGE":
        return node.projection == "FLAT" and node.extension != "CLIP"
    if node.type == "NORMAL_MAP":
        color = unlinked(node.inputs["Color"])
        return node.space == "TANGENT" and (color is None or color[:3] == _FLAT)
    if node.type in ("ATTRIBUTE", "VERTEX_COLOR"):
        is_global = getattr(node, "attribute_type", "GEOMETRY") != "GEOMETRY"
        return name in ("Base Color", "Alpha") and not is_global
    return True


def _has_factor(sockets):
    nodes = [source(socket) for socket in sockets]
    return any(node is None or node.type in _FACTORS for node in nodes)


def _lost_image(node):
    """What differs of an image."""
    image = node.image
    if image is not None and image.source in _CHANGING:
        yield f"image '{image.name}' is not supported as a {image.source.lower()}"
    elif surfaces.has_lost_tiles(node):
        yield f"the tiles of image '{image.name}' are no files of PNG, JPEG or WebP; left out"
    elif surfaces.is_missing(node):
        what = f"image '{image.name}' can't be read" if image else "it has no image"
        yield f"node '{node.name}': {what}"
    if node.interpolation not in ("Linear", "Closest"):
        yield f"the interpolation of node '{node.name}' is linear, not {node.interpolation}"


def _lost_inputs(node):
    """The inputs of a Principled BSDF that glTF has no word for, by name."""
    has_coat = unlinked(node.inputs["Coat Weight"]) != 0
    for name, usual in (_INPUTS | (_COAT_INPUTS if has_coat else {})).items():
        socket = node.inputs.get(name)
        if socket is not None and unlinked(socket) != usual:
            yield name
    color = unlinked(node.inputs["Base Color"])
    if color is not None and max(color[:3]) > 1:
        yield "Base Color above 1"
    if unlinked(node.inputs["IOR"]) is None:
        yield "a linked IOR"
    elif unlinked(node.inputs["IOR"]) < 1:
        yield "an IOR below 1"
    if (unlinked(node.inputs["Metallic"]) or 0) > 0:
        is_rough = (unlinked(node.inputs["Roughness"]) or 0) > 0.5
        if is_rough and node.distribution == "MULTI_GGX":
            yield "Multiscatter GGX"
        tint = unlinked(node.inputs["Specular Tint"])
        if tint is None or tint[:3] != (1, 1, 1):
            yield "Specular Tint of a metal"
    tint = surfaces.lost_tint(node)
    if tint is not None:
        yield tint


def _other_alphas(nodes):
    """Images with other alpha than Cycles has, and what they are rendered with."""
    for node in nodes:
        image = node.image if node.type == "TEX_IMAGE" else None
        if image is None or image.depth not in _DEPTHS_WITH_ALPHA:
            continue
        same = ("CHANNEL_PACKED", "STRAIGHT" if node.outputs["Alpha"].is_linked else "NONE")
        if image.alpha_mode not in same and _is_transparent(image):
            modes = image.bl_rna.properties["alpha_mode"].enum_items
            yield image.name, f"alpha 'Channel Packed', not '{modes[image.alpha_mode].name}'"


def _clipped(nodes):
    """Images with values that glTF lacks, and what they are rendered with."""
    for node in nodes:
        image = node.image if node.type == "TEX_IMAGE" else None
        if image is not None and image.is_float and (_pixels(image) > 1).any():
            yield image.name, "values of at most 1"


def _is_transparent(image):
    return bool((_pixels(image)[3::4] < 1).any())


def _pixels(image):
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels


def _other_spaces(nodes):
    """Images in other colour spaces than glTF has, and what they are rendered with."""
    for shader in nodes:
        for socket in shader.inputs if shader.type in surfaces.EXPORTED else ():
            for node in upstream(source(socket)):
                image = node.image if node.type == "TEX_IMAGE" else None
                if image is None or socket.name == "Alpha":
                    continue
                space = image.colorspace_settings
                is_converted = image.is_float and image.source == "GENERATED"
                if is_converted and socket.type == "RGBA" and not space.is_data:
                    continue
                is_linear = space.is_data or space.name.startswith("Linear")
                if is_linear if socket.type == "RGBA" else not is_linear:
                    expected = "sRGB" if socket.type == "RGBA" else "Non-Color"
                    yield image.name, f"color space '{expected}', not '{space.name}'"

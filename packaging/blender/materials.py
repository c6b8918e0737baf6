"""What Blender's glTF exporter loses of materials, and of objects."""

import numpy as np

from .nodes import linked, output_of, source, tree_of, upstream

# Those that the exporter reads
_NODES = {
    "ATTRIBUTE", "BSDF_PRINCIPLED", "BSDF_TRANSPARENT", "BACKGROUND", "EMISSION", "GROUP",
    "GROUP_INPUT", "GROUP_OUTPUT", "LIGHT_PATH", "MAPPING", "MATH", "MIX", "MIX_RGB", "MIX_SHADER",
    "NORMAL_MAP", "OUTPUT_MATERIAL", "RGB", "SEPARATE_COLOR", "SEPRGB", "TEX_COORD", "TEX_IMAGE",
    "UVMAP", "VALUE", "VERTEX_COLOR",
}
_DEPTHS_WITH_ALPHA = (32, 64, 128)  # bits of a pixel
_GEOMETRY = {"MESH", "CURVE", "SURFACE", "META", "FONT"}
_INVISIBLE = {"EMPTY", "CAMERA", "LIGHT", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE"}
_SHADOWLESS = ("visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission",
               "visible_shadow")


def check(depsgraph, warn):
    """Names what is left out of the objects that are rendered."""
    checked = set()
    for instance in depsgraph.object_instances:
        each = instance.object.original
        if each in checked or not instance.show_self:
            continue
        checked.add(each)
        _check_object(each, warn)
        for slot in each.material_slots:
            material = slot.material
            if material is not None and material not in checked:
                checked.add(material)
                _check_material(material, warn)


def _check_object(each, warn):
    if each.type not in _GEOMETRY | _INVISIBLE | {"VOLUME"}:
        kind = each.type.lower().replace("_", " ")
        warn(f"object '{each.name}' ({kind}) is not supported; left out")
    if any(system.settings.type == "HAIR" for system in each.particle_systems):
        warn(f"the hair of object '{each.name}' is not supported; left out")
    if any(m.type == "FLUID" and m.fluid_type == "DOMAIN" for m in each.modifiers):
        warn(f"the fluid of object '{each.name}' is not supported; left out")
    if each.type not in _INVISIBLE and not all(getattr(each, name) for name in _SHADOWLESS):
        warn(f"the ray visibility of object '{each.name}' is ignored")


def _check_material(material, warn):
    tree = tree_of(material)
    output = output_of(tree, "OUTPUT_MATERIAL") if tree else None
    if output is None:
        return
    if linked(output, "Displacement") is not None:
        warn(f"the displacement of material '{material.name}' is not supported; left out")
    nodes = list(upstream(linked(output, "Surface")))
    names = [node.name for node in nodes if node.type not in _NODES]
    if names:
        listed = ", ".join(f"'{name}'" for name in sorted(names))
        warn(f"material '{material.name}': glTF has no node {listed}; its default is used")
    for name, change in sorted({*_other_alphas(nodes), *_other_spaces(nodes)}):
        warn(f"material '{material.name}': image '{name}' is rendered with {change}")


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


def _is_transparent(image):
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return bool((pixels[3::4] < 1).any())


def _other_spaces(nodes):
    """Images in other colour spaces than glTF has, and what they are rendered with."""
    for shader in nodes:
        for socket in shader.inputs if shader.type in ("BSDF_PRINCIPLED", "EMISSION") else ():
            for node in upstream(source(socket)):
                image = node.image if node.type == "TEX_IMAGE" else None
                if image is None or socket.name == "Alpha":
                    continue
                space = image.colorspace_settings
                is_linear = space.is_data or space.name.startswith("Linear")
                if is_linear if socket.type == "RGBA" else not is_linear:
                    expected = "sRGB" if socket.type == "RGBA" else "Non-Color"
                    yield image.name, f"color space '{expected}', not '{space.name}'"

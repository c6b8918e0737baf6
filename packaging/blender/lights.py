"""Lights of Blender, in the units of `extras.candela`: docs/MODELS.md.

Blender's powers and their meaning are those of Cycles: a light of P watts has the intensity
P / 4π W/sr, and an area light the radiance P / πA.
"""

import math

from .nodes import linked, output_of, unlinked

LUMENS_PER_WATT = 683.0
_TYPES = {"POINT": "point", "SPOT": "spot", "SUN": "directional"}


def fields(lamp, matrix, warn):
    """The light of KHR_lights_punctual, if it is one, and `extras.candela.light` of its node.

    :param lamp: an object; what gives no light is None
    """
    light = lamp.data
    if getattr(getattr(light, "cycles", None), "is_portal", False):
        return None, None
    watts = _watts(light, matrix, warn)
    if min(watts) < 0:
        warn(f"the negative power of light '{light.name}' is not supported")
        return None, None
    if light.type == "AREA":
        described, more = None, _area(light, watts, matrix, warn)
    else:
        described, more = _punctual(light, watts, matrix, warn)
    return described, more and {**more, "inView": lamp.visible_camera}


def _watts(light, matrix, warn):
    """Red, green and blue in watts; of a sun, in W/m²."""
    tint = light.temperature_color if light.use_temperature else (1.0, 1.0, 1.0)
    scale = light.energy * 2 ** getattr(light, "exposure", 0.0)
    if not getattr(light, "normalize", True):
        scale *= light.area(matrix_world=matrix)
    colors = zip(light.color, tint, _emission(light, warn), strict=True)
    return [scale * c * t * e for c, t, e in colors]


def _emission(light, warn):
    """What the nodes make of the light."""
    if not light.use_nodes or light.node_tree is None:
        return (1.0, 1.0, 1.0)
    output = output_of(light.node_tree)
    node = linked(output, "Surface") if output else None
    if node is None:
        return (0.0, 0.0, 0.0)
    if node.type == "EMISSION":
        color, power = unlinked(node.inputs["Color"]), unlinked(node.inputs["Strength"])
        if color is not None and power is not None:
            return tuple(c * power for c in color[:3])
    warn(f"the nodes of light '{light.name}' are not supported; using its colour and power")
    return (1.0, 1.0, 1.0)


def _punctual(light, watts, matrix, warn):
    power = max(watts)
    unit = LUMENS_PER_WATT if light.type == "SUN" else LUMENS_PER_WATT / (4 * math.pi)
    described = {
        "type": _TYPES[light.type],
        "name": light.name,
        "color": [w / power for w in watts] if power > 0 else [1.0, 1.0, 1.0],
        "intensity": power * unit,
    }
    if light.type == "SUN":
        return described, {"angle": min(light.angle, math.pi)}
    more = {"radius": light.shadow_soft_size}
    if light.type == "SPOT":
        outer = min(light.spot_size / 2, math.pi / 2)
        described["spot"] = {"innerConeAngle": 0.0, "outerConeAngle": outer}
        more["blend"] = light.spot_blend
        if light.use_square:
            warn(f"the square cone of light '{light.name}' is not supported; using a round one")
        if light.spot_size > math.pi + 1e-4:
            warn(f"the cone of light '{light.name}' is over 180°; using 180°")
        scale = matrix.to_scale()
        if max(scale) - min(scale) > 1e-4 * max(scale):
            warn(f"the scale of light '{light.name}' is ignored: its cone is round")
    return described, more


def _area(light, watts, matrix, warn):
    is_wide = light.shape in ("RECTANGLE", "ELLIPSE")
    width, height = light.size, light.size_y if is_wide else light.size
    is_round = light.shape in ("DISK", "ELLIPSE")
    scale = matrix.to_scale()
    surface = abs(width * scale.x * height * scale.y) * (math.pi / 4 if is_round else 1)
    if surface <= 0:
        warn(f"light '{light.name}' has no area; left out")
        return None
    if not matrix.to_3x3().is_orthogonal_axis_vectors:
        warn(f"the shape of light '{light.name}' is not sheared as in Cycles")
    return {
        "shape": "ellipse" if is_round else "rectangle",
        "size": [width, height],
        "radiance": [w / (math.pi * surface) for w in watts],
        "spread": min(light.spread, math.pi),
    }

"""Lights of Blender, in the units of `extras.candela`: docs/MODELS.md.

Blender's powers and their meaning are those of Cycles: a light of P watts has the intensity
P / 4π W/sr, and an area light the radiance P / πA.
"""

import math

from .nodes import linked, output_of, unlinked

LUMENS_PER_WATT = 683.0


class Power:
    """The power of a light as it is when the export begins."""

    def __init__(self, light):
        self._light = light
        tint = light.temperature_color if light.use_temperature else (1.0, 1.0, 1.0)
        scale = light.energy * 2 ** getattr(light, "exposure", 0.0)
        self._color = [scale * c * t for c, t in zip(light.color, tint)]
        self._is_of_all = getattr(light, "normalize", True)

    def watts(self, matrix, warn):
        """Red, green and blue in watts; of a sun, in W/m²."""
        area = 1.0 if self._is_of_all else self._light.area(matrix_world=matrix)
        return [c * area * f for c, f in zip(self._color, _emission(self._light, warn))]


def _emission(light, warn):
    """What the nodes make of the light."""
    if not light.use_nodes or light.node_tree is None:
        return (1.0, 1.0, 1.0)
    output = output_of(light.node_tree, "OUTPUT_LIGHT")
    node = linked(output, "Surface") if output else None
    if node is None:
        return (0.0, 0.0, 0.0)
    if node.type == "EMISSION":
        color, power = unlinked(node.inputs["Color"]), unlinked(node.inputs["Strength"])
        if color is not None and power is not None:
            return tuple(c * power for c in color[:3])
    warn(f"the nodes of light '{light.name}' are not supported; using its colour and power")
    return (1.0, 1.0, 1.0)


def _brightest(watts):
    """A factor, and a colour of at most 1."""
    power = max(watts)
    return power, [w / power for w in watts] if power > 0 else [1.0, 1.0, 1.0]


def punctual(light, watts, warn):
    """The light of KHR_lights_punctual, and `extras.candela.light` of its node."""
    power, color = _brightest(watts)
    unit = LUMENS_PER_WATT if light.type == "SUN" else LUMENS_PER_WATT / (4 * math.pi)
    fields = {"color": color, "intensity": power * unit}
    if light.type == "SUN":
        return fields, {"angle": min(light.angle, math.pi)}
    more = {"radius": light.shadow_soft_size}
    if light.type == "SPOT":
        outer = min(light.spot_size / 2, math.pi / 2)
        fields["spot"] = {"innerConeAngle": 0.0, "outerConeAngle": outer}
        more["blend"] = light.spot_blend
        if light.use_square:
            warn(f"the square cone of light '{light.name}' is not supported; using a round one")
        if light.spot_size > math.pi + 1e-4:
            warn(f"the cone of light '{light.name}' is over 180°; using 180°")
    return fields, more


def area(light, watts, matrix, warn):
    """`extras.candela.light` of an area light."""
    is_wide = light.shape in ("RECTANGLE", "ELLIPSE")
    width, height = light.size, light.size_y if is_wide else light.size
    is_round = light.shape in ("DISK", "ELLIPSE")
    scale = matrix.to_scale()
    surface = abs(width * scale.x * height * scale.y) * (math.pi / 4 if is_round else 1)
    if surface <= 0:
        warn(f"light '{light.name}' has no area; left out")
        return None
    return {
        "shape": "ellipse" if is_round else "rectangle",
        "size": [width, height],
        "radiance": [w / (math.pi * surface) for w in watts],
        "spread": min(light.spread, math.pi),
    }

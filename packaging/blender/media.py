"""Volume shaders, as `extras.candela.medium` of docs/MODELS.md. Their units are those of Cycles."""

import math
from typing import NamedTuple

from .nodes import linked, output_of, source, tree_of, unlinked

DENSITY = "density"


class Medium(NamedTuple):
    """Coefficients in red, green and blue, per metre.

    :param emission: in W/(m³ sr)
    :param grid: that the coefficients are scaled by, or None
    """

    absorption: tuple = (0.0, 0.0, 0.0)
    scattering: tuple = (0.0, 0.0, 0.0)
    anisotropy: float = 0.0
    emission: tuple = (0.0, 0.0, 0.0)
    grid: str | None = None

    @property
    def is_empty(self):
        return not any(self.absorption) and not any(self.scattering)

    def fields(self, scale=1.0):
        return {
            "absorption": list(_times(self.absorption, scale)),
            "scattering": list(_times(self.scattering, scale)),
            "anisotropy": self.anisotropy,
        }


# What Cycles has where a volume has no material
DEFAULT = Medium((0.5,) * 3, (0.5,) * 3, grid=DENSITY)


def is_surface(material):
    """Whether light meets a surface of the material."""
    tree = tree_of(material)
    output = output_of(tree) if tree else None
    return output is None or linked(output, "Surface") is not None


def of(material, grids, warn):
    """The medium of a material, or None if it has no volume.

    :param grids: names of those that the object has
    """
    tree = tree_of(material)
    output = output_of(tree) if tree else None
    node = linked(output, "Volume") if output else None
    if node is None:
        return None
    shader = _Shader(material, grids, warn)
    return shader.sum(list(shader.closures(node, 1.0)))


class _Shader:
    def __init__(self, material, grids, warn):
        self._grids = grids
        self._warn = lambda text: warn(f"material '{material.name}': {text}")

    def closures(self, node, weight):
        """Each closure that adds to the volume."""
        if node is None or weight == 0:
            return
        inputs = node.inputs
        if node.type == "ADD_SHADER":
            for socket in inputs:
                yield from self.closures(source(socket), weight)
        elif node.type == "MIX_SHADER" and unlinked(inputs[0]) is not None:
            factor = min(max(unlinked(inputs[0]), 0.0), 1.0)
            yield from self.closures(source(inputs[1]), weight * (1 - factor))
            yield from self.closures(source(inputs[2]), weight * factor)
        elif node.type in _KINDS:
            yield _KINDS[node.type](self, node, weight)
        else:
            self._warn(f"volumes have no node '{node.name}' in Candela; left out")

    def sum(self, closures):
        """One medium of several."""
        of_matter = [c for c in closures if not c.is_empty]
        grid = of_matter[0].grid if of_matter else None
        some = [c for c in of_matter if c.grid == grid]
        if len(some) < len(of_matter):
            names = " and ".join(sorted({str(c.grid or "a constant") for c in of_matter}))
            self._warn(f"its density is one of {names}; using the first node's")
        weights = [sum(c.scattering) for c in some]
        if len({c.anisotropy for c, w in zip(some, weights, strict=True) if w > 0}) > 1:
            self._warn("its volume has one anisotropy in Candela, the mean")
        total = sum(weights)
        mean = sum(c.anisotropy * w for c, w in zip(some, weights, strict=True))
        return Medium(
            _added(c.absorption for c in some),
            _added(c.scattering for c in some),
            mean / total if total > 0 else 0.0,
            _added(c.emission for c in closures),
            grid,
        )

    def principled(self, node, weight):
        name = node.inputs["Density Attribute"].default_value
        density, grid = self._density(node, name if name in self._grids else None)
        self._warn_of_colors(node)
        color = self._color(node, "Color")
        dark = [math.sqrt(c) for c in self._color(node, "Absorption Color")]
        absorbed = [max(1 - c, 0) * max(1 - d, 0) for c, d in zip(color, dark, strict=True)]
        strength = self._number(node, "Emission Strength")
        if self._number(node, "Blackbody Intensity") > 0:
            self._warn("the blackbody emission of volumes is not supported; left out")
        return Medium(
            _times(absorbed, weight * density),
            _times(color, weight * density),
            self._number(node, "Anisotropy"),
            _times(self._color(node, "Emission Color"), weight * max(strength, 0)),
            grid,
        )

    def _warn_of_colors(self, node):
        name = node.inputs["Color Attribute"].default_value
        if name in self._grids:
            self._warn(f"the colours of grid '{name}' are not supported; using one colour")

    def scatter(self, node, weight):
        density, grid = self._density(node)
        self._warn_of_phase(node)
        color = _times(self._color(node, "Color"), weight * density)
        return Medium(scattering=color, anisotropy=self._number(node, "Anisotropy"), grid=grid)

    def absorption(self, node, weight):
        density, grid = self._density(node)
        absorbed = [max(1 - c, 0) for c in self._color(node, "Color")]
        return Medium(absorption=_times(absorbed, weight * density), grid=grid)

    def coefficients(self, node, weight):
        self._warn_of_phase(node)
        return Medium(
            _times(self._color(node, "Absorption Coefficients"), weight),
            _times(self._color(node, "Scatter Coefficients"), weight),
            self._number(node, "Anisotropy"),
            _times(self._color(node, "Emission Coefficients"), weight),
        )

    def emission(self, node, weight):
        strength = max(self._number(node, "Strength"), 0)
        return Medium(emission=_times(self._color(node, "Color"), weight * strength))

    def _warn_of_phase(self, node):
        phase = getattr(node, "phase", "HENYEY_GREENSTEIN")
        if phase != "HENYEY_GREENSTEIN":
            name = phase.replace("_", " ").title()
            self._warn(f"the phase function {name} is not supported; using Henyey-Greenstein")

    def _density(self, node, grid=None):
        """A factor, and the name of the grid that it scales, or None."""
        factor, linked_grid = self._product(node, node.inputs["Density"])
        if grid is not None and linked_grid is not None:
            self._warn(f"the density of node '{node.name}' is that of grid '{grid}' alone")
        return max(factor, 0), grid or linked_grid

    def _product(self, node, socket):
        value = unlinked(socket)
        if value is not None:
            return value, None
        below = source(socket)
        output = socket.links[0].from_socket.name
        if below.type == "VOLUME_INFO" and output == "Density" and DENSITY in self._grids:
            return 1.0, DENSITY
        is_number = output in ("Fac", "Factor")
        if below.type == "ATTRIBUTE" and is_number and below.attribute_name in self._grids:
            return 1.0, below.attribute_name
        if below.type == "MATH" and below.operation == "MULTIPLY" and not below.use_clamp:
            (a, first), (b, second) = (self._product(node, s) for s in below.inputs[:2])
            if first is None or second is None:
                return a * b, first or second
        self._warn(f"the density of node '{node.name}' is not supported; left out")
        return 0.0, None

    def _number(self, node, name):
        return self._value(node, name) if name in node.inputs else 0.0

    def _color(self, node, name):
        return tuple(max(0.0, c) for c in self._value(node, name)[:3])

    def _value(self, node, name):
        socket = node.inputs[name]
        value = unlinked(socket)
        if value is None:
            self._warn(f"'{name}' of node '{node.name}' is not constant; its default is used")
            value = socket.default_value
        return value


_KINDS = {
    "PRINCIPLED_VOLUME": _Shader.principled,
    "VOLUME_SCATTER": _Shader.scatter,
    "VOLUME_ABSORPTION": _Shader.absorption,
    "VOLUME_COEFFICIENTS": _Shader.coefficients,
    "EMISSION": _Shader.emission,
}


def _times(color, factor):
    return tuple(c * factor for c in color)


def _added(colors):
    return tuple(map(sum, zip((0.0,) * 3, *colors, strict=True)))

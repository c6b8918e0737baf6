package candela.build

import candela.color.Rgb
import candela.math.Vec3

/** What all volumes of v2 have. */
abstract class VolumeRecipe(name: String, meaning: String)
    extends Recipe[Unit](name, meaning, onlyV2)
    with Vacuum:
  declare(
    color("sigma_a", "absorption coefficient", SpectrumRole.Reflectance, unit = PerUnit)(Rgb.Black),
    color("sigma_s", "scattering coefficient", SpectrumRole.Reflectance, unit = PerUnit)(Rgb.Black),
    float("g", "asymmetry of scattering, -1 to 1")(0f),
    color("Le", "emitted radiance", SpectrumRole.Emission, unit = "W/(m³ sr)")(Rgb.Black),
    point("p0", "a corner of the box")(Vec3.Zero),
    point("p1", "the opposite one")(Vec3(1f, 1f, 1f))
  )

object HomogeneousVolume extends VolumeRecipe("homogeneous", "the same everywhere in a box")

object ExponentialVolume extends VolumeRecipe("exponential", "thinner with height: a exp(-b h)"):
  declare(
    float("a", "density at height 0")(1f),
    float("b", "how fast it falls", unit = PerUnit)(1f),
    vector("updir", "along which height is measured")(Vec3.Y)
  )

object VolumeGrid extends VolumeRecipe("volumegrid", "a grid of densities"):
  declare(
    numbers("density", "float[]", "nx by ny by nz densities, x first"),
    integer("nx", "cells along x")(1),
    integer("ny", "cells along y")(1),
    integer("nz", "cells along z")(1)
  )

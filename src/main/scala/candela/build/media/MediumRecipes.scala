package candela.build

import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.Dialect

/** What all media of v3 and v4 have. */
abstract class MediumRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[Unit](name, meaning, dialects)
    with Vacuum:
  declare(float("g", "asymmetry of scattering, -1 to 1")(0f))

  /** Coefficients that are the same everywhere, or multiply a density. */
  protected def coefficients(): Unit = declare(
    color("sigma_a", "absorption coefficient", SpectrumRole.Reflectance, unit = PerUnit)(
      if v4 then Rgb.White else Rgb(0.0011f, 0.0024f, 0.014f)
    ),
    color("sigma_s", "scattering coefficient", SpectrumRole.Reflectance, unit = PerUnit)(
      if v4 then Rgb.White else Rgb(2.55f, 3.21f, 3.77f)
    )
  )

  protected def preset(): Unit = declare(
    string("preset", "name of a measured medium, instead of coefficients", shown = "none")("")
  )

  protected def scale(): Unit = declare(float("scale", "factor of the coefficients")(1f))

  protected def emission(): Unit = declare(
    color("Le", "emitted radiance", SpectrumRole.Emission, onlyV4, "W/(m² sr)", "none")(Rgb.Black)
  )

  protected def emissionScale(): Unit =
    declare(float("Lescale", "factor of what is emitted", onlyV4)(1f))

  protected def box(): Unit = declare(
    point("p0", "a corner of the box")(Vec3.Zero),
    point("p1", "the opposite one")(Vec3(1f, 1f, 1f))
  )

  protected def grid(): Unit =
    for axis <- Seq("x", "y", "z") do declare(integer(s"n$axis", s"cells along $axis")(1))

  protected def temperatures(): Unit = declare(
    float("temperatureoffset", "subtracted from temperatures", unit = "K")(0f),
    float(
      "temperaturecutoff",
      "another name of `temperatureoffset`",
      unit = "K",
      shown = "temperatureoffset"
    )(0f),
    float("temperaturescale", "factor of temperatures")(1f)
  )

private[build] val PerUnit = "1/scene unit"

object HomogeneousMedium extends MediumRecipe("homogeneous", "the same everywhere", sinceV3):
  preset()
  coefficients()
  scale()
  emission()
  emissionScale()

object HeterogeneousMedium extends MediumRecipe("heterogeneous", "a grid of densities", onlyV3):
  preset()
  coefficients()
  scale()
  declare(numbers("density", "float[]", "nx by ny by nz densities, x first"))
  grid()
  box()

object UniformGrid extends MediumRecipe("uniformgrid", "a grid of densities", onlyV4):
  coefficients()
  scale()
  declare(
    numbers("density", "float[]", "nx by ny by nz densities, x first"),
    numbers("temperature", "float[]", "of each cell, which glows", unit = "K"),
    numbers("Lescale", "float[]", "factor of what each cell emits", shown = "1")
  )
  emission()
  grid()
  box()
  temperatures()

object RgbGrid extends MediumRecipe("rgbgrid", "a grid of coefficients", onlyV4):
  declare(
    numbers("sigma_a", "rgb[]", "absorption of each cell", unit = PerUnit, shown = "1"),
    numbers("sigma_s", "rgb[]", "scattering of each cell", unit = PerUnit, shown = "1"),
    numbers("Le", "rgb[]", "emitted radiance of each cell", unit = "W/(m² sr)")
  )
  scale()
  emissionScale()
  grid()
  box()

object Cloud extends MediumRecipe("cloud", "a cloud of noise", onlyV4):
  coefficients()
  declare(
    float("density", "factor of the density")(1f),
    float("wispiness", "how much the cloud frays")(1f),
    float("frequency", "of the noise")(5f)
  )
  box()

object NanoVdb extends MediumRecipe("nanovdb", "densities from a NanoVDB file", onlyV4):
  coefficients()
  scale()
  declare(
    string("filename", "a .nvdb file", shown = "none")(""),
    string("gridname", "the grid of densities")("density"),
    string("temperaturename", "the grid of temperatures")("temperature")
  )
  emissionScale()
  temperatures()

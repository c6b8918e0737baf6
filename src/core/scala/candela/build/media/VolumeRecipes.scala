package candela.build.media

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*
import candela.media.*

/** Base of v2's volumes. */
abstract class VolumeRecipe(name: String, meaning: String)
    extends Recipe[Option[Region]](name, meaning, onlyV2)
    with Scatters
    with HasBox:
  private val sigmaA =
    color(
      "sigma_a", "absorption coefficient", SpectrumRole.Reflectance, unit = PerUnit, range = Held
    )(Rgb.Black)
  private val sigmaS =
    color(
      "sigma_s", "scattering coefficient", SpectrumRole.Reflectance, unit = PerUnit, range = Held
    )(Rgb.Black)
  private val emitted =
    color("Le", "emitted radiance", SpectrumRole.Emission, unit = "W/(m³ sr)", range = Held)(
      Rgb.Black
    )

  protected def filling()(using Site): Filling =
    Filling(notNegative(sigmaA()), notNegative(sigmaS()), notNegative(emitted()), phase())

  /** The box and its transform to the world. Warns and returns None if it is empty or its transform
    * is singular.
    */
  protected def box()(using site: Site): Option[(Transform, Bounds3)] =
    val (low, high) = corners(sorted = true)
    val size = high - low
    val hasVolume = size.isFinite && size.x > 0f && size.y > 0f && size.z > 0f
    if !hasVolume || site.toWorld.isFlat then
      site.warn(Code.NoVolume, "this volume is empty; it is ignored")
      None
    else
      val (least, most) = (corner(low), corner(high))
      val isFar = least.reach >= VolumeRecipe.Far * size.length
      if !isFar then Some((site.toWorld, Bounds3(low, high)))
      else Some((site.toWorld * least.fromOrigin, Bounds3(Vec3.Zero, span(least, most))))

private object VolumeRecipe:
  /** Sizes from its own origin at which a box is moved there, where Floats are finer. */
  private val Far = 1024.0

object HomogeneousVolumeRecipe extends VolumeRecipe("homogeneous", "homogeneous volume in a box"):
  protected def create()(using site: Site): Option[Region] =
    box().map((toWorld, b) => UniformRegion(toWorld, b, filling()))

object ExponentialVolumeRecipe
    extends VolumeRecipe("exponential", "density that falls off with height h: a exp(-b h)"):
  private val ground = float("a", "density at height 0", range = Coefficients)(1f)
  private val falloff = float("b", "falloff of the density", unit = PerUnit)(1f)
  private val upDirection = vector("updir", "direction of height")(Vec3.Y)

  protected def create()(using site: Site): Option[Region] =
    val direction = upDirection()
    if direction.isZero then
      site.error(Code.ParameterValue, "`updir` must not be zero")
      None
    else
      for (toWorld, b) <- box()
      yield ExponentialRegion(
        toWorld,
        b,
        filling(),
        direction.normalized,
        ground(),
        falloff()
      )

object VolumeGridRecipe extends VolumeRecipe("volumegrid", "density grid in a box") with HasGrid:
  private val densities =
    Samples(densityOfCells)

  protected def create()(using site: Site): Option[Region] =
    for
      (toWorld, b) <- box()
      density <- densities()
    yield GridRegion(toWorld, b, filling(), density)

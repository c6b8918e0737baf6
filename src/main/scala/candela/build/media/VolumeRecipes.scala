package candela.build.media

import candela.build.recipe.*
import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*
import candela.media.*

/** What all volumes of v2 have. */
abstract class VolumeRecipe(name: String, meaning: String)
    extends Recipe[Option[Region]](name, meaning, onlyV2)
    with Scatters
    with HasBox:
  private val sigmaA =
    color("sigma_a", "absorption coefficient", SpectrumRole.Reflectance, unit = PerUnit)(Rgb.Black)
  private val sigmaS =
    color("sigma_s", "scattering coefficient", SpectrumRole.Reflectance, unit = PerUnit)(Rgb.Black)
  private val emitted =
    color("Le", "emitted radiance", SpectrumRole.Emission, unit = "W/(m³ sr)")(Rgb.Black)

  protected def filling()(using Site): Filling =
    Filling(held(sigmaA(), "sigma_a"), held(sigmaS(), "sigma_s"), held(emitted(), "Le"), phase())

  /** The box, if it and its place in the world can be had; else it was said that they can't. */
  protected def box()(using site: Site): Option[Bounds3] =
    val (low, high) = corners(sorted = true)
    val size = high - low
    val hasVolume = size.isFinite && size.x > 0f && size.y > 0f && size.z > 0f
    if !hasVolume || site.toWorld.isFlat then
      site.warn("this volume is empty: it is left out")
      None
    else Some(Bounds3(low, high))

object HomogeneousVolumeRecipe extends VolumeRecipe("homogeneous", "the same everywhere in a box"):
  protected def make()(using site: Site): Option[Region] =
    box().map(UniformRegion(site.toWorld, _, filling()))

object ExponentialVolumeRecipe
    extends VolumeRecipe("exponential", "thinner with height: a exp(-b h)"):
  private val ground = float("a", "density at height 0")(1f)
  private val fall = float("b", "how fast it falls", unit = PerUnit)(1f)
  private val up = vector("updir", "along which height is measured")(Vec3.Y)

  protected def make()(using site: Site): Option[Region] =
    val direction = up()
    if direction.isZero then
      site.error("`updir` has no direction")
      None
    else
      for b <- box()
      yield ExponentialRegion(
        site.toWorld,
        b,
        filling(),
        direction.normalized,
        Math.max(0f, ground()),
        fall()
      )

object VolumeGridRecipe extends VolumeRecipe("volumegrid", "a grid of densities") with HasGrid:
  private val density = numbers("density", "float[]", "nx by ny by nz densities, x first")

  protected def make()(using site: Site): Option[Region] =
    for
      b <- box()
      grids <- samples("density", density())
    yield GridRegion(site.toWorld, b, filling(), grids.head)

package candela.build.media

import candela.base.Suggest
import candela.build.recipe.*
import candela.color.Rgb
import candela.geometry.Bounds3
import candela.math.*
import candela.media.{GridEdge, Medium, Region, SampledGrid}
import candela.sampling.HenyeyGreenstein
import candela.scenefile.Dialect

/** Recipes of participating media: v3's and v4's. They make none where there would be nothing. */
object Media:
  val all: Recipes[Option[Medium]] = Recipes(
    "medium",
    Vector(
      HomogeneousRecipe, HeterogeneousRecipe, UniformGridRecipe, RgbGridRecipe, CloudRecipe,
      NanoVdbRecipe
    )
  )

/** Recipes of v2's volumes, which fill a box. */
object Volumes:
  val all: Recipes[Option[Region]] =
    Recipes("volume", Vector(HomogeneousVolumeRecipe, VolumeGridRecipe, ExponentialVolumeRecipe))

private[build] val PerUnit = "1/scene unit"

/** What media and volumes share. */
trait Scatters extends Fields:
  private val asymmetry = float("g", "asymmetry of scattering, -1 to 1")(0f)

  protected def phase()(using site: Site): HenyeyGreenstein =
    // Where pbrt-v4 ends; nearer to 1 the function is too narrow for Floats
    val most = if site.dialect == Dialect.V4 then 0.99f else 0.999f
    val g = asymmetry()
    if !(Math.abs(g) <= most) then site.warn(s"`g` of $g is held to ±$most")
    HenyeyGreenstein(if g.isNaN then 0f else clamp(g, -most, most))

  /** Coefficients can't be negative. */
  protected def held(c: Rgb, name: String)(using site: Site): Rgb =
    if c.isFinite && c.r >= 0f && c.g >= 0f && c.b >= 0f then c
    else
      site.warn(s"`$name` is negative or no number somewhere: 0 is used there")
      c.map(v => if v > 0f && java.lang.Float.isFinite(v) then v else 0f)

/** What all media of v3 and v4 have. */
abstract class MediumRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[Option[Medium]](name, meaning, dialects)
    with Scatters

/** Coefficients that are the same everywhere, or multiply a density. */
trait HasCoefficients extends Scatters:
  private val sigmaA =
    color("sigma_a", "absorption coefficient", SpectrumRole.Reflectance, unit = PerUnit)(
      if v4 then Rgb.White else Rgb(0.0011f, 0.0024f, 0.014f)
    )
  private val sigmaS =
    color("sigma_s", "scattering coefficient", SpectrumRole.Reflectance, unit = PerUnit)(
      if v4 then Rgb.White else Rgb(2.55f, 3.21f, 3.77f)
    )

  /** A measured medium that takes the place of the defaults; in v4 of what is given, too. */
  protected def measured()(using Site): Option[MediumCoefficients] = None

  protected def factor()(using Site): Float = 1f

  /** Absorption and scattering. */
  protected def coefficients()(using site: Site): (Rgb, Rgb) =
    val known = measured()
    def of(given_ : Option[Rgb], preset: Option[Rgb], default: => Rgb) =
      val first =
        if site.dialect == Dialect.V4 then preset.orElse(given_) else given_.orElse(preset)
      first.getOrElse(default) * factor()
    (
      held(of(sigmaA.given_(), known.map(_.absorption), sigmaA()), "sigma_a"),
      held(of(sigmaS.given_(), known.map(_.scattering), sigmaS()), "sigma_s")
    )

trait HasScale extends HasCoefficients:
  private val scale = float("scale", "factor of the coefficients")(1f)
  override protected def factor()(using Site): Float = scale()

trait HasPreset extends HasCoefficients:
  private val preset =
    string("preset", "name of a measured medium, instead of coefficients", shown = "none")("")

  override protected def measured()(using site: Site): Option[MediumCoefficients] =
    val name = preset()
    val found = MeasuredMedia.find(name, site.dialect)
    if name.nonEmpty && found.isEmpty then
      site.missing(
        s"no measured medium is named `$name`",
        StandIns.Default,
        Suggest.help(name, MeasuredMedia.names(site.dialect))
      )
    val basis = site.resources.basis
    found.map(m => MediumCoefficients(basis.fromSrgb(m.absorption), basis.fromSrgb(m.scattering)))

/** The box that a medium fills, in its own space. */
trait HasBox extends Fields:
  private val first = point("p0", "a corner of the box")(Vec3.Zero)
  private val second = point("p1", "the opposite one")(Vec3(1f, 1f, 1f))

  /** Two corners; where `sorted`, the least and the greatest. */
  protected def corners(sorted: Boolean)(using Site): (Vec3, Vec3) =
    val (a, b) = (first(), second())
    if sorted then
      val box = Bounds3.of(Seq(a, b))
      (box.min, box.max)
    else (a, b)

  /** From world space to the unit cube. None if there is no such map, which was said. */
  protected def toUnit()(using site: Site): Option[Transform] =
    // A box of pbrt-v3 may be written the other way round: its grid is mirrored then
    val (a, b) = corners(sorted = site.dialect == Dialect.V4)
    val size = b - a
    val scale = Transform.scale(size.x, size.y, size.z)
    val map =
      if site.toWorld.isFlat then None
      else
        scale.map: s =>
          (site.toWorld * Transform.translate(a.x, a.y, a.z) * s).inverse
    if map.isEmpty then site.warn("this medium has no volume: it is left out")
    map

/** Grids of samples. */
trait HasGrid extends Fields:
  private val sizes =
    Vector("x", "y", "z").map(axis => integer(s"n$axis", s"cells along $axis")(1))

  /** The samples, `channels` at each place; None if their number is wrong, which was said. */
  protected def samples(name: String, values: Array[Float], channels: Int = 1)(using
      site: Site
  ): Option[Vector[SampledGrid]] =
    val Vector(nx, ny, nz) = sizes.map(_()): @unchecked
    val wanted = sizes.map(_().toLong).product * channels
    if Seq(nx, ny, nz).exists(_ < 1) || wanted != values.length then
      val shape = (Seq(nx, ny, nz) ++ Option.when(channels > 1)(channels)).mkString("·")
      site.error(s"`$name` holds ${values.length} numbers, not $shape")
      None
    else
      val edge = if site.dialect == Dialect.V2 then GridEdge.Clamped else GridEdge.Zero
      Some(Vector.tabulate(channels): c =>
        val one = Array.tabulate(values.length / channels): i =>
          val v = values(i * channels + c)
          if v > 0f && java.lang.Float.isFinite(v) then v else 0f
        SampledGrid(nx, ny, nz, one, edge))

package candela.build.media

import candela.diagnostics.{Code, Suggest}
import candela.build.recipe.*
import candela.color.Rgb
import candela.math.*
import candela.media.{Medium, Region, SampledGrid, VaryingMedium, WorldBoxMedium}
import candela.sampling.{HenyeyGreenstein, PhaseFunction}
import candela.scenefile.Dialect

/** Recipes of v3's and v4's participating media. An empty medium is None. */
object Media:
  val all: Recipes[Option[Medium]] = Recipes(
    "medium",
    Vector(
      HomogeneousRecipe, HeterogeneousRecipe, UniformGridRecipe, RgbGridRecipe, CloudRecipe,
      NanoVdbRecipe
    )
  )

/** Recipes of v2's volumes, each within a box. */
object Volumes:
  val all: Recipes[Option[Region]] =
    Recipes("volume", Vector(HomogeneousVolumeRecipe, VolumeGridRecipe, ExponentialVolumeRecipe))

private[build] val PerUnit = "1/scene unit"

/** Of coefficients and their scales, whose product is a number, too. */
private[build] val Coefficients: Range = Range(0f, 1e15f).limited
private[build] val Held: Option[Range] = Some(Coefficients)

/** Phase function and checks of media and volumes. */
trait Scatters extends Fields:
  // pbrt-v4's bound; nearer to 1 the phase function exceeds Float precision
  private val asymmetry = float(
    "g",
    "scattering asymmetry",
    range = (if v4 then Range(-0.99f, 0.99f) else Range(-0.999f, 0.999f)).limited
  )(0f)

  private val kinds =
    strings(
      "phases",
      "string[]",
      s"phase functions, summed: ${PhaseFunction.Kinds.mkString(", ")}",
      onlyMitsuba
    )
  private val weights = numbers("phaseweights", "float[]", "weights of `phases`", onlyMitsuba)
  private val values =
    numbers(
      "phasevalues",
      "float[]",
      "of each of `phases` in turn: g of hg; the number of tabulated values, and these",
      onlyMitsuba
    )

  protected def phase()(using site: Site): PhaseFunction =
    if kinds().isEmpty then HenyeyGreenstein(asymmetry())
    else
      val summed = PhaseFunction.of(kinds(), weights().toVector, values().toVector)
      if summed.isEmpty then
        site.error(Code.ParameterCount, "`phases`, `phaseweights` and `phasevalues` don't match")
      summed.getOrElse(HenyeyGreenstein(0f))

  /** Colours that sRGB lacks have negative components. */
  protected def notNegative(c: Rgb): Rgb = c.map(Math.max(_, 0f))

/** Base of v3's and v4's media. */
abstract class MediumRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[Option[Medium]](name, meaning, dialects)
    with Scatters

/** Coefficients of a homogeneous medium, or scales of a density. */
trait HasCoefficients extends Scatters:
  private val sigmaA =
    color(
      "sigma_a", "absorption coefficient", SpectrumRole.Unbounded, unit = PerUnit, range = Held
    )(
      if v4 then Rgb.White else Rgb(0.0011f, 0.0024f, 0.014f)
    )
  private val sigmaS =
    color(
      "sigma_s", "scattering coefficient", SpectrumRole.Unbounded, unit = PerUnit, range = Held
    )(
      if v4 then Rgb.White else Rgb(2.55f, 3.21f, 3.77f)
    )

  /** A measured medium that overrides the defaults and, in v4, the given coefficients. */
  protected def measured()(using Site): Option[MediumCoefficients] = None

  protected def factor()(using Site): Float = 1f

  /** Absorption and scattering coefficients. */
  protected def coefficients()(using site: Site): (Rgb, Rgb) =
    val tabulated = measured()
    def of(given_ : Option[Rgb], preset: Option[Rgb], default: => Rgb) =
      val first =
        if site.dialect == Dialect.V4 then preset.orElse(given_) else given_.orElse(preset)
      notNegative(first.getOrElse(default) * factor())
    (
      of(sigmaA.given_(), tabulated.map(_.absorption), sigmaA()),
      of(sigmaS.given_(), tabulated.map(_.scattering), sigmaS())
    )

trait HasScale extends HasCoefficients:
  private val scale = float("scale", "scale of the coefficients", range = Coefficients)(1f)
  override protected def factor()(using Site): Float = scale()

trait HasPreset extends HasCoefficients:
  private val preset =
    string("preset", "name of a measured medium, instead of coefficients", shown = "none")("")

  override protected def measured()(using site: Site): Option[MediumCoefficients] =
    val name = preset()
    val medium = MeasuredMedia.coefficients(name, site.dialect)
    if name.nonEmpty && medium.isEmpty then
      site.problems.warn(
        Code.UnknownType,
        site.declaration.param("preset").fold(site.declaration.pos)(_.valuesAt),
        s"unknown measured medium \"$name\"; using the coefficients, as pbrt does",
        Suggest.help(name, MeasuredMedia.names(site.dialect))
      )
    val basis = site.resources.basis
    medium.map(m =>
      MediumCoefficients(basis.unbounded(m.absorption), basis.unbounded(m.scattering))
    )

/** Media of a grid, which may fill more than the grid. */
trait FillsBox extends HasBox:
  private val fills = bool(
    "fillsworldbox",
    "fill the box along the world's axes around the grid, whose outermost values continue",
    onlyMitsuba
  )(false)

  protected def placed(toUnit: Transform)(make: Transform => VaryingMedium)(using Site): Medium =
    if fills() then WorldBoxMedium(make(toUnit), toUnit) else make(toUnit)

/** Media given by a grid. */
trait HasGrid extends HasCells:
  protected final val Cells: Range = Range(0f, SampledGrid.MaxValue).limited

  protected final def densityOfCells: Field[Array[Float]] =
    numbers("density", "float[]", "nx by ny by nz densities, x varies fastest", range = Cells)

  /** Samples of one value each; None, after a report, if there is a wrong number of them. */
  protected final class Samples(values: Field[Array[Float]]):
    private val grid = Once[Option[SampledGrid]]()
    def apply()(using Site): Option[SampledGrid] =
      grid(grids(values.name, values(), 1).map(_.head))

  protected def grids(name: String, values: Array[Float], channels: Int)(using
      site: Site
  ): Option[Vector[SampledGrid]] =
    cells(name, values, channels).map: (nx, ny, nz) =>
      Vector.tabulate(channels): c =>
        SampledGrid(nx, ny, nz, channel(values, c, channels), site.rules.gridEdge)

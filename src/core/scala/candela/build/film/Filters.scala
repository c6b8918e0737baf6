package candela.build.film

import candela.build.recipe.*
import candela.film.*
import candela.scenefile.Dialect

/** Recipes of reconstruction filters. */
object Filters:
  val all: Recipes[Filter] =
    Recipes(
      "pixel filter",
      Vector(
        BoxFilterRecipe, TriangleFilterRecipe, GaussianFilterRecipe, MitchellFilterRecipe,
        SincFilterRecipe
      )
    )

/** Base of filter recipes. */
abstract class FilterRecipe(name: String, meaning: String)
    extends Recipe[Filter](name, meaning):
  private val Extent = Range(1e-3f, 1000f).limited
  private def meaning(axis: String) = s"half extent along $axis"

  /** Declares the half extents: `xwidth` in v2 and v3, `xradius` in v4. */
  protected def extents(default: Dialect ?=> Float): Seq[(Field[Float], Field[Float])] =
    Seq("x", "y").map: axis =>
      (
        float(s"${axis}width", meaning(axis), untilV3, "pixels", range = Extent)(default),
        float(s"${axis}radius", meaning(axis), onlyV4, "pixels", range = Extent)(default)
      )

  protected def radii(fields: Seq[(Field[Float], Field[Float])])(using Site): (Float, Float) =
    val Seq(x, y) = fields.map((width, radius) =>
      radius.given_().orElse(width.given_()).getOrElse(radius())
    ): @unchecked
    (x, y)

object BoxFilterRecipe extends FilterRecipe("box", "box filter"):
  private val size = extents(0.5f)
  protected def create()(using Site): Filter =
    val (x, y) = radii(size)
    BoxFilter(x, y)

object TriangleFilterRecipe extends FilterRecipe("triangle", "triangle (tent) filter"):
  private val size = extents(2f)
  protected def create()(using Site): Filter =
    val (x, y) = radii(size)
    TriangleFilter(x, y)

object GaussianFilterRecipe extends FilterRecipe("gaussian", "Gaussian filter"):
  private val size = extents(if v4 then 1.5f else 2f)
  private val alpha = float(
    "alpha",
    "falloff rate: exp(-alpha d²)",
    untilV3,
    range = Range(1e-6f, 1e4f)
  )(2f)
  private val sigma = float(
    "sigma",
    "standard deviation, pixels",
    onlyV4,
    range = Range(0.01f, 1000f).limited
  )(0.5f)
  protected def create()(using site: Site): Filter =
    val (x, y) = radii(size)
    if site.dialect == Dialect.V4 then GaussianFilter.ofSigma(x, y, sigma())
    else GaussianFilter.ofAlpha(x, y, alpha())

object MitchellFilterRecipe
    extends FilterRecipe("mitchell", "Mitchell–Netravali filter, slightly sharpening"):
  private val size = extents(2f)
  // Beyond, its lobes all but cancel each other
  private val Lobes = Range(-10f, 10f).limited
  private val b = float("B", "parameter B: blur", range = Lobes)(1f / 3f)
  private val c = float("C", "parameter C: ringing", range = Lobes)(1f / 3f)
  protected def create()(using Site): Filter =
    val (x, y) = radii(size)
    MitchellFilter(x, y, b(), c())

object SincFilterRecipe extends FilterRecipe("sinc", "Lanczos-windowed sinc filter"):
  private val size = extents(4f)
  private val tau = float(
    "tau",
    "cycles of the sinc within the window",
    range = Range(0.01f, 1000f).limited
  )(3f)
  protected def create()(using site: Site): Filter =
    val (x, y) = radii(size)
    if site.dialect == Dialect.V2 then LanczosSincFilter.stretched(x, y, tau())
    else LanczosSincFilter(x, y, tau())

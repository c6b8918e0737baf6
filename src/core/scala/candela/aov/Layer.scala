package candela.aov

import candela.color.{ColorSpace, Matrix3, Rgb}
import candela.film.ExactSums
import candela.math.Vec3

import Statistic.*
import Tally.{color, numbers, plane, vector}

/** An AOV: an image channel group besides colour, mostly a property of the first visible surface. A
  * case defines everything about an AOV.
  *
  * @param word      command-line name
  * @param channels  channel names as in pbrt-v4, or customary names where it has none
  * @param meaning   one line for the help
  * @param statistic one value per channel
  */
enum Layer(
    val word: String,
    val channels: Vector[String],
    val meaning: String,
    private[aov] val statistic: Statistic,
    override val needsFootprints: Boolean = false,
    override val needsFloat: Boolean = false,
    override val dividesLight: Boolean = false
) extends ImageLayer:
  /** A part of the light, which the integrator must divide. */
  private def this(word: String, name: String, meaning: String, part: Int) =
    this(
      word,
      Layer.rgb(name),
      meaning,
      ScaledMeanOfAll(Tally.light(part)),
      dividesLight = true
    )

  case Albedo
      extends Layer(
        "albedo",
        Layer.rgb("Albedo"),
        "directional albedo of the BSDF",
        MeanOfAll(color(_.albedo))
      )
  case Position extends Layer("position", Layer.xyz("P"), "position", Mean(vector(_.p)))
  case Gradient
      extends Layer(
        "gradient",
        Vector("dzdx", "dzdy"),
        "screen-space change of z per sample",
        Magnitude(numbers(_.dzdx, _.dzdy)),
        needsFootprints = true
      )
  case Normal
      extends Layer("normal", Layer.xyz("N"), "geometric normal", Direction(vector(_.n)))
  case ShadingNormal
      extends Layer(
        "shadingnormal",
        Layer.xyz("Ns"),
        "shading normal",
        Direction(vector(_.shadingNormal))
      )
  case Uv extends Layer(
        "uv",
        Vector("u", "v"),
        "surface parameters",
        Mean(numbers(_.point.u, _.point.v))
      )
  case Variance
      extends Layer(
        "variance",
        Layer.rgb("Variance"),
        "sample variance",
        SampleVariance,
        needsFloat = true
      )
  case RelativeVariance
      extends Layer(
        "relativevariance",
        Layer.rgb("RelativeVariance"),
        "sample variance over the mean",
        VarianceOverMean,
        needsFloat = true
      )
  case Depth extends Layer("depth", Vector("Z"), "distance along the ray", Mean(numbers(_.depth)))
  case Samples
      extends Layer("samples", Vector("samples"), "sample count", SampleCount)
  case Motion
      extends Layer(
        "motion",
        Vector("Motion.X", "Motion.Y"),
        "motion while the shutter is open, in pixels to the right and down",
        Mean(plane(_.motion)),
        needsFloat = true
      )
  case Emission
      extends Layer(
        "emission",
        Layer.rgb("Emission"),
        "light that surfaces and media emit towards the camera",
        ScaledMeanOfAll(Tally.light(LightParts.Emission))
      )
  case Background
      extends Layer(
        "background",
        "Background",
        "light of infinite lights that reaches the camera unscattered",
        LightParts.Background
      )
  case Direct
      extends Layer(
        "direct",
        "Direct",
        "light scattered once",
        LightParts.Direct
      )
  case Indirect
      extends Layer(
        "indirect",
        "Indirect",
        "light scattered more than once",
        LightParts.Indirect
      )
  case Lights
      extends Layer(
        "lights",
        Vector.empty,
        "light of each light group",
        ScaledMeanOfAll(Tally.Empty),
        dividesLight = true
      )
  case DenoisingAlbedo
      extends Layer(
        "denoisingalbedo",
        Layer.rgb("DenoisingAlbedo"),
        "albedo, through mirrors and glass",
        MeanOfAll(color(_.albedoBehind))
      )
  case DenoisingNormal
      extends Layer(
        "denoisingnormal",
        Layer.xyz("DenoisingNormal"),
        "shading normal, through mirrors and glass",
        MeanOfAll(vector(_.normalBehind))
      )
  case CryptoObject
      extends Layer(
        "cryptoobject",
        Cryptomatte.channels("CryptoObject"),
        "Cryptomatte of shapes and instances",
        Cryptomatte.Ranked(Cryptomatte.tally(_.objectId)),
        needsFloat = true
      )
  case CryptoMaterial
      extends Layer(
        "cryptomaterial",
        Cryptomatte.channels("CryptoMaterial"),
        "Cryptomatte of materials",
        Cryptomatte.Ranked(Cryptomatte.tally(_.materialId)),
        needsFloat = true
      )
  case Alpha
      extends Layer(
        "alpha",
        Vector("A"),
        "coverage by surfaces and media; in Mitsuba's scenes, a visible sky covers all",
        MeanOfAll(Tally.always(numbers(_.coverage)))
      )

  def channelsOf(groups: Vector[String]): Vector[String] = this match
    case Lights => groups.flatMap(group => Layer.rgb(s"Combined_$group"))
    case _ => channels

  private[aov] def statisticOf(groups: Vector[String]): Statistic = this match
    case Lights => ScaledMeanOfAll(Tally.light(LightParts.Groups, groups.size))
    case _ => statistic

  override def isLight: Boolean = dividesLight || this == Emission

  private[aov] override def to(space: ColorSpace): Option[Matrix3] = this match
    case Albedo | DenoisingAlbedo => Some(space.ofSrgbAdapted)
    case Emission => Some(space.ofSrgb)
    case _ => None

object Layer:
  /** The AOVs of pbrt-v4's film "gbuffer". */
  val gbuffer: Vector[Layer] =
    Vector(Albedo, Position, Gradient, Normal, ShadingNormal, Uv, Variance, RelativeVariance)

  /** What a denoiser takes beside the colours. */
  val denoising: Vector[Layer] = Vector(DenoisingAlbedo, DenoisingNormal)

  /** What tells surfaces apart by name. */
  val cryptomatte: Vector[Layer] = Vector(CryptoObject, CryptoMaterial)

  /** Layers by the name of a film that has them. */
  val films: Map[String, Vector[Layer]] = Map("gbuffer" -> gbuffer, "rgba" -> Vector(Alpha))

  private def rgb(name: String) = Vector("R", "G", "B").map(c => s"$name.$c")
  private def xyz(name: String) = Vector("X", "Y", "Z").map(c => s"$name.$c")

/** Per-pixel accumulators of an AOV. Stateless: the accumulators are stored by [[LayerFilm]] and
  * start at 0.
  *
  * @param size number of accumulators
  */
private[aov] abstract class Tally(val size: Int):
  /** Whether it counts only samples that hit a surface. */
  def needsSurface: Boolean = true

  /** Adds a sample.
    *
    * @param at index of the first accumulator
    */
  def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface): Unit

  /** Moves what is not a sum from `more` to `sums`, before the sums of both are added. */
  def join(sums: ExactSums, at: Int, more: ExactSums): Unit = ()

  /** Whether `join` does anything. */
  def joins: Boolean = false

private[aov] object Tally:
  /** A quantity accumulated with the filter weight. */
  trait Number:
    def apply(seen: VisibleSurface): Float

  def numbers(of: Number*): Tally = new Tally(of.length):
    private val quantities = of.toArray
    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      var i = 0
      while i < quantities.length do
        sums.add(at + i, weight * quantities(i)(seen))
        i += 1

  /** A tally that counts samples without a surface, too. */
  def always(tally: Tally): Tally = new Tally(tally.size):
    override def needsSurface: Boolean = false

    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      tally.add(sums, at, weight, light, seen)

  def vector(of: VisibleSurface => Vec3): Tally = new Tally(3):
    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      val v = of(seen)
      sums.add(at, weight * v.x)
      sums.add(at + 1, weight * v.y)
      sums.add(at + 2, weight * v.z)

  def plane(of: VisibleSurface => Vec3): Tally = new Tally(2):
    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      val v = of(seen)
      sums.add(at, weight * v.x)
      sums.add(at + 1, weight * v.y)

  def color(of: VisibleSurface => Rgb): Tally = new Tally(3):
    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      val c = of(seen)
      sums.add(at, weight * c.r)
      sums.add(at + 1, weight * c.g)
      sums.add(at + 2, weight * c.b)

  /** Parts of the light, from `first` on. */
  def light(first: Int, count: Int = 1): Tally = new Tally(3 * count):
    override def needsSurface: Boolean = false

    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      var i = 0
      while i < count do
        val c = seen.light(first + i)
        sums.add(at + 3 * i, weight * c.r)
        sums.add(at + 3 * i + 1, weight * c.g)
        sums.add(at + 3 * i + 2, weight * c.b)
        i += 1

  object Empty extends Tally(0):
    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) = ()

  /** Number of samples, sum of their weights, sums of the light, then sums of its squares. The
    * weights are those of [[VisibleSurface]]: powers of two, which lose nothing.
    */
  object Moments extends Tally(8):
    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      val counts = seen.weight.toDouble
      sums.add(at, 1)
      sums.add(at + 1, counts)
      power(sums, at, 0, counts, light.r)
      power(sums, at, 1, counts, light.g)
      power(sums, at, 2, counts, light.b)

    private def power(sums: ExactSums, at: Int, c: Int, counts: Double, value: Float): Unit =
      sums.add(at + 2 + c, counts * value)
      sums.add(at + 5 + c, counts * (value.toDouble * value))

/** Accumulators of one pixel, for evaluation.
  *
  * @param samples   number of samples
  * @param weight    sum of their filter weights
  * @param hitWeight sum of the filter weights of samples that hit a surface
  * @param scale     from accumulated values to image values
  */
private[aov] final class PixelTally(
    sums: ExactSums,
    at: Int,
    val size: Int,
    val samples: Double,
    val weight: Double,
    val hitWeight: Double,
    val scale: Double
):
  def apply(i: Int): Double = sums(at + i)

  /** n Σx² − (Σx)², where n is the number of samples, or the sum of their weights. A difference of
    * nearly equal numbers: it needs the digits that rounding would lose.
    */
  def spread(n: Double, x: Int, squares: Int): Double =
    val s = sums(at + x)
    val q = sums(at + squares)
    val ofMean = s * s
    val ofSquares = n * q
    val rounding = Math.fma(n, q, -ofSquares) - Math.fma(s, s, -ofMean)
    val below = n * sums.remainder(at + squares) - 2 * s * sums.remainder(at + x)
    Math.max(0.0, ofSquares - ofMean + (rounding + below))

  def dividedBy(weight: Double): Array[Double] =
    Array.tabulate(size)(i => if weight != 0 then this(i) / weight else 0.0)

/** Evaluates an AOV from the samples of a pixel.
  *
  * @param tally its accumulators; AOVs may share them
  */
private[aov] abstract class Statistic(val tally: Tally):
  def apply(pixel: PixelTally): Array[Double]

private[aov] object Statistic:
  /** Average over samples that hit a surface. */
  final class Mean(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] = pixel.dividedBy(pixel.hitWeight)

  /** Average over all samples; misses count as 0. */
  final class MeanOfAll(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] = pixel.dividedBy(pixel.weight)

  /** The same, in image values. */
  final class ScaledMeanOfAll(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] = pixel.dividedBy(pixel.weight).map(_ * pixel.scale)

  /** Of a colour that camera samples bring nothing to. */
  object SplatsOnly extends Statistic(Tally.Empty):
    def apply(pixel: PixelTally): Array[Double] = new Array[Double](3)

  /** Absolute value of the average. */
  final class Magnitude(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] = pixel.dividedBy(pixel.hitWeight).map(Math.abs)

  /** Normalised average. */
  final class Direction(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] =
      val v = Array.tabulate(pixel.size)(pixel(_))
      val length = Math.sqrt(v.map(x => x * x).sum)
      if length > 0 then v.map(_ / length) else v

  object SampleCount extends Statistic(Tally.Empty):
    def apply(pixel: PixelTally): Array[Double] = Array(pixel.samples)

  object SampleVariance extends Statistic(Tally.Moments):
    def apply(pixel: PixelTally): Array[Double] =
      Array.tabulate(3)(variance(pixel, _) * pixel.scale * pixel.scale)

  object VarianceOverMean extends Statistic(Tally.Moments):
    def apply(pixel: PixelTally): Array[Double] = Array.tabulate(3): c =>
      val mean = if pixel(1) > 0 then pixel(2 + c) / pixel(1) else 0.0
      if mean == 0 then 0.0 else variance(pixel, c) / mean * pixel.scale

  /** Of samples whose variance is inverse to their weight; over their number, that of the mean. */
  private def variance(pixel: PixelTally, c: Int): Double =
    val n = pixel(0)
    val weight = pixel(1)
    if n > 1 then pixel.spread(weight, 2 + c, 5 + c) / (weight * weight) * (n / (n - 1)) else 0.0

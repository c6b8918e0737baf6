package candela.film

import candela.color.Rgb
import candela.math.Vec3

import Statistic.*
import Tally.{color, numbers, vector}

/** What an image can hold beside its colours, mostly of the first surface that each camera ray
  * meets. A case says all about a layer.
  *
  * @param word      its name on the command line
  * @param channels  names as pbrt-v4 has them, or customary ones where it has none
  * @param meaning   one line for the help
  * @param statistic one value for each channel
  * @param needsFootprints must the scene track ray differentials for it?
  */
enum Layer(
    val word: String,
    val channels: Vector[String],
    val meaning: String,
    private[film] val statistic: Statistic,
    val needsFootprints: Boolean = false
):
  case Albedo
      extends Layer(
        "albedo",
        Layer.rgb("Albedo"),
        "part of the light that is scattered",
        MeanOfAll(color(_.albedo))
      )
  case Position extends Layer("position", Layer.xyz("P"), "where it is", Mean(vector(_.p)))
  case Gradient
      extends Layer(
        "gradient",
        Vector("dzdx", "dzdy"),
        "change of z to the next sample",
        Magnitude(numbers(_.dzdx, _.dzdy)),
        needsFootprints = true
      )
  case Normal
      extends Layer("normal", Layer.xyz("N"), "normal of the surface", Direction(vector(_.n)))
  case ShadingNormal
      extends Layer(
        "shadingnormal",
        Layer.xyz("Ns"),
        "normal that shades it",
        Direction(vector(_.shadingNormal))
      )
  case Uv extends Layer("uv", Vector("u", "v"), "its parameters", Mean(numbers(_.at.u, _.at.v)))
  case Variance
      extends Layer("variance", Layer.rgb("Variance"), "variance of the samples", SampleVariance)
  case RelativeVariance
      extends Layer(
        "relativevariance",
        Layer.rgb("RelativeVariance"),
        "variance over the mean",
        VarianceOverMean
      )
  case Depth extends Layer("depth", Vector("Z"), "distance along the ray", Mean(numbers(_.depth)))
  case Samples
      extends Layer("samples", Vector("samples"), "how many samples there are", SampleCount)

object Layer:
  /** Those of pbrt-v4's film "gbuffer". */
  val gbuffer: Vector[Layer] =
    Vector(Albedo, Position, Gradient, Normal, ShadingNormal, Uv, Variance, RelativeVariance)

  private def rgb(name: String) = Vector("R", "G", "B").map(c => s"$name.$c")
  private def xyz(name: String) = Vector("X", "Y", "Z").map(c => s"$name.$c")

/** The numbers that a pixel keeps of its samples for a layer. Stateless: the numbers are among the
  * sums of [[LayerFilm]], and start at 0.
  *
  * @param size how many there are
  */
private[film] abstract class Tally(val size: Int):
  /** Adds a sample that met a surface.
    *
    * @param at the first of the numbers
    */
  def add(sums: Array[Double], at: Int, weight: Double, light: Rgb, seen: VisibleSurface): Unit

private[film] object Tally:
  /** What is summed by weight. */
  trait Number:
    def apply(seen: VisibleSurface): Float

  def numbers(of: Number*): Tally = new Tally(of.length):
    private val all = of.toArray
    def add(sums: Array[Double], at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      var i = 0
      while i < all.length do
        sums(at + i) += weight * all(i)(seen)
        i += 1

  def vector(of: VisibleSurface => Vec3): Tally = new Tally(3):
    def add(sums: Array[Double], at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      val v = of(seen)
      sums(at) += weight * v.x
      sums(at + 1) += weight * v.y
      sums(at + 2) += weight * v.z

  def color(of: VisibleSurface => Rgb): Tally = new Tally(3):
    def add(sums: Array[Double], at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      val c = of(seen)
      sums(at) += weight * c.r
      sums(at + 1) += weight * c.g
      sums(at + 2) += weight * c.b

  object Empty extends Tally(0):
    def add(sums: Array[Double], at: Int, weight: Double, light: Rgb, seen: VisibleSurface) = ()

  /** How many samples there are, the means of the light, then the sums of squared deviations.
    *
    * Source: Welford, "Note on a method for calculating corrected sums of squares and products",
    * Technometrics 4(3), 1962.
    */
  object Moments extends Tally(7):
    def add(sums: Array[Double], at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      sums(at) += 1
      deviate(sums, at, 0, light.r)
      deviate(sums, at, 1, light.g)
      deviate(sums, at, 2, light.b)

    private def deviate(sums: Array[Double], at: Int, c: Int, value: Float): Unit =
      val before = value - sums(at + 1 + c)
      sums(at + 1 + c) += before / sums(at)
      sums(at + 4 + c) += before * (value - sums(at + 1 + c))

/** One pixel's tally, when the image is made.
  *
  * @param samples   how many there were
  * @param weight    the sum of their filter weights
  * @param metWeight of those that met a surface
  * @param scale     of the samples that were added, to be those of the image
  */
private[film] final class PixelTally(
    sums: Array[Double],
    at: Int,
    val size: Int,
    val samples: Double,
    val weight: Double,
    val metWeight: Double,
    val scale: Double
):
  def apply(i: Int): Double = sums(at + i)

  def over(weight: Double): Array[Double] =
    Array.tabulate(size)(i => if weight != 0 then this(i) / weight else 0.0)

/** What a layer's values are, of all samples of a pixel.
  *
  * @param tally what it is computed from; layers may share one
  */
private[film] abstract class Statistic(val tally: Tally):
  def apply(pixel: PixelTally): Array[Double]

private[film] object Statistic:
  /** Over the samples that met a surface. */
  final class Mean(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] = pixel.over(pixel.metWeight)

  /** Over all samples; those that met nothing count as 0. */
  final class MeanOfAll(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] = pixel.over(pixel.weight)

  /** Of the mean. */
  final class Magnitude(tally: Tally) extends Statistic(tally):
    def apply(pixel: PixelTally): Array[Double] = pixel.over(pixel.metWeight).map(Math.abs)

  /** The mean as a unit vector. */
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
      val mean = pixel(1 + c)
      if mean == 0 then 0.0 else variance(pixel, c) / mean * pixel.scale

  private def variance(pixel: PixelTally, c: Int): Double =
    if pixel(0) > 1 then pixel(4 + c) / (pixel(0) - 1) else 0.0

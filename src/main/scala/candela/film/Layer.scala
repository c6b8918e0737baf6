package candela.film

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

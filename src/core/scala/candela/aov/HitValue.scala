package candela.aov

import candela.color.Rgb
import candela.film.ExactSums

import Statistic.MeanOfAll
import Tally.{always, color, numbers, vector}

/** A quantity of a [[NamedLayer]], as Mitsuba's integrator "aov" defines it.
  *
  * @param word          Mitsuba's name
  * @param components    last letters of its channels
  * @param needsPartials whether the scene must have partial derivatives for it
  */
enum HitValue(
    val word: String,
    val components: String,
    private[aov] val statistic: Statistic,
    val needsPartials: Boolean = false
):
  private def this(word: String, components: String, tally: Tally) =
    this(word, components, MeanOfAll(always(tally)))

  private def this(word: String, components: String, tally: Tally, needsPartials: Boolean) =
    this(word, components, MeanOfAll(always(tally)), needsPartials)

  case Albedo extends HitValue("albedo", "RGB", color(_.first.diffuseReflectance))
  case Depth extends HitValue("depth", "T", numbers(_.first.depth))
  case Position extends HitValue("position", "XYZ", vector(_.first.position))
  case Uv extends HitValue("uv", "UV", numbers(_.first.u, _.first.v))
  case GeometricNormal extends HitValue("geo_normal", "XYZ", vector(_.first.geometricNormal))
  case ShadingNormal extends HitValue("sh_normal", "XYZ", vector(_.first.shadingNormal))
  case Dpdu extends HitValue("dp_du", "XYZ", vector(_.first.dpdu), true)
  case Dpdv extends HitValue("dp_dv", "XYZ", vector(_.first.dpdv), true)

  /** The colours of the image and their coverage, once more. */
  case Colors extends HitValue("colors", "RGBA", HitValue.ColorsAndCoverage)

object HitValue:
  private object Light extends Tally(4):
    override def needsSurface: Boolean = false

    def add(sums: ExactSums, at: Int, weight: Double, light: Rgb, seen: VisibleSurface) =
      sums.add(at, weight * light.r)
      sums.add(at + 1, weight * light.g)
      sums.add(at + 2, weight * light.b)
      sums.add(at + 3, weight * seen.coverage)

  private[aov] object ColorsAndCoverage extends Statistic(Light):
    def apply(pixel: PixelTally): Array[Double] =
      val means = pixel.dividedBy(pixel.weight)
      Array.tabulate(4)(i => if i < 3 then means(i) * pixel.scale else means(i))

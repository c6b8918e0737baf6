package candela.stability

import java.util.SplittableRandom

import Checks.assert

import candela.bench.robustness.{BsdfKind, ExtremeBsdfs, ExtremeInputs}
import candela.bsdf.{Bsdf, DiffuseTransmission, Directions, Lambert}
import candela.bsdf.measured.{FourierBsdf, FourierTables}
import candela.bsdf.microfacet.{
  Dielectric, Mirror, SmoothDielectric, ThinDielectric, TrowbridgeReitz
}
import candela.color.Rgb
import candela.math.*

/** BSDFs at the ends of their parameters and of the hemisphere: 10⁸ inputs a kind, whose variants
  * share them.
  */
object Scattering extends Group(
      Extremes.all.flatMap(kind =>
        kind.variants.map((name, bsdf) =>
          val long = (100_000_000L + kind.variants.size - 1) / kind.variants.size
          val words = s"$name scatters numbers, whatever the directions"
          Case.sliced(words, kind.quick, long, s"inputs of ${kind.name}")(trials =>
            Checks.holds(ExtremeInputs.tally(bsdf, trials))
          )
        )
      ) ++ Furnaces.cases ++ Interfaces.cases
    )

class ScatteringSuite extends GroupSuite(Scattering)

private object Extremes:
  /** All kinds of the program, and tables of series, which are made for tests alone. */
  val all: Seq[BsdfKind] =
    ExtremeBsdfs.all.map: kind =>
      if kind.name == "tables" then kind.copy(variants = kind.variants ++ series) else kind

  private def series =
    val cosines = FourierTables.cosines(16)
    val color = Rgb(1f, 0.5f, 0f)
    Seq[(String, Bsdf)](
      "series in colours" ->
        FourierBsdf(FourierTables(cosines, 2, 3, 1f)(FourierTables.cushion(color)).table),
      "series of an index" ->
        FourierBsdf(FourierTables(cosines, 2, 1, 1.5f)(FourierTables.cushion(Rgb.White)).table)
    )

/** In a white furnace what conserves energy is invisible: the mean weight is 1. */
private object Furnaces:
  private val lossless: Seq[(String, Bsdf)] = Seq(
    "matte" -> Lambert(Rgb.White),
    "a sheet" -> DiffuseTransmission(Rgb.gray(0.25f), Rgb.gray(0.75f)),
    "a mirror" -> Mirror(Rgb.White),
    "a pane" -> ThinDielectric(1.5f),
    "glass" -> SmoothDielectric(1.5f),
    "glass of index 1 + 1e-7" -> SmoothDielectric(Math.nextUp(1f)),
    "glass seen from within" -> SmoothDielectric(1 / 1.5f),
    "glass of a roughness below all" -> Dielectric(TrowbridgeReitz(0f, 0f), 1.5f),
    "rough glass of index 1" -> Dielectric(TrowbridgeReitz(1f, 1f), 1f)
  )

  val cases: Seq[Case] =
    for (name, bsdf) <- lossless
    yield Case(s"$name is invisible in a white furnace", 20000, 10_000_000L)(isInvisible(bsdf))

  /** Each weight undoes the change of radiance by refraction; it is 1 for all these lobes, so that
    * no noise is left.
    */
  private def isInvisible(bsdf: Bsdf)(count: Long): Unit =
    val random = SplittableRandom(2)
    var i = 0L
    while i < count do
      val wo = Directions.uniform(random)
      def u() = Math.min(random.nextDouble().toFloat, OneMinusEpsilon)
      val s = bsdf.sample(wo, u(), u(), u())
      val weight = s.weight.g * s.eta * s.eta
      assert(Math.abs(weight - 1f) <= 1e-3f, s"weight $weight for $wo"): Unit
      i += 1

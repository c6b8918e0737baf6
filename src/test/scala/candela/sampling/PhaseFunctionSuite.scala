package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.ChiSquare

final class PhaseFunctionSuite extends AnyFunSuite:
  private val table = TabulatedPhase(Array(1.5f, 0.2f, 0f, 0f, 0.9f, 3f))
  private val all = Vector(
    "Rayleigh" -> Rayleigh,
    "a table" -> table,
    "an even table" -> TabulatedPhase(Array(2f, 2f)),
    "a blend" -> BlendedPhase(
      Array(Rayleigh, HenyeyGreenstein(0.7f), table),
      Array(0.2f, 0.5f, 0.3f)
    )
  )

  for ((name, phase), i) <- all.zipWithIndex do
    test(s"$name: it integrates to 1 over the sphere, and has the asymmetry that it tells"):
      val n = 200000
      val cosines = Vector.tabulate(n)(k => -1.0 + (k + 0.5) * 2.0 / n)
      val values = cosines.map(c => phase.value(c.toFloat).toDouble)
      assert(Math.abs(values.sum * 4.0 * Math.PI / n - 1) < 1e-5)
      val mean = values.zip(cosines).map((v, c) => -v * c).sum * 4.0 * Math.PI / n
      assert(Math.abs(mean - phase.asymmetry) < 1e-5)

    test(s"$name: samples are as dense as its values"):
      val result = ChiSquare.directions(seed = 17 + i)(
        u => Some(phase.sample(Vec3.Z, u(), u())),
        wi => phase.value(Vec3.Z, wi)
      )
      assert(result.accepted(all.size), result)

  test("the last value of a table is that of light that goes straight on"):
    val phase = TabulatedPhase(Array(0f, 1f))
    assert(phase.value(Vec3.Z, -Vec3.Z) > 0f && phase.value(Vec3.Z, Vec3.Z) == 0f)

  test("samples are finite up to the ends of the unit interval, and not where a table is 0"):
    for (name, phase) <- all; u <- Seq(0f, 1e-7f, 0.5f, OneMinusEpsilon) do
      val c = phase.cosine(u)
      assert(c >= -1f && c <= 1f && phase.value(c) > 0f, s"$name $u $c")

  test("kinds, weights and values must fit together"):
    val (hg, both) = (Vector("hg"), Vector("rayleigh", "tabulated"))
    def made(kinds: Vector[String], weights: Vector[Float], values: Float*) =
      PhaseFunction.of(kinds, weights, values.toVector)
    assert(made(hg, Vector(1f), 0.5f).exists(_.asymmetry == 0.5f))
    assert(made(both, Vector(0.5f, 0.5f), 2f, 0f, 1f).isDefined)
    val wrong = Vector(
      made(hg, Vector(1f)),
      made(hg, Vector(1f), 0.5f, 0.5f),
      made(hg, Vector(1f), 1.5f),
      made(hg, Vector(0.5f, 0.5f), 0.5f),
      made(hg, Vector(0.5f), 0.5f),
      made(both, Vector(0.5f, 0.5f), 3f, 0f, 1f),
      made(both, Vector(0.5f, 0.5f), 2f, -1f, 1f),
      made(Vector("mie"), Vector(1f))
    )
    assert(wrong.forall(_.isEmpty), wrong.indexWhere(_.nonEmpty))

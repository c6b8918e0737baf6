package candela.bsdf.composite

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.testing.{ChiSquare, Draws}
import candela.textures.{ConstantFloat, ConstantRgb}

final class DisneyBssrdfSuite extends AnyFunSuite:
  private val bssrdf = DisneyBssrdf(Rgb(0.2f, 0.5f, 0.8f), Rgb(0.1f, 0.3f, 1f), eta = 1f)

  /** Over the plane around a place, between two distances, in even steps of their logarithms. */
  private def integral(from: Double, to: Double)(f: Float => Double): Double =
    val steps = 4000
    val width = Math.log(to / from) / steps
    (0 until steps).map: i =>
      val r = from * Math.exp((i + 0.5) * width)
      2 * Math.PI * r * r * f(r.toFloat) * width
    .sum

  test("of light that enters, the colour comes out again"):
    val all = Seq[Rgb => Float](_.r, _.g, _.b).map(c => integral(1e-6, 60)(r => c(bssrdf(r))))
    for (found, right) <- all.zip(Seq(0.2, 0.5, 0.8)) do
      // Nearer than a hundredth of a thousandth of d there is as little
      assert(Math.abs(found - right) < 1e-4, s"$found, not $right")

  test("distances are drawn with the density of the mean of the channels"):
    // As above: what is nearer than 1e-6
    assert(Math.abs(integral(1e-6, 60)(bssrdf.density(_).toDouble) - 1) < 1e-4)
    val draws = Draws(7)
    val n = 60000
    val edges =
      Array(1e-6, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4, 6, 8, 12, 60)
    val seen = new Array[Long](edges.length - 1)
    for i <- 0 until n do
      val r = Math.max(bssrdf.sample(i % 3, draws.unit()), 1e-6f)
      seen(edges.indexWhere(_ > r) - 1) += 1
    val expected = Array.tabulate(seen.length): i =>
      n * integral(edges(i), edges(i + 1))(bssrdf.density(_).toDouble)
    val result = ChiSquare.counts(seen, expected)
    assert(result.accepted(tests = 1), result)

  test("a channel without distance is black, and none is drawn of it"):
    val part = DisneyBssrdf(Rgb.White, Rgb(0f, 1f, 1f), eta = 1.5f)
    assert(part(0.3f).r == 0f && part(0.3f).g > 0f && part.sample(0, 0.5f) < 0f)
    assert(part.reach(0) < 0f && part.reach(1) > 1f)

  private def material(distance: Rgb, metallic: Float, isThin: Boolean) =
    val Seq(zero, half, metal) = Seq(0f, 0.5f, metallic).map(ConstantFloat(_)): @unchecked
    DisneyMaterial(
      DisneyParameters(
        ConstantRgb(Rgb.White), metal, ConstantFloat(1.5f), half, zero, zero, zero, zero, zero,
        zero, zero, isThin, zero, zero, ConstantRgb(distance)
      )
    )

  test("no light enters metal or a sheet, nor where the distance is 0"):
    val at = ShadingPoint()
    assert(material(Rgb.White, metallic = 0.5f, isThin = false).bssrdf(at) != null)
    assert(material(Rgb.White, metallic = 1f, isThin = false).bssrdf(at) == null)
    assert(!material(Rgb.White, metallic = 0f, isThin = true).isSubsurface)
    assert(!material(Rgb.Black, metallic = 0f, isThin = false).isSubsurface)

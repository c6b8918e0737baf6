package candela.bsdf.layered

import candela.bsdf.{BsdfLaws, Directions, Statistics}
import candela.color.Rgb
import candela.math.*
import candela.sampling.HenyeyGreenstein

import java.util.SplittableRandom

class ScatteringLayerSuite extends BsdfLaws:
  private val isotropic = HenyeyGreenstein(0f)
  obeysLaws("thin", ScatteringLayer(Rgb.gray(0.2f), Rgb(0.5f, 0.7f, 0.9f), isotropic))
  // Each channel passes and scatters at most all light, but the law counts the largest of a sample
  obeysLaws(
    "coloured",
    ScatteringLayer(Rgb(0.05f, 0.2f, 0.5f), Rgb.gray(0.9f), isotropic),
    isPassive = false
  )
  obeysLaws("thick", ScatteringLayer(Rgb.gray(5f), Rgb(0.3f, 0.6f, 1f), HenyeyGreenstein(0.5f)))
  obeysLaws("endless", ScatteringLayer(Rgb.gray(1e30f), Rgb.gray(0.8f), HenyeyGreenstein(-0.3f)))
  obeysLaws("clear", ScatteringLayer(Rgb.Black, Rgb.Black, isotropic), isLossless = true)
  obeysLaws("only absorbs", ScatteringLayer(Rgb.gray(0.7f), Rgb.Black, isotropic))

  test("values are what rays scatter on their way through, counted step by step"):
    val (depth, g) = (0.8, 0.4f)
    val phase = HenyeyGreenstein(g)
    val layer = ScatteringLayer(Rgb.gray(depth.toFloat), Rgb.gray(0.7f), phase)
    val wo = Directions.at(35, 0)
    for wi <- Seq(Directions.at(60, 130), Directions.at(120, 70), Directions.at(145, 10)) do
      val (a, b) = (wo.z.toDouble, Math.abs(wi.z.toDouble))
      val steps = 20000
      val sum = (0 until steps).map: i =>
        val down = (i + 0.5) / steps * depth
        Math.exp(-down / a) * Math.exp(-(if wi.z > 0f then down else depth - down) / b)
      // Radiance per irradiance: L dω' = σs p E dz / (cos θo cos θi)
      val expected = 0.7 * phase.value(wo, wi) * sum.sum / steps * depth / (a * b)
      assert(Math.abs(layer.f(wo, wi).g / expected - 1) < 1e-4)

  test("the unscattered light is Beer's"):
    val layer = ScatteringLayer(Rgb(0.2f, 0.5f, 1f), Rgb.gray(0.5f), isotropic)
    val random = SplittableRandom(3)
    val (passed, wo) = (Statistics(), Directions.at(50, 30))
    for _ <- 0 until 100000 do
      val s = layer.sample(wo, random.nextDouble().toFloat, 0.5f, 0.5f)
      passed.add(if s.isSpecular then s.weight.g else 0.0)
    assert(Math.abs(passed.mean - Math.exp(-0.5 / wo.z)) < 4.5 * passed.error)

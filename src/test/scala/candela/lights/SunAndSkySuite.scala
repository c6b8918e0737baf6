package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.math.*
import candela.testing.Draws

final class SunAndSkySuite extends AnyFunSuite:

  private def light(degrees: Double, sun: Float, sky: Float, aperture: Double = 10): SunAndSky =
    val elevation = Math.toRadians(degrees).toFloat
    val toSun = Vec3(cos(elevation), 0f, sin(elevation))
    val model = SkyModel(3.3f, Rgb(0.1f, 0.3f, 0.8f), elevation)
    SunAndSky(
      LightFrame(Transform.rotate(25, 1, 1, 0).get),
      model,
      toSun,
      Math.toRadians(aperture / 2).toFloat,
      sky,
      model.sunIrradiance * sun,
      identity,
      complete = true
    )

  private val cases = Seq(
    "both" -> light(35, 0.01f, 1f),
    "the sky alone" -> light(70, 0f, 2f),
    "a low sun" -> light(3, 0.02f, 1f),
    "the sun alone" -> light(50, 1f, 0f)
  )

  for (name, env) <- cases do
    test(s"$name: a sample's density and radiance are those of its direction"):
      val draws = Draws(5)
      val out = LightSample()
      val count = 10000
      val off = (1 to count).count: _ =>
        env.sample(Vec3.Zero, draws.unit(), draws.unit(), out)
        val there = env.radiance(Vec3.Zero, out.wi)
        Math.abs(out.pdf - env.pdf(Vec3.Zero, out.wi)) > 1e-3f * out.pdf ||
        (out.radiance.toRgb - there).largest > 1e-3f * there.largest
      assert(off <= 30, s"$off of $count") // at the borders of cells and of the disk

    test(s"$name: the irradiance by sampling is that of all directions"):
      val expected = Skies.irradiance(env.radiance(Vec3.Zero, _).g.toDouble)
      val found = Skies.sampled(env, Vec3.Zero, 200000)
      // 1,000 cells in the sun's disk, a hundred on its edge: 0.3 %; as much by 200,000 samples
      assert(Math.abs(found / expected - 1) < 0.02, s"$found, expected $expected")

  test("the sun's irradiance does not depend on its size"):
    val expected = SkyModel(3.3f, Rgb(0.1f, 0.3f, 0.8f), Math.toRadians(50).toFloat).sunIrradiance
    for aperture <- Seq(0.2, 0.5358, 30.0) do
      val env = light(50, 1f, 0f, aperture)
      val out = LightSample()
      env.sample(Vec3.Zero, 0.3f, 0.6f, out)
      val found = out.radiance.toRgb.g / out.pdf
      assert(Math.abs(found / expected.g - 1) < 1e-5, s"$aperture°: $found")

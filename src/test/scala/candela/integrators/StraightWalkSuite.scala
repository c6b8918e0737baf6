package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.lights.ConstantEnvironment
import candela.math.*
import candela.media.{GridMedium, MediumBorder, SampledGrid, SceneMedia}
import candela.sampling.{HenyeyGreenstein, IndependentSampler}
import candela.testing.PlainScene

import org.scalatest.funsuite.AnyFunSuite

final class StraightWalkSuite extends AnyFunSuite:

  /** A triangle under a layer of a medium, and a sky. */
  private val scene =
    val sky = ConstantEnvironment(Rgb.White, complete = true)
    val triangle = (Vec3(-90f, -50f, 0f), Vec3(90f, -50f, 0f), Vec3(0f, 90f, 0f))
    PlainScene(Rgb.gray(0.8f), sky, triangle)

  private def media(absorption: Rgb, scattering: Rgb) =
    val toUnit = Transform.scale(0.01, 0.01, 1).get * Transform.translate(50, 50, 0)
    val density = SampledGrid(1, 1, 2, Array(0.4f, 1.6f))
    val layer = GridMedium(toUnit, density, absorption, scattering, None, HenyeyGreenstein(0f))
    val borders = Array(MediumBorder(-1, -1))
    SceneMedia(Array(layer), borders, camera = 0, Array(-1), Vec3(0f, 0f, 0.9f), reach = 300f)

  /** Mean of what is seen from within the layer, downwards. */
  private def seen(media: SceneMedia, photons: Option[PhotonLight]): Rgb =
    val tracer = VolumePathTracer(
      scene,
      media,
      PathLimits(4, LightTransport.RouletteDepth),
      PathOptions(photons = photons)
    )
    val sampler = IndependentSampler(1, 1)
    val ray = Ray()
    val n = 100000
    var (r, g, b) = (0.0, 0.0, 0.0)
    for i <- 0 until n do
      sampler.start(i, 0, 0)
      ray.set(Vec3(0f, 0f, 0.9f), Vec3(0.3f, 0f, -1f), Float.PositiveInfinity)
      val found = tracer.radiance(ray, sampler)
      r += found.r
      g += found.g
      b += found.b
    Rgb((r / n).toFloat, (g / n).toFloat, (b / n).toFloat)

  /** Photons that bring all that media scatter: nothing. */
  private val dark = new PhotonLight(scene, scene.casters, 4, bringsAll = true):
    protected def gather(vertex: SurfaceVertex, most: Int, isAlone: Boolean): Rgb = Rgb.Black
    protected def along(segment: MediumSegment, most: Int, isAlone: Boolean, isSeen: Boolean) = ()

  for (what, extinction) <- Seq("grey" -> Rgb.gray(0.8f), "coloured" -> Rgb(0.4f, 0.8f, 1.5f)) do
    test(s"to a path that goes straight, what scatters is as what absorbs: $what"):
      val found = seen(media(Rgb.Black, extinction), Some(dark))
      val expected = seen(media(extinction, Rgb.Black), None)
      // Some 0.2 % of noise in either
      for (f, e) <- Seq(found.r -> expected.r, found.g -> expected.g, found.b -> expected.b) do
        assert(e > 0.02f && Math.abs(f / e - 1) < 0.015f, s"$found, expected $expected")

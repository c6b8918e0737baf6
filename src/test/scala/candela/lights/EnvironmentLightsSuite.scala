package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.image.Image
import candela.math.*
import candela.testing.Draws

final class EnvironmentLightsSuite extends AnyFunSuite:

  /** A few bright spots on a dim ground. */
  private def picture(width: Int, height: Int): Image =
    val draws = Draws(1)
    val image = Image.rgb(width, height)
    for i <- image.data.indices do image.data(i) = 0.1f + 5f * pow(draws.unit(), 8f)
    image

  private val turned = Draws(2).rotation()

  private def environment(
      image: Image,
      layout: SphereMap,
      factor: Rgb,
      smooth: Boolean,
      complete: Boolean
  ) = ImageEnvironment(LightFrame(turned), SphereImage(image, layout, factor, smooth), complete)

  private def light(layout: SphereMap, smooth: Boolean, complete: Boolean): ImageEnvironment =
    val image = if layout eq LatLongMap then picture(16, 8) else picture(12, 12)
    environment(image, layout, Rgb(1f, 0.5f, 2f), smooth, complete)

  private val all =
    for
      (name, layout) <- Seq("latitude-longitude" -> LatLongMap, "equal-area" -> EqualAreaMap)
      smooth <- Seq(true, false)
      complete <- Seq(true, false)
    yield
      val words = s"$name, ${if smooth then "smooth" else "blocky"}"
      (
        s"$words, ${if complete then "" else "in"}complete",
        light(layout, smooth, complete),
        complete
      )

  private val constant =
    ("constant", ConstantEnvironment(Rgb(1f, 2f, 3f), complete = true), true)

  for smooth <- Seq(true, false) do
    test(s"colours of samples are converted when they are asked for, once; smooth: $smooth"):
      var conversions = 0
      val colors = Some((c: Rgb) =>
        conversions += 1; c
      )
      val image = SphereImage(picture(16, 8), LatLongMap, Rgb.White, smooth, colors)
      val env = ImageEnvironment(LightFrame(turned), image, complete = true)
      conversions = 0
      val (draws, out) = (Draws(6), LightSample())
      for _ <- 1 to 10 do
        env.sample(Vec3.Zero, draws.unit(), draws.unit(), out)
        assert(out.isLit)
      assert(conversions == 0)
      val radiance = out.radiance.toRgb
      assert(out.radiance.toRgb == radiance && conversions == 1)
      assert(radiance == env.radiance(Vec3.Zero, out.wi))

  for (name, env, complete) <- all :+ constant do
    test(s"$name: a sample's density and radiance are those of its direction"):
      val draws = Draws(5)
      val out = LightSample()
      val count = 10000
      val off = (1 to count).count: _ =>
        env.sample(Vec3.Zero, draws.unit(), draws.unit(), out)
        assert(out.isInfinite && Math.abs(out.wi.length - 1f) < 1e-5f)
        assert(out.radiance.toRgb == env.radiance(Vec3.Zero, out.wi))
        Math.abs(out.pdf - env.pdf(Vec3.Zero, out.wi)) > 1e-3f * out.pdf
      // Rounding of 1e-6 may move a direction over one of the 16 borders between pixels
      assert(off <= 10, s"$off of $count")

    test(s"$name: the density integrates to 1"):
      // Steps of the density at the borders of pixels cost a cell of 512 at most, with random sign
      val sum = Skies.sphere(d => env.pdf(Vec3.Zero, d).toDouble)
      assert(Math.abs(sum - 1) < 0.01, sum)

    if complete then
      test(s"$name: irradiance by sampling is that of all directions"):
        val expected = Skies.irradiance(env.radiance(Vec3.Zero, _).g.toDouble)
        // The cosine (and two zeroes below the horizon in three) make a deviation of about 1.5 of
        // the mean: of 200000 samples, 0.4 %
        val found = Skies.sampled(env, Vec3.Zero, 200000)
        assert(Math.abs(found / expected - 1) < 0.02, s"$found, expected $expected")
    else
      test(s"$name: dim directions are left to BSDF sampling, bright ones are not"):
        val draws = Draws(8)
        val directions = Seq.fill(5000)(draws.direction())
        val mean = Skies.sphere(env.radiance(Vec3.Zero, _).average.toDouble) / (4 * Math.PI)
        assert(directions.exists(env.pdf(Vec3.Zero, _) == 0f))
        val bright = directions.maxBy(env.radiance(Vec3.Zero, _).average)
        assert(env.radiance(Vec3.Zero, bright).average > mean)
        assert(env.pdf(Vec3.Zero, bright) > 0f)

  test("pixels are as probable as lookups within them are bright, at borders and poles, too"):
    val draws = Draws(3)
    val (w, h) = (8, 8)
    val image = Image(w, h, Image.RgbNames, Array.fill(3 * w * h)(draws.unit()))
    for layout <- Seq(LatLongMap, PolarLatLongMap(h), EqualAreaMap) do
      val sphere = SphereImage(image, layout, Rgb.White, smooth = true)
      // Lookups are bilinear in each quarter of a pixel, where the midpoint rule is exact
      val expected =
        for y <- 0 until h; x <- 0 until w yield
          val quarters =
            for j <- Seq(0.25f, 0.75f); i <- Seq(0.25f, 0.75f)
            yield sphere.bilinear(Vec3((x + i) / w, (y + j) / h, 0f)).average
          quarters.sum / 4 * layout.share(y, h)
      val mean = expected.sum / (w * h)
      val found = ImageEnvironment.distribution(sphere, complete = true)
      for (e, i) <- expected.zipWithIndex do
        val density = found.pdf((i % w + 0.5f) / w, (i / w + 0.5f) / h)
        assert(Math.abs(density - e / mean) < 1e-5f * (1 + e / mean), s"$layout $i")

  test("a factor multiplies the image"):
    val (one, scaled) = (
      environment(picture(16, 8), LatLongMap, Rgb.White, true, true),
      light(LatLongMap, smooth = true, complete = true)
    )
    val d = Vec3(0.6f, 0f, 0.8f)
    val (a, b) = (one.radiance(Vec3.Zero, d), scaled.radiance(Vec3.Zero, d))
    assert(Math.abs(a.g * 0.5f - b.g) < 1e-5f && Math.abs(a.b * 2f - b.b) < 1e-5f) // rounding

  test("an environment that need not be complete, or is black, is not sampled"):
    assert(!ConstantEnvironment(Rgb.White, complete = false).isSampled)
    assert(ConstantEnvironment(Rgb.White, complete = false).pdf(Vec3.Zero, Vec3.Z) == 0f)
    assert(!ConstantEnvironment(Rgb.Black, complete = true).isSampled)
    assert(!environment(Image.rgb(4, 4), EqualAreaMap, Rgb.White, true, true).isSampled)

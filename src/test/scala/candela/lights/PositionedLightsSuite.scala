package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.image.Image
import candela.math.*
import candela.testing.Draws

final class PositionedLightsSuite extends AnyFunSuite:
  private val turned = Transform.translate(0.3, -1, 2) * Draws(2).rotation()
  private val frame = LightFrame(turned)
  private val axis = Vec3(1, 2, 3).normalized
  private def degrees(d: Double) = Math.cos(Math.toRadians(d)).toFloat

  private def chart(width: Int, height: Int): Image =
    val draws = Draws(5)
    Image(width, height, Image.RgbNames, Array.fill(3 * width * height)(draws.unit()))

  private def spot(edge: Double, full: Double, fade: Fade) =
    SpotLight(frame, axis, Rgb(1, 2, 3), degrees(edge), degrees(full), fade)

  private def slide(aspect: (Int, Int), upright: Boolean, lookup: PictureLookup) =
    val picture = Picture(chart(aspect._1, aspect._2), lookup)
    ProjectionLight(frame, Rgb(1, 2, 3), 0.7f, Some(picture), upright)

  private val all: Seq[(String, PositionedLight)] = Seq(
    "point" -> PointLight(frame.position, Rgb(1, 2, 3)),
    "spot" -> spot(40, 25, Fade.Quartic),
    "hard spot" -> spot(40, 40, Fade.Cubic),
    "wide spot" -> spot(120, 10, Fade.Cubic),
    "wide slide" -> slide((8, 4), true, PictureLookup.Nearest),
    "tall slide" -> slide((3, 5), false, PictureLookup.SmoothRepeating),
    "white slide" -> ProjectionLight(frame, Rgb.White, 1f, None, false),
    "goniometric" ->
      GoniometricLight(frame, SphereImage(chart(16, 8), LatLongMap, Rgb(1, 2, 3), true)),
    "goniometric, equal-area" ->
      GoniometricLight(frame, SphereImage(chart(8, 8), EqualAreaMap, Rgb.White, false))
  )

  for (name, light) <- all do
    test(s"$name: what arrives is the intensity over the squared distance"):
      val draws = Draws(1)
      val out = LightSample()
      for _ <- 1 to 1000 do
        val from = draws.vec(-5, 5)
        light.sample(from, draws.unit(), draws.unit(), out)
        val d = frame.position - from
        assert(out.pdf == 1f && !out.isInfinite && (out.wi - d.normalized).length < 1e-6f)
        val expected = light.intensity(-out.wi) * (1f / d.lengthSquared)
        assert(Math.abs(out.radiance.g - expected.g) <= 1e-5f * expected.g)
      light.sample(frame.position, 0.5f, 0.5f, out)
      assert(out.pdf == 0f, "its own place")

    test(s"$name: its importance is above 0 wherever it sends light"):
      val draws = Draws(4)
      val bounds = light.bounds.get
      for _ <- 1 to 5000 do
        val w = draws.direction()
        if !light.intensity(w).isBlack then
          val p = frame.position + w * draws.between(0.1f, 5f)
          assert(bounds.importance(p, Vec3.Zero) > 0f, s"$w"): Unit

  for (edge, full) <- Seq((40.0, 25.0), (40.0, 40.0), (150.0, 100.0)) do
    test(s"the total of a spot of $edge degrees that fades from $full is that of its formula"):
      val light = spot(edge, full, Fade.Cubic)
      val sum = Skies.sphere(light.intensity(_).r.toDouble)
      val expected = SpotLight.solidAngle(degrees(edge), degrees(full))
      // A hard edge cuts about 2000 of the 262144 cells of the sum
      assert(Math.abs(sum / expected - 1) < 5e-3, s"$sum, expected $expected")

  test("older spots fade with the fourth power"):
    val light = spot(40, 20, Fade.Quartic)
    val across = (axis cross Vec3.X).normalized
    for angle <- Seq(5.0, 20.5, 25.0, 30.0, 39.0, 41.0) do
      val local = axis * degrees(angle) + across * degrees(90 - angle)
      val t = Math.max(
        0.0,
        Math.min(
          1.0,
          (degrees(angle) - degrees(40)) /
            (degrees(20) - degrees(40))
        )
      )
      val found = light.intensity(frame.toWorld(local)).r
      assert(Math.abs(found - Math.pow(t, 4)) < 1e-4, s"$angle") // cosines of Floats, steep

  test("the power that a slide lets through is its intensity over all directions"):
    for aspect <- Seq((8, 4), (3, 5)) do
      val picture = Picture(chart(aspect._1, aspect._2), PictureLookup.Nearest)
      val light = ProjectionLight(frame, Rgb.White, 0.7f, Some(picture), upright = true)
      val sum = Skies.sphere(light.intensity(_).luminance.toDouble)
      val power = ProjectionLight.power(picture, 0.7f, _.luminance)
      // The formula takes the middle of each of few pixels for all of it
      assert(Math.abs(sum / power - 1) < 0.03, s"$sum, expected $power")

  test("a slide of v4 stands upright, in v2 and v3 on its head; x runs to the left's right"):
    val image = Image(2, 2, Image.RgbNames, Array.tabulate(12)(i => (i / 3 + 1).toFloat))
    val picture = Some(Picture(image, PictureLookup.Nearest))
    def seen(upright: Boolean, x: Float, y: Float) =
      val light = ProjectionLight(LightFrame(Transform.Identity), Rgb.White, 1f, picture, upright)
      light.intensity(Vec3(x, y, 1f).normalized).r
    assert(Seq(seen(true, -0.5f, 0.5f), seen(true, 0.5f, 0.5f), seen(true, -0.5f, -0.5f)) ==
      Seq(1f, 2f, 3f))
    assert(Seq(seen(false, -0.5f, -0.5f), seen(false, 0.5f, -0.5f), seen(false, -0.5f, 0.5f)) ==
      Seq(1f, 2f, 3f))

  test("a plane across the axis is lit evenly by a projector of Mitsuba's"):
    val light =
      ProjectionLight(LightFrame(Transform.Identity), Rgb.White, 1f, None, true, onPlane = true)
    for at <- Seq(Vec3(0f, 0f, 1f), Vec3(0.9f, 0f, 1f), Vec3(-0.5f, 0.8f, 1f)) do
      // Irradiance: the intensity times the cosine, by the squared distance
      val w = at.normalized
      assert(Math.abs(light.intensity(w).r * w.z / at.lengthSquared - 1f) < 1e-5f)

  test("the pole of a goniometric image is the light's +y"):
    val image = Image(1, 2, Image.RgbNames, Array(1f, 1f, 1f, 0f, 0f, 0f))
    val sphere = SphereImage(image, LatLongMap, Rgb.White, smooth = false)
    val light = GoniometricLight(LightFrame(Transform.Identity), sphere)
    assert(light.intensity(Vec3.Y).r == 1f && light.intensity(-Vec3.Y).r == 0f)

  test("a stretched light is taken to matter everywhere"):
    val squeezed = LightFrame(Transform.scale(1, 4, 1).get)
    assert(!squeezed.keepsAngles && frame.keepsAngles)
    val light = SpotLight(squeezed, Vec3.Z, Rgb.White, 0.9f, 0.95f, Fade.Cubic)
    assert(light.bounds.get.importance(Vec3(0, 0, -1), Vec3.Zero) > 0f)

  test("pictures are bilinear between pixels, and go on or repeat beyond their border"):
    val image = Image(2, 1, Image.RgbNames, Array(0f, 0f, 0f, 1f, 1f, 1f))
    def at(lookup: PictureLookup, x: Float) = Picture(image, lookup)(x, 0.5f).r
    assert(Seq(0.1f, 0.4f, 0.6f).map(at(PictureLookup.Nearest, _)) == Seq(0f, 0f, 1f))
    assert(at(PictureLookup.Smooth, 0.5f) == 0.5f && at(PictureLookup.Smooth, 1f) == 1f)
    assert(at(PictureLookup.SmoothRepeating, 1f) == 0.5f)

package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.Ray
import candela.math.*
import candela.testing.Draws

final class RealisticCameraSuite extends AnyFunSuite:
  private val diagonal = 0.035f

  private def focused(lens: LensSystem): LensSystem =
    LensFocus.focused(lens, 2, diagonal).toOption.get

  private val lenses = Vector(
    "wide open" -> focused(Lenses.doubleGauss()),
    "stopped down" -> focused(Lenses.doubleGauss(stop = 0.6)),
    "single" -> focused(Lenses.biconvex(0.06, 0.008, 1.5, 0.05)),
    "square stop" -> focused(
      Lenses.biconvex(0.06, 0.008, 1.5, 0.05, Some(StopShapes.all("square")()))
    )
  )

  for (name, lens) <- lenses do
    test(s"$name: all light that reaches the film comes through the pupil's rectangle"):
      val pupil = ExitPupil.of(lens, diagonal)
      val draws = Draws(3)
      var passed = 0
      for _ <- 0 until 200000 do
        val radius = draws.unit() * diagonal / 2
        val ring = pupil.ring(radius)
        val turn = draws.unit() * 2 * Math.PI
        val (c, s) = (Math.cos(turn), Math.sin(turn))
        val reach = lens.rearAperture
        val (x, y) = ((2 * draws.unit() - 1) * reach, (2 * draws.unit() - 1) * reach)
        val (px, py) = (c * x - s * y, s * x + c * y)
        val ray = Array(c * radius, s * radius, 0, px - c * radius, py - s * radius, lens.rearZ)
        if lens.fromFilm(ray) > 0 then
          passed += 1
          assert(!pupil.isDark(ring))
          assert(x >= pupil.x(ring, 0) && x <= pupil.x(ring, 1), s"x $x at $radius")
          assert(y >= pupil.y(ring, 0) && y <= pupil.y(ring, 1), s"y $y at $radius"): Unit
      assert(passed > 50)

    test(s"$name: the rectangle is not much larger than the pupil"):
      val pupil = ExitPupil.of(lens, diagonal)
      val draws = Draws(5)
      val tries = 20000
      val hits = (0 until tries).count: _ =>
        val (x, y) = (pupil.x(0, draws.unit()), pupil.y(0, draws.unit()))
        lens.fromFilm(Array(0.0, 0, 0, x, y, lens.rearZ)) > 0
      // π/4 for a disc, but for what a rectangle has to have around it
      assert(hits > (if name == "stopped down" then 0.2 else 0.4) * tries)

  private def camera(lens: LensSystem, width: Int = 60, height: Int = 40): RealisticCamera =
    val pupil = ExitPupil.of(lens, diagonal)
    val gain = RealisticCamera.exposureGain(lens, 1)
    RealisticCamera(Transform.Identity, FilmFrame(width, height, diagonal), lens, pupil, gain)

  test("the weights' mean is the film's integral of cos⁴ over the pupil, wherever it is taken"):
    val lens = lenses.head._2
    val draws = Draws(7)
    val ray = Ray()
    for (x, y) <- Seq((30f, 20f), (12f, 31f), (50f, 4f)) do
      val n = 40000
      val mean = Iterator
        .fill(n) {
          camera1.generate(x, y, draws.unit(), draws.unit(), ray)
          ray.weight.toDouble
        }
        .sum / n
      // The same integral over the whole rear surface
      val w = diagonal / Math.sqrt(1 + 4.0 / 9)
      val (fx, fy) = (w / 2 - x / 60 * w, y / 60 * w - w / 3)
      val reach = lens.rearAperture
      val whole = Iterator
        .fill(4 * n) {
          val (px, py) = ((2 * draws.unit() - 1) * reach, (2 * draws.unit() - 1) * reach)
          val (dx, dy, dz) = (px - fx, py - fy, lens.rearZ)
          val cosine2 = dz * dz / (dx * dx + dy * dy + dz * dz)
          lens.fromFilm(Array(fx, fy, 0, dx, dy, dz)) * cosine2 * cosine2
        }
        .sum / (4 * n) * 4 * reach * reach / (lens.rearZ * lens.rearZ)
      // Monte Carlo with a relative error of about 0.7 %
      assert(Math.abs(mean / whole - 1) < 0.03, s"$x, $y: $mean, $whole")

  private lazy val camera1 = camera(lenses.head._2)

  test("the picture is upright: up and to the right on it is up and to the right in the scene"):
    val ray = Ray()
    camera1.generate(30f, 5f, 0.5f, 0.5f, ray)
    assert(ray.weight > 0 && ray.direction.y > 0.1f)
    camera1.generate(50f, 20f, 0.5f, 0.5f, ray)
    assert(ray.weight > 0 && ray.direction.x > 0.1f)
    assert(Math.abs(ray.direction.length - 1) < 1e-5f)

  test("rays through one place of the film meet at the focus"):
    val draws = Draws(9)
    val ray = Ray()
    val stopped = camera(lenses(1)._2)
    for (x, y) <- Seq((30f, 20f), (20f, 25f)) do
      val places = Vector.fill(200) {
        stopped.generate(x, y, draws.unit(), draws.unit(), ray)
        Option.when(ray.weight > 0)(ray.at((2f - ray.oz) / ray.dz))
      }.flatten
      assert(places.size > 20)
      // A pixel is 29 mm / 60 · 2 m / 52 mm = 19 mm large there; the lens has aberrations
      assert(places.forall(p => (p - places.head).length < 0.004f))

  test("differentials are the distance of neighbouring pixels, also beside blocked rays"):
    val (ray, scratch) = (Ray(), Ray())
    // Not in the middle: there the pupil turns by a half from one side to the other
    camera1.generate(40f, 24f, 0.4f, 0.6f, ray)
    camera1.differential(40f, 24f, 0.4f, 0.6f, 1f, ray, scratch)
    val d = ray.differential
    assert(d.isKnown)
    val at = ray.at((2f - ray.oz) / ray.dz)
    val there = d.xOrigin + d.xDirection * ((2f - d.xOrigin.z) / d.xDirection.z)
    assert(Math.abs((there - at).length - 0.0187f) < 0.001f)

  test("a moving camera keeps the weights of the one that moves"):
    val moving = MovingCamera(camera1, Still(Transform.translate(1, 2, 3)))
    val (a, b) = (Ray(), Ray())
    assert(moving.weighs)
    moving.generate(22f, 11f, 0.3f, 0.4f, a)
    camera1.generate(22f, 11f, 0.3f, 0.4f, b)
    assert(a.weight == b.weight && (a.origin - b.origin - Vec3(1, 2, 3)).length < 1e-6f)

package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

final class LensSystemSuite extends AnyFunSuite:
  private val (radius, thickness, eta) = (0.06, 0.008, 1.5)

  /** The lensmaker's equation for a thick lens (Hecht, "Optics", 4th ed., §6.1), from its own
    * principal planes: focal length, and how far the planes lie inside of the two vertices.
    */
  private val focal =
    val n = eta - 1
    1 / (n * (2 / radius - n * thickness / (eta * radius * radius)))
  private val plane = focal * (eta - 1) * thickness / (eta * radius)

  test("the cardinal points of a thick lens are those of the lensmaker's equation"):
    val lens = Lenses.biconvex(radius, thickness, eta, filmDistance = 0.05)
    val thick = LensFocus.thickLens(lens, 1e-5).get
    val back = 0.05 + 0.002 // of the rear vertex
    // Rays 1e-5 m from the axis: spherical aberration is of the order (1e-5 / radius)²
    assert(Math.abs(thick.focalLength - focal) < 1e-6 * focal)
    assert(Math.abs(thick.filmPlane - (back + plane)) < 1e-7)
    assert(Math.abs(thick.scenePlane - (back + thickness - plane)) < 1e-7)
    assert(Math.abs(thick.filmFocus - (back + plane - focal)) < 1e-7)
    assert(Math.abs(thick.sceneFocus - (back + thickness - plane + focal)) < 1e-7)

  test("the double Gauss lens has the focal length it is sold for"):
    val thick = LensFocus.thickLens(Lenses.doubleGauss(), 1e-5).get
    // Focal lengths are sold in whole millimetres
    assert(Math.abs(thick.focalLength - 0.05) < 0.0005)

  test("paraxial rays from the focused film meet where the focus is"):
    val lenses = Vector(
      Lenses.doubleGauss(),
      Lenses.biconvex(radius, thickness, eta, filmDistance = 0.05)
    )
    for lens <- lenses; distance <- Seq(0.4, 1.0, 3.0, 50.0) do
      val focused = LensFocus.focused(lens, distance, 0.035).toOption.get
      val ray = Array(0.0, 0, 0, 1e-5, 0, focused.rearZ)
      assert(focused.fromFilm(ray) == 1)
      val met = ray(2) - ray(0) / ray(3) * ray(5)
      // What is far away is out of focus by the least error of the film's place
      assert(Math.abs(met - distance) < 1e-4 * distance * distance.max(1), s"$distance: $met")

  test("the thick lens' focus is the one of 1/f, for a film's distance of its own"):
    val lens = Lenses.doubleGauss()
    val focused = LensFocus.focused(lens, 2, 0.035).toOption.get
    val thick = LensFocus.thickLens(focused, 1e-5).get
    val found = 1 / (2 - thick.scenePlane) + 1 / thick.filmPlane
    assert(Math.abs(found - 1 / thick.focalLength) < 2e-4)

  test("what is too near can't be focused, and it is said which is the nearest"):
    val why = LensFocus.focused(Lenses.doubleGauss(), 0.1, 0.035).left.toOption.get
    assert(why.contains("at least 0.196 m"))

  test("a stop that is too small for paraxial rays is an error"):
    assert(LensFocus.focused(Lenses.doubleGauss(stop = 0.01), 2, 0.035).isLeft)

  test("light goes the same way back"):
    val lens = Lenses.doubleGauss()
    val draws = Draws(4)
    var passed = 0
    for _ <- 0 until 2000 do
      val film = (draws.between(-0.012f, 0.012f), draws.between(-0.012f, 0.012f))
      val (px, py) = (draws.between(-0.008f, 0.008f), draws.between(-0.008f, 0.008f))
      val ray = Array[Double](film._1, film._2, 0, px - film._1, py - film._2, lens.rearZ)
      if lens.fromFilm(ray) > 0 then
        passed += 1
        val back = Array(
          ray(0) + 0.1 * ray(3),
          ray(1) + 0.1 * ray(4),
          ray(2) + 0.1 * ray(5),
          -ray(3),
          -ray(4),
          -ray(5)
        )
        assert(lens.fromScene(back))
        val t = -back(2) / back(5)
        assert(Math.abs(back(0) + t * back(3) - film._1) < 1e-9)
        assert(Math.abs(back(1) + t * back(4) - film._2) < 1e-9): Unit
    assert(passed > 500)

  test("no light goes round a rim"):
    val lens = Lenses.doubleGauss()
    val ray = Array(0.0, 0, 0, 0.0101, 0, lens.rearZ) // the rear surface is 10 mm in radius
    assert(lens.fromFilm(ray) == 0)

  test("a stop's shape weighs light"):
    val half = StopShape(2, 1, Array(0f, 1f))
    assert(half.transmission(-0.5, 0) == 0 && half.transmission(0.5, 0) == 1)
    assert(Math.abs(half.transmission(0, 0) - 0.5) < 1e-12)
    for (name, make) <- StopShapes.all do
      val shape = make()
      // As bright as the disc of the same stop: π/4 of the square
      val steps = 400
      val values =
        for i <- 0 until steps; j <- 0 until steps
        yield shape.transmission((i + 0.5) / steps * 2 - 1, (j + 0.5) / steps * 2 - 1)
      assert(Math.abs(values.sum / values.size - Math.PI / 4) < 0.003, name)
      assert(values.min == 0 && shape.extent < 1.01 * Math.sqrt(2), name)
    assert(StopShapes.all("pentagon")().transmission(0, -0.75) > 1)
    assert(StopShapes.all("pentagon")().transmission(0, 0.75) == 0)
    assert(StopShapes.all("star")().transmission(-0.95, 0) > 0)

package candela.math

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

class InterpolationSuite extends AnyFunSuite:

  private def between(a: Transform, b: Transform, shortest: Boolean = true): Interpolation =
    Interpolation(a, b, 1f, 3f, shortest)

  private def rotation(degrees: Double, x: Double, y: Double, z: Double): Transform =
    Transform.rotate(degrees, x, y, z).get

  private def scale(x: Double, y: Double, z: Double): Transform = Transform.scale(x, y, z).get

  private def assertClose(a: Transform, b: Transform, tolerance: Double = 1e-9): Unit =
    val size = a.m.map(Math.abs).max
    for i <- 0 until 16 do
      assert(Math.abs(a.m(i) - b.m(i)) <= tolerance * size, s"$i of\n$a\n$b"): Unit

  private def affine(draws: Draws): Transform =
    draws.translation(5) * draws.rotation() * draws.stretch() * draws.rotation()

  test("before the start and after the end, and at both, the given maps hold exactly"):
    val draws = Draws(1)
    for _ <- 0 until 100 do
      val (a, b) = (affine(draws), affine(draws))
      val motion = between(a, b)
      for t <- Seq(-1f, 1f) do assert(motion.transform(t) == a)
      for t <- Seq(3f, 9f) do assert(motion.transform(t) == b)

  test("just after the start and just before the end it is close to the given maps"):
    val draws = Draws(2)
    for _ <- 0 until 100 do
      val (a, b) = (affine(draws), affine(draws))
      // Unless the determinants' signs differ, so that something must pass through zero
      if a.swapsHandedness == b.swapsHandedness then
        val motion = between(a, b)
        assertClose(a, motion.transform(1.0001f), 1e-2)
        assertClose(b, motion.transform(2.9999f), 1e-2)

  test("translations go straight, at constant speed"):
    val motion = between(Transform.translate(1, 2, 3), Transform.translate(5, 0, 3))
    assertClose(motion.transform(1.5f), Transform.translate(2, 1.5, 3))

  test("rotations about one axis turn at constant speed, the short way"):
    for degrees <- Seq(10.0, 90, 179, -120) do
      val motion = between(Transform.Identity, rotation(degrees, 1, 2, -2))
      for t <- Seq(0.1, 0.5, 0.8) do
        // The time is a Float: it is off by up to 1e-7, of half a turn
        assertClose(motion.transform((1 + 2 * t).toFloat), rotation(t * degrees, 1, 2, -2), 1e-6)
    val far = between(Transform.Identity, rotation(200, 0, 0, 1))
    assertClose(far.transform(2f), rotation(-80, 0, 0, 1))

  test("pbrt-v2 turns by 200 degrees if told so"):
    val far = between(Transform.Identity, rotation(200, 0, 0, 1), shortest = false)
    assertClose(far.transform(2f), rotation(100, 0, 0, 1))

  test("half a turn goes one way or the other, through rotations"):
    for degrees <- Seq(179.999, 180.0, 180.001) do
      val half = between(Transform.Identity, rotation(degrees, 0, 1, 0)).transform(2f)
      val isQuarter = Seq(90, -90).exists: q =>
        val quarter = rotation(q, 0, 1, 0)
        half.m.lazyZip(quarter.m).forall((p, q) => Math.abs(p - q) < 2e-5)
      assert(isQuarter, half)

  test("nearly equal rotations are no division by zero"):
    val motion = between(rotation(30, 1, 1, 0), rotation(30.0001, 1, 1, 0))
    assertClose(motion.transform(2f), rotation(30.00005, 1, 1, 0))
    val same = between(rotation(30, 1, 1, 0), Transform.translate(1, 0, 0) * rotation(30, 1, 1, 0))
    assertClose(same.transform(2f), Transform.translate(0.5, 0, 0) * rotation(30, 1, 1, 0))

  test("stretches are interpolated in the frame that turns"):
    val motion = between(scale(1, 2, 3), rotation(60, 0, 0, 1) * scale(3, 2, 1))
    assertClose(motion.transform(2f), rotation(30, 0, 0, 1) * scale(2, 2, 2))

  test("what mirrors at both ends mirrors in between, and is never flat"):
    val draws = Draws(3)
    for _ <- 0 until 200 do
      val mirror = scale(-1, 1, 1)
      val (a, b) = (draws.rotation() * mirror, draws.translation(3) * draws.rotation() * mirror)
      for t <- Seq(1.2f, 1.9f, 2.5f) do
        val m = between(a, b).transform(t)
        assert(m.swapsHandedness)
        val (x, y, z) = (m.vector(Vec3.X), m.vector(Vec3.Y), m.vector(Vec3.Z))
        // A rotation of a mirror image, so of unit volume
        assert(Math.abs(Math.abs((x cross y) dot z) - 1f) < 1e-5f)

  test("the inverse that is written is that of the map"):
    val draws = Draws(4)
    val m = new Array[Double](Motion.Work)
    for _ <- 0 until 200 do
      val motion = draws.below(3) match
        case 0 => between(affine(draws), affine(draws))
        case 1 => InverseMotion(between(affine(draws), affine(draws)))
        case _ => MotionProduct(between(affine(draws), affine(draws)), Still(affine(draws)))
      motion.write(draws.between(0.5f, 3.5f), m, 0)
      val forth = Transform.fromRows(m.take(12).toVector ++ Vector(0.0, 0.0, 0.0, 1.0))
      for t <- forth do
        for i <- 0 until 12 do
          val size = t.inverseM.map(Math.abs).max
          assert(Math.abs(t.inverseM(i) - m(12 + i)) <= 1e-6 * size): Unit

  test("a product moves by the inner motion first"):
    val outer = between(Transform.Identity, Transform.translate(4, 0, 0))
    val inner = between(Transform.Identity, rotation(90, 0, 0, 1))
    assertClose(
      MotionProduct(outer, inner).transform(2f),
      Transform.translate(2, 0, 0) * rotation(45, 0, 0, 1)
    )

  test("about another origin, that is what turns stay at"):
    val origin = Vec3(5f, 0f, 0f)
    val about = Transform.translate(5, 0, 0) * rotation(90, 0, 0, 1) * Transform.translate(-5, 0, 0)
    val motion = Interpolation(Transform.Identity, about, 0f, 1f, shortest = true, origin)
    for t <- Seq(0.25f, 0.5f, 0.9f) do
      assert((motion.transform(t).point(origin) - origin).length < 1e-5f)

  test("the inverse of a motion between inverses has its ends, and another way between"):
    val a = Transform.translate(3, 0, 0)
    val b = rotation(90, 0, 0, 1) * a
    val motion = InverseMotion(between(a.inverse, b.inverse))
    assertClose(motion.transform(1f), a)
    assertClose(motion.transform(3f), b)
    // The way back is T(−3, 0, 0) · R(−90°), whose translation stays while it turns
    assertClose(motion.transform(2f), rotation(45, 0, 0, 1) * Transform.translate(3, 0, 0))
    assert(motion.moves && !Still(a).moves)

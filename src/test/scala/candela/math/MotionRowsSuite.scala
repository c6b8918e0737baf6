package candela.math

import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

class MotionRowsSuite extends AnyFunSuite:
  private val draws = Draws(1)

  private def bits(m: IArray[Double]) = m.map(java.lang.Double.doubleToRawLongBits).toVector

  private def again(t: Transform): Transform =
    val rows = MotionRows()
    rows.transform(rows.add(t))

  /** Largest difference of the maps, of vectors and of the origin, relative to the map. */
  private def error(a: Transform, b: Transform): Double =
    def apart(columns: Range) =
      val all = for r <- 0 until 3; c <- columns yield 4 * r + c
      val size = all.map(i => a.m(i).abs).max
      if size == 0 then all.map(i => b.m(i).abs).max
      else all.map(i => (a.m(i) - b.m(i)).abs).max / size
    Math.max(apart(0 until 3), apart(3 to 3))

  test("a map is told by its inverse, which has every bit"):
    for _ <- 0 until 2000 do
      val size = draws.magnitude(1e-6, 1e6)
      val t = draws.translation(size * draws.magnitude(0.1, 100)) * draws.rotation() *
        draws.stretch() * draws.rotation() * Transform.scale(size, size, size).get
      assert(MotionRows.canHold(t))
      val found = again(t)
      assert(bits(found.inverseM) == bits(t.inverseM))
      // The given map has rounding errors of its own, of all its factors
      assert(error(t, found) < 2e-13)

  test("translations, scales and rotations about an axis have the zeros and ones they had"):
    val turn = Transform.rotate(33, 0, 0, 1).get
    val all = Seq(
      Transform.Identity,
      Transform.translate(5, -7, 0.25),
      Transform.scale(4, -1, 0.5).get,
      Transform.translate(1, 2, 3) * turn,
      turn * Transform.scale(2, 2, 2).get
    )
    for t <- all do
      val found = again(t)
      for i <- 0 until 16 if t.m(i) == 0 || t.m(i) == 1 do assert(found.m(i) == t.m(i))
      assert(found.m.forall(x => 1 / x > Double.NegativeInfinity))
    for t <- all.take(3) do assert(again(t) == t)

  test("maps that are nearly singular, or whose determinant a Double can't hold, have no row"):
    val thin = draws.rotation() * Transform.scale(1, 1, 1e-12).get * draws.rotation()
    val tiny = Transform.scale(1e-120, 1e-120, 1e-120).get
    for t <- Seq(thin, thin.inverse, tiny, tiny.inverse, Transform.flat(Vector.fill(16)(0.5))) do
      assert(!MotionRows.canHold(t), t)
    // A scale alone may be as thin
    assert(MotionRows.canHold(Transform.scale(1, 1, 1e-12).get * draws.rotation()))

  test("maps that are flattened as much as a row holds are told as well as their rounding lets"):
    for thickness <- Seq(1e-1, 1e-2, 1e-3) do
      for _ <- 0 until 100 do
        val t = draws.rotation() * Transform.scale(1, 1, thickness).get * draws.rotation()
        if MotionRows.canHold(t) then assert(error(t, again(t)) < 1e-14 / thickness): Unit

  test("rows that go on from others leave these as they are"):
    val one = MotionRows()
    for i <- 0 until 300 do one.add(Transform.translate(i, 0, 0)): Unit
    val other = one.continued
    other.add(Transform.translate(0, 1, 0)): Unit
    one.add(Transform.translate(0, 2, 0)): Unit
    assert(one.transform(300) == Transform.translate(0, 2, 0))
    assert(other.transform(300) == Transform.translate(0, 1, 0))
    assert(other.transform(299) == Transform.translate(299, 0, 0) && one.count == 301)

package candela.color

import org.scalatest.funsuite.AnyFunSuite

final class Matrix3Suite extends AnyFunSuite:
  private val m = Matrix3(Vector(2, 1, 0, -1, 3, 1, 0.5, 0, 4))

  test("a matrix times its inverse is the identity, and so for vectors"):
    val one = m * m.inverse
    for r <- 0 until 3; c <- 0 until 3 do
      assert(Math.abs(one(r, c) - (if r == c then 1 else 0)) < 1e-12)
    val v = m.inverse * (m * Vector(1.0, 2.0, 3.0))
    assert(v.lazyZip(Vector(1.0, 2.0, 3.0)).forall((a, b) => Math.abs(a - b) < 1e-12))

  test("rows come first, and transposing changes them for columns"):
    assert(m(0, 1) == 1 && m(1, 0) == -1 && m.transposed(1, 0) == 1)
    assert(m * Vector(1.0, 0.0, 0.0) == Vector(2.0, -1.0, 0.5))

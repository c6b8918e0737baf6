package candela.testing

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.math.*

class ChiSquareSuite extends AnyFunSuite:

  private def uniformSphere(u: () => Float): Option[Vec3] =
    val (z, phi) = (2 * u() - 1, TwoPi * u())
    Some(Vec3(safeSqrt(1 - z * z) * cos(phi), safeSqrt(1 - z * z) * sin(phi), z))

  test("a right density is accepted, and one that is 6% wrong is refused"):
    val right = ChiSquare.directions(seed = 1)(uniformSphere, _ => 1 / (4 * Pi))
    assert(right.accepted(tests = 1), right)
    val tilted = ChiSquare.directions(seed = 1)(uniformSphere, w => (1 + 0.06f * w.x) / (4 * Pi))
    assert(!tilted.accepted(tests = 100), tilted)

  test("p-values of a right density are spread evenly", Slow):
    val ps = (1 to 100).map: seed =>
      ChiSquare.directions(seed, draws = 5000)(uniformSphere, _ => 1 / (4 * Pi)).pValue
    // 100 uniform values: each quarter gets 25 ± 4.3; 4 sigmas
    for quarter <- 0 until 4 do
      val count = ps.count(p => p >= quarter / 4.0 && p < (quarter + 1) / 4.0)
      assert(Math.abs(count - 25) < 18, s"quarter $quarter: $count")

  test("draws that return nothing must be as many as the density leaves"):
    def upperOnly(u: () => Float) = uniformSphere(u).filter(_.z > 0)
    val honest = ChiSquare.directions(seed = 2)(upperOnly, w => if w.z > 0 then 1 / (4 * Pi) else 0)
    assert(honest.accepted(tests = 1), honest)
    val boasting = ChiSquare.directions(seed = 2)(upperOnly, w => if w.z > 0 then 1 / TwoPi else 0)
    assert(!boasting.accepted(tests = 100), boasting)

  test("draws where the density is zero are refused"):
    val result = ChiSquare.directions(seed = 3)(
      u => uniformSphere(u).map(w => if w.z < -0.999f then w else Vec3(w.x, w.y, abs(w.z))),
      w => if w.z > 0 then 1 / TwoPi else 0
    )
    assert(!result.accepted(tests = 100), result)

  test("bins integrate peaks and jumps"):
    val peak = BinIntegral((x, y) => Math.exp(-((x - 0.3) * (x - 0.3) + y * y) / 2e-4))
    // half a Gaussian of variance 1e-4: π · 1e-4; 1e-7 as the class says
    assert(Math.abs(peak(0, 0, 1, 1) - Math.PI * 1e-4) < 1e-7)
    val step = BinIntegral((x, _) => if x < 1 / 3.0 then 1 else 0)
    assert(Math.abs(step(0, 0, 1, 1) - 1 / 3.0) < 1 / 512.0)

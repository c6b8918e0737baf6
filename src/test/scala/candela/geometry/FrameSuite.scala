package candela.geometry

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.Draws

class FrameSuite extends AnyFunSuite:

  // Unit vectors in Float and a handful of operations on them: some 8 round-offs
  private val Rounding = 16 * MachineEpsilon

  private def orthonormal(f: Frame): Assertion =
    def close(x: Float, y: Float) = abs(x - y) <= Rounding
    val lengths = Seq(f.s, f.t, f.n).forall(v => close(v.length, 1f))
    val angles = close(f.s dot f.t, 0f) && close(f.t dot f.n, 0f) && close(f.n dot f.s, 0f)
    assert(lengths && angles && ((f.s cross f.t) dot f.n) > 0.99f, s"${f.s} ${f.t} ${f.n}")

  private val axes =
    Seq(Vec3.X, Vec3.Y, Vec3.Z, -Vec3.X, -Vec3.Y, -Vec3.Z, Vec3(1f, 0f, -0f), Vec3(0f, -1f, -0f))

  /** Where a naive construction breaks down. */
  private val nearPoles =
    for e <- Seq(1e-3f, 1e-4f, 1e-7f, 1e-20f, 1e-40f); z <- Seq(1f, -1f)
    yield Vec3(e, -e, z).normalized

  test("a frame around any direction is orthonormal and right-handed"):
    val draws = Draws(1)
    (axes ++ nearPoles).foreach(n => orthonormal(Frame.fromZ(n)))
    for _ <- 0 until 100000 do orthonormal(Frame.fromZ(draws.direction()))

  test("a frame around n has n as its third axis"):
    for n <- axes do assert(Frame.fromZ(n).n == n && Frame.fromZ(n).toLocal(n) == Vec3.Z)

  test("a frame along a vector is orthonormal, and its s follows the vector"):
    val draws = Draws(2)
    for _ <- 0 until 100000 do
      val (n, v) = (draws.direction(), draws.direction() * draws.magnitude(1e-8, 1e8))
      val frame = Frame.along(n, v)
      orthonormal(frame)
      assert(frame.n == n && (frame.s dot v) >= 0f)
      assert((frame.t absDot v) <= 1e-5f * v.length) // v lies in the plane of s and n

  test("a frame along what is all but parallel to n is still orthonormal"):
    val draws = Draws(3)
    for _ <- 0 until 100000 do
      val n = draws.direction()
      orthonormal(Frame.along(n, n + draws.direction() * draws.magnitude(1e-9, 1e-1)))

  test("a frame along nothing, or along n itself, is some frame around n"):
    for n <- axes; v <- Seq(Vec3.Zero, n, n * -3f) do orthonormal(Frame.along(n, v))

  test("to local and back is the identity"):
    val draws = Draws(4)
    for _ <- 0 until 10000 do
      val (frame, v) = (Frame.fromZ(draws.direction()), draws.direction())
      assert((frame.toWorld(frame.toLocal(v)) - v).length <= Rounding)
      assert((frame.toLocal(frame.toWorld(v)) - v).length <= Rounding)

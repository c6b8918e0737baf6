package candela.moving

import candela.math.{Position, Transform}

import org.scalatest.funsuite.AnyFunSuite

class CameraPoseSuite extends AnyFunSuite:
  import CameraPose.*

  private def view(numbers: Double*): Transform =
    Transform.lookAt(numbers.take(3), numbers.slice(3, 6), numbers.drop(6)).get

  private val mirror = Transform.scale(-1, 1, 1).get
  private val upright = view(0, -8, 3, 0, 0, 1, 0, 0, 1)

  private def assertNear(a: Transform, b: Transform, tolerance: Double): Unit =
    for i <- 0 until 16 do assert(Math.abs(a.m(i) - b.m(i)) < tolerance, s"$a, $b")

  private def toCamera(pose: CameraPose): Transform = pose.inside * view(pose.numbers*)

  test("a pose is that of its transform, with mirrors and scales"):
    val scale = Transform.scale(0.5, 0.5, 2).get
    val shear = Transform.fromRows(Vector(1, 0.2, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)).get
    val views =
      Vector(upright, view(1e4, 2e4, 3, 1.1e4, 2e4, 0, 0, 1, 0), view(1, 2, 3, 4, 4, 4, 1, 5, 2))
    for inside <- Vector(Transform.Identity, mirror, scale, mirror * scale, shear); v <- views do
      val pose = CameraPose.of(inside * v, 7)
      assert(Math.abs(pose.distance - 7) < 1e-9)
      // A direction that is rounded in its sixth digit, times positions
      assertNear(toCamera(pose), inside * v, 1e-5 * (1 + pose.eye.reach))

  test("an upright camera says so in round numbers, and mirrors are exact"):
    val pose = CameraPose.of(mirror * upright, Math.sqrt(68))
    assert(pose.numbers == Vector[Double](0, -8, 3, 0, 0, 1, 0, 0, 1))
    assert(pose.inside == mirror)

  test("orbiting keeps distance and target, and turns the front of the scene as asked"):
    for inside <- Vector(Transform.Identity, mirror) do
      val pose = CameraPose.of(inside * upright, Math.sqrt(68))
      val turned = pose.orbited(10, 0, pose.target)
      assert(Math.abs(turned.distance - pose.distance) < 1e-9)
      assert(turned.target.distance(pose.target) < 1e-9 && turned.eye.z == pose.eye.z)
      // A point before the target moves to the right of the picture, one behind it to the left
      val front = pose.target + (pose.eye - pose.target) * 0.2
      assert(toCamera(turned).position(front).x > 1e-3)
      val raised = pose.orbited(0, 10, pose.target)
      assert(raised.eye.z > pose.eye.z && toCamera(raised).position(front).y < -1e-3)

  test("no orbit passes the poles"):
    val pose = CameraPose.of(upright, 5)
    for rise <- Vector(-200.0, -91.0, 91.0, 200.0) do
      val turned = pose.orbited(0, rise, pose.target)
      assert(dot(turned.above, turned.axis) > 0)
      assert(turned.orbited(30, 0, turned.target).numbers.forall(_.isFinite))

  test("a tilted horizon stays tilted"):
    val tilted = CameraPose.of(view(0, -8, 3, 0, 0, 1, 0.5, 0, 1), 5)
    val turned = tilted.orbited(40, 0, tilted.target)
    assert(Math.abs(dot(turned.right, turned.axis) - dot(tilted.right, tilted.axis)) < 1e-9)
    assert(tilted.numbers.drop(6) != Vector[Double](0, 0, 1))

  test("moving nearer divides the distance, and keeps the target"):
    val pose = CameraPose.of(upright, 6)
    val near = pose.nearer(1.5)
    assert(Math.abs(near.distance - 4) < 1e-12 && near.target == pose.target)
    assert(pose.moved(Position(1, 2, 3)).eye == pose.eye + Position(1, 2, 3))

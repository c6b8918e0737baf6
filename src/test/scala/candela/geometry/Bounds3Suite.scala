package candela.geometry

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*

class Bounds3Suite extends AnyFunSuite:
  private val box = Bounds3(Vec3(-1f, 0f, 2f), Vec3(3f, 2f, 8f))

  test("the empty box holds nothing and adds nothing"):
    assert(Bounds3.Empty.isEmpty && Bounds3.Empty.radius == 0f)
    assert(Bounds3.Empty.union(box) == box && box.union(Bounds3.Empty) == box)
    assert(Bounds3.of(Nil).isEmpty)

  test("one point makes a box that is not empty"):
    val point = Bounds3.of(Seq(Vec3.X))
    assert(!point.isEmpty && point.extent.isZero && point.center == Vec3.X && point.radius == 0f)

  test("a box spans its corners, and its sphere reaches them"):
    assert(Bounds3.of((0 until 8).map(box.corner)) == box)
    assert((0 until 8).map(box.corner).distinct.size == 8)
    assert(box.center == Vec3(1f, 1f, 5f) && box.extent == Vec3(4f, 2f, 6f))
    for i <- 0 until 8 do assert((box.corner(i) - box.center).length == box.radius)

  test("a mapped box spans what becomes of its corners"):
    val turned = Transform.translate(1, 2, 3) * Transform.rotate(40, 1, 2, 3).get
    assert(box.mapped(turned.point(_)) == Bounds3.of((0 until 8).map(i =>
      turned.point(box.corner(i))
    )))
    assert(box.mapped(-_) == Bounds3(-box.max, -box.min))

  test("the reach of a box is the largest distance of its corners along each axis"):
    assert(box.reach == Vec3(3f, 2f, 8f) && box.mapped(-_).reach == box.reach)

  test("a union with a point grows to it and no further"):
    assert(box.union(Vec3(0f, 5f, 3f)) == Bounds3(box.min, Vec3(3f, 5f, 8f)))
    assert(box.union(box.center) == box)

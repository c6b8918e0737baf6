package candela.scene

import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.Bounds3
import candela.math.*
import candela.shapes.*
import candela.testing.Draws

class ShapeRowsSuite extends AnyFunSuite:
  private val draws = Draws(1)

  private def curve(form: CurveForm): BezierCurve =
    val points = Array.fill(12)(draws.between(-1, 1).toDouble)
    val isRibbon = form.kind == CurveKind.Ribbon
    val normals = Option.when(isRibbon)((draws.direction(), draws.direction()))
    BezierCurve(points, 0.02f, 0.01f, normals)

  private def sphere(): Shape =
    Spheres(0.1f, -0.1f, 0.1f, 2 * Pi)(draws.translation(3), false)

  private val forms =
    for kind <- CurveKind.values.toVector; depth <- Seq(0, 2) yield CurveForm(kind, depth, 1f)

  /** Similarities, of which there are two, and maps that stretch. */
  private val places = Vector(
    Transform.Identity,
    draws.translation(2) * draws.rotation() * Transform.scale(2, 2, 2).get,
    Transform.scale(1, 2, 3).get,
    Transform.scale(1, 1, -1).get
  )

  test("curves that share segments are where each is alone, between other shapes"):
    val rows = ShapeRows(Parallel.Alone)
    val expected = Vector.newBuilder[Bounds3]
    for i <- 0 until 600 do
      val (form, toWorld) = (forms(i / 7 % forms.size), places(i / 5 % places.size))
      if i % 11 == 0 then
        val ball = sphere()
        rows.add(ball, i, if i % 2 == 0 then i else ShapeTable.Dark, isInverted = i % 3 == 0)
        expected += ball.bounds
      else
        val some = Vector.fill(1 + i % 2)(curve(form))
        val alone = CurveBuilder.segments(some, form, toWorld, i % 4 == 0)
        val count = rows.addCurves(some, form, toWorld, i % 4 == 0, i)
        assert(count == alone.count)
        expected ++= (0 until count).map(alone.bounds)
      assert(rows.count == expected.result().size)
    val table = rows.result()
    assert(Vector.tabulate(table.count)(table.shape(_).bounds) == expected.result())

  test("rows keep their materials, lights and sides; curves do not emit"):
    val rows = ShapeRows(Parallel.Alone)
    val hair = Vector(curve(forms(0)))
    rows.addCurves(hair, forms(1), Transform.Identity, false, 5): Unit
    rows.add(sphere(), 6, 1, isInverted = true)
    rows.addCurves(hair, forms(0), Transform.Identity, false, 7): Unit
    val table = rows.result()
    assert((0 until table.count).map(table.material) == Seq(5, 5, 5, 5, 6, 7))
    assert((0 until table.count).map(table.light) == Seq(-1, -1, -1, -1, 1, -1))
    assert((0 until table.count).filter(table.isInverted) == Seq(4))
    val dark = ShapeRows(Parallel.Alone)
    dark.add(sphere(), 2, ShapeTable.Dark, isInverted = false)
    assert(dark.result().light(0) == ShapeTable.Dark && !table.isInverted(0))

  test("so many curves are made as they come, all the same"):
    val rows = ShapeRows(Parallel.Alone)
    val hair = Vector.fill(100)(curve(forms(1)))
    val alone = CurveBuilder.segments(hair, forms(1), Transform.Identity, false)
    for _ <- 0 until 200 do rows.addCurves(hair, forms(1), Transform.Identity, false, 0): Unit
    val table = rows.result()
    assert(table.count == 80_000)
    for i <- 0 until table.count by 77 do
      assert(table.shape(i).bounds == alone.bounds(i % alone.count))

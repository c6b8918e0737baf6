package candela.render

import org.scalatest.funsuite.AnyFunSuite

class CostsSuite extends AnyFunSuite:
  private def told(costs: Cost*): Vector[(CostKind, Long, Double)] =
    (Costs() ++ costs.toVector).reported.map(c => (c.kind, c.bytes, c.seconds))

  test("bytes and seconds of a kind are added up, in the order of the kinds"):
    val all = Costs() ++ Vector(Cost(CostKind.Film, 5), Cost(CostKind.Triangles, 3, 0.5)) ++
      Vector(Cost(CostKind.Film, 2, 1))
    assert(all.reported == Vector(Cost(CostKind.Triangles, 3, 0.5), Cost(CostKind.Film, 7, 1)))
    assert(all.bytes == 10)

  test("what took neither bytes nor time is not told"):
    assert(told(Cost(CostKind.Textures, 0, 0.001), Cost(CostKind.Film, 1)) ==
      Vector((CostKind.Film, 1L, 0.0)))

  test("without triangles, building surfaces is the other shapes' time"):
    val built = Cost(CostKind.Triangles, 0, 2)
    assert(told(Cost(CostKind.Shapes, 9), built) == Vector((CostKind.Shapes, 9L, 2.0)))
    assert(told(built) == Vector((CostKind.Triangles, 0L, 2.0)))
    val both = told(Cost(CostKind.Shapes, 9), Cost(CostKind.Triangles, 4), built)
    assert(both == Vector((CostKind.Triangles, 4L, 2.0), (CostKind.Shapes, 9L, 0.0)))

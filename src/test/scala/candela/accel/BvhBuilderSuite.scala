package candela.accel

import org.scalatest.funsuite.AnyFunSuite

class BvhBuilderSuite extends AnyFunSuite:

  private def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

  for (name, primitives) <- AcceleratorScenes.all; maxLeaf <- Seq(1, 4) do
    test(s"each primitive is in one leaf, inside all boxes above: $name, leaves to $maxLeaf"):
      val boxes = primitives.bounds
      val built = BvhBuilder(boxes, maxLeaf)
      val seen = new Array[Int](primitives.count)

      def visit(code: Int, size: Int, depth: Int, above: List[Array[Float]]): Unit =
        // What the walk's stack has room for
        assert(depth <= 128)
        if code < 0 then
          assert(primitives.count == 0 || (size >= 1 && size <= maxLeaf))
          for slot <- ~code until ~code + size do
            val i = built.order(slot)
            seen(i) += 1
            for box <- above; k <- 0 until 3 do
              assert(box(k) <= boxes(6 * i + k) && box(3 + k) >= boxes(6 * i + 3 + k))
        else
          for side <- 0 until 2 do
            val at = code + 6 * side
            visit(
              bits(built.nodes(code + 12 + side)),
              bits(built.nodes(code + 14 + side)),
              depth + 1,
              built.nodes.slice(at, at + 6) :: above
            )

      visit(built.root, built.rootCount, 0, Nil)
      assert(seen.forall(_ == 1))

  test("primitives that all lie at one point are halved into leaves"):
    val built = BvhBuilder(Array.fill(6 * 1000)(2f), maxLeaf = 4)
    assert(built.order.sorted.sameElements(Array.range(0, 1000)))
    assert(built.nodeCount <= 511) // 1000 in leaves of at most 4 by halving: 256 or 512 leaves

  test("centroids a denormal number apart are no worse than equal ones"):
    val boxes = Array.tabulate(6 * 100)(i => (i / 6 % 2) * 1e-44f)
    assert(BvhBuilder(boxes, maxLeaf = 4).order.distinct.length == 100)

package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

class VertexIndicesSuite extends AnyFunSuite:

  private def all(packed: VertexIndices): Seq[Int] = (0 until packed.length).map(packed(_))

  /** Runs of triangles around places that are near each other or far, in any order. */
  private def indices(count: Int, reach: Int, most: Int): Array[Int] =
    val draws = Draws(7)
    Array.tabulate(3 * count): i =>
      val place = if i / 200 % 2 == 0 then 0 else most - reach
      place + (if i % 64 == 0 then 0 else if i % 64 == 1 then reach - 1 else draws.below(reach))

  test("indices are those that were given, near each other and far"):
    for (reach, most) <- Seq((1, 1), (65536, 100000), (65537, 200000), (9, Int.MaxValue)) do
      for count <- Seq(0, 1, 21, 22, 64, 1000) do
        val given_ = indices(count, reach, most)
        val packed = VertexIndices(given_)
        assert(packed.length == given_.length && all(packed) == given_.toSeq, s"$count $reach")
        assert(packed.slice(packed.length / 3, packed.length).toSeq ==
          given_.toSeq.drop(given_.length / 3))

  test("pieces follow each other, each raised by its number, across the ends of groups"):
    val sizes = Vector(3, 0, 60, 66, 3, 300)
    val pieces = sizes.indices.map(k => (Array.tabulate(sizes(k))(_ * (k + 1)), 70000 * k))
    val packed = VertexIndices.joined(pieces.iterator, sizes.sum)
    assert(all(packed) == pieces.flatMap((p, by) => p.map(_ + by)))

  test("where they are near each other, they take half the memory; never much more than Ints"):
    val near = VertexIndices(Array.tabulate(300000)(i => i / 2))
    assert(near.bytes <= 2.1 * near.length)
    val far = VertexIndices(indices(100000, 1000000, 1000000))
    assert(far.bytes <= 4.1 * far.length)
    val mixed = VertexIndices(Array.tabulate(300000)(i => if i < 100000 then i * 7919 else i))
    assert(mixed.bytes <= 4 * mixed.length)

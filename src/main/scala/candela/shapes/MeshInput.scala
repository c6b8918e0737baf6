package candela.shapes

import candela.base.loop

/** What must hold before an array of faces is looked at as a surface. */
private[shapes] object MeshInput:

  /** @throws MeshError at the first thing that is wrong */
  def check(levels: Int, indices: Array[Int], positions: Array[Float]): Unit =
    def fail(message: String) = throw MeshError(message)
    val vertexCount = positions.length / 3
    if levels < 0 then fail(s"a mesh can't be subdivided $levels times")
    if positions.length % 3 != 0 then
      fail(s"${positions.length} coordinates are no whole number of points")
    if indices.isEmpty then fail("a mesh without faces")
    if indices.length % 3 != 0 then
      fail(s"${indices.length} indices are no whole number of triangles")
    if indices.length.toDouble * Math.pow(4, levels) > Int.MaxValue - 8 then
      fail(s"$levels levels make too many triangles of ${indices.length / 3}")
    indices.indices.find(i => indices(i) < 0 || indices(i) >= vertexCount).foreach: i =>
      fail(s"face ${i / 3} uses vertex ${indices(i)}; there are $vertexCount, counted from 0")
    positions.indices.find(i => !java.lang.Float.isFinite(positions(i))).foreach: i =>
      fail(s"a coordinate of vertex ${i / 3} is ${positions(i)}")
    loop(indices.length / 3): f =>
      val a = indices(3 * f)
      val b = indices(3 * f + 1)
      val c = indices(3 * f + 2)
      if a == b || b == c || c == a then
        fail(s"face $f uses a vertex twice: $a, $b, $c")

  /** The faces, and for each vertex that they use its old number, in the old order. */
  def withoutUnused(indices: Array[Int], vertexCount: Int): (Array[Int], Array[Int]) =
    val uses = new Array[Boolean](vertexCount)
    indices.foreach(i => uses(i) = true)
    val used = (0 until vertexCount).filter(i => uses(i)).toArray
    val renumbered = new Array[Int](vertexCount)
    loop(used.length)(i => renumbered(used(i)) = i)
    (indices.map(i => renumbered(i)), used)

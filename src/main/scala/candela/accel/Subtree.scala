package candela.accel

import candela.base.{loop, Parallel}

/** A part of a tree, laid out as in [[Bvh]]; its nodes count from its own first Float.
  *
  * @param leafSize of the root, if it is a leaf; −k: it is the kth of the parts that were left for
  *                 later
  */
private[accel] final class Subtree(val root: Int, val leafSize: Int, val nodes: Array[Float])

private[accel] object Subtree:
  import BvhBuilder.NodeFloats

  /** The tree of which `top` is the upper part, and `parts` what it left for later. */
  def join(top: Subtree, parts: Array[Subtree], parallel: Parallel): Subtree =
    val starts = parts.scanLeft(top.nodes.length.toLong)(_ + _.nodes.length)
    if starts.last > Int.MaxValue - 8 then
      val count = starts.last / NodeFloats
      throw IllegalStateException(s"a hierarchy of $count nodes has no place in an array")
    val all = java.util.Arrays.copyOf(top.nodes, starts.last.toInt)
    parallel.each(parts.length): i =>
      val start = starts(i).toInt
      System.arraycopy(parts(i).nodes, 0, all, start, parts(i).nodes.length)
      children(all, start, starts(i + 1).toInt): (at, code, _) =>
        setBits(all, at, moved(code, start))
    def rootOf(k: Int) = moved(parts(k).root, starts(k).toInt)
    children(all, 0, top.nodes.length): (at, _, size) =>
      if size < 0 then
        setBits(all, at, rootOf(-size - 1))
        setBits(all, at + 2, parts(-size - 1).leafSize)
    val size = top.leafSize
    if size < 0 then Subtree(rootOf(-size - 1), parts(-size - 1).leafSize, all)
    else Subtree(top.root, size, all)

  private def moved(code: Int, start: Int): Int = if code < 0 then code else code + start

  /** For each child: where its code is, the code, and its size. */
  private inline def children(nodes: Array[Float], from: Int, until: Int)(
      inline use: (Int, Int, Int) => Unit
  ): Unit =
    var node = from
    while node < until do
      loop(2): side =>
        val at = node + 12 + side
        use(at, bits(nodes, at), bits(nodes, at + 2))
      node += NodeFloats

  private def bits(nodes: Array[Float], at: Int): Int =
    java.lang.Float.floatToRawIntBits(nodes(at))

  private def setBits(nodes: Array[Float], at: Int, value: Int): Unit =
    nodes(at) = java.lang.Float.intBitsToFloat(value)

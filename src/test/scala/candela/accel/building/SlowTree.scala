package candela.accel.building

import candela.accel.BinaryTree
import candela.geometry.Bounds3

/** A hierarchy of boxes as the field describes it, and built so: the oracle of [[BvhBuilder]]. */
enum SlowTree(val box: Bounds3):
  case Leaf(around: Bounds3, primitives: Vector[Int]) extends SlowTree(around)
  case Node(around: Bounds3, left: SlowTree, right: SlowTree) extends SlowTree(around)

  /** What a ray that meets the root is expected to cost, a box pair being 1 and a primitive 1. */
  def cost: Double =
    def sum(tree: SlowTree): Double = tree match
      case Leaf(box, primitives) => SlowTree.area(box) * primitives.size
      case Node(box, left, right) => SlowTree.area(box) + sum(left) + sum(right)
    sum(this) / SlowTree.area(box)

  def primitivesInside: Vector[Int] = this match
    case Leaf(_, primitives) => primitives
    case Node(_, left, right) => left.primitivesInside ++ right.primitivesInside

object SlowTree:

  /** Divides between two of 16 slabs across the axis along which centres are spread widest, where
    * the surface area heuristic says that it costs least.
    */
  def build(boxes: IndexedSeq[Bounds3], maxLeaf: Int): SlowTree =
    def centre(i: Int, axis: Int) = 0.5 * (boxes(i).min(axis).toDouble + boxes(i).max(axis))
    def around(some: Vector[Int]) = some.map(boxes).foldLeft(Bounds3.Empty)(_.union(_))

    def tree(some: Vector[Int]): SlowTree =
      def range(k: Int) = (some.map(centre(_, k)).min, some.map(centre(_, k)).max)
      val axis = (0 until 3).maxBy(k => range(k)._2 - range(k)._1)
      val (low, high) = range(axis)
      def slab(i: Int) = Math.min(15, ((centre(i, axis) - low) / (high - low) * 16).toInt)
      val cuts =
        for
          k <- 1 until 16
          (left, right) = some.partition(slab(_) < k)
          if low < high && left.nonEmpty && right.nonEmpty
        yield (left, right)
      def price(some: Vector[Int]) = area(around(some)) * some.size
      val (left, right) =
        if cuts.isEmpty then some.splitAt(some.size / 2)
        else cuts.minBy((left, right) => price(left) + price(right))
      val isWorthIt = area(around(some)) + price(left) + price(right) < price(some)
      if some.size <= maxLeaf && !isWorthIt then Leaf(around(some), some)
      else Node(around(some), tree(left), tree(right))

    tree(boxes.indices.toVector)

  /** A tree in flat arrays, in this form. */
  def of(built: BinaryTree): SlowTree =
    def bits(at: Int) = java.lang.Float.floatToRawIntBits(built.nodes(at))
    def box(at: Int) =
      import candela.math.Vec3
      val b = built.nodes
      Bounds3(Vec3(b(at), b(at + 1), b(at + 2)), Vec3(b(at + 3), b(at + 4), b(at + 5)))
    def tree(code: Int, size: Int, around: Bounds3): SlowTree =
      if code < 0 then Leaf(around, built.order.slice(~code, ~code + size).toVector)
      else
        def child(side: Int) =
          tree(bits(code + 12 + side), bits(code + 14 + side), box(code + 6 * side))
        Node(around, child(0), child(1))
    tree(built.root, built.rootCount, built.bounds)

  def area(b: Bounds3): Double =
    val e = b.extent
    e.x.toDouble * e.y + e.y.toDouble * e.z + e.z.toDouble * e.x

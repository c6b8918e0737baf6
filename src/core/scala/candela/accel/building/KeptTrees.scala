package candela.accel.building

import candela.concurrency.Parallel
import candela.io.{CheckedInput, CheckedOutput, Keep, PartForm}
import candela.accel.{Primitives, WideLayout, WideTree}
import candela.geometry.Bounds3
import candela.math.Vec3

/** Builds hierarchies, but for what a scene before has built: the whole, if nothing has moved, or
  * the part that has not, if most has not. Hits do not depend on the hierarchy, so neither do
  * images.
  *
  * @param width, lanes, maxLeaf as in [[WideBuilder]]
  * @param unsplit               likewise, of hierarchies that are not kept
  */
private[accel] final class KeptTrees(
    keep: Keep,
    width: Int,
    lanes: Int,
    maxLeaf: Int,
    parallel: Parallel,
    unsplit: Int = 1
):
  import KeptTrees.*

  def of(primitives: Primitives): WideTree =
    if !keep.isKeeping || primitives.count < MinPrimitives then
      WideBuilder.of(primitives, width, lanes, maxLeaf, parallel, unsplit)
    else layout(primitives).withPrimitives(primitives, parallel)

  private def layout(primitives: Primitives): WideLayout =
    val treeParts = TreeParts.of(primitives, parallel)
    val wholeKey = key(treeParts, _ => true)
    keep.lookup(Layouts, wholeKey).getOrElse:
      val form = s"$width $lanes $maxLeaf ${treeParts.form}"
      val previous = keep.lookup(Latest, form)
      val moves = moving(treeParts, previous)
      keep.insert(Latest, form, Moves(treeParts, moves))
      val restingCount = primitives.count - movers(treeParts, moves)
      if previous.isEmpty || restingCount < primitives.count / 2 || restingCount == primitives.count
      then
        val layout = built(primitives, BoxRecord.ofAll(primitives, parallel))
        keep.insert(Layouts, wholeKey, layout)
        layout
      else
        val restingLayout = keep(Layouts, key(treeParts, !moves(_))):
          built(primitives, someRecords(primitives, treeParts, !moves(_)))
        restingLayout.joined(built(primitives, someRecords(primitives, treeParts, moves(_))))

  private def key(parts: TreeParts, chosen: Int => Boolean): String =
    s"$width $lanes $maxLeaf ${parts.form} ${parts.digest(chosen)}"

  private def built(primitives: Primitives, records: => Array[Int]): WideLayout =
    WideBuilder.layout(primitives, records, width, lanes, maxLeaf, parallel)

  private def someRecords(primitives: Primitives, treeParts: TreeParts, chosen: Int => Boolean) =
    val indices = new Array[Int](size(treeParts, chosen))
    var slot = 0
    for
      i <- 0 until treeParts.count if chosen(i);
      p <- treeParts.start(i) until treeParts.start(i + 1)
    do
      indices(slot) = p
      slot += 1
    BoxRecord.ofSome(primitives, indices, parallel)

private[accel] object KeptTrees:
  /** Building a tree of fewer primitives takes no longer than their digest. */
  private val MinPrimitives = 4096

  private val Layouts = Keep.Shelf(Some(LayoutForm))
  private val Latest = Keep.Shelf[Moves]()

  /** The latest parts of their form.
    *
    * @param moves those that have ever moved: the others' hierarchy is then one for many frames
    */
  private final class Moves(val treeParts: TreeParts, val moves: Array[Boolean])

  private def moving(treeParts: TreeParts, previous: Option[Moves]): Array[Boolean] =
    Array.tabulate(treeParts.count): i =>
      previous.exists(b => b.moves(i) || !treeParts.isSame(i, b.treeParts))

  private def movers(parts: TreeParts, moves: Array[Boolean]): Int = size(parts, moves(_))

  private def size(parts: TreeParts, chosen: Int => Boolean): Int =
    var sum = 0
    for i <- 0 until parts.count if chosen(i) do sum += parts.start(i + 1) - parts.start(i)
    sum

/** Files of layouts. */
private object LayoutForm extends PartForm[WideLayout]("hierarchy 1"):
  def size(layout: WideLayout): Long =
    4L * layout.nodes.length + 4L * layout.blocks.length + 4L * layout.order.length

  def write(layout: WideLayout, out: CheckedOutput): Unit =
    out.int(layout.width)
    out.int(layout.lanes)
    out.int(layout.count)
    val (low, high) = (layout.bounds.min, layout.bounds.max)
    for x <- Seq(low.x, low.y, low.z, high.x, high.y, high.z) do out.float(x)
    out.floats(layout.nodes)
    out.int(layout.root)
    out.floats(layout.blocks)
    out.ints(layout.order)

  def read(in: CheckedInput): WideLayout =
    def corner() = Vec3(in.float(), in.float(), in.float())
    WideLayout(
      in.int(),
      in.int(),
      in.int(),
      Bounds3(corner(), corner()),
      in.floats(),
      in.int(),
      in.floats(),
      in.ints()
    )

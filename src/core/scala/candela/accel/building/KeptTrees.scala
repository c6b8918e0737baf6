package candela.accel.building

import candela.accel.{Primitives, WideLayout, WideTree}
import candela.base.{CheckedInput, CheckedOutput, Keep, Parallel, PartForm}
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
    else layout(primitives).of(primitives, parallel)

  private def layout(primitives: Primitives): WideLayout =
    val parts = TreeParts.of(primitives, parallel)
    val whole = key(parts, _ => true)
    keep.find(Layouts, whole).getOrElse:
      val form = s"$width $lanes $maxLeaf ${parts.form}"
      val before = keep.find(Latest, form)
      val moves = moving(parts, before)
      keep.put(Latest, form, Moves(parts, moves))
      val resting = primitives.count - movers(parts, moves)
      if before.isEmpty || resting < primitives.count / 2 || resting == primitives.count then
        val all = built(primitives, BoxRecord.all(primitives, parallel))
        keep.put(Layouts, whole, all)
        all
      else
        val rest = keep(Layouts, key(parts, !moves(_))):
          built(primitives, some(primitives, parts, !moves(_)))
        rest.joined(built(primitives, some(primitives, parts, moves(_))))

  private def key(parts: TreeParts, chosen: Int => Boolean): String =
    s"$width $lanes $maxLeaf ${parts.form} ${parts.digest(chosen)}"

  private def built(primitives: Primitives, records: => Array[Int]): WideLayout =
    WideBuilder.layout(primitives, records, width, lanes, maxLeaf, parallel)

  private def some(primitives: Primitives, parts: TreeParts, chosen: Int => Boolean) =
    val which = new Array[Int](size(parts, chosen))
    var at = 0
    for i <- 0 until parts.count if chosen(i); p <- parts.start(i) until parts.start(i + 1) do
      which(at) = p
      at += 1
    BoxRecord.some(primitives, which, parallel)

private[accel] object KeptTrees:
  /** Building a tree of fewer primitives takes no longer than their digest. */
  private val MinPrimitives = 4096

  private val Layouts = Keep.Shelf(Some(LayoutForm))
  private val Latest = Keep.Shelf[Moves]()

  /** The latest parts of their form.
    *
    * @param moves those that have ever moved: the others' hierarchy is then one for many frames
    */
  private final class Moves(val parts: TreeParts, val moves: Array[Boolean])

  private def moving(parts: TreeParts, before: Option[Moves]): Array[Boolean] =
    Array.tabulate(parts.count): i =>
      before.exists(b => b.moves(i) || !parts.isSame(i, b.parts))

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

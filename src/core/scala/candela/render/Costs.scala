package candela.render

import candela.base.{ByteCount, JavaHeap}
import candela.diagnostics.{Code, Problem, SourcePos}

/** Memory and time of a rendering, by kind. */
final case class Costs(all: Vector[Cost] = Vector.empty):
  def bytes: Long = all.map(_.bytes).sum

  def ++(more: Vector[Cost]): Costs =
    val kinds = (all ++ more).groupBy(_.kind).toVector.sortBy(_._1.ordinal)
    Costs(kinds.map: (kind, same) =>
      Cost(kind, same.map(_.bytes).sum, same.map(_.seconds).sum, same.exists(_.isMost)))

  /** What there is to tell: surfaces are built together, and a scene may have no triangles. */
  def reported: Vector[Cost] =
    val isOther = all.exists(_.kind == CostKind.Shapes) &&
      all.forall(c => c.kind != CostKind.Triangles || c.bytes == 0)
    val named =
      all.map(c => if isOther && c.kind == CostKind.Triangles then c.copy(CostKind.Shapes) else c)
    (Costs() ++ named).all.filter(c => c.bytes > 0 || c.seconds >= Costs.MinSeconds)

  /** The greatest parts, those that matter. */
  def greatest: Vector[Cost] =
    all.filter(_.bytes * Costs.Matters >= bytes).sortBy(-_.bytes).take(Costs.MaxListed)

  /** Why the rendering ends: the heap is too small.
    *
    * @param heap   its limit, in bytes
    * @param needed bytes that are needed at least, if that is known
    */
  def problem(heap: Long, needed: Option[Long], at: Option[SourcePos] = None): Problem =
    val listed = greatest.map(c => s"${c.kind.word} ${ByteCount.format(c.bytes)}").mkString(", ")
    val limit = s"Java's heap is limited to ${ByteCount.format(heap)}"
    val message = needed match
      case Some(n) => s"the scene needs about ${ByteCount.format(n)} of memory, but $limit: $listed"
      case None if listed.isEmpty => s"out of memory: $limit"
      case None => s"out of memory: $limit; the scene has $listed"
    val bytesNeeded = Math.max(needed.getOrElse(0L), Math.max(heap, bytes))
    val gigabytes = Math.ceil(bytesNeeded * Costs.Room / 1e9).toLong
    val cures = JavaHeap.raise(s"${gigabytes}g") +: greatest.flatMap(c => Costs.cure(c.kind))
    Problem.error(Code.OutOfMemory, at, message, Some(cures.mkString("; ")))

object Costs:
  /** Parts of less than one in this many are not reported. */
  private val Matters = 20

  private val MaxListed = 4

  /** Costs of less time are not reported. */
  val MinSeconds = 0.005

  /** A heap that is a little larger than a scene makes it slow. */
  private val Room = 1.5

  private def cure(kind: CostKind): Option[String] = kind match
    case CostKind.Film => Some("or render parts of the image with --cropwindow")
    case CostKind.Textures => Some("or give images less memory with --texture-memory")
    case _ => None

package candela.accel.building

import candela.base.loop
import candela.concurrency.Parallel
import candela.io.Sha256
import candela.io.Sha256.Numbers
import candela.accel.Primitives

import java.nio.ByteBuffer
import java.util.Arrays

/** What the hierarchy of primitives depends on, by parts that may move: a digest of each mesh, and
  * a box of each other primitive.
  *
  * @param sums  the digests, one after another
  * @param boxes six Floats each
  * @param form  tells which primitives belong to each part
  */
private[building] final class TreeParts private (
    ends: Array[Int],
    private val sums: Array[Byte],
    private val boxes: Array[Float],
    val form: String
):
  import TreeParts.*

  def meshes: Int = ends.length
  def count: Int = ends.length + boxes.length / 6

  /** The first primitive of part `i`, or that after the last part's end. */
  def start(i: Int): Int =
    if i == 0 then 0
    else if i <= meshes then ends(i - 1)
    else (if meshes == 0 then 0 else ends(meshes - 1)) + i - meshes

  /** Whether part `i` is the same in parts of the same form. */
  def isSame(i: Int, other: TreeParts): Boolean =
    if i < meshes then
      Arrays.equals(sums, Size * i, Size * (i + 1), other.sums, Size * i, Size * (i + 1))
    else
      val offset = 6 * (i - meshes)
      Arrays.equals(boxes, offset, offset + 6, other.boxes, offset, offset + 6)

  /** Of all parts of a choice. */
  def digest(chosen: Int => Boolean): String =
    val buffer = ByteBuffer.allocate(count * (Size + 4))
    loop(count): i =>
      if chosen(i) then
        buffer.putInt(i)
        if i < meshes then buffer.put(sums, Size * i, Size): Unit
        else loop(6)(k => buffer.putFloat(boxes(6 * (i - meshes) + k)): Unit)
    Sha256.of(buffer.flip())

private[building] object TreeParts:
  /** Bytes of a digest. */
  private val Size = 32

  def of(primitives: Primitives, parallel: Parallel): TreeParts =
    val soup = primitives.soup
    // Soups of tests may have no meshes
    val starts =
      if soup.meshes.isEmpty then Array((0, 0))
      else soup.meshes.map(m => (m.firstTriangle, m.firstVertex))
    val ends = starts.indices.map: i =>
      if i + 1 < starts.length then starts(i + 1)._1 else soup.count
    .toArray
    val sums = new Array[Byte](starts.length * Size)
    def note(i: Int, parallel: Parallel): Unit =
      def ofNumbers =
        val vertices =
          if i + 1 < starts.length then 3 * starts(i + 1)._2 else soup.positions.length
        val numbers = Seq(
          Numbers(soup.positions, 3 * starts(i)._2, vertices),
          Numbers(soup.indices.slice(3 * starts(i)._1, 3 * ends(i)))
        )
        Sha256.ofNumbers(numbers, parallel)
      val sum = soup.meshes.lift(i).flatMap(_.content).fold(ofNumbers)(Sha256.bytesOf)
      System.arraycopy(sum, 0, sums, Size * i, Size)
    // A few large meshes, or many small ones
    if starts.length < 4 * parallel.threads then starts.indices.foreach(note(_, parallel))
    else parallel.forEach(starts.length)(note(_, Parallel.Alone))
    val otherCount = primitives.count - soup.count
    val boxes = new Array[Float](6 * otherCount)
    parallel.ranges(otherCount): (from, until) =>
      var i = from
      while i < until do
        primitives.writeBounds(boxes, 6 * i, soup.count + i)
        i += 1
    val form =
      Sha256.ofNumbers(Seq(Numbers(ends), Numbers(Array(otherCount))), Parallel.Alone)
    new TreeParts(ends, sums, boxes, Sha256.hex(form))

package candela.textures

import candela.concurrency.Lending
import java.lang.invoke.VarHandle
import java.util.concurrent.atomic.AtomicLongArray

/** Memory for tiles of images. Tiles are read when a lookup needs them, and give way to others when
  * the memory is full. Safe for threads; a lookup of a tile that is there neither locks nor
  * allocates.
  *
  * Slots of memory are used again, since garbage would take more than the limit. Each has a stamp:
  * the tile that it holds and a count. A lookup is valid if the stamp is the same before and after
  * it; else another tile came in between.
  *
  * Sources: Corbató, "A Paging Experiment with the Multics System", 1969, for eviction by clock;
  * Lameter, "Effective Synchronization on Linux/NUMA Systems", 2005, for sequence locks.
  *
  * @param limit in bytes
  */
final class TileMemory(limit: Long):
  import TileMemory.*

  private val slotCount =
    val heap = Runtime.getRuntime.maxMemory
    Math.max(MinSlots.toLong, Math.min(MaxSlots, Math.min(limit, heap) / SlotBytes)).toInt
  private val slots = new Array[Array[Int]](slotCount)
  private val stamps = AtomicLongArray(slotCount)
  private val recent = new Array[Boolean](slotCount)
  private val buffers = Lending(TileBuffer())
  private var filled = 0
  private var hand = 0
  private var loads = 0
  private var tileCount = 1

  /** Numbers of tiles, the first of which is returned. */
  private[textures] def numbers(count: Int): Int = synchronized:
    val firstNumber = tileCount
    tileCount = Math.addExact(tileCount, count)
    firstNumber

  /** What the slot holds. */
  private[textures] def stamp(slot: Int): Long = stamps.getAcquire(slot)

  private[textures] def ints(slot: Int): Array[Int] =
    if !recent(slot) then recent(slot) = true
    slots(slot)

  /** Whether the slot has held the same since `stamp`. */
  private[textures] def isStill(slot: Int, stamp: Long): Boolean =
    VarHandle.loadLoadFence()
    stamps.getOpaque(slot) == stamp

  /** Reads a tile and returns one of its numbers.
    *
    * @param number of the tile in this memory
    * @param pages  receives its slot + 1, at `tile`
    */
  private[textures] def load(
      from: TileSource,
      tile: Int,
      number: Int,
      pages: Array[Int],
      at: Int
  ): Int = buffers.lend: buffer =>
    from.fill(tile, buffer)
    val value = buffer.ints(at)
    synchronized:
      // Another thread may have read it meanwhile
      val slot = pages(tile) - 1
      val isThere = slot >= 0 && holder(stamps.get(slot)) == number
      if !isThere then pages(tile) = store(buffer.ints, number) + 1
    value

  private def store(tile: Array[Int], number: Int): Int =
    val slot = free()
    loads += 1
    stamps.set(slot, 0L)
    VarHandle.fullFence()
    System.arraycopy(tile, 0, slots(slot), 0, Ints)
    recent(slot) = true
    stamps.set(slot, number.toLong << 32 | loads & 0xffffffffL)
    slot

  private def free(): Int =
    if filled < slotCount then
      slots(filled) = new Array[Int](Ints)
      filled += 1
      filled - 1
    else
      // Lookups of other threads may mark slots as fast as the hand goes round
      var remaining = 2 * slotCount.toLong
      while recent(hand) && remaining > 0 do
        recent(hand) = false
        hand = if hand + 1 < slotCount then hand + 1 else 0
        remaining -= 1
      val slot = hand
      hand = if hand + 1 < slotCount then hand + 1 else 0
      slot

private[textures] object TileMemory:
  /** Numbers of a tile: 64 × 64 texels of three bytes, 32 × 32 of three Floats. */
  val Ints = 3072

  /** With the array's header and a slot's bookkeeping. */
  private val SlotBytes = 4 * Ints + 32

  private val MinSlots = 16
  private val MaxSlots = 1L << 26

  /** The number of the tile that a stamp tells of. */
  inline def holder(stamp: Long): Int = (stamp >>> 32).toInt

/** Where tiles come from. */
private[textures] trait TileSource:
  /** Reads a tile into the buffer. */
  def fill(tile: Int, buffer: TileBuffer): Unit

/** For a tile on its way. */
private[textures] final class TileBuffer:
  /** What was read last from an image file that has tiles itself. */
  var decoded: DecodedTile | Null = null
  val ints = new Array[Int](TileMemory.Ints)
  val bytes: java.nio.ByteBuffer = java.nio.ByteBuffer
    .allocateDirect(TileRecord.Bytes)
    .order(java.nio.ByteOrder.LITTLE_ENDIAN)

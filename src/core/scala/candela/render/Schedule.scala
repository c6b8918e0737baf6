package candela.render

import candela.film.PixelBounds

import java.util.concurrent.atomic.AtomicLongArray

/** Execution order of a rendering: sample passes ("waves"), each over all pieces.
  *
  * Waves grow (1, 1, 1, 1, 2, 2, 4, 4, … 64 samples per pixel), so that a cancelled image has
  * uniform noise, while a long rendering rarely revisits a piece. Totals of 2ᵏ samples are
  * ends of waves: there the error is estimated.
  *
  * @param largestWave maximum samples per pixel of a wave
  * @param openWaves   maximum number of waves in progress: wave w begins only when wave w −
  *                    openWaves is finished
  * @param grows       whether the first waves are smaller
  */
private[render] abstract class Schedule(
    val pieces: Int,
    samplesPerPixel: Int,
    largestWave: Int = Schedule.LargestWave,
    val openWaves: Int = Int.MaxValue,
    grows: Boolean = true
):

  // The waves before the first of the largest size; from then on, all are of that size.
  private val growing: Array[Int] =
    Iterator
      .iterate(0)(start => start + Schedule.size(start))
      .takeWhile(start => grows && Schedule.size(start) < largestWave)
      .toArray
  private val grown = growing.lastOption.fold(0)(start => start + Schedule.size(start))

  /** First sample of a wave, if there were no end. */
  private def start(wave: Int): Long =
    if wave < growing.length then growing(wave)
    else grown + (wave - growing.length).toLong * largestWave

  val waves: Int =
    if samplesPerPixel <= grown then growing.count(_ < samplesPerPixel)
    else growing.length + (samplesPerPixel - grown - 1) / largestWave + 1

  /** Number of steps, each a piece in a wave; the steps of a wave are consecutive. */
  val steps: Long = waves.toLong * pieces

  /** Fewest samples per pixel that a part of a rendering may have; 0: it may end anywhere. */
  def step: Int = 1

  /** The wave that has this sample. */
  def waveOf(sample: Int): Int =
    if sample >= samplesPerPixel then waves + (sample - samplesPerPixel) / largestWave
    else if sample >= grown then growing.length + (sample - grown) / largestWave
    else growing.lastIndexWhere(_ <= sample)

  /** Samples per pixel when the wave ends in which there are so many. */
  def wholeWaves(samples: Double): Int =
    val last = Math.max(0, Math.min(Math.ceil(samples), Int.MaxValue).toInt - 1)
    endSample(waveOf(last))

  /** Greatest progress of a piece. */
  def maxProgress: Long = Int.MaxValue

  /** Samples per pixel that a piece with this progress has at least. */
  protected def samplesOf(piece: Int, progress: Long): Int

  /** Whether a piece with this progress has so many samples per pixel, planned or beyond. */
  def hasReached(piece: Int, progress: Long, samples: Int): Boolean

  /** Samples per pixel of each piece. */
  final def samplesDone(progress: AtomicLongArray): IndexedSeq[Int] =
    (0 until pieces).map(i => samplesOf(i, progress.get(i)))

  /** Waves beyond the planned ones are of equal size. */
  def firstSample(wave: Int): Int =
    if wave < waves then start(wave).toInt
    else
      val further = samplesPerPixel + (wave - waves).toLong * largestWave
      Math.min(further, Int.MaxValue).toInt

  /** One more than the last sample of the wave. */
  def endSample(wave: Int): Int = firstSample(wave + 1)

  /** Waves after which every pixel has 1, 2, 4, 8, … samples, and the last wave. */
  def doublings: Vector[Int] =
    val powers = Iterator.iterate(1L)(_ * 2).takeWhile(_ <= samplesPerPixel)
    (powers.flatMap(endingAt) ++ Iterator(waves)).toVector.distinct

  /** The number of waves that have this many samples, if no wave is divided. */
  private def endingAt(samples: Long): Option[Int] =
    if samples < grown then Some(growing.indexOf(samples.toInt)).filter(_ > 0)
    else
      val waveCount = growing.length + (samples - grown) / largestWave
      Option.when(start(waveCount.toInt) == samples)(waveCount.toInt)

private[render] object Schedule:

  /** Larger waves would not be cheaper. */
  val LargestWave: Int = 64

  /** Of the wave that begins with this sample, unless it is limited: two waves double the total. */
  private def size(start: Int): Int = Math.max(Integer.highestOneBit(start) / 2, 1)

/** A schedule whose pieces are the tiles of an image, row by row.
  *
  * @param atOnce samples of a pixel that follow each other: one, or all, in a single wave
  */
private[render] final class TileSchedule(
    bounds: PixelBounds,
    samplesPerPixel: Int,
    largestWave: Int = Schedule.LargestWave,
    openWaves: Int = Int.MaxValue,
    val atOnce: Int = 1
) extends Schedule(
      TileSchedule.count(bounds),
      samplesPerPixel,
      Math.max(largestWave, atOnce),
      openWaves,
      grows = atOnce == 1
    ):

  override def step: Int = if atOnce == 1 then 1 else 0

  protected def samplesOf(tile: Int, progress: Long): Int = progress.toInt

  def hasReached(tile: Int, progress: Long, samples: Int): Boolean = progress >= samples

  val tiles: Vector[PixelBounds] =
    Vector.tabulate(pieces)(TileSchedule.tile(bounds, _))

/** A schedule whose pieces are Markov chains. Their paths are as many as samples of all pixels,
  * distributed over the chains in turn.
  */
private[render] final class ChainSchedule(
    chains: Int,
    pixels: Long,
    samplesPerPixel: Int,
    shard: Shard
) extends Schedule(chains, samplesPerPixel):

  override def step: Int = 0

  def takesChain(chain: Int): Boolean = shard.takesChain(chain)

  /** Number of paths of the chain after `samples` per pixel. */
  def paths(chain: Int, samples: Int): Long = (samples * pixels + pieces - 1 - chain) / pieces

  override def maxProgress: Long = paths(0, Int.MaxValue)

  def hasReached(chain: Int, progress: Long, samples: Int): Boolean =
    progress >= paths(chain, samples)

  protected def samplesOf(chain: Int, progress: Long): Int =
    if !takesChain(chain) then samplesPerPixel
    else
      // The last wave whose paths are all there
      var done = 0
      var open = waves
      while done < open do
        val middle = done + (open - done + 1) / 2
        if paths(chain, firstSample(middle)) <= progress then done = middle else open = middle - 1
      firstSample(done)

private[render] object TileSchedule:

  /** Tile edge in pixels: small enough that all workers finish at about the same time. */
  val TileSize: Int = 16

  private def columns(bounds: PixelBounds): Int = (bounds.width + TileSize - 1) / TileSize
  private def rows(bounds: PixelBounds): Int = (bounds.height + TileSize - 1) / TileSize
  private def count(bounds: PixelBounds): Int = Math.multiplyExact(columns(bounds), rows(bounds))

  private def tile(bounds: PixelBounds, index: Int): PixelBounds =
    val x = bounds.x0 + index % columns(bounds) * TileSize
    val y = bounds.y0 + index / columns(bounds) * TileSize
    PixelBounds(x, y, Math.min(x + TileSize, bounds.x1), Math.min(y + TileSize, bounds.y1))

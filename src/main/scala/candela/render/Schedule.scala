package candela.render

import candela.film.PixelBounds

import java.util.concurrent.atomic.AtomicLongArray

/** Execution order of a rendering: sample passes ("waves"), each over all pieces.
  *
  * Waves grow (1, 1, 1, 1, 2, 2, 4, 4, … 64 samples per pixel), so that a cancelled image has
  * uniform noise, while a long rendering rarely revisits a piece. Totals of 2ᵏ and 3 · 2ᵏ samples
  * are what an estimate of the error compares.
  *
  * @param largestWave maximum samples per pixel of a wave
  * @param openWaves   maximum number of waves in progress: wave w begins only when wave w −
  *                    openWaves is finished
  */
private[render] abstract class Schedule(
    val pieces: Int,
    samplesPerPixel: Int,
    largestWave: Int = Schedule.LargestWave,
    val openWaves: Int = Int.MaxValue
):

  // Wave w has the samples from waveStarts(w) until waveStarts(w + 1); two double the total.
  private val waveStarts: Array[Int] =
    Iterator
      .iterate(0): start =>
        start + Math.min(Math.max(Integer.highestOneBit(start) / 2, 1), largestWave)
      .takeWhile(_ < samplesPerPixel)
      .toArray :+ samplesPerPixel

  val waves: Int = waveStarts.length - 1

  /** Number of steps, each a piece in a wave; the steps of a wave are consecutive. */
  val steps: Long = waves.toLong * pieces

  /** Samples per pixel that a piece with this progress has at least. */
  protected def samplesOf(piece: Int, progress: Long): Int

  final def samplesDone(progress: AtomicLongArray): Int =
    (0 until pieces).map(i => samplesOf(i, progress.get(i))).min

  /** Waves beyond the planned ones are of equal size. */
  def firstSample(wave: Int): Int =
    if wave <= waves then waveStarts(wave) else samplesPerPixel + (wave - waves) * largestWave

  /** One more than the last sample of the wave. */
  def endSample(wave: Int): Int = firstSample(wave + 1)

  /** Waves after which every pixel has 1, 2, 4, 8, … samples, and the last wave. */
  def passes: Vector[Int] = (1 to waves).toVector.filter: end =>
    end == waves || Integer.bitCount(waveStarts(end)) == 1

private[render] object Schedule:

  /** Larger waves would not be cheaper. */
  val LargestWave: Int = 64

/** A schedule whose pieces are the tiles of an image, row by row. */
private[render] final class TileSchedule(
    bounds: PixelBounds,
    samplesPerPixel: Int,
    largestWave: Int = Schedule.LargestWave,
    openWaves: Int = Int.MaxValue
) extends Schedule(TileSchedule.count(bounds), samplesPerPixel, largestWave, openWaves):

  protected def samplesOf(tile: Int, progress: Long): Int = progress.toInt

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

  def takes(chain: Int): Boolean = shard.takesChain(chain)

  /** Number of paths of the chain after `samples` per pixel. */
  def paths(chain: Int, samples: Int): Long = (samples * pixels + pieces - 1 - chain) / pieces

  protected def samplesOf(chain: Int, progress: Long): Int =
    if !takes(chain) then samplesPerPixel
    else (0 to waves).map(firstSample).filter(paths(chain, _) <= progress).last

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

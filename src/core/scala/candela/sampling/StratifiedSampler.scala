package candela.sampling

import candela.math.*

/** Stratified (jittered) sampling: the samples of a pixel fill each cell of an `xSamples` ×
  * `ySamples` grid once in every pair of dimensions, and each of `xSamples · ySamples` intervals
  * once in every single dimension. Each pixel and dimension has its own random permutation of the
  * cells. Sample numbers past the last cell begin another pass over all cells, with new jitter.
  *
  * In pbrt: `stratified` (v2, v3, v4), with its `xsamples`, `ysamples` and `jitter`.
  *
  * Source: Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.
  *
  * @param jitter whether to sample a random point in each cell; if false, its centre
  */
final class StratifiedSampler(xSamples: Int, ySamples: Int, jitter: Boolean, seed: Int)
    extends HashedSampler:

  require(xSamples > 0 && ySamples > 0, s"a grid of $xSamples by $ySamples has no cells")
  val samplesPerPixel: Int = Math.multiplyExact(xSamples, ySamples)

  private var index = 0

  def start(x: Int, y: Int, sample: Int): Unit =
    index = sample % samplesPerPixel
    startAt(SampleHash.mix64(SampleHash.pixel(x, y, seed) + sample / samplesPerPixel))

  def next1D(): Float =
    val bits = nextBits()
    val cell = Permutation.element(index, samplesPerPixel, bits)
    jittered(cell, (offsetBits(bits, cell) >>> 32).toInt, samplesPerPixel)

  def next2D(): Unit =
    val bits = nextBits()
    val cell = Permutation.element(index, samplesPerPixel, bits)
    val offset = offsetBits(bits, cell)
    x = jittered(cell % xSamples, (offset >>> 32).toInt, xSamples)
    y = jittered(cell / xSamples, offset.toInt, ySamples)

  def copy(): StratifiedSampler = StratifiedSampler(xSamples, ySamples, jitter, seed)

  private def offsetBits(bits: Long, cell: Int): Long =
    SampleHash.mix64(bits + (cell + 1) * SampleHash.Step)

  private def jittered(cell: Int, offset: Int, cells: Int): Float =
    val fraction = if jitter then SampleHash.toUnit(offset) else 0.5f
    belowOne((cell + fraction) / cells)

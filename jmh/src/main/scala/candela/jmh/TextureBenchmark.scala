package candela.jmh

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import candela.concurrency.Parallel
import candela.io.CacheFolder
import candela.color.{Encoding, Rgb}
import candela.textures.*

import org.openjdk.jmh.annotations.*

/** Lookups of an image texture of 2048 × 2048 texels, in ns: with all levels in memory, and in tiles
  * that a memory of 256 MB holds. `place`: `near`, where successive lookups are a few texels apart
  * as those of neighbouring pixels, or `far`, anywhere.
  *
  * Samples of 4096 lookups each: their median is that of an idle machine, if other programs take
  * less than half of it.
  */
@State(Scope.Benchmark)
@BenchmarkMode(Array(Mode.SampleTime))
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@OperationsPerInvocation(TextureBenchmark.Many)
@Warmup(iterations = 3, time = 1)
@Measurement(iterations = 5, time = 1)
@Fork(value = 1, jvmArgsAppend = Array("-Xmx2g", "-XX:+UseParallelGC"))
class TextureBenchmark:
  @Param(Array("memory", "tiles"))
  var kept: String = ""

  @Param(Array("bytes", "floats"))
  var texels: String = ""

  @Param(Array("near", "far"))
  var place: String = ""

  private val side = 2048
  private val many = TextureBenchmark.Many
  private var folder = Path.of("")
  private var levels = Array.empty[MipLevel]
  private var lookup: EwaLookup = scala.compiletime.uninitialized
  private val (s, t) = (new Array[Float](many), new Array[Float](many))

  @Setup
  def make(): Unit =
    folder = Files.createTempDirectory("candela-textures")
    val random = java.util.SplittableRandom(1)
    val numbers = 3 * side * side
    val image =
      if texels == "bytes" then
        val bytes = new Array[Byte](numbers)
        random.nextBytes(bytes)
        val meaning = Array.tabulate(256)(i => Encoding.Srgb.decode(i / 255f))
        ByteTexels(side, side, 3, bytes, meaning)
      else FloatTexels(side, side, 3, Array.fill(numbers)(random.nextDouble.toFloat))
    levels =
      if kept == "memory" then Pyramid.of(image, Wrap.Repeat, 1f, Parallel.Alone)
      else
        val cache = new TileCache(new TileMemory(256L << 20), CacheFolder(folder, Long.MaxValue))
        val made = MadeTexels(TexelBands.of(image), Some(1f), Encoding.Srgb, None)
        cache.image("a", Wrap.Repeat)(() => made).levels
    lookup = EwaLookup(MipMap.of(levels), 8f, bottomUp = true, turned = false)
    var (x, y) = (0.5, 0.5)
    for i <- 0 until many do
      if place == "far" then
        x = random.nextDouble
        y = random.nextDouble
      else
        x = (x + random.nextDouble(-3, 3) / side + 1) % 1
        y = (y + random.nextDouble(-3, 3) / side + 1) % 1
      s(i) = x.toFloat
      t(i) = y.toFloat

  @TearDown
  def delete(): Unit =
    Files.list(folder).forEach(Files.delete(_))
    Files.delete(folder)

  private inline def sum(inline lookup: (Float, Float) => Rgb): Float =
    var all = 0f
    var i = 0
    while i < many do
      val c = lookup(s(i), t(i))
      all += c.r + c.g + c.b
      i += 1
    all

  @Benchmark
  def nearest(): Float = sum(levels(0).nearest(_, _))

  @Benchmark
  def bilinear(): Float = sum(levels(0).bilinear(_, _))

  /** Over a footprint of 2 × 6 texels. */
  @Benchmark
  def ewa(): Float = sum(lookup.filtered(_, _, 2f / side, 0f, 0f, 6f / side))

object TextureBenchmark:
  /** Lookups of a sample. */
  inline val Many = 4096

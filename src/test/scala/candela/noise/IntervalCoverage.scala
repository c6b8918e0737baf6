package candela.noise

import candela.bench.statistics.*
import candela.image.Image
import candela.measure.*
import candela.render.Renderer
import candela.settings.RenderSettings

import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path, StandardOpenOption}
import java.util.SplittableRandom

/** How often the 95 % intervals of `candela bench` hold the truth, for docs/NOISE.md: renders each
  * scene with many seeds, and draws a few of them again and again.
  *
  * Options: `--scenes A.pbrt,B.pbrt` `--samples N` `--width N` (of the image, in pixels)
  * `--seeds N` (rendered) `--drawn 3,10` (seeds of a repeat) `--repeats N` `--folder F` (keeps the
  * images; a later run goes on there).
  */
object IntervalCoverage:
  private val Scenes = Vector(
    "direct light" -> "scenes/v3-matte-directlighting.pbrt",
    "diffuse interior" -> "bench/scenes/grey-room.v4.pbrt",
    "glossy" -> "scenes/v3-glossy.pbrt",
    "caustic" -> "bench/scenes/fireflies.v4.pbrt",
    "tiny lamps" -> "bench/scenes/lamps.v4.pbrt",
    "fog" -> "scenes/v4-fog.pbrt",
    "fur" -> "scenes/v4-curves.pbrt",
    "depth of field" -> "scenes/v4-depth-of-field.pbrt",
    "motion" -> "scenes/v4-motion.pbrt",
    "environment map" -> "scenes/v4-environment-map.pbrt"
  )

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(k, v) => k.drop(2) -> v }.toMap
    def number(name: String, default: Int) = options.get(name).fold(default)(_.toInt)
    val (samples, width) = (number("samples", 8), number("width", 48))
    val (seeds, repeats) = (number("seeds", 400), number("repeats", 300))
    val drawn = options.getOrElse("drawn", "3,10").split(',').toVector.map(_.toInt)
    val scenes = options.get("scenes").fold(Scenes)(_.split(',').toVector.map(f => "" -> f))
    val folder = options.get("folder").map(Path.of(_))
    println(
      "| scene | seeds | relative MSE | within | truth below, above | no upper limit | " +
        "half width | without a reference | time to an error | Student's |"
    )
    println("|---|---|---|---|---|---|---|---|---|---|")
    for (kind, file) <- scenes do
      val name = NoiseScenes.name(file)
      val kept = folder.map(_.resolve(s"${name.replace('/', '-')}-$width-$samples.f32"))
      val images = SeedImages.of(file, samples, width, seeds, kept)
      val pool = CoveragePool(images, samples)
      for count <- drawn do
        val title = if kind.isEmpty then name else s"$kind ($name)"
        println(s"| $title | $count | " + pool.row(count, repeats))

/** Images of one scene, one for each seed, from a file as far as it has them. */
private object SeedImages:
  def of(
      file: String,
      samples: Int,
      width: Int,
      seeds: Int,
      kept: Option[Path]
  ): Vector[Image] =
    val scene = SmallScene(file, width)
    def plan(seed: Int) = scene.plan(RenderSettings(samples = Some(samples), seed = seed))
    val first = plan(1).crop
    val size = 3 * first.width * first.height
    val old = kept.filter(Files.exists(_)).fold(Vector.empty[Image]): path =>
      val numbers = ByteBuffer.wrap(Files.readAllBytes(path)).order(ByteOrder.LITTLE_ENDIAN)
        .asFloatBuffer
      Vector.fill(Math.min(seeds, numbers.capacity / size)):
        val data = new Array[Float](size)
        val _ = numbers.get(data)
        Image(first.width, first.height, Image.RgbNames, data)
    old ++ (old.size + 1 to seeds).map: seed =>
      val now = plan(seed)
      val image = Renderer.render(now, 2).image(now.development).toRgb
      for path <- kept do
        val bytes = ByteBuffer.allocate(4 * size).order(ByteOrder.LITTLE_ENDIAN)
        val _ = bytes.asFloatBuffer.put(image.data)
        val _ = Files.write(path, bytes.array, StandardOpenOption.CREATE, StandardOpenOption.APPEND)
      image

/** All images of a scene: what is true of all, and how often a few tell it. A seed's images of
  * twice and four times the samples are means of its own and others, as those of `bench` contain
  * the samples of the shorter ones.
  */
private final class CoveragePool(images: Vector[Image], samples: Int):
  private val center = SeedNoise.mean(images)
  private val steps = Vector(1, 2, 4).map: n =>
    val all = images.indices.toVector.map: i =>
      SeedNoise.mean(Vector(0, 7, 31, 109).take(n).map(k => images((i + k) % images.size)))
    // An image is in the mean of all, which therefore is too near
    val own = images.size / (images.size - n.toDouble)
    all.map: image =>
      val parts = ErrorParts.against(ImagePair(image, center))
      parts.copy(squared = parts.squared.map(_ * own), relative = parts.relative.map(_ * own))
  private val truths = steps.map(all => all.map(_.relative.sum).sum / all.size)
  private val target = truths.head / Math.sqrt(8)
  private val time = LogLogFit.firstAt(
    steps.indices.toVector.map(i => ((samples << i).toDouble, truths(i))),
    target
  ).get

  /** @param count of seeds that are drawn */
  def row(count: Int, repeats: Int): String =
    val random = SplittableRandom(count)
    def draw(): Vector[Int] =
      Iterator.continually(random.nextInt(images.size)).distinct.take(count).toVector
    val truth = truths.head
    val all = Vector.fill(repeats):
      val of = draw()
      val curve = MeasuredCurve(
        steps.zipWithIndex.flatMap: (pool, step) =>
          of.zipWithIndex.map((i, seed) => measurement(samples << step, seed, pool(i))),
        steps.indices.map(i => (samples << i) -> Vector((samples << i).toDouble)).toMap
      )
      val student = Statistics.mean(of.map(steps.head(_).relative.sum))
      val noise = SeedNoise.parts(of.map(images), center).map(_.relative)
      (
        curve.points.head(Metric.RelativeMse).get,
        ErrorInterval.of(noise).interval,
        curve.secondsUntil(target),
        student
      )
    val errors = all.map(_._1)
    val bounded = errors.filter(_.isBounded)
    def share(n: Int, of: Int) = if of == 0 then "–" else f"${100.0 * n / of}%.0f %%"
    def within(intervals: Vector[Interval], truth: Double) =
      val some = intervals.filter(_.isBounded)
      share(some.count(i => i.low <= truth && truth <= i.high), some.size)
    val below = share(bounded.count(_.low > truth), bounded.size)
    val above = share(bounded.count(_.high < truth), bounded.size)
    val widths = bounded.map(i => (i.high - i.low) / 2 / truth)
    val width = if widths.isEmpty then "–" else f"${100 * Statistics.median(widths)}%.0f %%"
    val open = errors.filterNot(_.isBounded)
    // Of intervals without an upper limit, how often the lower one is right
    val lower = if open.isEmpty then "" else s" (${share(open.count(_.low <= truth), open.size)})"
    f"$truth%.3g | ${within(errors, truth)} | $below, $above | " +
      s"${share(open.size, repeats)}$lower | $width | ${within(all.map(_._2), truth)} | " +
      s"${within(all.flatMap(_._3), time)} | ${within(all.map(_._4), truth)} |"

  private def measurement(samples: Int, seed: Int, parts: ErrorParts): Measurement =
    val errors = Errors(parts.squared.sum, parts.relative.sum, None, None, None, Vector.empty)
    Measurement(samples, seed, samples.toDouble, errors, parts = Some(parts))

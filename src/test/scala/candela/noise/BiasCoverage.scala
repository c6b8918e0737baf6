package candela.noise

import candela.guiding.GuidingMode
import candela.measure.{BiasTest, Renderings, TileSums}
import candela.render.Renderer
import candela.sampling.PointSet
import candela.settings.{PointChoice, RenderSettings}

import java.util.SplittableRandom

/** Measures how often [[BiasTest]] accuses unbiased programs, and how often it finds a planted
  * bias, for docs/METRICS.md.
  *
  * Options: `--scenes A.pbrt,B.pbrt` `--width N` (of the image, in pixels) `--pool N` (images of
  * independent seeds, of which each repeat draws others) `--spp N` (of each image) `--seeds N` (of
  * each program) `--others N` (of the second one, if not as many) `--repeats N` `--against
  * same|independent|guiding|path-NAME` (what the second one does) `--bias X`.
  */
object BiasCoverage:
  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(k, v) => k.drop(2) -> v }.toMap
    def number(name: String, default: Int) = options.get(name).fold(default)(_.toInt)
    val bias = options.get("bias").fold(0.005)(_.toDouble)
    val (pool, spp, width) = (number("pool", 256), number("spp", 4), number("width", 128))
    val seeds = number("seeds", 16)
    val others = number("others", seeds)
    val repeats = number("repeats", 200)
    val scenes = options.get("scenes").fold(NoiseScenes.all)(_.split(',').toVector)
    println("| scene | second program | seeds, samples | false alarms | found | tiles below 5 % |")
    println("|---|---|---|---|---|---|")
    for file <- scenes do
      val scene = SmallScene(file, width)
      def images(settings: RenderSettings, from: Int): Vector[TileSums] =
        Vector.tabulate(pool): i =>
          val plan = scene.plan(settings.copy(samples = Some(spp), seed = from + i))
          TileSums.of(Renderer.render(plan, 2).image(plan.development))
      val usual = images(RenderSettings(), 1)
      for against <- options.getOrElse("against", "same").split(',') do
        val second = against match
          case "same" => usual
          case "independent" =>
            images(RenderSettings(points = Some(PointChoice.Named(PointSet.Independent))), 100_001)
          case "guiding" => images(RenderSettings(guiding = Some(GuidingMode.On)), 200_001)
        val random = SplittableRandom(7)
        var alarms, found = 0
        var below = 0.0
        for _ <- 1 to repeats do
          val drawn = shuffled(pool, random)
          val a = drawn.take(seeds).map(usual)
          val b = drawn.drop(seeds).take(others).map(second)
          val test = BiasTest.of(Renderings.seeds(a), Renderings.seeds(b))
          if test.p < 0.05 then alarms += 1
          below += test.shareBelow(0.05)
          val planted = a.map(brightened(_, 1 + bias))
          if BiasTest.of(Renderings.seeds(planted), Renderings.seeds(b)).p < 0.05 then found += 1
        println(
          s"| ${NoiseScenes.name(file)} | $against | $seeds / $others × $spp | " +
            s"$alarms of $repeats | $found of $repeats | " + f"${100 * below / repeats}%.1f %% |"
        )

  private def shuffled(n: Int, random: SplittableRandom): Vector[Int] =
    val all = Array.range(0, n)
    for i <- n - 1 to 1 by -1 do
      val j = random.nextInt(i + 1)
      val kept = all(i)
      all(i) = all(j)
      all(j) = kept
    all.toVector

  /** With the upper left quarter brighter. */
  private def brightened(image: TileSums, factor: Double): TileSums =
    image.mapped: (x, y, sum) =>
      if x < (image.columns + 1) / 2 && y < (image.rows + 1) / 2 then sum * factor else sum

package candela.noise

import candela.base.loop
import candela.film.Fireflies
import candela.image.Image
import candela.measure.Metrics
import candela.render.{Renderer, RenderPlan}
import candela.settings.{PointChoice, RenderSettings}

/** Measures what `--fireflies` brings and costs, for docs/NOISE.md: the relative MSE of single
  * images, and that of the mean of several, which is their bias.
  *
  * Options: `--scenes A.pbrt,B.pbrt` `--samples 16,64,256` `--seeds N` `--width N` (of the image,
  * in pixels) `--truth N` (samples of the reference) `--most X` (the limit of indirect light).
  */
object FireflyErrors:
  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(k, v) => k.drop(2) -> v }.toMap
    def list(name: String, default: String) = options.getOrElse(name, default).split(',').toVector
    def number(name: String, default: Int) = options.get(name).fold(default)(_.toInt)
    val seeds = number("seeds", 8)
    val clamp = Fireflies.Clamped(options.getOrElse("most", "10").toFloat)
    println("| scene | samples | kept: error | re-weighted: error, bias, mean | " +
      "limited: error, bias, mean |")
    println("|---|---|---|---|---|")
    for file <- list("scenes", NoiseScenes.all.mkString(",")) do
      val scene = SmallScene(file, number("width", 64))
      def plan(spp: Int, seed: Int, fireflies: Fireflies) = scene.plan(
        RenderSettings(
          samples = Some(spp),
          seed = seed,
          points = Some(PointChoice.Progressive),
          fireflies = fireflies
        )
      )
      val truth = image(plan(number("truth", 8192), 12345, Fireflies.Kept))
      for n <- list("samples", "16,64,256").map(_.toInt) do
        val all = Vector(Fireflies.Kept, Fireflies.Reweighted, clamp).map: fireflies =>
          Errors.of((1 to seeds).toVector.map(s => image(plan(n, s, fireflies))), truth)
        val Vector(kept, reweighted, limited) = all: @unchecked
        def row(e: Errors) = f"${e.single}%.3g, ${e.bias}%.3g, ${e.mean}%.3f"
        println(
          s"| ${NoiseScenes.name(file)} | $n | " + f"${kept.single}%.3g | " +
            s"${row(reweighted)} | ${row(limited)} |"
        )

  private def image(plan: RenderPlan): Image = Renderer.render(plan, 1).image(plan.development)

  /** @param single relative MSE of an image
    * @param bias   of the mean of all images, without what noise is left in it
    * @param mean   of all images, over the true one
    */
  private final case class Errors(single: Double, bias: Double, mean: Double)

  private object Errors:
    def of(images: Vector[Image], truth: Image): Errors =
      val mean = Image.rgb(truth.width, truth.height)
      for image <- images do
        loop(mean.data.length)(i => mean.data(i) += image.data(i) / images.size)
      def error(of: Image, to: Image) = Metrics.compare(of, to).relativeMse
      // E |X − t|² = V + b², and E |X̄ − t|² = V/n + b²
      val single = images.map(error(_, truth)).sum / images.size
      val n = images.size
      val bias = (error(mean, truth) * n - single) / (n - 1)
      def sum(of: Image) = of.data.map(_.toDouble).sum
      Errors(single, Math.max(0, bias), sum(mean) / sum(truth))

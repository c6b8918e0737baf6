package candela.noise

import candela.base.loop
import candela.image.Image
import candela.measure.{LogLogFit, Metrics}
import candela.render.Renderer
import candela.sampling.PointSet
import candela.settings.{PointChoice, RenderSettings}

import java.lang.management.ManagementFactory

/** Measures the noise of all sets of sample points between seeds, for docs/SAMPLERS.md.
  *
  * Options: `--scenes A.pbrt,B.pbrt` `--samples 4,16,64` `--seeds N` `--points halton,sobol`
  * `--width N` (of the image, in pixels).
  */
object SamplerTable:
  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(k, v) => k.drop(2) -> v }.toMap
    def list(name: String, default: String) = options.getOrElse(name, default).split(',').toVector
    val samples = list("samples", "4,16,64").map(_.toInt)
    val seeds = options.getOrElse("seeds", "16").toInt
    val width = options.getOrElse("width", "32").toInt
    println("| scene | points | noise | kurtosis | slope | processor ms |")
    println("|---|---|---|---|---|---|")
    for file <- list("scenes", NoiseScenes.all.mkString(",")) do
      val scene = SmallScene(file, width)
      for points <- list("points", PointSet.all.map(_.word).mkString(",")) do
        val choice = PointChoice.all.find(_.word == points).get
        val noises = samples.map(n => NoiseOf(scene, choice, n, seeds))
        val slope = LogLogFit.slope(noises.map(n => (n.samples.toDouble, n.variance)))
        def row(figure: NoiseOf => String) = noises.map(figure).mkString(", ")
        println(
          s"| ${NoiseScenes.name(file)} | $points | " +
            row(n => f"${n.variance}%.3g") + " | " + row(n => f"${n.kurtosis}%.1f") +
            f" | ${slope.getOrElse(0.0)}%.2f | ${noises.last.seconds * 1e3}%.0f |"
        )

/** Noise of a rendering.
  *
  * @param samples  per pixel
  * @param variance between seeds, over (mean + 0.01)²: the relative MSE
  * @param kurtosis of the errors of a pixel; 3: they are normally distributed
  * @param seconds  of processor time, per rendering
  */
private final case class NoiseOf(samples: Int, variance: Double, kurtosis: Double, seconds: Double)

private object NoiseOf:
  def apply(scene: SmallScene, choice: PointChoice, samples: Int, seeds: Int): NoiseOf =
    var taken, seconds = 0.0
    val images = (1 to seeds).toVector.map: seed =>
      val settings = RenderSettings(Some(samples), seed, points = Some(choice))
      val plan = scene.plan(settings)
      val start = cpu()
      val rendering = Renderer.render(plan, threads = 1)
      seconds += cpu() - start
      taken += rendering.samplesDone
      rendering.image(plan.development)
    val (variance, kurtosis) = moments(images)
    NoiseOf((taken / seeds).toInt, variance, kurtosis, seconds / seeds)

  /** Mean variance, and mean fourth moment over the mean squared variance: both of relative errors,
    * by unbiased estimates.
    *
    * Source: Halmos, "The theory of unbiased estimation", Annals of Mathematical Statistics 17(1),
    * 1946.
    */
  private def moments(images: Vector[Image]): (Double, Double) =
    val n = images.size.toDouble
    val triples = (n - 1) * (n - 2) * (n - 3)
    var variances, squares, fourths = 0.0
    val values = images.head.data.length
    loop(values): i =>
      val mean = images.map(_.data(i).toDouble).sum / n
      val errors = images.map(image => (image.data(i) - mean) / (mean + Metrics.RelativeEpsilon))
      val m2 = errors.map(e => e * e).sum
      val m4 = errors.map(e => e * e * e * e).sum
      variances += m2 / (n - 1)
      squares += ((n * n - 3 * n + 3) * m2 * m2 / n - (n - 1) * m4) / triples
      fourths += ((n * n - 2 * n + 3) * m4 - 3 * (2 * n - 3) / n * m2 * m2) / triples
    (variances / values, fourths / squares)

  private def cpu(): Double =
    ManagementFactory.getOperatingSystemMXBean match
      case system: com.sun.management.OperatingSystemMXBean => system.getProcessCpuTime * 1e-9
      case _ => System.nanoTime * 1e-9

package candela.noise

import candela.cli.rendering.RenderRecorder
import candela.measure.{Interval, Metrics}
import candela.render.{RenderControl, Looks, Pass, Renderer, RenderListener}
import candela.film.Film
import candela.guiding.GuidingMode
import candela.image.{Image, ImageFiles}
import candela.settings.{PointChoice, RenderSettings}

import java.nio.file.{Files, Path}

/** Compares the error that a rendering estimates of itself with the true one, for docs/NOISE.md.
  *
  * Options: `--scenes A.pbrt,B.pbrt` `--samples 16,64` `--seeds N` `--width N` (of the image, in
  * pixels) `--truth N` (samples of the reference) `--guiding auto` `--folder F` (keeps
  * references) `--values F` (a file of all figures: scene, samples, true
  * relative MSE, its estimate, and the limits of that).
  */
object ErrorHonesty:
  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(k, v) => k.drop(2) -> v }.toMap
    def list(name: String, default: String) = options.getOrElse(name, default).split(',').toVector
    def number(name: String, default: Int) = options.get(name).fold(default)(_.toInt)
    val samples = list("samples", "16,64").map(_.toInt)
    println(
      "| scene | samples | true error | true / estimate: median, 10 %, 90 % | within 15 % | " +
        "of the mean error | squared error within 15 % | in the interval | no upper limit |"
    )
    println("|---|---|---|---|---|---|---|---|---|")
    val values = StringBuilder()
    for file <- list("scenes", NoiseScenes.all.mkString(",")) do
      val scene = SmallScene(file, number("width", 64))
      def plan(spp: Int, seed: Int) =
        scene.plan(RenderSettings(
          samples = Some(spp),
          seed = seed,
          points = Some(PointChoice.Progressive),
          guiding = options.get("guiding").map(g => GuidingMode.valueOf(g.capitalize))
        ))
      def rendered(): Image =
        val most = plan(number("truth", 4096), 12345)
        Renderer.render(most, 2).image(most.development)
      val kept = options.get("folder").map: folder =>
        Path.of(folder, s"${NoiseScenes.name(file)}-${number("width", 64)}.pfm".replace('/', '-'))
      val truth = kept.filter(Files.exists(_)).fold(rendered())(ImageFiles.read(_))
      kept.foreach(ImageFiles.write(_, truth))
      val seen = (1 to number("seeds", 20)).toVector.map: seed =>
        val eye = HonestyOf(plan(samples.max, seed).development, truth)
        val _ = Renderer.render(plan(samples.max, seed), RenderControl(2, listener = eye))
        eye.ratios
      for n <- samples do
        val found = seen.flatMap(_.get(n))
        val ratios = found.map(_._2).sorted
        // What an estimate would reach that knew the mean error of all seeds
        val mean = Math.sqrt(found.map(f => f._1 * f._1).sum / found.size)
        val intervals = found.map(f => (f._1 * f._1, f._3))
        for (square, i) <- intervals do
          values ++= s"${NoiseScenes.name(file)} $n $square ${i.estimate} ${i.low} ${i.high}\n"
        val within = intervals.count((square, i) => i.low <= square && square <= i.high)
        def near(ratios: Seq[Double]) =
          s"${ratios.count(r => Math.abs(r - 1) <= 0.15)} of ${ratios.size}"
        def at(part: Double) = ratios((part * (ratios.size - 1)).round.toInt)
        println(
          s"| ${NoiseScenes.name(file)} | $n | " + f"${100 * mean}%.3g %% | " +
            f"${at(0.5)}%.2f, ${at(0.1)}%.2f, ${at(0.9)}%.2f | " +
            s"${near(ratios)} | ${near(found.map(_._1 / mean))} | " +
            s"${near(ratios.map(r => r * r))} | $within of ${found.size} | " +
            s"${intervals.count(!_._2.isBounded)} |"
        )
    for name <- options.get("values") do Files.writeString(Path.of(name), values.toString): Unit

/** Records the true relative error of each pass, and its ratio to the estimate. */
private final class HonestyOf(development: candela.film.Development, truth: Image)
    extends RenderListener:
  private val recorder = RenderRecorder(development, None)
  private var found = Map.empty[Int, (Double, Double, Interval)]

  /** By samples: the true error, its ratio to the estimate, and the interval of its square. */
  def ratios: Map[Int, (Double, Double, Interval)] = found
  override def looks: Looks = Looks.Waves

  override def passed(pass: Pass, film: Film): Unit =
    recorder.passed(pass, film)
    for
      estimate <- recorder.errorAt(pass.samples)
      interval <- recorder.interval(pass.samples)
    do
      val error = Math.sqrt(Metrics.compare(development(film), truth).relativeMse)
      found += pass.samples -> (error, error / estimate, interval)

package candela.noise

import candela.cli.rendering.RenderRecorder
import candela.film.{Development, Film}
import candela.guiding.GuidingMode
import candela.image.{Image, ImageFiles}
import candela.integrators.CausticsMode
import candela.measure.{ErrorEstimate, Interval, Metrics}
import candela.render.{Looks, Pass, RenderControl, RenderListener, Renderer}
import candela.settings.{PointChoice, RenderSettings}

import java.nio.file.{Files, Path}

/** Compares the error that a rendering estimates of itself with the true one, and the samples that
  * it expects to need with those that it needs, for docs/NOISE.md.
  *
  * Options: `--scenes A.pbrt,B.pbrt` `--samples 16,64` `--seeds N` `--width N` (of the image, in
  * pixels) `--truth N` (samples of the reference) `--guiding auto` `--folder F` (of references, for
  * later runs)
  */
object ErrorHonesty:
  private val Scenes =
    val own = "door-ajar prism wine-glass".split(' ').map(s => s"bench/scenes/$s.v4.pbrt")
    val rest =
      "showcase v2-instances v2-materials v2-point-lights v2-subsurface v2-textures v2-volumes " +
        "v3-alpha v3-bdpt-caustic v3-blends v3-bump v3-disney v3-environment-map v3-fog " +
        "v3-glass v3-glossy v3-instances v3-lights v3-media v3-metal-mirror v3-motion " +
        "v3-subsurface v3-textures v4-bdpt v4-bdpt-media v4-caustics-glass v4-caustics-mist " +
        "v4-caustics-pool v4-caustics-ring v4-coated-diffuse v4-depth-of-field v4-dispersion " +
        "v4-lights v4-measured v4-media-cloud v4-motion v4-panorama v4-picture-lights " +
        "v4-realistic v4-spectral v4-subsurface v4-textures"
    own.toVector ++ rest.split(' ').map(s => s"scenes/$s.pbrt")

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(k, v) => k.drop(2) -> v }.toMap
    def list(name: String, default: String) = options.getOrElse(name, default).split(',').toVector
    def number(name: String, default: Int) = options.get(name).fold(default)(_.toInt)
    val samples = list("samples", "8,16,32,64").map(_.toInt)
    val (width, threads) = (number("width", 48), number("threads", 2))
    println("| scene | samples | true error | true / estimate: median, 10 %, 90 % |")
    println("|---|---|---|---|")
    val all =
      for file <- list("scenes", Scenes.mkString(",")) yield
        val scene = SmallScene(file, width)
        def plan(spp: Int, seed: Int, caustics: CausticsMode = CausticsMode.Off) =
          scene.plan(RenderSettings(
            samples = Some(spp),
            seed = seed,
            points = Some(PointChoice.Progressive),
            guiding = options.get("guiding").map(g => GuidingMode.valueOf(g.capitalize)),
            caustics = Some(caustics)
          ))
        def rendered(): Image =
          val long = plan(number("truth", 2048), 12345, CausticsMode.Auto)
          Renderer.render(long, RenderControl(threads)).image(long.development)
        val stored = options.get("folder").map: folder =>
          Path.of(folder, s"${NoiseScenes.name(file)}-$width.pfm".replace('/', '-'))
        val truth = stored.filter(Files.exists(_)).fold(rendered())(ImageFiles.read(_))
        stored.foreach(ImageFiles.write(_, truth))
        val runs = (1 to number("seeds", 10)).toVector.map: seed =>
          val follower = HonestyOf(plan(samples.max, seed).development, truth)
          val control = RenderControl(threads, listener = follower)
          val _ = Renderer.render(plan(samples.max, seed), control)
          follower.judged
        for n <- samples do
          val judged = runs.flatMap(_.get(n))
          val ratios = judged.map(_.ratio).sorted
          val error = Math.sqrt(judged.map(_.relativeMse).sum / judged.size)
          def at(part: Double) = ratios((part * (ratios.size - 1)).round.toInt)
          println(
            s"| ${NoiseScenes.name(file)} | $n | " + f"${100 * error}%.3g %% | " +
              f"${at(0.5)}%.2f, ${at(0.1)}%.2f, ${at(0.9)}%.2f |"
          )
        runs
    println(
      "\n| samples | within 15 % | within 25 % | true error more than 15 % above, below | " +
        "in its interval | four times as many samples: expected within 25 %, in their interval |"
    )
    println("|---|---|---|---|---|---|")
    for n <- samples do
      val judged = all.flatten.flatMap(_.get(n))
      def of(count: Int) = s"$count of ${judged.size}"
      def within(part: Double) = judged.count(j => Math.abs(j.ratio - 1) <= part)
      val expected =
        for run <- all.flatten; now <- run.get(n); later <- run.get(4 * n)
        yield now.estimate.samplesUntil(later.interval.estimate) * (1.0 / (4 * n))
      val forecasts =
        if expected.isEmpty then ""
        else
          val near = expected.count(i => Math.abs(i.estimate - 1) <= 0.25)
          val inside = expected.count(i => i.low <= 1 && 1 <= i.high)
          s"$near, $inside of ${expected.size}"
      println(
        s"| $n | ${of(within(0.15))} | ${within(0.25)} | ${judged.count(_.ratio > 1.15)}, " +
          s"${judged.count(_.ratio < 0.85)} | ${judged.count(_.isInside)} | $forecasts |"
      )

/** @param relativeMse the true one
  * @param interval    of the estimate
  */
private final case class Judged(relativeMse: Double, estimate: ErrorEstimate, interval: Interval):
  /** True error over the estimated one. */
  def ratio: Double = Math.sqrt(relativeMse / interval.estimate)
  def isInside: Boolean = interval.low <= relativeMse && relativeMse <= interval.high

/** Records the true error of each pass beside its estimate, by samples. */
private final class HonestyOf(development: Development, truth: Image) extends RenderListener:
  private val recorder = RenderRecorder(development, None)
  private var bySamples = Map.empty[Int, Judged]

  def judged: Map[Int, Judged] = bySamples
  override def frequency: Looks = Looks.Waves

  override def passed(pass: Pass, film: Film): Unit =
    recorder.passed(pass, film)
    for estimate <- recorder.estimate do
      val relativeMse = Metrics.compare(development(film), truth).relativeMse
      bySamples += pass.samples -> Judged(relativeMse, estimate, estimate.interval(pass.samples))

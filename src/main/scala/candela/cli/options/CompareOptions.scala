package candela.cli.options

import scopt.{OParser, Read}
import candela.image.{Contents, OutputFormat}
import candela.measure.{Metric, PixelWindow}

/** Options of `compare`.
  *
  * @param channels channels to compare instead of R, G, B (or of all, if an image has no RGB)
  * @param difference file for the absolute difference |a − b|
  * @param heatMap file for the per-pixel error in false colours
  * @param heatMapMax error at the top of the colour scale
  * @param bias whether to test for bias, between sets of images
  * @param significance chance of a false alarm of this test
  * @param limits bounds that make the comparison fail: upper bounds, but a lower bound for PSNR
  */
final case class CompareOptions(
    crop: Option[PixelWindow] = None,
    channels: Option[Vector[String]] = None,
    perChannel: Boolean = false,
    difference: Option[String] = None,
    heatMap: Option[String] = None,
    heatMapMetric: Metric = Metric.Flip,
    heatMapMax: Option[Double] = None,
    bias: Boolean = false,
    significance: Double = 0.05,
    limits: Vector[Limit] = Vector.empty
):
  /** FLIP takes longer than all other metrics together. */
  def writesPictures: Boolean = difference.isDefined || heatMap.isDefined

/** Bound on a metric.
  *
  * @param option option name, without dashes
  * @param figure display name of the metric
  */
final case class Limit(option: String, figure: String, value: Double)

object Limit:
  /** Option, metric, and help text. */
  val all: Vector[(String, String, String)] = Vector(
    ("max-mse", "MSE", "mean squared error"),
    ("max-rmse", "RMSE", "root mean squared error"),
    ("max-mae", "MAE", "mean absolute error"),
    ("max-relmse", "relative MSE", "relative mean squared error"),
    ("max-flip", "FLIP", "mean FLIP error"),
    ("max-bias", "bias", "the largest |mean ratio − 1| of any channel"),
    ("min-psnr", "PSNR", "peak signal-to-noise ratio in dB")
  )

/** Option table of `compare`, one row each. */
private[cli] object CompareTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private[cli] given window: Read[PixelWindow] = Read.reads: text =>
    text.split(",", -1).map(_.trim.toIntOption) match
      case Array(Some(x0), Some(x1), Some(y0), Some(y1)) if 0 <= x0 && 0 <= y0 && x1 != x0 =>
        // As in imgtool, a negative end is a size.
        PixelWindow(x0, if x1 < 0 then x0 - x1 else x1, y0, if y1 < 0 then y0 - y1 else y1)
      case _ => throw IllegalArgumentException("expected x0,x1,y0,y1 in pixels, e.g. 0,64,0,32")

  private given Read[Metric] = Read.reads: word =>
    Metric.named(word).filter(_.hasMap).getOrElse:
      val metrics = Metric.values.filter(_.hasMap).map(_.word).mkString(", ")
      throw IllegalArgumentException(s"expected one of $metrics")

  private def change(o: Options)(f: CompareOptions => CompareOptions): Options =
    o.copy(compare = f(o.compare))

  /** A number, or a percentage of 1. */
  private val bound: Read[Double] = Read.reads: text =>
    val number = summon[Read[Double]].reads(text.stripSuffix("%").trim)
    if text.endsWith("%") then number / 100 else number

  private def limit(option: String, figure: String, text: String): Row =
    val side = if option.startsWith("min") then "below" else "above"
    opt[Double](option)(using bound).valueName("X").text(s"exit with 1 if $text is $side X")
      .validate: x =>
        if x >= 0 then success else failure(s"--$option must be at least 0, found `$x`")
      .action: (x, o) =>
        change(o)(c => c.copy(limits = c.limits :+ Limit(option, figure, x)))

  val options: Vector[Row] = Vector[Row](
    opt[PixelWindow]("crop").valueName("x0,x1,y0,y1")
      .text("restrict the comparison to these pixels, x1 and y1 excluded")
      .action((w, o) => change(o)(_.copy(crop = Some(w)))),
    opt[Seq[String]]("channels").valueName("NAME,...")
      .text("restrict the comparison to these channels (default R,G,B)")
      .validate(nonEmpty("channels"))
      .action((names, o) => change(o)(_.copy(channels = Some(names.toVector)))),
    opt[Unit]("per-channel")
      .text("also print per-channel figures")
      .action((_, o) => change(o)(_.copy(perChannel = true))),
    opt[String]("difference").valueName("FILE")
      .text(s"write the absolute difference image, ${OutputFormat.listed()}")
      .action((f, o) => change(o)(_.copy(difference = Some(f)))),
    opt[String]("heatmap").valueName("FILE")
      .text(
        s"write the per-pixel error: ${OutputFormat.listed(Contents.Display)} in false colours, " +
          s"${OutputFormat.listed(Contents.Radiance, Contents.Channels)} as numbers"
      )
      .action((f, o) => change(o)(_.copy(heatMap = Some(f)))),
    opt[Metric]("heatmap-metric")
      .valueName(Metric.values.filter(_.hasMap).map(_.word).mkString("|"))
      .text(OptionText(
        "metric of the heat map (default flip)",
        "[Definitions of the metrics](METRICS.md)."
      ))
      .action((m, o) => change(o)(_.copy(heatMapMetric = m))),
    opt[Double]("heatmap-max").valueName("X")
      .text(
        "top of its scale (default: 1 for flip, 4 powers of ten for --bias, else the 99th " +
          "percentile)"
      )
      .validate(positive("heatmap-max"))
      .action((x, o) => change(o)(_.copy(heatMapMax = Some(x)))),
    opt[Unit]("bias")
      .text(OptionText(
        "test whether two programs render the same expected image: both arguments are sets of " +
          "images with several seeds (a folder, A.exr,B.exr or 'NAME*.exr'), or an image with " +
          "its variance; exit with 1 if they don't",
        "[How the test works](METRICS.md#a-test-for-bias)."
      ))
      .action((_, o) => change(o)(_.copy(bias = true))),
    opt[Double]("significance").valueName("X")
      .text("chance of a false alarm of --bias (default 0.05)")
      .validate: x =>
        if x > 0 && x < 1 then success
        else failure(s"--significance must be between 0 and 1, found `$x`")
      .action((x, o) => change(o)(_.copy(significance = x)))
  ) ++ Limit.all.map(limit)

  /** What is wrong with the options of `compare`, if anything. */
  def problem(o: Options): Option[String] =
    val c = o.compare
    Option.when(c.bias && c.limits.nonEmpty):
      s"--bias has no limits but --significance; omit --${c.limits.head.option}"
    .orElse(Option.when(c.bias && c.difference.isDefined):
      "--bias writes no --difference; --heatmap FILE writes a map of p-values")

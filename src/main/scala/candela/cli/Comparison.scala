package candela.cli

import candela.measure.{ErrorMap, ImagePair, Metric, Metrics}

/** A picture beside its reference, and what `compare` says about them.
  *
  * @param flip only of colours
  */
final case class Comparison(pair: ImagePair, metrics: Metrics, flip: Option[Double]):

  def lines: Vector[String] =
    val m = metrics
    val ratios = m.channels.zip(m.meanRatio).map((c, r) => s"$c ${Figures.fixed(r, 4)}")
    val difference = Figures.scientific(m.largest.value)
    val most = m.largest
    Vector(
      s"MSE           ${Figures.scientific(m.mse)}",
      s"RMSE          ${Figures.scientific(m.rmse)}",
      s"MAE           ${Figures.scientific(m.mae)}",
      s"relative MSE  ${Figures.scientific(m.relativeMse)}",
      s"PSNR          ${Comparison.decibels(m.psnr)}"
    ) ++ flip.map(f => s"FLIP          ${Figures.scientific(f)}") ++ Vector(
      s"mean ratio    ${ratios.mkString("  ")}",
      s"largest       $difference in ${most.channel} at (${most.x}, ${most.y})"
    ) ++ Option.when(m.skipped > 0):
      s"skipped       ${Figures.count(m.skipped, "pixel")}, NaN or infinite"

  /** A table of the channels. */
  def perChannel: Vector[String] =
    val head = Vector("channel", "MSE", "RMSE", "MAE", "relative MSE", "mean", "reference", "ratio")
    val rows = metrics.perChannel.map: c =>
      val figures = Vector(c.mse, c.rmse, c.mae, c.relativeMse, c.mean, c.referenceMean)
      (c.name +: figures.map(Figures.scientific)) :+ Figures.fixed(c.meanRatio, 4)
    Comparison.aligned(head +: rows)

object Comparison:

  def apply(pair: ImagePair): Comparison =
    val metrics = Metrics.compare(pair.image, pair.reference)
    val flip = Option.when(pair.isColor)(ErrorMap.mean(ErrorMap(Metric.Flip, pair)))
    Comparison(pair, metrics, flip)

  def decibels(psnr: Double): String =
    if psnr.isInfinite then "infinite" else s"${Figures.fixed(psnr, 2)} dB"

  /** Columns as wide as they need to be, numbers to the right. */
  def aligned(rows: Vector[Vector[String]]): Vector[String] =
    val widths = rows.head.indices.map(i => rows.map(_(i).length).max)
    rows.map: row =>
      val cells = row.zip(widths).tail.map((cell, width) => " " * (width - cell.length) + cell)
      (row.head.padTo(widths.head, ' ') +: cells).mkString("  ")

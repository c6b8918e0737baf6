package candela.cli

import candela.measure.{Metric, PixelWindow}

import scopt.{OParser, Read}

/** The options of `compare`, one row each. */
private[cli] object CompareTable:
  private type Row = OParser[?, Options]

  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private given Read[PixelWindow] = Read.reads: text =>
    text.split(",", -1).map(_.trim.toIntOption) match
      case Array(Some(x0), Some(x1), Some(y0), Some(y1)) if 0 <= x0 && 0 <= y0 && x1 != x0 =>
        // As in imgtool: a negative end is a size.
        PixelWindow(x0, if x1 < 0 then x0 - x1 else x1, y0, if y1 < 0 then y0 - y1 else y1)
      case _ => throw IllegalArgumentException("expected x0,x1,y0,y1 in pixels, e.g. 0,64,0,32")

  private given Read[Metric] = Read.reads: word =>
    Metric.named(word).filter(_.hasMap).getOrElse:
      val known = Metric.values.filter(_.hasMap).map(_.word).mkString(", ")
      throw IllegalArgumentException(s"expected one of $known")

  private def change(o: Options)(f: CompareOptions => CompareOptions): Options =
    o.copy(compare = f(o.compare))

  private def limit(option: String, figure: String, text: String): Row =
    val where = if option.startsWith("min") then "below" else "above"
    opt[Double](option).valueName("X").text(s"exit with 1 if $text is $where")
      .validate: x =>
        if x >= 0 then success else failure(s"--$option: expected a number from 0, found `$x`")
      .action: (x, o) =>
        change(o)(c => c.copy(limits = c.limits :+ Limit(option, figure, x)))

  val options: Vector[Row] = Vector[Row](
    opt[PixelWindow]("crop").valueName("x0,x1,y0,y1")
      .text("compare only these pixels, x1 and y1 excluded")
      .action((w, o) => change(o)(_.copy(crop = Some(w)))),
    opt[Seq[String]]("channels").valueName("NAME,...")
      .text("compare these channels, instead of R,G,B")
      .action((names, o) => change(o)(_.copy(channels = Some(names.toVector)))),
    opt[Unit]("per-channel")
      .text("print the figures of each channel, too")
      .action((_, o) => change(o)(_.copy(perChannel = true))),
    opt[String]("difference").valueName("FILE")
      .text("write the absolute difference of each pixel, .exr or .png")
      .action((f, o) => change(o)(_.copy(difference = Some(f)))),
    opt[String]("heatmap").valueName("FILE")
      .text("write the error of each pixel in colours (.png), or as numbers (.exr)")
      .action((f, o) => change(o)(_.copy(heatMap = Some(f)))),
    opt[Metric]("heatmap-metric").valueName("METRIC")
      .text("of which error: mse, rmse, mae, relmse or flip (default flip)")
      .action((m, o) => change(o)(_.copy(heatMapMetric = m))),
    opt[Double]("heatmap-max").valueName("X")
      .text("the error with the brightest colour (default: 1 for flip, else the 99th percentile)")
      .validate(x => if x > 0 then success else failure("--heatmap-max: expected more than 0"))
      .action((x, o) => change(o)(_.copy(heatMapMax = Some(x))))
  ) ++ Limit.all.map(limit)

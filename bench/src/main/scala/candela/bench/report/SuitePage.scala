package candela.bench.report

import candela.measure.{Interval, Metric}
import candela.report.{ChartFrame, Numbers, Page, Picture, Viewer}

import scalatags.Text.all.*

/** Page about a suite: which program reaches a target error first. */
object SuitePage:

  /** @param hasPictures if false, omits images, which keeps the page small enough for a repository
    */
  def html(r: SuiteReport, hasPictures: Boolean = true): String =
    val conditions = s"${r.begun} on ${r.machine.processor}, ${r.machine.cores} hardware threads"
    // Of scenes that grow, time and memory matter, not the error
    val judged = r.copy(scenes = r.scenes.filter(_.growth.isEmpty))
    Page.html(r.title, conditions, r.version)(
      warnings(r),
      GrowthPart(r.growing),
      Option.when(judged.scenes.nonEmpty)(errors(judged, hasPictures)),
      h2("Method"),
      method(r),
      Option.when(r.leftOut.nonEmpty)(frag(h3("Not run"), Page.facts(r.leftOut))),
      h3("Machine"),
      Page.facts(r.machine.rows ++ Vector("version" -> s"Candela ${r.version}")),
      h3("Commands"),
      Page.facts(commands(r))
    )

  /** The error against time. */
  private def errors(r: SuiteReport, hasPictures: Boolean): Frag =
    frag(
      h2("Time to target"),
      p(
        "Seconds from program start until the relative MSE reaches the second column, including " +
          "start-up, parsing and scene construction. The target is the suite's, or the error " +
          "that half of the programs reach; variants of a program count once, by the first. " +
          "Bold: best of the scene; –: not reached; blank: not run; ⚠: measured on a busy machine."
      ),
      overview(r)("relative MSE", s => Some(Numbers.tick(s.target))): (s, p) =>
        p.curve.secondsUntil(s.target)
          .map(t => (t.estimate, s"${Numbers.short(t.estimate)} s")),
      Option.when(r.scenes.exists(s => s.programs.sizeIs > 1 && s.equalTime.isDefined))(frag(
        h2("Error at equal time"),
        p(
          "Relative MSE after the time in the second column, the longest that all programs of a " +
            "scene took, from program start. Bold: best of the scene; blank: not run."
        ),
        overview(r)("seconds", _.equalTime.map(Numbers.short)): (s, p) =>
          s.errorAtEqualTime(p).map(e => (e, Numbers.short(e)))
      )),
      Option.when(r.scenes.sizeIs > 1)(
        div(
          cls := "card chart",
          Page.fitting(SuiteChart.overview(r).svg, SuiteChart.overview(r, columns = 1).svg)
        )
      ),
      r.scenes.map(scene(_, hasPictures))
    )

  private def warnings(r: SuiteReport): Option[Frag] =
    val messages = r.business.toVector ++ r.disturbances
    Option.when(messages.nonEmpty):
      div(
        cls := "warning",
        attr("role") := "note",
        messages.map(words => p(s"⚠ ${words.head.toUpper}${words.tail}."))
      )

  /** A row for each scene, a column for each program.
    *
    * @param key    of a scene
    * @param figure number and text; the smallest is the best
    */
  private def overview(r: SuiteReport)(keys: String, key: SceneResult => Option[String])(
      figure: (SceneResult, ProgramResult) => Option[(Double, String)]
  ): Frag =
    val programs = r.scenes.flatMap(_.programs.map(p => (p.name, p.title))).distinct
    val head = Vector("scene", keys) ++ programs.map(_._2)
    val rows = r.scenes.map: s =>
      val figures = s.programs.map(p => p.name -> (figure(s, p), p.isDisturbed)).toMap
      val minFigure = figures.values.flatMap(_._1).map(_._1).minOption
      val cells = programs.map: (name, _) =>
        figures.get(name) match
          case None => td()
          case Some((None, _)) => td("–")
          case Some((Some((number, text)), isDisturbed)) =>
            val mark = Option.when(isDisturbed || r.business.isDefined)(" ⚠")
            td(Option.when(minFigure.contains(number))(cls := "best"), text, mark)
      tr(td(s.title), td(key(s).getOrElse("–")), cells)
    Page.scrolling(head, rows)

  private def scene(s: SceneResult, hasPictures: Boolean): Frag =
    val charts =
      for
        metric <- Vector(Metric.RelativeMse, Metric.Mse, Metric.Mae, Metric.Flip)
        axis <- Vector("seconds", "samples")
      yield
        def shaped(frame: ChartFrame) = SuiteChart.errorChart(s, metric, axis, frame).svg
        val graphic = Page.fitting(shaped(ChartFrame.Whole), shaped(ChartFrame.Narrow))
        (metric.word, metric.title, axis, graphic)
    val pictures = s.programs.map(p => Picture(p.title, p.picture)) :+
      Picture(
        if s.referenceName.isDefined then "reference" else "mean",
        s.reference,
        isReference = true
      )
    frag(
      h2(s.title),
      Option.when(s.note.nonEmpty)(p(cls := "soft", s.note)),
      Page.charts(charts),
      h3("Results at the highest sample count"),
      Page.grid(Head, s.programs.map(row(s, _))),
      p(
        cls := "soft",
        "±: 95 % confidence over seeds (Student's t); none for one seed. Slope " +
          "of relative MSE against samples: −1 for independent samples, 0 where bias (or the " +
          s"reference's noise) dominates. First image: the whole process, with one sample per " +
          "pixel, median over seeds. Peak memory: resident, of all runs the largest. " +
          "Other programs: share of the processors that they took during the runs. " +
          s.referenceName.fold(
            "No reference: errors are the variance between the seeds, which reveals no bias. " +
              "They and the mean ratios are relative to the mean of the longest renderings of " +
              s"${s.makers.mkString(" and ")}; variants of a program count once."
          )(name => s"Reference: $name. ${ownError(s)}")
      ),
      certainty(s),
      spectrum(s),
      Option.when(s.biases.nonEmpty)(BiasTable(s.biases, hasPictures)),
      Option.when(hasPictures)(frag(h3("Images"), Viewer(pictures)))
    )

  private def spectrum(s: SceneResult): Frag =
    val graphic =
      for
        wide <- SuiteChart.spectrum(s)
        narrow <- SuiteChart.spectrum(s, ChartFrame.Narrow)
      yield Page.fitting(wide.svg, narrow.svg)
    graphic.fold(frag()): chart =>
      frag(
        h3("Error by spatial frequency"),
        div(cls := "card chart", chart),
        p(
          cls := "soft",
          "Power of the relative error at the highest sample count, mean over seeds; bars: " +
            "standard deviation over seeds. Independent pixels give a level line, whose height " +
            "is the relative MSE. More at low frequencies (left): neighbouring pixels share " +
            "errors, which look like blotches. Less there: errors of neighbours balance."
        )
      )

  private def ownError(s: SceneResult): String =
    val errors = s.programs.flatMap(_.curve.points.flatMap(_.runs.map(_.errors)))
    s.ownError.fold("")(Page.subtracted(_, errors))

  private val Head = Vector("program", "samples", "seconds", "relative MSE", "FLIP") ++
    Vector("mean ratio R, G, B", "slope", "efficiency", "seconds to target") ++
    Vector("first image, s", "peak memory, MB", "other programs")

  private def row(s: SceneResult, p: ProgramResult): Vector[Frag] =
    val finalPoint = p.curve.points.last
    Vector(
      p.title,
      finalPoint.samples.toString,
      Numbers.short(finalPoint.seconds),
      finalPoint(Metric.RelativeMse).fold("–")(estimate),
      finalPoint(Metric.Flip).fold("–")(i => Numbers.short(i.estimate)),
      p.curve.meanRatio.map(Numbers.fixed(_, 4)).mkString(", "),
      p.curve.slope.fold("–")(Numbers.plusMinus(_, Numbers.fixed(_, 2))),
      p.curve.efficiency.fold("–")(estimate),
      p.curve.secondsUntil(s.target).fold("–")(estimate),
      p.firstImage.fold("–")(Numbers.short),
      p.curve.memory.fold("–")(m => Numbers.fixed(m * 1e-6, 0)),
      p.otherShare.fold("–")(Numbers.percentage) + (if p.isDisturbed then " ⚠" else "")
    ).map(cell => stringFrag(cell.replace("± ", "±\u00a0")))

  private def estimate(i: Interval): String = Numbers.short(i.estimate)

  /** How certain the figures are that follow from the error. */
  private def certainty(s: SceneResult): Frag =
    val head = Vector("program", "relative MSE", "deviation over seeds") ++
      Vector("worst hundredth of pixels", "efficiency", "seconds to target")
    val rows = s.programs.map: p =>
      val finalPoint = p.curve.points.last
      val error = finalPoint(Metric.RelativeMse)
      val share =
        for e <- error; d <- finalPoint.deviation(Metric.RelativeMse) if e.estimate > 0
        yield Numbers.percentage(d / e.estimate)
      Vector(
        p.title,
        error.fold("–")(Numbers.range),
        share.getOrElse("–"),
        finalPoint.worst.fold("–")(Numbers.percentage),
        p.curve.efficiency.fold("–")(Numbers.range),
        p.curve.secondsUntil(s.target).fold("–")(Numbers.range)
      ).map(stringFrag)
    frag(
      h3("How certain they are"),
      Page.grid(head, rows),
      p(
        cls := "soft",
        "Ranges: 95 % confidence, from parts of the images of all seeds; those of efficiency " +
          "and time are the error's alone. Where few pixels carry the error, seeds don't bound " +
          "it from above: then only the lower limit is known. Deviation over seeds: standard " +
          "deviation of an image's relative MSE, as a share of the mean. Worst hundredth of " +
          "pixels: its share in the relative MSE. docs/NOISE.md has tests of the ranges."
      )
    )

  private def method(r: SuiteReport): Frag = frag(
    p(
      s"Each program rendered each scene with ${r.seeds} seeds per sample count, in turn with " +
        "the others, each run in a separate process, after one warm-up run. " +
        "Times are median wall-clock times of the whole process; errors are averages over the " +
        "seeds. Programs without seeds are deterministic: their errors have no " +
        s"bars. All runs together took ${Numbers.short(r.seconds / 60)} minutes."
    ),
    p(
      "All images of a scene are compared with one reference; docs/METRICS.md defines the " +
        "metrics. The reference's own error is subtracted where it is known; elsewhere, errors " +
        "below the reference's noise are not resolved. Without a reference, " +
        "images of several seeds are compared with each other."
    )
  )

  private def commands(r: SuiteReport): Vector[(String, String)] =
    r.scenes.flatMap(_.programs).distinctBy(_.name).map(p => (p.title, p.command))

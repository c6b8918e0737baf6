package candela.report

import candela.measure.{Interval, Metric}

import scalatags.Text.all.*

/** The page about a suite: who reaches which error first. */
object SuitePage:

  /** @param hasPictures without them a page is small enough to be kept in a repository */
  def html(r: SuiteReport, hasPictures: Boolean = true): String =
    val when = s"${r.begun} on ${r.machine.processor}, ${r.machine.cores} hardware threads"
    Page.html(r.title, when, r.version)(
      h2("Who is there first"),
      p(
        "Seconds from the start of the program until the relative squared error is that of the " +
          "second column, reading and building of the scene (and the start of Java) included. " +
          "The best of each scene stands out; – was not reached, blank was not run."
      ),
      overview(r),
      Option.when(r.scenes.sizeIs > 1)(div(cls := "card chart", SuiteChart.all(r).svg)),
      r.scenes.map(scene(_, hasPictures)),
      h2("How it was measured"),
      method(r),
      Option.when(r.leftOut.nonEmpty)(frag(h3("Left out"), Page.facts(r.leftOut))),
      h3("Machine"),
      Page.facts(r.machine.rows ++ Vector("version" -> s"Candela ${r.version}")),
      h3("Commands"),
      Page.facts(commands(r))
    )

  private def overview(r: SuiteReport): Frag =
    val programs = r.scenes.flatMap(_.programs.map(p => (p.name, p.title))).distinct
    val head = Vector("scene", "relative MSE") ++ programs.map(_._2)
    val rows = r.scenes.map: s =>
      val times = s.programs.map(p => p.name -> p.curve.secondsUntil(s.target)).toMap
      val best = times.values.flatten.minOption
      val cells = programs.map: (name, _) =>
        times.get(name) match
          case None => td()
          case Some(None) => td("–")
          case Some(Some(t)) =>
            td(Option.when(best.contains(t))(cls := "best"), s"${Numbers.short(t)} s")
      tr(td(s.title), td(Numbers.tick(s.target)), cells)
    div(cls := "scroll", table(thead(tr(head.map(th(_)))), tbody(rows)))

  private def scene(s: SceneResult, hasPictures: Boolean): Frag =
    val charts =
      for
        metric <- Vector(Metric.RelativeMse, Metric.Mse, Metric.Mae, Metric.Flip)
        axis <- Vector("seconds", "samples")
      yield (metric.word, metric.title, axis, SuiteChart.of(s, metric, axis).svg)
    val pictures = s.programs.map(p => Picture(p.title, p.picture)) :+
      Picture("reference", s.reference, isReference = true)
    frag(
      h2(s.title),
      Option.when(s.note.nonEmpty)(p(cls := "soft", s.note)),
      Page.charts(charts),
      h3("Figures of the longest renderings"),
      Page.grid(Head, s.programs.map(row(s, _))),
      p(
        cls := "soft",
        "± and ranges: 95 % confidence over the seeds, by Student's t; none with one seed. Slope " +
          "of the relative MSE over samples: −1 for independent samples, 0 where bias (or the " +
          s"noise of the reference) is all that is left. Reference: ${s.referenceName}."
      ),
      Option.when(hasPictures)(frag(h3("Pictures"), Viewer(pictures)))
    )

  private val Head = Vector("program", "samples", "seconds", "relative MSE", "FLIP") ++
    Vector("mean ratio R, G, B", "slope", "efficiency", "seconds to target")

  private def row(s: SceneResult, p: ProgramResult): Vector[Frag] =
    val last = p.curve.points.last
    Vector(
      p.title,
      last.samples.toString,
      Numbers.short(last.seconds),
      last(Metric.RelativeMse).fold("–")(Numbers.plusMinus(_, Numbers.short)),
      last(Metric.Flip).fold("–")(i => Numbers.short(i.estimate)),
      p.curve.meanRatio.map(Numbers.fixed(_, 4)).mkString(", "),
      p.curve.slope.fold("–")(Numbers.plusMinus(_, Numbers.fixed(_, 2))),
      p.curve.efficiency.fold("–")(range),
      p.curve.secondsUntil(s.target).fold("–")(Numbers.short)
    ).map(stringFrag)

  private def range(i: Interval): String =
    val known = if i.isKnown then s" (${Numbers.short(i.low)} to ${Numbers.short(i.high)})" else ""
    Numbers.short(i.estimate) + known

  private def method(r: SuiteReport): Frag = frag(
    p(
      s"Every program rendered each scene with ${r.seeds} seeds at each sample count, one after " +
        "another in turn, each in a process of its own, after one run that was not counted. " +
        "Times are medians of the wall clock of the whole process; errors are means over the " +
        "seeds. Programs without seeds make the same image every time: their errors have no " +
        s"bars. The runs took ${Numbers.short(r.seconds / 60)} minutes together."
    ),
    p(
      "All images of a scene are compared with one reference; the definitions of the figures are " +
        "in docs/METRICS.md. An error below the noise of the reference is not seen."
    )
  )

  private def commands(r: SuiteReport): Vector[(String, String)] =
    r.scenes.flatMap(_.programs).distinctBy(_.name).map(p => (p.title, p.command))

package candela.report

import scalatags.Text.all.Frag

/** Timeline of a rendering: the phases in one row, the passes of each worker in further rows. */
private[report] final class Timeline(
    phases: Vector[Span],
    passes: Vector[PassSpan],
    width: Double = Timeline.Width
):
  import Svg.*

  private val workers = passes.headOption.fold(0)(_.workers.size)
  private val rows = 1 + workers
  private val height = 34 + rows * Timeline.Row + 26.0
  private val totalSeconds = Math.max(1e-9, phases.map(_.end).maxOption.getOrElse(1.0))
  private val renderBegin = phases.find(_.name == "render").fold(0.0)(_.begin)

  private def pixel(seconds: Double): Double =
    Timeline.LeftMargin + seconds / totalSeconds * (width - Timeline.LeftMargin - 20)

  def svg: Node =
    picture(width, height, "phases and threads")(
      (axis ++ labels ++ phases.zipWithIndex.map(phase) ++ passes.zipWithIndex.flatMap(pass))*
    )

  private def top(row: Int): Double = 8.0 + row * Timeline.Row

  private def labels: Vector[Frag] =
    text(Timeline.LeftMargin - 8, top(0) + 17, "tick", "end")("phases") +:
      Vector.tabulate(workers): i =>
        text(Timeline.LeftMargin - 8, top(i + 1) + 17, "tick", "end")(s"thread ${i + 1}")

  private def box(row: Int, start: Double, end: Double, css: String, words: String): Frag =
    val width = Math.max(0.8, pixel(end) - pixel(start))
    val rect = element(
      "rect",
      "x" -> px(pixel(start)),
      "y" -> px(top(row)),
      "width" -> px(width),
      "height" -> px(Timeline.Row - 6),
      "rx" -> "2",
      "class" -> css
    )(tip(words))
    val name = words.takeWhile(_ != ':')
    if width < 8 * name.length then rect
    else
      val label = text(pixel(start) + width / 2, top(row) + 16, "boxtext", "middle")(name)
      element("g")(rect, label)

  private def phase(span: Span, i: Int): Frag =
    val words = s"${span.name}: ${Numbers.fixed(span.seconds, 3)} s"
    box(0, span.begin, span.end, s"box c${i % LogLogChart.Colors}", words)

  /** A worker that runs out of tasks early leaves a gap before the next pass. */
  private def pass(p: PassSpan, i: Int): Vector[Frag] =
    p.workers.zipWithIndex.map: (busy, worker) =>
      val start = renderBegin + p.begin
      val words = s"${p.samples}: up to ${p.samples} samples per pixel, " +
        s"busy for ${Numbers.fixed(busy, 3)} s of ${Numbers.fixed(p.end - p.begin, 3)} s"
      box(worker + 1, start, Math.min(start + busy, renderBegin + p.end), s"box s${i % 2}", words)

  private def axis: Vector[Frag] =
    val step = Math.pow(10, Math.floor(Math.log10(totalSeconds)))
    val fine = Vector(step / 5, step / 2, step).find(s => totalSeconds / s <= width / 95)
      .getOrElse(step * 2)
    val bottom = top(rows) + 4
    Iterator.iterate(0.0)(_ + fine).takeWhile(_ <= totalSeconds * 1.0001).toVector.flatMap: t =>
      Vector(
        line(pixel(t), top(0), pixel(t), bottom, "grid"),
        text(
          pixel(t),
          bottom + 16,
          "tick",
          "middle"
        )(s"${if t == 0 then "0" else Numbers.tick(t)} s")
      )

private object Timeline:
  val Width = 760.0

  /** For phones. */
  val Narrow = 380.0
  val LeftMargin = 76.0
  val Row = 30.0

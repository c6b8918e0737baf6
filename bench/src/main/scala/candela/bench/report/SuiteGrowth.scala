package candela.bench.report

import candela.measure.LogLogFit
import candela.report.{ChartFrame, ChartGrid, LogLogChart, Mark, Numbers, Page, Series}

import scalatags.Text.all.*

/** What a scene has more of than others of a suite.
  *
  * @param quantity in the plural, such as "spheres"
  * @param size how many
  */
final case class Growth(quantity: String, size: Double)

/** Scenes that differ in the number of one thing, smallest first. */
final class GrowingScenes(val quantity: String, scenes: Vector[SceneResult]):

  val programs: Vector[ProgramResult] = scenes.flatMap(_.programs).distinctBy(_.name)

  /** Seconds of a whole process by size: the median of the longest renderings. */
  def seconds(program: String): Vector[(Double, Double)] =
    figures(program)(_.curve.points.lastOption.map(_.seconds))

  /** Peak memory in bytes by size. */
  def memory(program: String): Vector[(Double, Double)] =
    figures(program)(_.curve.memory.map(_.toDouble))

  private def figures(program: String)(figure: ProgramResult => Option[Double]) =
    for
      s <- scenes
      size <- s.growth.toVector.map(_.size)
      p <- s.programs if p.name == program
      y <- figure(p).toVector
    yield size -> y

  def chart(title: String, frame: ChartFrame)(
      figures: String => Vector[(Double, Double)],
      scale: Double,
      unit: String
  ): LogLogChart =
    val curves = programs.map: p =>
      val marks = figures(p.name).map: (size, y) =>
        val tip = s"${p.title}: ${Numbers.tick(size)} $quantity, ${Numbers.short(y * scale)} $unit"
        Mark(size, y * scale, y * scale, y * scale, tip)
      Series(p.title, p.color, p.isThin, marks)
    LogLogChart(title, quantity, unit, curves, guideSlope = None, frame = frame)

object GrowingScenes:
  /** By what is expected of programs: twice as much takes hardly more than twice as long. */
  val MaxExponent = 1.05

  /** Sizes that an exponent is fitted to: at the smaller ones, time and memory are those of the
    * start.
    */
  private val Fitted = 3

  def of(scenes: Vector[SceneResult]): Vector[GrowingScenes] =
    for quantity <- scenes.flatMap(_.growth.map(_.quantity)).distinct yield
      val growing = scenes.filter(_.growth.exists(_.quantity == quantity))
      GrowingScenes(quantity, growing.sortBy(_.growth.map(_.size)))

  /** The power of the size with which a figure grows: that of the largest sizes. */
  def exponent(figures: Vector[(Double, Double)]): Option[Double] =
    LogLogFit.slope(figures.takeRight(Fitted))

  /** What one more takes: from the smallest to the largest size. */
  def marginal(figures: Vector[(Double, Double)]): Option[Double] =
    for
      (minSize, minFigure) <- figures.headOption
      (maxSize, maxFigure) <- figures.lastOption
      if maxSize > minSize
    yield (maxFigure - minFigure) / (maxSize - minSize)

/** The part of a page about the scenes of a suite that grow. */
private[report] object GrowthPart:
  import GrowingScenes.{marginal, exponent, MaxExponent}

  def apply(scenes: Vector[GrowingScenes]): Frag =
    if scenes.isEmpty then frag()
    else
      frag(
        h2("Growth"),
        p(
          "Time of the whole process and peak memory of scenes that have more and more of one " +
            "thing, both logarithmic: a line that rises as fast as it goes to the right grows " +
            "in proportion. Exponents are those of the three largest sizes; above " +
            s"$MaxExponent, they are marked. Each: what one more takes, from the smallest to " +
            "the largest scene."
        ),
        Page.grid(Head, scenes.flatMap(rows)),
        scenes.map(charts)
      )

  private val Head =
    Vector("what grows", "program", "sizes", "seconds of the largest", "exponent of time") ++
      Vector("µs each", "MB of the largest", "exponent of memory", "bytes each")

  private def rows(g: GrowingScenes): Vector[Vector[Frag]] =
    for p <- g.programs yield
      val (seconds, memory) = (g.seconds(p.name), g.memory(p.name))
      val sizes = seconds.map(_._1)
      def largest(figures: Vector[(Double, Double)], scale: Double) =
        figures.lastOption.fold("–")((_, y) => Numbers.short(y * scale))
      def marginalText(figures: Vector[(Double, Double)], scale: Double) =
        marginal(figures).fold("–")(y => Numbers.short(y * scale))
      Vector(
        g.quantity,
        p.title,
        sizes.headOption.fold("–")(s => s"${Numbers.tick(s)} to ${Numbers.tick(sizes.last)}"),
        largest(seconds, 1),
        exponentWords(seconds),
        marginalText(seconds, 1e6),
        largest(memory, 1e-6),
        exponentWords(memory),
        marginalText(memory, 1)
      ).map(stringFrag)

  private[report] def exponentWords(figures: Vector[(Double, Double)]): String =
    exponent(figures).fold("–"): e =>
      Numbers.fixed(e, 2) + (if e > MaxExponent then " ▲" else "")

  private def charts(g: GrowingScenes): Frag =
    def fittingChart(title: String)(draw: (String, ChartFrame) => LogLogChart): Frag =
      div(
        cls := "card chart",
        Page.fitting(draw(title, ChartFrame.Whole).svg, draw(title, ChartFrame.Narrow).svg)
      )
    frag(
      h3(s"More ${g.quantity}"),
      fittingChart(s"Time by ${g.quantity}")(g.chart(_, _)(g.seconds, 1, "seconds")),
      fittingChart(s"Memory by ${g.quantity}")(g.chart(_, _)(g.memory, 1e-6, "MB"))
    )

  /** Small charts of time and memory side by side. */
  def grid(r: SuiteReport, scenes: Vector[GrowingScenes]): ChartGrid =
    val legend = scenes.flatMap(_.programs).distinctBy(_.name)
      .map(p => Series(p.title, p.color, p.isThin, Vector.empty))
    val panels = scenes.flatMap: g =>
      def note(figures: String => Vector[(Double, Double)]) =
        val firstProgram = g.programs.headOption
        val words =
          firstProgram.flatMap(p => exponent(figures(p.name)).map(p.title -> Numbers.fixed(_, 2)))
        ChartGrid.frame(words.fold("")((title, e) => s"$title: exponent $e"))
      Vector(
        g.chart(s"${g.quantity}: seconds", note(g.seconds))(g.seconds, 1, "seconds"),
        g.chart(s"${g.quantity}: MB", note(g.memory))(g.memory, 1e-6, "MB")
      )
    ChartGrid(
      r.title,
      "Time of the whole process and peak memory, by the number of things in a scene.",
      legend,
      panels,
      columns = 2
    )

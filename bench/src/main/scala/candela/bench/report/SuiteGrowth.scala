package candela.bench.report

import candela.measure.LogLogFit
import candela.report.{ChartFrame, ChartGrid, LogLogChart, Mark, Numbers, Page, Series}

import scalatags.Text.all.*

/** What a scene has more of than others of a suite.
  *
  * @param of   in the plural, such as "spheres"
  * @param size how many
  */
final case class Growth(of: String, size: Double)

/** Scenes that differ in the number of one thing, smallest first. */
final class GrowingScenes(val of: String, scenes: Vector[SceneResult]):

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
        val tip = s"${p.title}: ${Numbers.tick(size)} $of, ${Numbers.short(y * scale)} $unit"
        Mark(size, y * scale, y * scale, y * scale, tip)
      Series(p.title, p.color, p.isThin, marks)
    LogLogChart(title, of, unit, curves, guideSlope = None, frame = frame)

object GrowingScenes:
  /** By what is expected of programs: twice as much takes hardly more than twice as long. */
  val MostExponent = 1.05

  /** Sizes that an exponent is fitted to: at the smaller ones, time and memory are those of the
    * start.
    */
  private val Fitted = 3

  def of(scenes: Vector[SceneResult]): Vector[GrowingScenes] =
    for what <- scenes.flatMap(_.growth.map(_.of)).distinct yield
      val those = scenes.filter(_.growth.exists(_.of == what))
      GrowingScenes(what, those.sortBy(_.growth.map(_.size)))

  /** The power of the size with which a figure grows: that of the largest sizes. */
  def exponent(figures: Vector[(Double, Double)]): Option[Double] =
    LogLogFit.slope(figures.takeRight(Fitted))

  /** What one more takes: from the smallest to the largest size. */
  def each(figures: Vector[(Double, Double)]): Option[Double] =
    for
      (few, less) <- figures.headOption
      (many, more) <- figures.lastOption
      if many > few
    yield (more - less) / (many - few)

/** The part of a page about the scenes of a suite that grow. */
private[report] object GrowthPart:
  import GrowingScenes.{each, exponent, MostExponent}

  def apply(all: Vector[GrowingScenes]): Frag =
    if all.isEmpty then frag()
    else
      frag(
        h2("Growth"),
        p(
          "Time of the whole process and peak memory of scenes that have more and more of one " +
            "thing, both logarithmic: a line that rises as fast as it goes to the right grows " +
            "in proportion. Exponents are those of the three largest sizes; above " +
            s"$MostExponent, they are marked. Each: what one more takes, from the smallest to " +
            "the largest scene."
        ),
        Page.grid(Head, all.flatMap(rows)),
        all.map(charts)
      )

  private val Head =
    Vector("what grows", "program", "sizes", "seconds of the largest", "exponent of time") ++
      Vector("µs each", "MB of the largest", "exponent of memory", "bytes each")

  private def rows(g: GrowingScenes): Vector[Vector[Frag]] =
    for p <- g.programs yield
      val (seconds, memory) = (g.seconds(p.name), g.memory(p.name))
      val sizes = seconds.map(_._1)
      def last(figures: Vector[(Double, Double)], scale: Double) =
        figures.lastOption.fold("–")((_, y) => Numbers.short(y * scale))
      def one(figures: Vector[(Double, Double)], scale: Double) =
        each(figures).fold("–")(y => Numbers.short(y * scale))
      Vector(
        g.of,
        p.title,
        sizes.headOption.fold("–")(s => s"${Numbers.tick(s)} to ${Numbers.tick(sizes.last)}"),
        last(seconds, 1),
        exponentWords(seconds),
        one(seconds, 1e6),
        last(memory, 1e-6),
        exponentWords(memory),
        one(memory, 1)
      ).map(stringFrag)

  private[report] def exponentWords(figures: Vector[(Double, Double)]): String =
    exponent(figures).fold("–"): e =>
      Numbers.fixed(e, 2) + (if e > MostExponent then " ▲" else "")

  private def charts(g: GrowingScenes): Frag =
    def both(title: String)(draw: (String, ChartFrame) => LogLogChart): Frag =
      div(
        cls := "card chart",
        Page.fitting(draw(title, ChartFrame.Whole).svg, draw(title, ChartFrame.Narrow).svg)
      )
    frag(
      h3(s"More ${g.of}"),
      both(s"Time by ${g.of}")(g.chart(_, _)(g.seconds, 1, "seconds")),
      both(s"Memory by ${g.of}")(g.chart(_, _)(g.memory, 1e-6, "MB"))
    )

  /** Small charts of time and memory side by side. */
  def grid(r: SuiteReport, all: Vector[GrowingScenes]): ChartGrid =
    val legend = all.flatMap(_.programs).distinctBy(_.name)
      .map(p => Series(p.title, p.color, p.isThin, Vector.empty))
    val panels = all.flatMap: g =>
      def note(figures: String => Vector[(Double, Double)]) =
        val first = g.programs.headOption
        val words =
          first.flatMap(p => exponent(figures(p.name)).map(p.title -> Numbers.fixed(_, 2)))
        ChartGrid.frame(words.fold("")((title, e) => s"$title: exponent $e"))
      Vector(
        g.chart(s"${g.of}: seconds", note(g.seconds))(g.seconds, 1, "seconds"),
        g.chart(s"${g.of}: MB", note(g.memory))(g.memory, 1e-6, "MB")
      )
    ChartGrid(
      r.title,
      "Time of the whole process and peak memory, by the number of things in a scene.",
      legend,
      panels,
      columns = 2
    )

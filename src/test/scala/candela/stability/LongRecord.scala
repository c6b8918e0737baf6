package candela.stability

import java.nio.file.{Files, Path, StandardOpenOption}

import scala.jdk.CollectionConverters.*

/** What of the long runs is done: a line for each slice, in a file that outlives a stopped run. */
private final class LongRecord(file: Path):
  import LongRecord.*

  def add(line: Line): Unit =
    val _ = Files.writeString(
      file,
      line.text + "\n",
      StandardOpenOption.CREATE,
      StandardOpenOption.APPEND
    )

  private def lines: Seq[Line] =
    if Files.exists(file) then Files.readAllLines(file).asScala.toSeq.map(Line.of) else Seq.empty

  /** How many slices of each case there are; they are begun in order. */
  def slices: Map[String, Int] = lines.groupMapReduce(_.name)(_.slice + 1)(Math.max)

  /** As Markdown; cases of the same kind in one line, with the count that each of them reached. */
  def table(cases: Seq[Case]): String =
    val byName = lines.groupBy(_.name)
    val rows = cases.map(_.kind).distinct.flatMap: kind =>
      val parts = cases.filter(_.kind == kind)
      val done = parts.flatMap(c => byName.getOrElse(c.name, Seq.empty))
      Option.when(done.nonEmpty):
        val each = parts.map(c => byName.getOrElse(c.name, Seq.empty).map(_.trials).sum)
        val failed = done.filterNot(_.held).map(_.name).distinct.size
        val result = if failed == 0 then "held" else s"**$failed failed**"
        val all = if parts.size == 1 then "1" else parts.size.toString
        Seq(
          kind,
          all,
          powers(each.min.toDouble),
          powers(each.sum.toDouble),
          f"${done.map(_.seconds).sum}%.1f",
          result
        ).mkString("| ", " | ", " |")
    (Head ++ rows).map(_ + "\n").mkString

private object LongRecord:
  private val Head = Seq(
    "| what | cases | trials, each at least | trials, all | seconds of processor | result |",
    "|---|---|---|---|---|---|"
  )

  /** @param held whether no trial failed */
  final case class Line(name: String, slice: Int, trials: Long, seconds: Double, held: Boolean):
    def text: String = Seq(slice, trials, seconds, held, name).mkString("\t")

  object Line:
    def of(text: String): Line = text.split("\t", 5) match
      case Array(slice, trials, seconds, held, name) =>
        Line(name, slice.toInt, trials.toLong, seconds.toDouble, held.toBoolean)
      case _ => throw IllegalArgumentException(s"no line of a record: $text")

  /** 1.5·10⁷, or the digits of a small number. */
  private def powers(count: Double): String =
    if count < 10000 then f"$count%.0f"
    else
      val power = Math.floor(Math.log10(count)).toInt
      val rest = f"${count / Math.pow(10, power)}%.2f".stripSuffix("0").stripSuffix("0")
      val digits = power.toString.map(d => "⁰¹²³⁴⁵⁶⁷⁸⁹".charAt(d - '0'))
      if rest == "1." then s"10$digits" else s"${rest.stripSuffix(".")}·10$digits"

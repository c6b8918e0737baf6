package candela.base

import java.io.IOException
import java.nio.file.{Files, InvalidPathException, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** Finds the nearest known name, for "did you mean". */
object Suggest:

  /** The known name with the smallest edit distance to `name`, ignoring case, if it is small enough
    * for a typo: at most a third of the longer name's length.
    */
  def nearest(name: String, known: Iterable[String]): Option[String] =
    def most(k: String) = math.max(1, math.max(name.length, k.length) / 3)
    val lower = name.toLowerCase
    known.toVector.sorted
      // The distance is at least the difference in length, so most names need no table.
      .filter(k => math.abs(k.length - name.length) <= most(k))
      .map(k => (k, distance(lower, k.toLowerCase)))
      .filter((k, d) => d <= most(k))
      .minByOption(_._2)
      .map(_._1)

  /** Help text: the nearest name, else all known names. */
  def help(name: String, known: Iterable[String]): Option[String] =
    nearest(name, known).map(k => s"did you mean `$k`?").orElse {
      Option.when(known.nonEmpty)(known.toVector.sorted.distinct.mkString("known: ", ", ", ""))
    }

  /** The nearest name in the folder of a missing file.
    *
    * @param at creates the path; fails for invalid names, such as those with a zero byte
    */
  def file(at: => Path): Option[String] =
    try near(at)
    catch case _: InvalidPathException | _: IOException => None

  private def near(path: Path): Option[String] =
    val folder = Option(path.toAbsolutePath.getParent).filter(Files.isDirectory(_))
    val names = folder.toVector.flatMap: f =>
      Using.resource(Files.list(f))(_.iterator.asScala.map(_.getFileName.toString).toVector)
    val name = Option(path.getFileName).map(_.toString)
    name.flatMap(nearest(_, names)).map(n => s"did you mean `$n`?")

  /** Edit distance (insertion, deletion, substitution, transposition of neighbours) from `a` to
    * `b`.
    *
    * Source: Damerau, "A technique for computer detection and correction of spelling errors", CACM
    * 7(3), 1964 (the restricted form).
    */
  def distance(a: String, b: String): Int =
    val d = Array.ofDim[Int](a.length + 1, b.length + 1)
    loop(a.length + 1)(i => d(i)(0) = i)
    loop(b.length + 1)(j => d(0)(j) = j)
    for i <- 1 to a.length; j <- 1 to b.length do
      val replace = d(i - 1)(j - 1) + (if a(i - 1) == b(j - 1) then 0 else 1)
      d(i)(j) = math.min(replace, math.min(d(i - 1)(j), d(i)(j - 1)) + 1)
      val swapped = i > 1 && j > 1 && a(i - 1) == b(j - 2) && a(i - 2) == b(j - 1)
      if swapped then d(i)(j) = math.min(d(i)(j), d(i - 2)(j - 2) + 1)
    d(a.length)(b.length)

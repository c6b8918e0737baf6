package candela.bench.suite

import java.nio.file.Path

import scala.util.matching.Regex

/** Replaces this machine's folders in published texts by the environment variables that locate
  * them.
  *
  * @param values values of environment variables, by name
  * @param folders other prefixes and their replacements
  */
final class PublicNames(values: Map[String, String], folders: Vector[(String, String)]):

  /** @param first variables preferred among those of equal value */
  def of(text: String, first: Vector[String] = Vector.empty): String =
    val (preferred, remaining) = values.toVector.sorted.partition((name, _) => first.contains(name))
    val variables = (preferred ++ remaining).filter(_._2.nonEmpty).distinctBy(_._2)
    // Longest first, because one may be a prefix of another.
    val named = variables.sortBy(-_._2.length).foldLeft(text):
      case (t, (name, value)) =>
        // Matches neither part of a longer name, nor one that begins elsewhere.
        val pattern = s"(?<![\\w/.-])${Regex.quote(value)}(?![\\w.-])"
        pattern.r.replaceAllIn(t, Regex.quoteReplacement("$" + name))
    folders.foldLeft(named):
      case (t, (folder, instead)) => t.replace(folder, instead)

object PublicNames:

  /** Names for all variables that a suite needs. */
  def of(suite: Suite, scratch: Path): PublicNames =
    val variables = suite.programs.flatMap(_.needs) ++ suite.scenes.flatMap(_.needs)
    val values = variables.distinct.flatMap(name => sys.env.get(name).map(name -> _))
    val separator = java.io.File.separator
    val prefixes = Vector(scratch -> "", Path.of("").toAbsolutePath -> "")
      .map((folder, instead) => s"$folder$separator" -> instead)
    val home = Option(System.getProperty("user.home")).filter(_.length > 1)
    PublicNames(values.toMap, prefixes ++ home.map(h => s"$h$separator" -> s"~$separator"))

package candela.api

import candela.diagnostics.SourcePos
import java.util.{Locale, Optional}

import scala.jdk.OptionConverters.*

/** An error or warning about a scene or a setting. Immutable. */
final class Problem private[api] (core: candela.diagnostics.Problem):
  private def pos: Option[SourcePos] = core.pos

  def severity: Severity = core.severity match
    case candela.diagnostics.Severity.Warning => Severity.Warning
    case candela.diagnostics.Severity.Error => Severity.Error

  /** Identifies meaning and cure, such as `E0201`; `candela explain` prints both. */
  def number: String = core.code.word

  /** The message, on one line. */
  def message: String = core.message

  /** The cure, if one is known. */
  def help: Optional[String] = core.help.toJava

  /** The file, as it was named; in a scene built in code, the source file of the call. */
  def file: Optional[String] = pos.map(_.file).toJava

  /** Line in the file, from 1; 0 if there is no file. */
  def line: Int = pos.fold(0)(_.line)

  /** Column in the line, from 1; 0 if there is no file; 1 in a scene built in code. */
  def column: Int = pos.fold(0)(_.column)

  /** The text of the line, if it is known. */
  def excerpt: Optional[String] = core.excerpt.toJava

  /** On one line: `a.pbrt:3:7: error: unknown shape "spher"; did you mean "sphere"? [E0401]`. */
  override def toString: String =
    val prefix = pos.fold("")(p => s"$p: ")
    val cure = core.help.fold("")(h => s"; $h")
    s"$prefix${severity.toString.toLowerCase(Locale.ROOT)}: $message$cure [$number]"

/** A scene that can't be rendered, or an invalid setting. Its message is that of the first error,
  * with its number, and says how many others there are. [[Candela.read]] and [[Scene.check]] return
  * problems instead of throwing them.
  */
final class SceneException private[api] (
    private[api] val coreProblems: Vector[candela.diagnostics.Problem]
) extends RuntimeException(Problems.summary(coreProblems)):

  /** All of them, errors and warnings, in the order of the scene; at least one. */
  def problems: java.util.List[Problem] = Problems.ofCore(coreProblems)

package candela.api

import candela.base.{Code, Keep}

import candela.build.ReadSettings as CoreSettings
import candela.job.{Preparation, TextForm}
import candela.scenefile.Dialect

import java.time.Duration

/** How scenes are read. Immutable: each method returns another value.
  *
  * Scenes that are read by one value, or by values made from it, share what they have in common
  * when they are prepared: meshes, textures, acceleration structures.
  */
final class ReadSettings private (private[api] val of: Preparation):
  private def reading(change: CoreSettings => CoreSettings): ReadSettings =
    val settings = of.settings
    new ReadSettings(of.copy(settings = settings.copy(reading = change(settings.reading))))

  /** Reads pbrt's files as of the version `v2`, `v3` or `v4`, whatever they seem to be of. */
  def withDialect(name: String): ReadSettings =
    val form = summon[TextForm[Dialect]]
    val dialect = form.read(name).getOrElse:
      Problems.fail(
        Code.UnknownEntry,
        s"unknown dialect `$name`",
        Some(s"expected ${form.expected}")
      )
    reading(_.copy(dialect = Some(dialect)))

  /** Gives a parameter of a Mitsuba scene, `$name` in its text, another value than its default. */
  def withDefine(name: String, value: String): ReadSettings =
    reading(r => r.copy(defines = r.defines + (name -> value)))

  /** Replaces what is missing, such as textures and meshes, by placeholders, with warnings. */
  def withPlaceholders: ReadSettings = reading(_.copy(keepGoing = true))

  /** Reads scenes of strangers: they read no files but those beside them or below, and have limits
    * of size, depth and count.
    */
  def withSandbox: ReadSettings = new ReadSettings(of.copy(limits = of.limits.copy(sandbox = true)))

  /** Ends reading and building of a scene with an error after a time, which begins now. */
  def withTimeLimit(time: Duration): ReadSettings =
    new ReadSettings(of.copy(limits =
      of.limits.copy(endsAt = Some(System.nanoTime + time.toNanos))
    ))

  /** Which of the worlds of a file of pbrt-v2 or v3 to read, from 0. */
  def withWorld(number: Int): ReadSettings = new ReadSettings(of.copy(world = number))

object ReadSettings:
  /** The usual way. */
  def apply(): ReadSettings = new ReadSettings(Preparation(keep = Keep()))

  /** The usual way, for Java and Kotlin. */
  def create(): ReadSettings = apply()

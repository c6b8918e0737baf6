package candela.api

import candela.base.{Code, Keep}

import candela.job.{Preparation, TextForm}
import candela.scenefile.Dialect
import candela.settings.ReadSettings as CoreSettings

import java.time.Duration

/** How scenes are read. Immutable: each method returns a new value.
  *
  * Scenes that are read with one value, or with values derived from it, share meshes, textures and
  * acceleration structures.
  */
final class ReadSettings private (private[api] val of: Preparation):
  private def reading(change: CoreSettings => CoreSettings): ReadSettings =
    val settings = of.settings
    new ReadSettings(of.copy(settings = settings.copy(reading = change(settings.reading))))

  /** Sets the pbrt version, `v2`, `v3` or `v4`, instead of detecting it. */
  def withDialect(name: String): ReadSettings =
    val form = summon[TextForm[Dialect]]
    val dialect = form.read(name).getOrElse:
      Problems.fail(
        Code.UnknownEntry,
        s"unknown dialect `$name`",
        Some(s"expected ${form.expected}")
      )
    reading(_.copy(dialect = Some(dialect)))

  /** Sets the parameter `$name` of a Mitsuba scene. */
  def withDefine(name: String, value: String): ReadSettings =
    reading(r => r.copy(defines = r.defines + (name -> value)))

  /** Replaces missing textures, meshes and the like by placeholders, with warnings. */
  def withPlaceholders: ReadSettings = reading(_.copy(keepGoing = true))

  /** For untrusted scenes: they can read only files of their own folder, and have limits of size,
    * depth and count.
    */
  def withSandbox: ReadSettings = new ReadSettings(of.copy(limits = of.limits.copy(sandbox = true)))

  /** Ends reading and building of a scene with an error after a time, counted from now. */
  def withTimeLimit(time: Duration): ReadSettings =
    new ReadSettings(of.copy(limits =
      of.limits.copy(endsAt = Some(System.nanoTime + time.toNanos))
    ))

  /** Which of the worlds of a file of pbrt-v2 or v3 to read, from 0. */
  def withWorld(number: Int): ReadSettings = new ReadSettings(of.copy(world = number))

object ReadSettings:
  /** The default settings. */
  def apply(): ReadSettings = new ReadSettings(Preparation(keep = Keep()))

  /** The default settings, for Java and Kotlin. */
  def create(): ReadSettings = apply()

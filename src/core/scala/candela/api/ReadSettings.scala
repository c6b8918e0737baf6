package candela.api

import candela.diagnostics.Code
import candela.io.Keep
import candela.scenefile.Dialect
import candela.settings.{BuildControl, ReadSettings as CoreSettings, TextForm}

import java.time.Duration

/** How scenes are read. Immutable: each method returns a new value.
  *
  * Scenes that are read with one value, or with values derived from it, share meshes, textures and
  * acceleration structures.
  */
final class ReadSettings private (
    private[api] val core: CoreSettings,
    private[api] val control: BuildControl
):
  private def controlled(other: BuildControl): ReadSettings = new ReadSettings(core, other)

  /** Sets the pbrt version, `v2`, `v3` or `v4`, instead of detecting it. */
  def withDialect(name: String): ReadSettings =
    val form = summon[TextForm[Dialect]]
    val dialect = form.read(name).getOrElse:
      Problems.fail(
        Code.UnknownEntry,
        s"unknown dialect `$name`",
        Some(s"expected ${form.expected}")
      )
    new ReadSettings(core.copy(dialect = Some(dialect)), control)

  /** Sets the parameter `$name` of a Mitsuba scene. */
  def withDefine(name: String, value: String): ReadSettings =
    new ReadSettings(core.copy(defines = core.defines + (name -> value)), control)

  /** Replaces missing textures, meshes and the like by placeholders, with warnings. */
  def withPlaceholders: ReadSettings = new ReadSettings(core.copy(keepGoing = true), control)

  /** For untrusted scenes: they can read only files of their own folder, and have limits of size,
    * depth and count.
    */
  def withSandbox: ReadSettings =
    controlled(control.copy(limits = control.limits.copy(sandbox = true)))

  /** Ends reading and building of a scene with an error after a time, counted from now. */
  def withTimeLimit(time: Duration): ReadSettings =
    val limits = control.limits.copy(endsAt = Some(System.nanoTime + time.toNanos))
    controlled(control.copy(limits = limits))

  /** Which of the worlds of a file of pbrt-v2 or v3 to read, from 0. */
  def withWorld(number: Int): ReadSettings = controlled(control.copy(world = Some(number)))

  /** As `ReadSettings(dialect v3, sandbox)`: what is not the default. */
  override def toString: String =
    val defines = core.defines.toVector.sorted.map((name, value) => s"$name=$value")
    val flags = Vector(
      core.dialect.map(d => s"dialect ${d.toString.toLowerCase}"),
      Option.when(core.keepGoing)("placeholders"),
      Option.when(control.limits.sandbox)("sandbox"),
      control.limits.endsAt.map(_ => "time limit"),
      control.world.map(n => s"world $n")
    )
    Shown("ReadSettings", (defines ++ flags.flatten)*)

object ReadSettings:
  /** The default settings. */
  def apply(): ReadSettings = new ReadSettings(CoreSettings(), BuildControl(cache = Keep()))

  /** The default settings, for Java and Kotlin. */
  def create(): ReadSettings = apply()

package candela.api

import candela.diagnostics.{Code, Limit, Suggest}
import candela.io.Keep
import candela.scenefile.Dialect
import candela.settings.{
  BuildControl, ReadSettings as CoreSettings, RenderSettings as CoreRendering, SceneLimits, Sensors,
  SettingsCodec, TextForm
}

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

  /** Ends reading, building and rendering of a scene with an error after a time, counted from the
    * call that reads it. A sandbox alone limits no time.
    */
  def withTimeLimit(time: Duration): ReadSettings =
    val seconds = Times.positive("the time limit", time)
    limited(Limit.Time, Some(Math.max(1, (seconds * 1000).toLong)))

  /** Sets a limit as `--limit` does: `withLimit("pixels", "20M")`; `none` lifts one. The names are
    * `files`, `bytes`, `triangles`, `pixels`, `depth`, `samples` and `time` ([[withTimeLimit]]).
    */
  def withLimit(name: String, value: String): ReadSettings =
    val limit = Limit.values.find(_.word == name).getOrElse:
      val help = Suggest.help(name, Limit.values.map(_.word).toVector)
      Problems.fail(Code.UnknownEntry, s"unknown limit `$name`", help)
    val form = SceneLimits.form(limit)
    def bound = form.read(value).getOrElse:
      Problems.fail(
        Code.OptionValue,
        s"wrong limit of `$name`: `$value`",
        Some(s"expected ${form.expected}, or none")
      )
    limited(limit, Option.unless(value == "none")(bound))

  private def limited(limit: Limit, bound: Option[Long]): ReadSettings =
    val changed = control.limits.changed + (limit -> bound)
    controlled(control.copy(limits = control.limits.copy(changed = changed)))

  /** These, whose time begins now. */
  private[api] def started: ReadSettings =
    controlled(control.copy(limits = control.limits.started))

  /** Sets a command-line option of reading scenes by its name, without `--`:
    * `withOption("resolution", "50%")`, `sensor`, `light`, `background`, `at`.
    */
  def withOption(name: String, value: String): ReadSettings =
    val changed =
      NamedOptions.change(name, Some(value), isRead = true)(CoreRendering(reading = core)).reading
    if changed.sensors.contains(Sensors.All) || changed.model.hasSeveralImages then
      Problems.fail(Code.OptionMisfit, s"`$name` $value is for several images; a scene has one")
    new ReadSettings(changed, control)

  /** Which of the worlds of a file of pbrt-v2 or v3 to read, from 0; if it is not given, the first,
    * with a warning if there are others. One that the file has not is an error.
    */
  def withWorld(number: Int): ReadSettings =
    if number < 0 then
      Problems.fail(Code.OptionValue, s"`number` must be at least 0, found $number")
    controlled(control.copy(world = Some(number)))

  /** As `ReadSettings(--dialect v3, sandbox)`: what is not the default. */
  override def toString: String =
    val words = SettingsCodec.words(CoreRendering(reading = core)).mkString(" ")
    val flags = Vector(
      Some(words),
      Option.when(control.limits.sandbox)("sandbox"),
      Option.when(control.limits.changed.nonEmpty)("limits"),
      control.world.map(n => s"world $n")
    )
    Shown("ReadSettings", flags.flatten*)

object ReadSettings:
  /** The default settings. */
  def apply(): ReadSettings =
    new ReadSettings(CoreSettings(), BuildControl(world = None, cache = Keep()))

  /** The default settings, for Java and Kotlin. */
  def create(): ReadSettings = apply()

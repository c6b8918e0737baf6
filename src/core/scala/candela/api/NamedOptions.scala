package candela.api

import candela.diagnostics.{Code, Problem as CoreProblem, SourcePos, Suggest}
import candela.settings.{RenderSettings as CoreSettings, SettingsTable}

/** Options of command lines, by their names. */
private[api] object NamedOptions:
  private val default = CoreSettings()

  /** Settings without effect here, and what to do instead. */
  private val ofProgram =
    val curve = "a RenderListener's `passed` has the image at 1, 2, 4, 8, … samples per pixel"
    Map(
      "mse-reference-image" -> curve,
      "mse-reference-out" -> curve,
      "turntable" -> "`scene.edit()` turns the camera: one scene for each image"
    )

  private def idle(name: String): String =
    s"setting `$name` is of the program, and does nothing in the library"

  /** A warning of a scene's option without effect here. */
  def idle(name: String, at: SourcePos): Option[CoreProblem] =
    ofProgram.get(name).map: help =>
      CoreProblem.warning(Code.OptionMisfit, at, idle(name), Some(help))

  /** What an option changes.
    *
    * @param isRead whether it must be, or must not be, of how scenes are read
    * @throws SceneException if there is none, it has no such value, or is the program's alone
    */
  def change(name: String, value: Option[String], isRead: Boolean): CoreSettings => CoreSettings =
    val setting = SettingsTable.named(name).getOrElse:
      val help = Suggest.help(name, SettingsTable.all.map(_.name))
      Problems.fail(Code.UnknownEntry, s"unknown setting `$name`", help)
    if setting.takesValue != value.isDefined then
      val actual = if value.isDefined then "found one" else "found none"
      val wanted = if setting.takesValue then "a value" else "no value"
      Problems.fail(Code.OptionValue, s"setting `$name` takes $wanted, $actual")
    for help <- ofProgram.get(name) do Problems.fail(Code.OptionMisfit, idle(name), Some(help))
    val text = value.getOrElse("")
    val changed = setting.change(text).getOrElse:
      Problems.fail(
        Code.OptionValue,
        s"`$name` must be ${setting.wanted(text)}, found `${setting.wrong(text)}`"
      )
    if (changed(default).reading != default.reading) != isRead then
      val (owner, reason) =
        if isRead then ("RenderSettings", "of rendering scenes")
        else ("ReadSettings", "of reading scenes")
      Problems.fail(Code.OptionMisfit, s"setting `$name` is $reason", Some(s"it belongs to $owner"))
    changed

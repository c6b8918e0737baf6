package candela.scenefile

import candela.base.{Problem, SceneError, SourcePos, Suggest}

/** The names that v4's `Option` knows, with the types of their values. */
object SceneOptions:

  private val Types: Map[String, ParamType] =
    val bools = "disablepixeljitter disabletexturefiltering disablewavelengthjitter forcediffuse " +
      "pixelstats wavefront"
    val strings = "msereferenceimage msereferenceout rendercoordsys"
    bools.split(' ').map(_ -> ParamType.Bool).toMap ++
      strings.split(' ').map(_ -> ParamType.String) ++
      Map("displacementedgescale" -> ParamType.Float, "seed" -> ParamType.Integer)

  /** The name without its type, capitals, `-` and `_`: all spellings of an option are one. */
  def plain(written: String): String =
    written.trim.split("[ \t]+").last.toLowerCase.filterNot(c => c == '-' || c == '_')

  def typeOf(written: String, at: SourcePos): ParamType =
    val name = plain(written)
    Types.getOrElse(
      name,
      throw SceneError(
        Problem.error(at, s"no option is called `$name`", Suggest.help(name, Types.keys))
      )
    )

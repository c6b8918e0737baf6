package candela.build

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import candela.lights.LightGroups
import candela.scenefile.Declaration
import candela.settings.LightGrouping

/** The light groups of a scene. */
object LightGroupBuilder:
  /** Each group has three channels, and scenes may have thousands of lights. */
  val MaxGroups = 100

  private val Rest = "default"
  private val Media = "media"

  /** @param statements of each light
    * @param glows      whether media emit light, too
    * @param warn       is told of groups without lights
    */
  def groups(
      grouping: LightGrouping,
      statements: Vector[Declaration],
      glows: Boolean,
      warn: String => Unit
  ): LightGroups =
    val named = names(statements)
    val lights = statements.map(d => Light(d.name, named(d))) ++
      Option.when(glows)(Light(Media, Media))
    val groupNames = lights.map(groupOf(grouping, lights))
    val distinctNames = groupNames.distinct
    grouping match
      case LightGrouping.Named(groups) =>
        for (name, _) <- groups if !distinctNames.contains(name) do
          warn(s"--light-groups: `$name` gets no light, as other groups name its lights")
      case _ => ()
    if distinctNames.size > MaxGroups then
      throw error(
        Code.OptionMisfit,
        s"the scene has ${distinctNames.size} light groups, more than $MaxGroups",
        Some("--light-groups type merges those of equal types; NAME=LIGHT+LIGHT,… names them")
      )
    val indices = groupNames.map(distinctNames.indexOf).toArray
    LightGroups(distinctNames, indices.take(statements.size), if glows then indices.last else -1)

  private final case class Light(kind: String, name: String)

  private def groupOf(grouping: LightGrouping, all: Vector[Light]): Light => String =
    grouping match
      case LightGrouping.Statements => _.name
      case LightGrouping.Types => _.kind
      case LightGrouping.Named(groups) =>
        val names = all.flatMap(l => Vector(l.kind, l.name)).distinct
        for (_, members) <- groups; member <- members if !names.contains(member) do
          throw error(
            Code.UnknownEntry,
            s"--light-groups: no light `$member`",
            Suggest.help(member, names)
          )
        light =>
          groups
            .collectFirst { case (name, in) if in.contains(light.name) => name }
            .orElse(groups.collectFirst { case (name, in) if in.contains(light.kind) => name })
            .getOrElse(Rest)

  private def error(code: Code, message: String, help: Option[String]): SceneError =
    SceneError(Problem.general(code, message, help))

  /** The shortest names that tell all statements apart. */
  private def names(statements: Vector[Declaration]): Declaration => String =
    val declarations = statements.distinctBy(d => (d.name, d.pos))
    val ways = Vector[Declaration => String](
      d => s"${d.name}_${d.pos.line}",
      d => s"${d.name}_${d.pos.line}_${d.pos.column}",
      d => s"${d.name}_${file(d)}_${d.pos.line}_${d.pos.column}"
    )
    ways.find(way => declarations.map(way).distinct.size == declarations.size).getOrElse(ways.last)

  /** Relative to the scene's folder, as far as channel names allow. */
  private def file(d: Declaration): String =
    StatementName.file(d).stripSuffix(".pbrt").replaceAll("[^A-Za-z0-9]+", "_")

package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, SourcePos, Suggest}
import scala.jdk.CollectionConverters.*

import candela.math.Transform

import java.util.Locale

/** Valid position of a directive: before `WorldBegin`, after it, or both. */
enum Section:
  case Options, World, Anywhere

/** A directive.
  *
  * @param usage arguments, for messages
  */
final class Directive(val name: String, val usage: String, val section: Section)(
    val run: (Arguments, SceneWriter) => Unit
):
  /** The error if the directive is not allowed here, before or after `WorldBegin`. */
  def misplaced(worldBegin: Option[SourcePos]): Option[String] = section match
    case Section.Anywhere => None
    case Section.World =>
      if worldBegin.isEmpty then Some(s"$name must be after WorldBegin") else None
    case Section.Options =>
      worldBegin.map: begin =>
        if name == "WorldBegin" then s"WorldBegin is repeated; the first is at $begin"
        else s"$name must be before WorldBegin (at $begin)"

/** All directives of all dialects. */
object Directives:
  import Section.*

  private val NameAndParams = "\"name\" parameters"

  private def option(name: String): Directive =
    Directive(name, NameAndParams, Options)((in, scene) => scene.option(name, in.named()))

  private def declaration(name: String, usage: String = NameAndParams)(
      run: (SceneWriter, Named) => Unit
  ): Directive =
    Directive(name, usage, World)((in, scene) => run(scene, in.named()))

  private val options: List[Directive] = List(
    option("Accelerator"),
    option("Camera"),
    option("Film"),
    option("Integrator"),
    option("PixelFilter"),
    option("Renderer"),
    option("Sampler"),
    option("SurfaceIntegrator"),
    option("VolumeIntegrator"),
    Directive("TransformTimes", "start end", Options): (in, scene) =>
      val times = in.numbers(2)
      scene.transformTimes(times(0).toFloat, times(1).toFloat)
    ,
    Directive("WorldBegin", "", Options)((in, scene) => scene.beginWorld(in.pos))
  )

  private val transforms: List[Directive] = List(
    Directive("Identity", "", Anywhere)((_, scene) => scene.transform(_ => Transform.Identity)),
    Directive("Translate", "x y z", Anywhere): (in, scene) =>
      val v = in.numbers(3)
      scene.transform(_ * Transform.translate(v(0), v(1), v(2)))
    ,
    Directive("Scale", "x y z", Anywhere): (in, scene) =>
      val v = in.numbers(3)
      val scale = orFlat(in, "zero scale")(Transform.scale(v(0), v(1), v(2))):
        Transform.flat(Vector[Double](v(0), 0, 0, 0, 0, v(1), 0, 0, 0, 0, v(2), 0, 0, 0, 0, 1))
      scene.transform(_ * scale)
    ,
    Directive("Rotate", "degrees axis.x axis.y axis.z", Anywhere): (in, scene) =>
      val v = in.numbers(4)
      val rotation = Transform.rotate(v(0), v(1), v(2), v(3)).getOrElse(noAxis(in, scene.inV4))
      scene.transform(_ * rotation)
    ,
    Directive("LookAt", "eye.x eye.y eye.z  look.x look.y look.z  up.x up.y up.z", Anywhere):
      (in, scene) =>
        val v = in.numbers(9).toVector
        val (eye, target) = (v.take(3), v.slice(3, 6))
        val view = Transform.lookAt(eye, target, v.drop(6)).getOrElse:
          if eye == target then noDirection(in, scene.inV4) else noUp(in, scene.inV4)
        scene.transform(_ * view)
    ,
    Directive("Transform", "[ 16 numbers in column order ]", Anywhere): (in, scene) =>
      val matrix = matrixOf(in)
      scene.transform(_ => matrix)
    ,
    Directive("ConcatTransform", "[ 16 numbers in column order ]", Anywhere): (in, scene) =>
      val matrix = matrixOf(in)
      scene.transform(_ * matrix)
    ,
    Directive("CoordinateSystem", "\"name\"", Anywhere): (in, scene) =>
      scene.nameCoordinates(in.quoted("a name")._1),
    Directive("CoordSysTransform", "\"name\"", Anywhere): (in, scene) =>
      val (name, at) = in.quoted("a name")
      scene.useCoordinates(name, at)
    ,
    Directive("ActiveTransform", "All | StartTime | EndTime", Anywhere): (in, scene) =>
      scene.activate(ActiveTransform.valueOf(in.word("All", "StartTime", "EndTime")))
  )

  /** pbrt-v4 goes on with NaN, and all that the transform places is invisible; v3 stops. */
  private def noAxis(in: Arguments, inV4: Boolean): Transform =
    val message = "transform can't be inverted: axis of length 0"
    if inV4 then
      in.report(Problem.warning(
        Code.Transform,
        in.pos,
        s"$message; what it places is invisible, as in pbrt-v4"
      ))
      Transform.nowhere
    else
      in.report(Problem.warning(Code.Transform, in.pos, s"$message; the rotation is ignored"))
      Transform.Identity

  private def noDirection(in: Arguments, inV4: Boolean): Transform =
    val message = "transform can't be inverted: eye equals look-at point"
    if !inV4 then throw SceneError(Problem.error(Code.Transform, in.pos, message))
    in.report(Problem.warning(
      Code.Transform,
      in.pos,
      s"$message; what it places is invisible, as in pbrt-v4"
    ))
    Transform.nowhere

  /** pbrt-v2 and v3 go on, v4 stops. */
  private def noUp(in: Arguments, inV4: Boolean): Transform =
    val message = "transform can't be inverted: up is zero or parallel to the view direction"
    if inV4 then throw SceneError(Problem.error(Code.Transform, in.pos, message))
    in.report(Problem.warning(Code.Transform, in.pos, s"$message; LookAt is ignored, as pbrt does"))
    Transform.Identity

  /** pbrt accepts transforms that flatten meshes, and some scenes use them. */
  private def orFlat(in: Arguments, reason: String)(t: Option[Transform])(
      flat: => Transform
  ): Transform =
    t.getOrElse:
      val message =
        s"singular transform ($reason); meshes are flattened, everything else it places is ignored"
      in.report(Problem.warning(Code.Transform, in.pos, message))
      flat

  private def matrixOf(in: Arguments): Transform =
    val columns = in.matrix().toIndexedSeq
    orFlat(in, "matrix of determinant 0")(Transform.fromColumns(columns)):
      Transform.flat(Vector.tabulate(16)(i => columns(i % 4 * 4 + i / 4)))

  private val blocks: List[Directive] = List(
    Directive("AttributeBegin", "", World): (in, scene) =>
      scene.blocks.start("AttributeBegin", in.pos),
    Directive("AttributeEnd", "", World)((in, scene) => scene.blocks.end("AttributeBegin", in.pos)),
    Directive("TransformBegin", "", World): (in, scene) =>
      scene.blocks.start("TransformBegin", in.pos),
    Directive("TransformEnd", "", World)((in, scene) => scene.blocks.end("TransformBegin", in.pos)),
    Directive("ObjectBegin", "\"name\"", World): (in, scene) =>
      scene.beginObject(in.quoted("a name")._1, in.pos),
    Directive("ObjectEnd", "", World)((in, scene) => scene.endObject(in.pos)),
    Directive("ObjectInstance", "\"name\"", World): (in, scene) =>
      val (name, at) = in.quoted("an object's name")
      scene.instance(name, at)
    ,
    Directive("WorldEnd", "", World)((in, scene) => scene.worldEnd = Some(in.pos))
  )

  private val world: List[Directive] = List(
    declaration("AreaLightSource")(_.areaLight(_)),
    declaration("LightSource")(_.light(_)),
    declaration("MakeNamedMaterial", "\"name\" \"string type\" \"…\" parameters")(
      _.makeNamedMaterial(_)
    ),
    declaration("Material")(_.material(_)),
    declaration("Shape")(_.shape(_)),
    declaration("Volume")(_.volume(_)),
    Directive("NamedMaterial", "\"name\"", World): (in, scene) =>
      val (name, at) = in.quoted("a material's name")
      scene.namedMaterial(name, at)
    ,
    Directive("ReverseOrientation", "", World)((_, scene) => scene.reverseOrientation()),
    Directive("Texture", "\"name\" \"float|spectrum\" \"class\" parameters", World): (in, scene) =>
      val (name, at) = in.quoted("a name")
      val (valueType, typeAt) = in.quoted("`float` or `spectrum`")
      val texture = in.named("a class")
      scene.texture(name, at, textureType(valueType, typeAt), texture)
  )

  private def textureType(written: String, at: SourcePos): String = written match
    case "float" | "spectrum" => written
    case "color" => "spectrum"
    case _ =>
      val help = Suggest.help(written, List("float", "spectrum", "color"))
      throw SceneError(Problem.error(
        Code.UnknownType,
        at,
        s"unknown texture value type `$written`",
        help
      ))

  /** Names of colour spaces, in lower case. */
  private[candela] val ColorSpaces: List[String] = List("srgb", "dci-p3", "rec2020", "aces2065-1")

  private val miscellaneous: List[Directive] = List(
    Directive("Attribute", "\"target\" parameters", Anywhere): (in, scene) =>
      val defaults = in.named("a target")
      scene.attribute(defaults.name, defaults.pos, defaults.params)
    ,
    Directive("ColorSpace", "\"name\"", Anywhere): (in, scene) =>
      val (name, at) = in.quoted("a name")
      if ColorSpaces.contains(name.toLowerCase(Locale.ROOT)) then
        scene.colorSpace(name.toLowerCase(Locale.ROOT))
      else
        val help = Suggest.help(name, ColorSpaces)
        in.report(Problem.error(Code.UnknownSystem, at, s"unknown colour space `$name`", help))
    ,
    Directive("Import", "\"file\"", World): (in, scene) =>
      val (file, at) = in.quoted("a file name")
      scene.blocks.isolated(in.include(file, at)).foreach(in.report)
    ,
    Directive("Include", "\"file\"", Anywhere): (in, _) =>
      val (file, at) = in.quoted("a file name")
      in.include(file, at)
    ,
    Directive("MakeNamedMedium", "\"name\" \"string type\" \"…\" parameters", Anywhere):
      (in, scene) => scene.makeNamedMedium(in.named())
    ,
    Directive("MediumInterface", "\"inside\" \"outside\"", Anywhere): (in, scene) =>
      val (inside, _) = in.quoted("a medium's name")
      scene.mediumInterface(inside, in.another.getOrElse(inside))
    ,
    Directive("Option", "\"name\" value", Anywhere): (in, scene) =>
      val (name, at) = in.quoted("a name")
      scene.option(in.value(SceneOptions.typeOf(name, at), SceneOptions.plain(name)))
  )

  val all: Map[String, Directive] =
    (options ++ transforms ++ blocks ++ world ++ miscellaneous).map(d => d.name -> d).toMap

  private val byName = java.util.HashMap(all.asJava)

  /** The directive of a word, or null: scenes have millions. */
  private[scenefile] def named(word: String): Directive | Null = byName.get(word)

/** Names of v4's `Option` statement, with the types of their values. */
object SceneOptions:

  private val Types: Map[String, ParamType] =
    val bools = "disablepixeljitter disabletexturefiltering disablewavelengthjitter forcediffuse " +
      "pixelstats wavefront"
    val strings = "msereferenceimage msereferenceout rendercoordsys"
    bools.split(' ').map(_ -> ParamType.Bool).toMap ++
      strings.split(' ').map(_ -> ParamType.String) ++
      Map("displacementedgescale" -> ParamType.Float, "seed" -> ParamType.Integer)

  /** The name without type, capitals, `-` and `_`: an option's spellings are equivalent. */
  def plain(written: String): String =
    written.trim.split("[ \t]+").last.toLowerCase(Locale.ROOT).filterNot(c => c == '-' || c == '_')

  def typeOf(written: String, at: SourcePos): ParamType =
    val name = plain(written)
    Types.getOrElse(
      name,
      throw SceneError(
        Problem.error(
          Code.UnknownSystem,
          at,
          s"unknown option `$name`",
          Suggest.help(name, Types.keys)
        )
      )
    )

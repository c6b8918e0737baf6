package candela.api

import candela.diagnostics.SourcePos
import candela.io.SceneFolder
import candela.job.FilmHeaders
import candela.math.Transform
import candela.mitsuba.SensorAxes
import candela.scenefile.{
  AnimatedTransform, Dialect, GivenStatement, GraphicsState, InstanceList, Param, StatementRunner
}

import java.util.{Locale, Objects}
import java.util.function.UnaryOperator

/** Builds a scene from statements of pbrt-v4, or edits another scene. Names, parameters and values
  * are those of scene files (docs/REFERENCE.md), with the same checks and messages. Errors are in
  * the problems of [[scene]], with the line of source code that called the builder; so are calls
  * without effect, such as a material that no shape follows.
  * {{{
  * val scene = Candela.build()
  *   .film("rgb", Parameters().integer("xresolution", 64).integer("yresolution", 48))
  *   .lookAt(0, 1, -5, 0, 0, 0, 0, 1, 0)
  *   .camera("perspective", Parameters().number("fov", 40))
  *   .world()
  *   .light("infinite", Parameters().rgb("L", 0.4, 0.5, 0.6))
  *   .material("diffuse", Parameters().rgb("reflectance", 0.8, 0.2, 0.1))
  *   .shape("sphere", Parameters().number("radius", 1))
  *   .scene()
  * }}}
  * Mutable, for one thread; each method returns the builder itself.
  */
final class SceneBuilder private[api] (name: String, folder: SceneFolder, base: Option[Scene]):
  private val runner = StatementRunner(folder, base.flatMap(_.description), placed)
  private val sum = StatementSum()
  private val idle = IdleStatements()
  private var shownName = name

  // The image, before the world

  // Of another scene, each replaces the statement; `change` keeps its other parameters

  /** The camera, at the origin of the current transform, looking along z. In a scene that is
    * edited, without a transform, it is where that scene's camera is.
    */
  def camera(kind: String, parameters: Parameters): SceneBuilder =
    setting(SceneSetting.Camera, "Camera", kind, parameters)

  /** The film: size and contents of the image. */
  def film(kind: String, parameters: Parameters): SceneBuilder =
    setting(SceneSetting.Film, "Film", kind, parameters)

  def sampler(kind: String, parameters: Parameters): SceneBuilder =
    setting(SceneSetting.Sampler, "Sampler", kind, parameters)

  /** The reconstruction filter. */
  def filter(kind: String, parameters: Parameters): SceneBuilder =
    setting(SceneSetting.Filter, "PixelFilter", kind, parameters)

  /** The integrator. */
  def integrator(kind: String, parameters: Parameters): SceneBuilder =
    setting(SceneSetting.Integrator, "Integrator", kind, parameters)

  /** An `Option` of pbrt-v4: one parameter. */
  def option(parameter: Parameters): SceneBuilder =
    for p <- located(parameter, position) do
      run(GivenStatement(
        "Option",
        p.pos,
        texts = Vector(p.name),
        params = Vector(p)
      ))
    this

  /** The times of the start and the end of transforms, in seconds. */
  def transformTimes(start: Double, end: Double): SceneBuilder =
    plain("TransformTimes", start, end)

  /** Begins the world: lights and shapes. The transform is then the identity. */
  def world(): SceneBuilder = plain("WorldBegin")

  // Transforms of what follows

  def identity(): SceneBuilder = plain("Identity")
  def translate(x: Double, y: Double, z: Double): SceneBuilder = plain("Translate", x, y, z)
  def scale(x: Double, y: Double, z: Double): SceneBuilder = plain("Scale", x, y, z)

  /** @param degrees counterclockwise about the axis x, y, z */
  def rotate(degrees: Double, x: Double, y: Double, z: Double): SceneBuilder =
    plain("Rotate", degrees, x, y, z)

  /** From eye to target; up is up in the image. */
  def lookAt(
      eyeX: Double,
      eyeY: Double,
      eyeZ: Double,
      targetX: Double,
      targetY: Double,
      targetZ: Double,
      upX: Double,
      upY: Double,
      upZ: Double
  ): SceneBuilder =
    plain("LookAt", eyeX, eyeY, eyeZ, targetX, targetY, targetZ, upX, upY, upZ)

  /** Replaces the transform.
    *
    * @param columns 16 numbers in column order
    */
  def transform(columns: Array[Double]): SceneBuilder = plain("Transform", columns*)

  /** @param columns 16 numbers in column order */
  def concatTransform(columns: Array[Double]): SceneBuilder =
    plain("ConcatTransform", columns*)

  /** Names the current transform. */
  def coordinateSystem(name: String): SceneBuilder = words("CoordinateSystem", name)

  /** Replaces the transform by a named one: `camera`, `world`, or your own. */
  def useCoordinateSystem(name: String): SceneBuilder = words("CoordSysTransform", name)

  /** Selects the transforms that later calls change: `All`, `StartTime` or `EndTime`. */
  def activeTransform(which: String): SceneBuilder = words("ActiveTransform", which)

  // Blocks

  /** Restores materials, transforms and all other state after `body`.
    *
    * @throws java.lang.IllegalArgumentException if `body` returns another builder
    */
  def attributes(body: UnaryOperator[SceneBuilder]): SceneBuilder =
    plain("AttributeBegin")
    continued(body)
    plain("AttributeEnd")

  /** Defines an object of the shapes in `body`, for [[instance]].
    *
    * @throws java.lang.IllegalArgumentException if `body` returns another builder
    */
  def define(name: String, body: UnaryOperator[SceneBuilder]): SceneBuilder =
    words("ObjectBegin", name)
    continued(body)
    plain("ObjectEnd")

  /** What another builder has would be lost. */
  private def continued(body: UnaryOperator[SceneBuilder]): Unit =
    if body(this) ne this then
      throw IllegalArgumentException("the body must return the builder that it is given")

  /** Places an object with the current transform. */
  def instance(name: String): SceneBuilder = words("ObjectInstance", name)

  // The world

  def shape(kind: String, parameters: Parameters): SceneBuilder = named("Shape", kind, parameters)

  def light(kind: String, parameters: Parameters): SceneBuilder =
    named("LightSource", kind, parameters)

  /** Makes the following shapes of the block area lights. */
  def areaLight(kind: String, parameters: Parameters): SceneBuilder =
    named("AreaLightSource", kind, parameters)

  /** Sets the material of the following shapes of the block. */
  def material(kind: String, parameters: Parameters): SceneBuilder =
    named("Material", kind, parameters)

  /** Names a material, for [[useMaterial]] and for mixtures. */
  def nameMaterial(name: String, kind: String, parameters: Parameters): SceneBuilder =
    typed("MakeNamedMaterial", name, kind, parameters)

  def useMaterial(name: String): SceneBuilder = words("NamedMaterial", name)

  /** Names a texture, for the following parameters. */
  def texture(
      name: String,
      values: TextureValues,
      kind: String,
      parameters: Parameters
  ): SceneBuilder =
    val pos = position
    val texts = Vector(name, values.toString.toLowerCase(Locale.ROOT), kind)
    run(GivenStatement("Texture", pos, texts = texts, params = located(parameters, pos)))

  /** Names a medium, for [[mediumInterface]]. */
  def nameMedium(name: String, kind: String, parameters: Parameters): SceneBuilder =
    typed("MakeNamedMedium", name, kind, parameters)

  /** Sets the media inside and outside of the following shapes, and around camera and lights:
    * names, or "" for none.
    */
  def mediumInterface(inside: String, outside: String): SceneBuilder =
    words("MediumInterface", inside, outside)

  def reverseOrientation(): SceneBuilder = plain("ReverseOrientation")

  /** Sets the space of the following colours: `srgb`, `dci-p3`, `rec2020` or `aces2065-1`. */
  def colorSpace(name: String): SceneBuilder = words("ColorSpace", name)

  /** Sets default parameters of the following statements.
    *
    * @param target `shape`, `light`, `material`, `medium` or `texture`
    */
  def defaults(target: String, parameters: Parameters): SceneBuilder =
    named("Attribute", target, parameters)

  // Changes of another scene

  /** Changes parameters of a statement that the scene has once, and keeps its others. */
  def change(setting: SceneSetting, parameters: Parameters): SceneBuilder =
    if setting == SceneSetting.Film then warnOfSize(parameters)
    edited(s"change $setting", "", parameters)(SceneEdits.setting(setting, _))

  /** Changes parameters of a named material, and keeps its others. */
  def changeMaterial(name: String, parameters: Parameters): SceneBuilder =
    edited("change material", name, parameters)(SceneEdits.material(name, _))

  /** Changes parameters of the material of one shape, which may be a named one: other shapes keep
    * theirs.
    *
    * @param shape index in [[Scene.shapes]]
    */
  def changeMaterialOf(shape: Int, parameters: Parameters): SceneBuilder =
    edited("change material of", shape.toString, parameters)(SceneEdits.materialOf(shape, _))

  /** Changes parameters of a shape, and keeps its others.
    *
    * @param shape index in [[Scene.shapes]]
    */
  def changeShape(shape: Int, parameters: Parameters): SceneBuilder =
    edited("change shape", shape.toString, parameters)(SceneEdits.shape(shape, _))

  /** Changes parameters of the light that a shape emits, and keeps its others.
    *
    * @param shape index in [[Scene.shapes]]
    */
  def changeAreaLightOf(shape: Int, parameters: Parameters): SceneBuilder =
    edited("change area light of", shape.toString, parameters)(SceneEdits.areaLightOf(shape, _))

  /** Changes parameters of a light, and keeps its others.
    *
    * @param light index in [[Scene.lights]]
    */
  def changeLight(light: Int, parameters: Parameters): SceneBuilder =
    edited("change light", light.toString, parameters)(SceneEdits.light(light, _))

  /** Changes parameters of a texture, and keeps its others. */
  def changeTexture(name: String, parameters: Parameters): SceneBuilder =
    edited("change texture", name, parameters)(SceneEdits.texture(name, _))

  /** Moves the camera to the current transform; it keeps its parameters. In a scene of Mitsuba or a
    * model, `lookAt` sees what that format's own does, without mirroring.
    */
  def placeCamera(): SceneBuilder =
    val statement = GivenStatement("place camera", SourcePos.Nowhere)
    sum.add(statement)
    idle.note(statement)
    runner.placeCamera()
    this

  /** Removes all lights except area lights. */
  def removeLights(): SceneBuilder =
    edited("remove lights", "", Parameters())(_ => _.copy(lights = Vector.empty))

  /** Removes all shapes, objects and instances. */
  def removeShapes(): SceneBuilder =
    edited("remove shapes", "", Parameters())(_ =>
      _.copy(shapes = Vector.empty, objects = Map.empty, instances = InstanceList.Empty)
    )

  /** Names the scene in image files and messages. */
  def called(name: String): SceneBuilder =
    shownName = name
    this

  /** The scene so far. The builder remains usable. */
  def scene(): Scene =
    val description = runner.result
    val completed = description.copy(
      folder = folder,
      unfiled = description.unfiled :+ (FilmHeaders.Statements -> sum.digest),
      warnings = description.warnings ++ idle.warnings(isEdit = base.nonEmpty)
    )
    Scenes.built(shownName, completed, base.fold(ReadSettings())(_.reading))

  /** As `SceneBuilder(scene: 3 shapes, 1 light)`. */
  override def toString: String =
    val description = runner.result
    Shown("SceneBuilder", Shown.contents(shownName, description)*)

  /** The view of a camera: those of Mitsuba and glTF are right-handed, pbrt's are left-handed. */
  private def placed(kind: String, view: AnimatedTransform): AnimatedTransform =
    def from(axes: Transform) = GraphicsState.constant(axes.inverse).after(view)
    base.flatMap(_.description).map(_.dialect) match
      case Some(Dialect.Mitsuba) => from(SensorAxes.of(kind))
      case Some(Dialect.Gltf) => from(SensorAxes.Plain)
      case _ => view

  private def located(parameters: Parameters, at: SourcePos): Vector[Param] =
    Objects.requireNonNull(parameters, "parameters").located(at)

  private def run(statement: GivenStatement): SceneBuilder =
    for text <- statement.texts do
      Objects.requireNonNull(text, s"a name or type of ${statement.directive}"): Unit
    sum.add(statement)
    idle.note(statement)
    runner.run(statement)
    this

  private def plain(directive: String, numbers: Double*): SceneBuilder =
    run(GivenStatement(directive, position, numbers = numbers.toVector))

  private def words(directive: String, texts: String*): SceneBuilder =
    run(GivenStatement(directive, position, texts = texts.toVector))

  private def setting(
      which: SceneSetting,
      directive: String,
      kind: String,
      parameters: Parameters
  ): SceneBuilder =
    val at = position
    for
      scene <- base.flatMap(_.description)
      warning <- SceneEdits.dropped(which, located(parameters, at), at, scene)
    do runner.report(warning)
    if which == SceneSetting.Film then warnOfSize(parameters)
    named(directive, kind, parameters)

  private def warnOfSize(parameters: Parameters): Unit =
    val at = position
    for warning <- base.flatMap(SceneEdits.resized(_, located(parameters, at), at)) do
      runner.report(warning)

  private def named(directive: String, name: String, parameters: Parameters): SceneBuilder =
    val pos = position
    run(GivenStatement(directive, pos, texts = Vector(name), params = located(parameters, pos)))

  private def typed(
      directive: String,
      name: String,
      kind: String,
      parameters: Parameters
  ): SceneBuilder =
    val pos = position
    val params = Param.string("type", pos, kind) +: located(parameters, pos)
    run(GivenStatement(directive, pos, texts = Vector(name), params = params))

  private def edited(what: String, name: String, parameters: Parameters)(
      f: Vector[Param] => SceneEdits.Edit
  ): SceneBuilder =
    val pos = position
    val params = located(parameters, pos)
    sum.add(GivenStatement(what, pos, texts = Vector(name), params = params))
    runner.change(pos)(f(runner.checked(params)))
    this

  private def position: SourcePos = CallPlace.caller

private object CallPlace:
  private val walker = StackWalker.getInstance()
  private val ownClasses = Set("candela.api.SceneBuilder", "candela.api.CallPlace$")

  /** The line that calls the builder. */
  def caller: SourcePos =
    val frame = walker.walk(_.dropWhile(f => ownClasses(f.getClassName)).findFirst())
    frame.map(f => SourcePos(String.valueOf(f.getFileName), Math.max(1, f.getLineNumber), 1))
      .orElse(SourcePos("code", 1, 1))

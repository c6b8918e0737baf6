package candela.scenefile

import scala.collection.immutable.VectorMap
import scala.collection.mutable

import candela.base.{Code, Problem, SceneError, SceneFolder, SourcePos, Suggest}
import candela.math.Transform

/** Executes statements: maintains the graphics state and collects the description.
  *
  * @param folder folder of the scene file
  * @param isV4 queried only where the dialects differ in the meaning of a statement
  * @param problem receives errors and warnings that don't abort the statement
  * @param foreign dialect of the declarations, if not that of the scene
  */
final class SceneWriter(
    folder: SceneFolder,
    evidence: DialectGuess,
    isV4: () => Boolean,
    problem: Problem => Unit,
    foreign: Option[Dialect] = None
):
  private val names = UniqueNames()
  private val textures = Vector.newBuilder[TextureDescription]
  private val lights = Vector.newBuilder[LightDescription]
  private val shapes = Vector.newBuilder[ShapeDescription]
  private val objects = mutable.LinkedHashMap.empty[String, Vector[ShapeDescription]]
  private val instances = InstanceList.newBuilder
  private val coordinateSystems = mutable.HashMap.empty[String, AnimatedTransform]
  private val texturesByName = mutable.HashMap.empty[(String, String), TextureDescription]
  private val media = mutable.LinkedHashMap.empty[String, MediumDescription]
  private var unknownSystems = 0
  private val objectNames = mutable.HashMap.empty[String, String]
  private var inObject = Option.empty[(String, mutable.ArrayBuffer[ShapeDescription])]
  private var result = SceneDescription(Dialect.V4, folder = folder)

  /** Whether it began with another scene. */
  private var isBased = false

  val blocks: Blocks = Blocks(isV4, problem)

  /** Position of `WorldBegin` and of `WorldEnd`, once read. */
  var worldBegin = Option.empty[SourcePos]
  var worldEnd = Option.empty[SourcePos]

  private val mixed = Vector.newBuilder[(Declaration, Param)]

  /** Notes the materials of a mixture that are not defined yet. */
  private def noteParts(d: Declaration): Declaration =
    if d.name == "mix" then
      for p <- d.params if SceneWriter.MixedNames(p.name) && p.strings.size == 1 do
        if !names.isTaken("material", p.strings.head) then mixed += (d -> p)
    d

  /** Warnings about mixtures of materials that are defined after them. */
  def lateParts(dialect: Dialect): Vector[Problem] =
    val all = result.namedMaterials.map((name, made) => name -> made.at).toMap
    val places = result.namedMaterials.map((_, made) => made.at).toSet
    def isNamed(d: Declaration) = places(d.at)
    for
      (mixture, part) <- mixed.result()
      // pbrt-v2 looks for the parts of a `Material` when a shape has it
      if dialect == Dialect.V3 || dialect == Dialect.V2 && isNamed(mixture)
      later <- all.get(part.strings.head)
    yield
      val name = part.strings.head
      Problem.warning(
        Code.DefinedLater,
        part.valuesAt,
        s"material `$name` is defined only later, at $later; pbrt mixes a grey \"matte\" instead " +
          "and prints an error",
        Some(s"move its MakeNamedMaterial before this statement")
      )

  /** Whether the scene is v4's. */
  def inV4: Boolean = isV4()

  private def state = blocks.state
  private def changeState(f: GraphicsState => GraphicsState): Unit = blocks.state = f(blocks.state)
  private def fail(code: Code, at: SourcePos, message: String, help: Option[String]) =
    throw SceneError(Problem.error(code, at, message, help))

  def description(dialect: Dialect, warnings: Vector[Problem]): SceneDescription =
    result.copy(
      dialect = dialect,
      // v4 resolves names at the Camera statement, v2 and v3 at the end of the world.
      cameraMedium = if keepsMedium(dialect) then result.cameraMedium else state.outsideMedium,
      textures = textures.result(),
      lights = lights.result(),
      shapes = shapes.result(),
      objects = VectorMap.from(objects),
      instances = instances.result(),
      media = media.values.toVector,
      warnings = warnings
    )

  private def keepsMedium(dialect: Dialect) = dialect == Dialect.V4 || isBased

  // Declarations

  private def declare(category: String, from: Named, defaults: String = ""): Declaration =
    evidence.uses(category, from.name, from.at)
    val inherited = state.defaults.getOrElse(defaults, Vector.empty)
    val all =
      if inherited.isEmpty then from.params
      else from.params ++ inherited.filterNot(d => from.params.exists(_.name == d.name))
    val params = state.scope.resolve(all)
    Declaration(category, from.name, params, from.at, folder, state.colorSpace, foreign)

  /** A declaration named by the value of its "string type". */
  private def declareByType(category: String, from: Named, defaults: String): Declaration =
    val whole = declare("", from, defaults)
    val missing = Some(s"add for example \"string type\" \"${SceneWriter.Examples(category)}\"")
    whole.param("type").filter(_.strings.size == 1) match
      case Some(t) =>
        evidence.uses(category, t.strings.head, t.valuesAt)
        val params = whole.params.filterNot(_ eq t)
        val name = t.strings.head
        Declaration(category, name, params, t.valuesAt, folder, state.colorSpace, foreign)
      case None => fail(
          Code.MissingParameter,
          from.at,
          s"\"${from.name}\" must have a \"string type\"",
          missing
        )

  /** A statement before WorldBegin; each overrides the previous one. */
  def option(directive: String, from: Named): Unit =
    val d = Some(declare(directive, from))
    result = directive match
      case "Camera" =>
        coordinateSystems("camera") = GraphicsState.inverse(state.transform)
        result.copy(camera = d, worldToCamera = state.transform, cameraMedium = state.outsideMedium)
      case "Film" => result.copy(film = d)
      case "Sampler" => result.copy(sampler = d)
      case "PixelFilter" => result.copy(filter = d)
      case "Integrator" | "SurfaceIntegrator" => result.copy(integrator = d)
      case "VolumeIntegrator" => result.copy(volumeIntegrator = d)
      case "Renderer" => result.copy(renderer = d)
      case "Accelerator" => result.copy(accelerator = d)

  /** Takes over all that stands before the world of another scene. */
  def keepSettings(of: SceneWriter): Unit =
    val old = of.result
    result = result.copy(
      camera = old.camera,
      worldToCamera = old.worldToCamera,
      film = old.film,
      sampler = old.sampler,
      filter = old.filter,
      integrator = old.integrator,
      volumeIntegrator = old.volumeIntegrator,
      renderer = old.renderer,
      accelerator = old.accelerator
    )

  /** Begins with all that another scene has; what there is once may be replaced. */
  def keepAll(of: SceneDescription): Unit =
    result = of
    isBased = true
    worldBegin = Some(SourcePos.Nowhere)
    coordinateSystems("camera") = GraphicsState.inverse(of.worldToCamera)
    coordinateSystems("world") = GraphicsState.Identity
    for t <- of.textures do
      keep(t)
      names.take(t.valueType, t.name): Unit
    for (name, _) <- of.namedMaterials do names.take("material", name): Unit
    for name <- of.objects.keys do
      names.take("object", name): Unit
      objectNames(name) = name
    lights ++= of.lights
    shapes ++= of.shapes
    objects ++= of.objects
    instances ++= of.instances
    media ++= of.media.map(m => m.name -> m)

  /** Changes all that there is so far. */
  def change(f: SceneDescription => SceneDescription): Unit =
    val changed = f(description(result.dialect, Vector.empty))
    for all <- Vector(textures, lights, shapes, instances) do all.clear()
    for all <- Vector(texturesByName, objects, media, objectNames) do all.clear()
    val begun = worldBegin
    keepAll(changed)
    worldBegin = begun

  /** Where the camera is, by the current transform. */
  def placeCamera(): Unit =
    coordinateSystems("camera") = GraphicsState.inverse(state.transform)
    result = result.copy(worldToCamera = state.transform)

  def option(param: Param): Unit = result = result.copy(options = result.options :+ param)

  def transformTimes(start: Float, end: Float): Unit =
    result = result.copy(transformTimes = (start, end))

  // The world

  def beginWorld(at: SourcePos): Unit =
    worldBegin = Some(at)
    changeState(_.copy(transform = GraphicsState.Identity, active = ActiveTransform.All))
    coordinateSystems("world") = GraphicsState.Identity

  def shape(from: Named): Unit =
    val described = ShapeDescription(
      declare("Shape", from, "shape"),
      state.transform,
      state.reverseOrientation,
      state.material,
      state.areaLight,
      state.insideMedium,
      state.outsideMedium
    )
    inObject match
      case Some((_, own)) => own += described
      case None => shapes += described
    ()

  def light(from: Named): Unit =
    val light = declare("LightSource", from, "light")
    lights += LightDescription(light, state.transform, state.outsideMedium)

  def volume(from: Named): Unit =
    val described = LightDescription(declare("Volume", from), state.transform)
    result = result.copy(volumes = result.volumes :+ described)

  /** An empty name ends the area light. */
  def areaLight(from: Named): Unit =
    val light = Option.when(from.name.nonEmpty)(declare("AreaLightSource", from, "light"))
    changeState(_.copy(areaLight = light))

  def material(from: Named): Unit =
    val material = MaterialRef.Inline(noteParts(declare("Material", from, "material")))
    changeState(_.copy(material = material))

  def namedMaterial(name: String, at: SourcePos): Unit =
    val unique = state.scope.materials.getOrElse(name, name)
    changeState(_.copy(material = MaterialRef.Named(unique, at)))

  def makeNamedMaterial(from: Named): Unit =
    val material = noteParts(declareByType("Material", from, "material"))
    val scope = state.scope
    val current = scope.materials.getOrElse(from.name, from.name)
    val unique =
      if names.take("material", current) then current
      else
        refuseInV4(from.at, "material", from.name)
        names.fresh(List("material"), from.name)
    val _ = names.take("material", unique)
    if unique != current then
      changeState(_.copy(scope =
        scope.copy(materials = scope.materials.updated(from.name, unique))
      ))
    result = result.copy(namedMaterials = result.namedMaterials :+ (unique -> material))

  def makeNamedMedium(from: Named): Unit =
    val medium = declareByType("Medium", from, "medium")
    if media.contains(from.name) then refuseInV4(from.at, "medium", from.name)
    // A later one goes behind all others
    media.remove(from.name): Unit
    media(from.name) = MediumDescription(from.name, medium, state.transform)

  /** @param name name of the texture; `from.name` is its class */
  def texture(name: String, at: SourcePos, valueType: String, from: Named): Unit =
    val described = (unique: String) =>
      TextureDescription(unique, valueType, declare("Texture", from, "texture"), state.transform)
    val scope = state.scope
    val current = scope.textures.getOrElse(name, name)
    if names.take(valueType, current) then keep(described(current))
    else
      refuseInV4(at, s"$valueType texture", name)
      val made = described(names.fresh(SceneWriter.TextureKinds, name))
      // Textures of the other value type with this name must resolve by the new name, too.
      for
        kind <- SceneWriter.TextureKinds if kind != valueType
        twin <- texturesByName.get((kind, current))
      do
        keep(twin.copy(name = made.name))
        val _ = names.take(kind, made.name)
      keep(made)
      val _ = names.take(valueType, made.name)
      changeState(_.copy(scope = scope.copy(textures = scope.textures.updated(name, made.name))))

  private def keep(texture: TextureDescription): Unit =
    textures += texture
    texturesByName((texture.valueType, texture.name)) = texture

  private def refuseInV4(at: SourcePos, kind: String, name: String): Unit =
    if isV4() then
      fail(
        Code.Redefined,
        at,
        s"$kind \"$name\" is already defined",
        Some("names must be unique in v4")
      )

  def mediumInterface(inside: String, outside: String): Unit =
    changeState(_.copy(insideMedium = inside, outsideMedium = outside))

  def attribute(target: String, at: SourcePos, params: Vector[Param]): Unit =
    if !SceneWriter.Targets.contains(target) then
      val help = Suggest.help(target, SceneWriter.Targets)
      fail(Code.UnknownSystem, at, s"unknown Attribute target `$target`", help)
    val earlier = state.defaults.getOrElse(target, Vector.empty)
    if earlier.size > SceneWriter.MostDefaults then
      fail(
        Code.TooLarge,
        at,
        s"more than ${SceneWriter.MostDefaults} defaults of \"$target\"",
        None
      )
    val all = earlier.filterNot(e => params.exists(_.name == e.name)) ++ params.map(
      _.asDefault(state.colorSpace)
    )
    changeState(s => s.copy(defaults = s.defaults.updated(target, all)))

  def colorSpace(name: String): Unit = changeState(_.copy(colorSpace = name))

  def reverseOrientation(): Unit =
    changeState(s => s.copy(reverseOrientation = !s.reverseOrientation))

  // Objects

  def beginObject(name: String, at: SourcePos): Unit =
    if inObject.nonEmpty then
      fail(Code.WrongPlace, at, "ObjectBegin inside an object", Some("objects can't be nested"))
    val unique =
      if names.take("object", name) then name
      else
        refuseInV4(at, "object", name)
        names.fresh(List("object"), name)
    val _ = names.take("object", unique)
    objectNames(name) = unique
    blocks.begin("ObjectBegin", at)
    inObject = Some((unique, mutable.ArrayBuffer.empty))

  def endObject(at: SourcePos): Unit =
    inObject.foreach((name, shapes) => objects(name) = shapes.toVector)
    inObject = None
    blocks.end("ObjectBegin", at)

  def instance(name: String, at: SourcePos): Unit =
    if inObject.nonEmpty then
      fail(Code.WrongPlace, at, "ObjectInstance inside an object", Some("objects can't be nested"))
    instances += InstanceDescription(objectNames.getOrElse(name, name), at, state.transform)

  // Transforms

  def transform(f: Transform => Transform): Unit = changeState(_.transformed(f))

  def activate(active: ActiveTransform): Unit = changeState(_.copy(active = active))

  def nameCoordinates(name: String): Unit = coordinateSystems(name) = state.transform

  def useCoordinates(name: String, at: SourcePos): Unit =
    coordinateSystems.get(name) match
      case Some(found) => changeState(_.copy(transform = found))
      case None =>
        unknownSystems += 1
        // The search takes its time, and may be asked for a million times
        val isHelped = unknownSystems <= Problems.MostHelped
        val help = if isHelped then Suggest.help(name, coordinateSystems.keys) else None
        val message = s"unknown coordinate system `$name`; keeping the current transform"
        problem(Problem.warning(Code.UnknownSystem, at, message, help))

object SceneWriter:
  private val TextureKinds = List("float", "spectrum")
  private val Targets = List("shape", "light", "material", "medium", "texture")

  /** Far more than there are parameters; each statement takes as long as there are defaults. */
  private val MostDefaults = 1000
  private val MixedNames = Set("namedmaterial1", "namedmaterial2")
  private val Examples = Map("Material" -> "diffuse", "Medium" -> "homogeneous")

/** A quoted name with its position, and the parameters after it. */
final case class Named(name: String, at: SourcePos, params: Vector[Param])

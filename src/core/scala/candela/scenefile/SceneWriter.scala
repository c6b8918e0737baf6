package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, SourcePos, Suggest}
import candela.io.SceneFolder
import scala.collection.immutable.VectorMap
import scala.collection.mutable

import candela.math.Transform

/** Executes statements: maintains the graphics state and collects the description.
  *
  * @param folder folder of the scene file
  * @param isV4 queried only where the dialects differ in the meaning of a statement
  * @param problem receives errors and warnings that don't abort the statement
  * @param foreign dialect of the declarations, if not that of the scene
  * @param placed the view of a type of camera that is placed by a transform
  */
final class SceneWriter(
    folder: SceneFolder,
    evidence: DialectGuess,
    isV4: () => Boolean,
    problem: Problem => Unit,
    foreign: Option[Dialect] = None,
    placed: (String, AnimatedTransform) => AnimatedTransform = (_, view) => view
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
  private val mediaBeforeCamera = mutable.HashSet.empty[String]
  private var unknownSystems = 0
  private val objectNames = mutable.HashMap.empty[String, String]
  private val idle = IdleMaterials()
  private val mixtures = Mixtures()
  private var inObject = Option.empty[(String, mutable.ArrayBuffer[ShapeDescription])]
  private var result = SceneDescription(Dialect.V4, folder = folder)

  private var isBased = false // whether it began with another scene
  val blocks: Blocks = Blocks(isV4, problem)

  /** Position of `WorldBegin` and of `WorldEnd`, once read. */
  var worldBegin = Option.empty[SourcePos]
  var worldEnd = Option.empty[SourcePos]

  /** Warnings about definitions whose place among other statements matters. */
  def displacedDefinitions(dialect: Dialect): Vector[Problem] =
    mixtures.ofLaterMaterials(dialect, result.namedMaterials) ++ earlyDefinitions(dialect)

  /** Media with a place that are defined before the camera. */
  private def earlyDefinitions(dialect: Dialect): Vector[Problem] =
    def isMoved = !RenderingOrigin.toWorld(result).isIdentity
    for
      m <- media.values.toVector
      if dialect == Dialect.V4 && mediaBeforeCamera(m.name)
      if m.medium.name != "homogeneous" && isMoved
    yield Problem.warning(
      Code.AsInPbrt,
      m.medium.pos,
      s"medium `${m.name}` is placed relative to the camera, as in pbrt-v4: it is defined before " +
        "`Camera`",
      Some("move its MakeNamedMedium after WorldBegin to place it in the world")
    )

  /** Whether the scene is v4's. */
  def inV4: Boolean = isV4()

  private def state = blocks.state
  private def changeState(f: GraphicsState => GraphicsState): Unit = blocks.state = f(blocks.state)
  private def fail(code: Code, at: SourcePos, message: String, help: Option[String]) =
    throw SceneError(Problem.error(code, at, message, help))

  def description(dialect: Dialect, warnings: Vector[Problem]): SceneDescription =
    val scene = result.copy(
      dialect = dialect,
      // v4 resolves names at the Camera statement, v2 and v3 at the end of the world.
      cameraMedium = if keepsMedium(dialect) then result.cameraMedium else state.outsideMedium,
      textures = textures.result(),
      lights = lights.result(),
      shapes = shapes.result(),
      objects = VectorMap.from(objects),
      instances = instances.result(),
      media = media.values.toVector,
      warnings = warnings,
      idleMaterials = result.idleMaterials ++ idle.all
    )
    if dialect == Dialect.V4 then RenderingOrigin.placing(mediaBeforeCamera, scene) else scene

  private def keepsMedium(dialect: Dialect) = dialect == Dialect.V4 || isBased

  // Declarations

  private def declare(category: String, from: Named, defaults: String = ""): Declaration =
    evidence.uses(category, from.name, from.pos)
    val inherited = state.defaults.getOrElse(defaults, Vector.empty)
    val combined =
      if inherited.isEmpty then from.params
      else from.params ++ inherited.filterNot(d => from.params.exists(_.name == d.name))
    val params = state.scope.resolve(combined)
    Declaration(
      category,
      from.name,
      params,
      from.pos,
      folder,
      state.colorSpace,
      foreign,
      from.isFaulty
    )

  /** A declaration named by the value of its "string type". */
  private def declareByType(category: String, from: Named, defaults: String): Declaration =
    val declared = declare("", from, defaults)
    val missing = Some(s"add for example \"string type\" \"${SceneWriter.Examples(category)}\"")
    declared.param("type").filter(_.strings.size == 1) match
      case Some(t) =>
        evidence.uses(category, t.strings.head, t.valuesAt)
        declared.copy(
          category = category,
          name = t.strings.head,
          params = declared.params.filterNot(_ eq t),
          pos = t.valuesAt
        )
      case None if from.isFaulty => throw SceneError(Vector.empty) // it may be what is faulty
      case None => fail(
          Code.MissingParameter,
          from.pos,
          s"\"${from.name}\" must have a \"string type\"",
          missing
        )

  /** A statement before WorldBegin; each overrides the previous one. */
  def option(directive: String, from: Named): Unit =
    val d = Some(declare(directive, from))
    result = directive match
      case "Camera" =>
        if result.camera.isEmpty then mediaBeforeCamera ++= media.keys
        result = result.copy(camera = d)
        // That of an edited scene stays where it is, unless a transform is given
        if !isBased || (state.transform ne GraphicsState.Identity) then
          placeCamera()
          result = result.copy(cameraMedium = state.outsideMedium)
        result
      case "Film" => result.copy(film = d)
      case "Sampler" => result.copy(sampler = d)
      case "PixelFilter" => result.copy(filter = d)
      case "Integrator" | "SurfaceIntegrator" => result.copy(integrator = d)
      case "VolumeIntegrator" => result.copy(volumeIntegrator = d)
      case "Renderer" => result.copy(renderer = d)
      case "Accelerator" => result.copy(accelerator = d)

  /** Takes over all that stands before the world of another scene. */
  def copySettings(other: SceneWriter): Unit =
    val settings = other.result
    result = result.copy(
      camera = settings.camera,
      worldToCamera = settings.worldToCamera,
      film = settings.film,
      sampler = settings.sampler,
      filter = settings.filter,
      integrator = settings.integrator,
      volumeIntegrator = settings.volumeIntegrator,
      renderer = settings.renderer,
      accelerator = settings.accelerator
    )

  /** Begins with all that another scene has; what there is once may be replaced. */
  def startFrom(base: SceneDescription): Unit =
    result = base
    isBased = true
    worldBegin = Some(SourcePos.Nowhere)
    coordinateSystems("camera") = GraphicsState.inverse(base.worldToCamera)
    coordinateSystems("world") = GraphicsState.Identity
    for t <- base.textures do
      addTexture(t)
      names.reserve(t.valueType, t.name): Unit
    for (name, _) <- base.namedMaterials do names.reserve("material", name): Unit
    for name <- base.objects.keys do
      names.reserve("object", name): Unit
      objectNames(name) = name
    lights ++= base.lights
    shapes ++= base.shapes
    objects ++= base.objects
    instances ++= base.instances
    media ++= base.media.map(m => m.name -> m)

  /** Begins with the camera of another scene, before its world. */
  def startFromCamera(base: SceneDescription): Unit =
    result = result.copy(camera = base.camera, worldToCamera = base.worldToCamera)
    isBased = true

  /** Changes all that there is so far. */
  def change(f: SceneDescription => SceneDescription): Unit =
    val changed = f(description(result.dialect, Vector.empty))
    for collection <- Vector(textures, lights, shapes, instances) do collection.clear()
    for collection <- Vector(texturesByName, objects, media, objectNames) do collection.clear()
    idle.clear()
    val begun = worldBegin
    startFrom(changed)
    worldBegin = begun

  /** Where the camera is, by the current transform. */
  def placeCamera(): Unit =
    val view = placed(result.camera.fold("")(_.name), state.transform)
    coordinateSystems("camera") = GraphicsState.inverse(view)
    result = result.copy(worldToCamera = view)

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
    idle.markUsed(state.material)
    inObject match
      case Some((_, group)) => group += described: Unit
      case None => shapes += described: Unit

  def light(from: Named): Unit =
    val light = declare("LightSource", from, "light")
    lights += LightDescription(light, state.transform, state.outsideMedium)

  def volume(from: Named): Unit =
    val described = LightDescription(declare("Volume", from), state.transform)
    result = result.copy(volumes = result.volumes :+ described)

  private def noted(material: Declaration): Declaration =
    mixtures.note(material, names.isTaken("material", _))
    material

  /** An empty name ends the area light. */
  def areaLight(from: Named): Unit =
    val light = Option.when(from.name.nonEmpty)(declare("AreaLightSource", from, "light"))
    changeState(_.copy(areaLight = light))

  def material(from: Named): Unit =
    val material = MaterialRef.Inline(noted(declare("Material", from, "material")))
    idle.add(material)
    changeState(_.copy(material = material))

  def namedMaterial(name: String, at: SourcePos): Unit =
    val material = new MaterialRef.Named(state.scope.materials.getOrElse(name, name), at)
    if !names.isTaken("material", material.name) then idle.add(material)
    changeState(_.copy(material = material))

  def makeNamedMaterial(from: Named): Unit =
    val material = noted(declareByType("Material", from, "material"))
    val scope = state.scope
    val current = scope.materials.getOrElse(from.name, from.name)
    val unique =
      if names.reserve("material", current) then current
      else
        rejectInV4(from.pos, "material", from.name)
        names.fresh(List("material"), from.name)
    val _ = names.reserve("material", unique)
    if unique != current then
      changeState(_.copy(scope =
        scope.copy(materials = scope.materials.updated(from.name, unique))
      ))
    result = result.copy(namedMaterials = result.namedMaterials :+ (unique -> material))

  def makeNamedMedium(from: Named): Unit =
    val medium = declareByType("Medium", from, "medium")
    if media.contains(from.name) then rejectInV4(from.pos, "medium", from.name)
    // A later one goes behind all others
    media.remove(from.name): Unit
    media(from.name) = MediumDescription(from.name, medium, state.transform)

  /** @param name name of the texture; `from.name` is its class */
  def texture(name: String, at: SourcePos, valueType: String, from: Named): Unit =
    val described = (unique: String) =>
      TextureDescription(unique, valueType, declare("Texture", from, "texture"), state.transform)
    val scope = state.scope
    val current = scope.textures.getOrElse(name, name)
    if names.reserve(valueType, current) then addTexture(described(current))
    else
      rejectInV4(at, s"$valueType texture", name)
      val redefined = described(names.fresh(SceneWriter.TextureKinds, name))
      // Textures of the other value type with this name must resolve by the new name, too.
      for
        kind <- SceneWriter.TextureKinds if kind != valueType
        twin <- texturesByName.get((kind, current))
      do
        addTexture(twin.copy(name = redefined.name))
        val _ = names.reserve(kind, redefined.name)
      addTexture(redefined)
      val _ = names.reserve(valueType, redefined.name)
      changeState(_.copy(scope =
        scope.copy(textures = scope.textures.updated(name, redefined.name))
      ))

  private def addTexture(texture: TextureDescription): Unit =
    textures += texture
    texturesByName((texture.valueType, texture.name)) = texture

  private def rejectInV4(at: SourcePos, kind: String, name: String): Unit =
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
    if earlier.size > SceneWriter.MaxDefaults then
      fail(
        Code.TooLarge,
        at,
        s"more than ${SceneWriter.MaxDefaults} defaults of \"$target\"",
        None
      )
    val merged = earlier.filterNot(e => params.exists(_.name == e.name)) ++ params.map(
      _.asDefault(state.colorSpace)
    )
    changeState(s => s.copy(defaults = s.defaults.updated(target, merged)))

  def colorSpace(name: String): Unit = changeState(_.copy(colorSpace = name))

  def reverseOrientation(): Unit =
    changeState(s => s.copy(reverseOrientation = !s.reverseOrientation))

  // Objects

  def beginObject(name: String, at: SourcePos): Unit =
    if inObject.nonEmpty then
      fail(Code.WrongPlace, at, "ObjectBegin inside an object", Some("objects can't be nested"))
    val isNew = names.reserve("object", name)
    val unique = if isNew then name else names.fresh(List("object"), name)
    val _ = names.reserve("object", unique)
    objectNames(name) = unique
    blocks.start("ObjectBegin", at)
    inObject = Some((unique, mutable.ArrayBuffer.empty))
    // The block is open, whatever its name
    if !isNew then rejectInV4(at, "object", name)

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
      case Some(system) => changeState(_.copy(transform = system))
      case None =>
        unknownSystems += 1
        // The search takes its time, and may be asked for a million times
        val isHelped = unknownSystems <= Problems.MaxHelped
        val help = if isHelped then Suggest.help(name, coordinateSystems.keys) else None
        val message = s"unknown coordinate system `$name`; keeping the current transform"
        problem(Problem.warning(Code.UnknownSystem, at, message, help))

object SceneWriter:
  private val TextureKinds = List("float", "spectrum")
  private val Targets = List("shape", "light", "material", "medium", "texture")

  /** Far more than there are parameters; each statement takes as long as there are defaults. */
  private val MaxDefaults = 1000
  private val Examples = Map("Material" -> "diffuse", "Medium" -> "homogeneous")

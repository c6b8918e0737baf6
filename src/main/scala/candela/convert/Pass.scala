package candela.convert

import candela.base.NumberedNames
import candela.diagnostics.{Code, Problem, SourcePos}
import candela.io.SceneFolder
import scala.collection.mutable

import candela.math.Transform
import candela.scenefile.*

import java.util.Locale

/** Conversion tables from one dialect to the next.
  *
  * @param defaults implementations that the source dialect uses where the scene names none, by
  *   category
  */
final class Pass(
    val from: Dialect,
    val to: Dialect,
    val tables: Vector[Table],
    val defaults: Map[String, String],
    val shape: (ShapeDescription, PassRun) => Vector[ShapeDescription] = (s, _) => Vector(s),
    val texture: TextureDescription => TextureDescription = identity,
    val light: (LightDescription, PassRun) => Vector[LightDescription] = (l, _) => Vector(l)
):
  def table(category: String): Table = tables.find(_.category == category).get

  /** Converts only those declarations of a scene in dialect `to` that are not in it. */
  def forForeign: Pass = new Pass(from, to, tables, Map.empty)

/** State of converting one scene.
  *
  * @param baking how to paint what the target dialect lacks, if at all
  * @param ends   dialects of the whole conversion, of which the pass may be a part
  */
final class PassRun(
    val pass: Pass,
    val scene: SceneDescription,
    val files: SideFiles,
    val baking: Option[Baking],
    val ends: (Dialect, Dialect)
):
  private val problems = mutable.LinkedHashSet.empty[Problem]
  private val textures = mutable.LinkedHashMap.from(
    scene.textures.map(t => (t.name, t.valueType) -> t)
  )
  lazy val textureUses: TextureUses = TextureUses(scene.textures)
  private val added = mutable.ArrayBuffer.empty[TextureDescription]
  private val textureNames = NumberedNames((name, number) => s"$name ($number)")
  for t <- scene.textures do textureNames(t.name): Unit
  private val shared = mutable.HashMap.empty[Declaration, Option[Declaration]]
  private var currentTransform = GraphicsState.Identity

  /** Transform of the texture being converted. */
  def textureToWorld: AnimatedTransform = currentTransform

  val values: Values =
    Values(pass.from, pass.to, (p, message) => warn(Code.Inexpressible, p.pos, message))

  def warn(code: Code, at: SourcePos, message: String): Unit =
    problems += Problem.warning(code, at, message)

  /** Reports a parameter that the source dialect lacks. */
  def ignore(p: Param, name: String): Unit =
    warn(Code.UnknownParameter, p.pos, s"unknown parameter `${p.name}` of \"$name\"; ignored")

  def warnings: Vector[Problem] = problems.toVector

  def texture(name: String, valueType: String): Option[TextureDescription] =
    textures.get((name, valueType))

  /** All materials that shapes may use. */
  lazy val materials: Vector[Declaration] =
    val shapeMaterials = (scene.shapes ++ scene.objects.values.flatten).map(_.material).distinct
    scene.namedMaterials.map(_._2) ++ shapeMaterials.collect { case MaterialRef.Inline(d) => d }

  /** Adds a texture to the output; returns its unique name. */
  def define(t: TextureDescription): String =
    val name = textureNames(t.name)
    added += t.copy(name = name)
    name

  def convert(d: Declaration, category: String): Option[Declaration] =
    if d.dialect.getOrElse(scene.dialect) == pass.to then Some(d)
    else converted(d.copy(dialect = None), category)

  private def converted(d: Declaration, category: String): Option[Declaration] =
    val table = pass.table(category)
    table.rule(d.name) match
      case Some(rule) => Some(Statement(d, this, rule).result())
      case None =>
        val dialect = pass.to.toString.toLowerCase(Locale.ROOT)
        val instead = table.fallback.fold("ignored")(f => s"using \"$f\"")
        val source = s"${category.toLowerCase(Locale.ROOT)} \"${d.name}\""
        warn(Code.Inexpressible, d.pos, s"$dialect has no equivalent of $source; $instead")
        table.fallback.map(name => d.copy(name = name, params = Vector.empty))

  /** Converts a declaration that several shapes may share, once. */
  private def sharing(d: Declaration, category: String): Option[Declaration] =
    shared.getOrElseUpdate(d, convert(d, category))

  def result(): SceneDescription =
    // Textures first: added textures must follow those they use and precede those that use them.
    val allTextures = scene.textures.flatMap: t =>
      val placed = pass.texture(t)
      currentTransform = placed.textureToWorld
      val declaration = convert(placed.texture, s"${t.valueType} texture")
      val dependencies = added.toVector
      added.clear()
      dependencies ++ declaration.map(d => placed.copy(texture = d))
    val defaultPosition = scene.camera.fold(SourcePos.Nowhere)(_.pos)
    def option(category: String, stated: Option[Declaration]): Option[Declaration] =
      val implicitDefault = pass.defaults.get(category).map: name =>
        Declaration(category, name, Vector.empty, defaultPosition, SceneFolder.Nowhere)
      stated.orElse(implicitDefault).flatMap(convert(_, category))
    val media =
      scene.media.flatMap(m => convert(m.medium, "Medium").map(d => m.copy(medium = d)))
    // What is left out must not be named
    val dropped = scene.media.map(_.name).toSet -- media.map(_.name)
    def medium(name: String) = if dropped(name) then "" else name
    def withMedia(s: ShapeDescription) =
      s.copy(insideMedium = medium(s.insideMedium), outsideMedium = medium(s.outsideMedium))
    val objects =
      scene.objects.map((name, shapes) => name -> shapes.flatMap(shape).map(withMedia))
    val shapes = scene.shapes.flatMap(shape).map(withMedia)
    val materials =
      scene.namedMaterials.flatMap((name, d) => convert(d, "Material").map(name -> _))
    scene.copy(
      dialect = pass.to,
      camera = scene.camera.flatMap(convert(_, "Camera")),
      film = option("Film", scene.film),
      sampler = option("Sampler", scene.sampler),
      filter = option("PixelFilter", scene.filter),
      integrator = option("Integrator", scene.integrator),
      accelerator = scene.accelerator.flatMap(convert(_, "Accelerator")),
      renderer = scene.renderer.flatMap(convert(_, "Renderer")),
      volumeIntegrator = scene.volumeIntegrator.flatMap(convert(_, "VolumeIntegrator")),
      options = scene.options.filter: o =>
        if pass.to != Dialect.V4 then
          warn(Code.Inexpressible, o.pos, s"Option \"${o.name}\" exists only in v4; ignored")
        pass.to == Dialect.V4
      ,
      namedMaterials = materials,
      lights =
        for
          l <- scene.lights
          light <- pass.light(l, this)
          declaration <- convert(light.light, "LightSource")
        yield light.copy(light = declaration, medium = medium(l.medium)),
      shapes = shapes,
      objects = objects,
      cameraMedium = medium(scene.cameraMedium),
      media = media,
      volumes = scene.volumes.flatMap(v => convert(v.light, "Volume").map(d => v.copy(light = d))),
      textures = allTextures ++ added
    )

  private def shape(s: ShapeDescription): Vector[ShapeDescription] =
    for
      piece <- pass.shape(s, this)
      declaration <- convert(piece.shape, "Shape")
    yield piece.copy(
      shape = declaration,
      material = piece.material match
        case MaterialRef.Inline(d) =>
          sharing(d, "Material").fold(MaterialRef.Default)(MaterialRef.Inline(_))
        case other => other
      ,
      areaLight = piece.areaLight.flatMap(sharing(_, "AreaLightSource"))
    )

object PassRun:
  /** With the transform inverted: pbrt-v2 and v3 place some textures by the inverse. */
  def inverse(t: TextureDescription): TextureDescription =
    t.copy(textureToWorld = GraphicsState.inverse(t.textureToWorld))

  def unplaced(t: TextureDescription): TextureDescription =
    t.copy(textureToWorld = GraphicsState.constant(Transform.Identity))

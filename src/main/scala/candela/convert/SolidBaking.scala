package candela.convert

import candela.diagnostics.{Code, Problem}
import candela.color.Rgb
import candela.math.Transform
import candela.scenefile.*

import scala.collection.mutable

/** Paints marble, which v3 colours otherwise than v2 and v4, for each shape that shows it: by its u
  * and v, where these tell its points apart. Shapes of objects are left as they are: each instance
  * shows another part of the marble.
  */
final class SolidBaking(
    scene: SceneDescription,
    to: Dialect,
    files: SideFiles,
    baking: Baking
):
  private val warnings = mutable.LinkedHashSet.empty[Problem]
  private val added = mutable.ArrayBuffer.empty[TextureDescription]
  private val bakedNames = mutable.HashMap.empty[(Declaration, Transform, String), Option[String]]

  private val uses = TextureUses(scene.textures)
  private val names = mutable.HashSet.from(scene.textures.map(_.name))
  private val numbers = mutable.HashMap.empty[String, Int]

  private val solids: Map[String, TextureDescription] =
    scene.textures
      .filter(t => t.valueType == "spectrum")
      .filter(t => uses.closure(t).exists(_.texture.name == "marble"))
      .map(t => t.name -> t)
      .toMap
  private val named = scene.namedMaterials.toMap

  def result: Converted =
    if solids.isEmpty then Converted(scene, Vector.empty)
    else
      val shapes = scene.shapes.map(baked)
      Converted(
        withoutUnused(scene.copy(shapes = shapes, textures = scene.textures ++ added)),
        warnings.toVector
      )

  private def baked(s: ShapeDescription): ShapeDescription =
    s.material.declared(named).filter(_.params.exists(isSolid)).fold(s): d =>
      val params = d.params.map: p =>
        val image = Option.when(isSolid(p))(p.strings.head).flatMap(painted(s, _))
        image.fold(p)(name => p.withStrings(Vector(name)))
      s.copy(material = MaterialRef.Inline(d.copy(params = params)))

  private def isSolid(p: Param) =
    p.paramType == ParamType.Texture && p.strings.headOption.exists(solids.contains)

  private def painted(s: ShapeDescription, texture: String): Option[String] =
    bakedNames.getOrElseUpdate(
      (s.shape, s.objectToWorld.start, texture), {
        val points =
          if s.objectToWorld.isAnimated then None else UvPoints.of(s.shape, baking.size)
        val image = points.flatMap(paint(s, solids(texture), _))
        val difference = s"pbrt-v3 colours the marble of \"$texture\" differently"
        warnings += Problem.warning(
          Code.Inexpressible,
          s.shape.pos,
          if image.isDefined then s"$difference; using ${baking.describe} for this shape"
          else s"$difference, and it can't be baked: its points do not have distinct u and v"
        )
        image
      }
    )

  private def paint(
      s: ShapeDescription,
      texture: TextureDescription,
      points: UvPoints
  ): Option[String] =
    val dependencies = uses.closure(texture)
    for value <- baking.values(SceneDescription(scene.dialect, textures = dependencies)) yield
      val toWorld = s.objectToWorld.start
      val file = baking.write(files, samplesAcross = 2): (x, y) =>
        val color = value(points.window.u(x), points.window.v(y), toWorld.point(points.point(x, y)))
        // What v3 extrapolates may be negative
        color.map(c => Math.max(c, 0f))
      if to == Dialect.V4 then
        warnings += Problem.warning(
          Code.Inexpressible,
          texture.texture.pos,
          "v4 clamps reflectances to 1, which the colours that pbrt-v3 extrapolates may exceed"
        )
      val name = nameOfImage(texture.name)
      val image = points.window.image(texture.texture, file, scene.dialect)
      added += texture.copy(
        name = name,
        texture = image,
        textureToWorld = GraphicsState.Identity
      )
      name

  private def nameOfImage(texture: String): String =
    val number =
      Iterator.from(numbers.getOrElse(texture, 1)).find(i => names.add(s"$texture baked $i")).get
    numbers(texture) = number + 1
    s"$texture baked $number"

  /** Without materials and textures that have been replaced. */
  private def withoutUnused(converted: SceneDescription): SceneDescription =
    val shapes = converted.shapes ++ converted.objects.values.flatten
    def textures(d: Declaration) =
      d.params.filter(_.paramType == ParamType.Texture).flatMap(_.strings)
    val byName = shapes.map(_.material).collect { case MaterialRef.Named(name, _) => name } ++
      converted.namedMaterials.flatMap(_._2.params).filter(_.paramType == ParamType.String)
        .flatMap(_.strings)
    val usedNames = byName.toSet
    val materials = converted.namedMaterials.filter: (name, d) =>
      usedNames(name) || !d.params.exists(isSolid)
    val declarations = materials.map(_._2) ++ shapes.map(_.shape) ++
      shapes.map(_.material).collect { case MaterialRef.Inline(d) => d }
    val referenced = declarations.flatMap(textures).toSet
    val live = converted.textures.filter(t => referenced(t.name))
      .flatMap(TextureUses(converted.textures).closure).map(_.name).toSet
    converted.copy(
      namedMaterials = materials,
      textures = converted.textures.filter(t => live(t.name) || !solids.contains(t.name))
    )

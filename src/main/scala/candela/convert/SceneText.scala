package candela.convert

import candela.diagnostics.SourcePos
import java.io.Writer

import candela.scenefile.*

/** Writes a description as a scene file of its dialect.
  *
  * Writes every transform in full, so that no statement depends on earlier ones. Consecutive shapes
  * that differ only in their transform share a block.
  */
final class SceneText private (out: Writer, scene: SceneDescription):
  private val text = Statements(out, scene.dialect)
  import text.{block, blank, line, statement}

  private val isV4 = scene.dialect == Dialect.V4

  /** The exterior medium outside all blocks is the camera's; blocks override it. */
  private val outside = scene.cameraMedium

  /** pbrt-v4 must know the camera's medium before the world begins. */
  private val (early, late) = scene.media.partition(m => isV4 && m.name == outside)

  private def write(): Unit =
    options()
    blank()
    line("WorldBegin")
    textures()
    materials()
    media()
    lights()
    for (name, shapes) <- scene.objects do
      blank()
      block(s"ObjectBegin ${Statements.quoted(name)}", "ObjectEnd")(grouped(shapes))
    grouped(scene.shapes)
    instances()
    if !isV4 then
      blank()
      line("WorldEnd")

  private def options(): Unit =
    for o <- scene.options do option(o)
    val (start, end) = scene.transformTimes
    if start != 0f || end != 1f then
      line(s"TransformTimes ${NumberText.of(start)} ${NumberText.of(end)}")
    if outside.nonEmpty then line(s"MediumInterface \"\" ${Statements.quoted(outside)}")
    for c <- scene.camera do
      if !isStill(scene.worldToCamera) then text.transform(scene.worldToCamera)
      text.declaration("Camera", c)
    val v2 = scene.dialect == Dialect.V2
    for
      (directive, d) <- Vector(
        "Film" -> scene.film,
        "Sampler" -> scene.sampler,
        "PixelFilter" -> scene.filter,
        (if v2 then "SurfaceIntegrator" else "Integrator") -> scene.integrator,
        "VolumeIntegrator" -> scene.volumeIntegrator,
        "Renderer" -> scene.renderer,
        "Accelerator" -> scene.accelerator
      )
      declaration <- d
    do text.declaration(directive, declaration)
    // There are no blocks before the world, which would end `Attribute`
    for m <- early do
      text.transform(m.mediumToWorld)
      medium(m.copy(medium = m.medium.copy(params = m.medium.params.map(_.asOwn))))

  /** `Option` has no type before its name. */
  private def option(p: Param): Unit =
    val value = p.paramType match
      case ParamType.String => p.strings.map(Statements.quoted).mkString(" ")
      case ParamType.Bool => p.bools.mkString(" ")
      case ParamType.Integer => p.ints.mkString(" ")
      case _ => p.floats.map(NumberText.of).mkString(" ")
    line(s"Option ${Statements.quoted(p.name)} $value")

  private def isStill(t: AnimatedTransform): Boolean = !t.isAnimated && t.start.isIdentity

  /** v2 and v3 would discard a definition at `AttributeEnd`; v4 deprecates `TransformBegin`. */
  private def placed(t: AnimatedTransform, isMore: Boolean)(body: => Unit): Unit =
    val kind = if isV4 then "Attribute" else "Transform"
    if isStill(t) && !isMore then body
    else
      block(s"${kind}Begin", s"${kind}End"):
        if !isStill(t) then text.transform(t)
        body

  private def hasDefaults(d: Declaration): Boolean = d.params.exists(_.isDefault)

  private def textures(): Unit =
    if scene.textures.nonEmpty then blank()
    for t <- scene.textures do
      placed(t.textureToWorld, hasDefaults(t.texture)):
        text.defaults("texture", t.texture)
        val valueType = if scene.dialect == Dialect.V2 && t.valueType == "spectrum" then "color"
        else t.valueType
        text.declaration("Texture", Vector(t.name, valueType, t.texture.name), t.texture)

  private def materials(): Unit =
    if scene.namedMaterials.nonEmpty then blank()
    for (name, m) <- scene.namedMaterials do
      placed(GraphicsState.Identity, hasDefaults(m)):
        text.defaults("material", m)
        text.declaration("MakeNamedMaterial", Vector(name), typed(m))

  private def media(): Unit =
    if late.nonEmpty then blank()
    for m <- late do
      placed(m.mediumToWorld, hasDefaults(m.medium)):
        text.defaults("medium", m.medium)
        medium(m)

  private def medium(m: MediumDescription): Unit =
    text.declaration("MakeNamedMedium", Vector(m.name), typed(m.medium))

  /** The declaration with its class as a parameter. */
  private def typed(d: Declaration): Declaration =
    val kind = Param(ParamType.String, "type", d.pos, d.pos, strings = Vector(d.name))
    d.copy(params = kind +: d.params)

  private def lights(): Unit =
    if scene.lights.nonEmpty || scene.volumes.nonEmpty then blank()
    for l <- scene.lights do
      val isPlain = isStill(l.lightToWorld) && l.medium == outside && !hasDefaults(l.light)
      attributes(isPlain):
        medium("", l.medium)
        if !isStill(l.lightToWorld) then text.transform(l.lightToWorld)
        text.defaults("light", l.light)
        text.declaration("LightSource", l.light)
    for v <- scene.volumes do
      attributes(isStill(v.lightToWorld)):
        if !isStill(v.lightToWorld) then text.transform(v.lightToWorld)
        text.declaration("Volume", v.light)

  private def attributes(isPlain: Boolean)(body: => Unit): Unit =
    if isPlain then body else block("AttributeBegin", "AttributeEnd")(body)

  private def medium(inner: String, outer: String): Unit =
    if inner.nonEmpty || outer != outside then
      line(s"MediumInterface ${Statements.quoted(inner)} ${Statements.quoted(outer)}")

  private def grouped(shapes: Vector[ShapeDescription]): Unit =
    var start = 0
    while start < shapes.length do
      val common = Surroundings(shapes(start))
      var end = start + 1
      while end < shapes.length && Surroundings(shapes(end)) == common do end += 1
      val group = shapes.slice(start, end)
      start = end
      blank()
      val isPlain = common == Surroundings.default(outside) &&
        group.forall(s => isStill(s.objectToWorld))
      attributes(isPlain)(shapesOf(common, group))

  private def shapesOf(common: Surroundings, group: Vector[ShapeDescription]): Unit =
    medium(common.inside, common.outside)
    common.material match
      case MaterialRef.Default => ()
      case MaterialRef.Named(name, _) => line(s"NamedMaterial ${Statements.quoted(name)}")
      case MaterialRef.Inline(m) =>
        text.defaults("material", m)
        text.declaration("Material", m)
    for a <- common.areaLight do
      text.defaults("light", a)
      text.declaration("AreaLightSource", a)
    if common.isReversed then line("ReverseOrientation")
    if common.defaults.nonEmpty then statement("Attribute", Vector("shape"), common.defaults)
    var current = GraphicsState.Identity
    for s <- group do
      if s.objectToWorld != current then text.transform(s.objectToWorld)
      current = s.objectToWorld
      text.declaration("Shape", s.shape)

  private def instances(): Unit =
    if scene.instances.nonEmpty then
      blank()
      val isPlain = scene.instances.forall(i => isStill(i.instanceToWorld))
      attributes(isPlain):
        var current = GraphicsState.Identity
        for k <- scene.instances.indices do
          val i = scene.instances(k)
          if i.instanceToWorld != current then
            if scene.instances.isPlain(k) then text.placement(i.instanceToWorld.start)
            else text.transform(i.instanceToWorld)
          current = i.instanceToWorld
          line(s"ObjectInstance ${Statements.quoted(i.name)}")

object SceneText:
  def write(scene: SceneDescription, out: Writer): Unit = SceneText(out, scene).write()

/** Attributes shared by the shapes of a block. Compares declarations by position: cheap, and exact
  * within one file.
  */
private final case class Surroundings(
    material: MaterialRef,
    areaLight: Option[Declaration],
    isReversed: Boolean,
    inside: String,
    outside: String,
    defaults: Vector[Param],
    colorSpace: String
)

private object Surroundings:
  def apply(s: ShapeDescription): Surroundings =
    val material = s.material match
      case MaterialRef.Named(name, _) => MaterialRef.Named(name, SourcePos.Nowhere)
      case other => other
    Surroundings(
      material, s.areaLight, s.reverseOrientation, s.insideMedium, s.outsideMedium,
      s.shape.params.filter(_.isDefault), s.shape.colorSpace
    )

  /** Attributes of shapes that specify none. */
  def default(outside: String): Surroundings =
    Surroundings(MaterialRef.Default, None, false, "", outside, Vector.empty, "srgb")

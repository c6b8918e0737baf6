package candela.build

import candela.build.materials.Materials
import candela.build.recipe.Findings
import candela.scenefile.{Declaration, MaterialRef, SceneDescription, ShapeDescription}

/** Checks materials that nothing rendered has. pbrt-v4 makes them, too, and refuses what is wrong
  * with them, as Mitsuba does; older pbrts go on.
  */
private[build] object UnusedMaterials:

  /** @param shapes   that are rendered
    * @param uses     of objects
    * @param textures defines textures
    */
  def check(context: BuildContext, shapes: Vector[ShapeDescription], uses: ObjectUses)(
      textures: SceneTextures
  ): Unit =
    val scene = context.description
    val inObjects = uses.unplaced.map(_.material).distinct
    val named = unusedNames(scene, shapes)
    val (inPlace, undefined) = split(scene, inObjects)
    val (idleInPlace, idleNames) = split(scene, scene.idleMaterials)
    if named.nonEmpty || (inPlace ++ undefined ++ idleInPlace ++ idleNames).nonEmpty then
      val isFatal = context.isV4
      val findings = if isFatal then context.problems else Findings(lost = scene.failedKinds)
      val aside = context.aside(findings)
      aside.resources.defineLater(textures.in(aside))
      MaterialTable.define(aside)
      for (name, d) <- named do
        aside.resources.materials(name, d.pos, aside.resources, findings): Unit
      for d <- idleInPlace ++ inPlace do Materials.build(aside.site(d)): Unit
      for ref <- undefined do
        aside.resources.materials(ref.name, ref.at, aside.resources, findings): Unit
      if !isFatal then context.problems.warnOf(findings)
      // Even pbrt-v4 looks for them only where a shape has them
      val warnings = Findings(lost = scene.failedKinds)
      for ref <- idleNames do
        aside.resources.materials(ref.name, ref.at, aside.resources, warnings): Unit
      context.problems.warnOf(warnings)

  /** Those that are written in place, and those that are names of nothing. */
  private def split(
      scene: SceneDescription,
      refs: Vector[MaterialRef]
  ): (Vector[Declaration], Vector[MaterialRef.Named]) =
    lazy val names = scene.namedMaterials.map(_._1).toSet
    val inPlace = refs.collect { case MaterialRef.Inline(d) => d }
    (inPlace, refs.collect { case ref: MaterialRef.Named if !names(ref.name) => ref })

  private def unusedNames(scene: SceneDescription, shapes: Vector[ShapeDescription]) =
    val shapeMaterials =
      shapes.iterator.map(_.material).collect { case MaterialRef.Named(name, _) => name }
    val names = if scene.namedMaterials.isEmpty then Set.empty else shapeMaterials.toSet
    scene.namedMaterials.filterNot((name, _) => names(name))

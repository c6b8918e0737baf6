package candela.build

import candela.build.materials.Materials
import candela.build.recipe.Findings
import candela.scenefile.{MaterialRef, SceneDescription, ShapeDescription}

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
    val inObjects = uses.unplaced.map(_.material).distinct.collect:
      case MaterialRef.Inline(d) => d
    val (named, inPlace) = (unusedNames(scene, shapes), scene.idleMaterials ++ inObjects)
    if named.nonEmpty || inPlace.nonEmpty then
      val isFatal = context.isV4
      val findings = if isFatal then context.problems else Findings(lost = scene.failedKinds)
      val aside = context.aside(findings)
      aside.resources.defineLater(textures.in(aside))
      MaterialTable.define(aside)
      for (name, d) <- named do
        aside.resources.materials(name, d.pos, aside.resources, findings): Unit
      for d <- inPlace do Materials.build(aside.site(d)): Unit
      if !isFatal then context.problems.warnOf(findings)

  private def unusedNames(scene: SceneDescription, shapes: Vector[ShapeDescription]) =
    val shapeMaterials =
      shapes.iterator.map(_.material).collect { case MaterialRef.Named(name, _) => name }
    val names = if scene.namedMaterials.isEmpty then Set.empty else shapeMaterials.toSet
    scene.namedMaterials.filterNot((name, _) => names(name))

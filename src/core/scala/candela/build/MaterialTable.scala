package candela.build

import scala.collection.mutable

import candela.bsdf.{DiffuseEquivalent, Material}
import candela.build.integrators.IntegratorPlan
import candela.build.materials.{Materials, ShapeMaterials}
import candela.media.MediumBorder
import candela.scene.SceneMaterials
import candela.scenefile.{Declaration, MaterialRef, ShapeDescription}

/** A shape and the index of its material.
  *
  * @param declared its statement, without material parameters
  */
private[build] final case class DressedShape(
    shape: ShapeDescription,
    declared: Declaration,
    material: Int
)

/** Materials of all shapes, by index. A material has one index for each pair of media that it
  * separates.
  *
  * @param borders      medium interfaces, as supported by the integrator
  * @param touchesMedia whether any surface is a medium interface, supported or not
  */
private[build] final class MaterialTable private (
    val materials: Array[Material],
    val borders: Array[MediumBorder],
    val touchesMedia: Boolean,
    named: => Vector[String],
    maker: (BuildContext, IntegratorPlan) => Int => Material,
    ofShape: Array[Int],
    ownPart: ShapeDescription => Declaration
):
  lazy val ofScene: SceneMaterials = SceneMaterials(materials)

  def names: Vector[String] = named

  /** The materials in another colour basis, in the same order, of one of so many.
    *
    * @param context made anew with each set of materials
    */
  def inBasis(bases: Int, isDispersive: Boolean, integrator: IntegratorPlan)(
      context: () => BuildContext
  ): SceneMaterials =
    ofScene.inBasis(isDispersive, Math.max(MaterialTable.MaxMaterials / bases, 1)): () =>
      maker(context(), integrator)

  /** Whether any material disperses light in this colour basis of a scene that may. */
  def disperses(context: BuildContext, integrator: IntegratorPlan): Boolean =
    context.resources.census.isDispersive &&
      materials.indices.map(maker(context, integrator)).exists(_.isDispersive)

  /** Of the shape at a place among all. */
  def materialOf(shapeIndex: Int): Int = ofShape(shapeIndex)

  /** @param shapeIndex of the shape among all */
  def dress(shape: ShapeDescription, shapeIndex: Int): DressedShape =
    DressedShape(shape, ownPart(shape), ofShape(shapeIndex))

  lazy val needsTangents: Boolean = materials.exists(_.isAnisotropic)

  def describe: String =
    s"${materials.length}, ${materials.count(_.isConstant)} of them constant"

  def describeSubsurface(integrator: IntegratorPlan): String =
    val count = materials.count(_.isSubsurface)
    if count == 0 then "none"
    else if integrator.goesBeneath then s"subsurface scattering in $count materials"
    else s"ignored for $count materials: this integrator does not support it, as in pbrt"

private[build] object MaterialTable:
  /** Materials kept in all colour bases together, of half a kilobyte each. */
  private val MaxMaterials = 1 << 19

  /** @param shapes all shapes to render */
  def of(
      context: BuildContext,
      integrator: IntegratorPlan,
      media: MediaBuilder,
      shapes: Vector[ShapeDescription]
  ): MaterialTable =
    val named = context.description.namedMaterials
    val shapeMaterials = ShapeMaterials(context.dialect, named.toMap)
    def split(s: ShapeDescription) = shapeMaterials.split(s.shape, s.material)

    // Each has its material looked up once: there may be millions
    val assignments = mutable.ArrayBuffer.empty[(Finish, MediumBorder)]
    // The first index of each, and others of those that have several
    val firsts = java.util.HashMap[MaterialRef, Int]()
    val extraIndices = mutable.HashMap.empty[(Finish, MediumBorder), Int]
    // Materials with several indices, one for each pair of media and side
    val sharing = mutable.HashSet.empty[MaterialRef]
    def number(assignment: (Finish, MediumBorder)): Int =
      def added =
        assignments += assignment
        assignments.size - 1
      val ref = assignment._1.ref
      val first = firsts.getOrDefault(ref, -1)
      if first < 0 then
        firsts.put(ref, assignments.size): Unit
        added
      else if assignments(first) == assignment then first
      else
        sharing += ref
        extraIndices.getOrElseUpdate(assignment, added)
    val ofShape = new Array[Int](shapes.size)
    var touchesMedia = false
    var shapeIndex = 0
    var last: (ShapeDescription, MaterialRef) | Null = null
    for s <- shapes do
      val ref = split(s)._2
      // Most shapes wear what the one before does: its statement is not compared part by part
      val previous = last
      ofShape(shapeIndex) =
        if previous != null && (previous._2 eq ref) && isWornAlike(previous._1, s) then
          ofShape(shapeIndex - 1)
        else
          val border = media.border(s)
          touchesMedia |= border.inside >= 0 || border.outside >= 0
          last = (s, ref)
          number((Finish(ref, s.oneSided), media.supported(border)))
      shapeIndex += 1
    define(context)
    val families = MaterialFamilies(assignments.size)
    def maker(
        context: BuildContext,
        integrator: IntegratorPlan,
        inPlace: (Int, Declaration) => Material
    ): Int => Material =
      val cache = mutable.HashMap.empty[MaterialRef, Material]
      index =>
        val finish = assignments(index)._1
        def create = finished(context, integrator, finish.ref, inPlace(index, _))
        finish.of(if sharing.isEmpty || !sharing(finish.ref) then create
        else cache.getOrElseUpdate(finish.ref, create))
    new MaterialTable(
      assignments.indices.map(maker(context, integrator, families.plainBuilder(context))).toArray,
      assignments.map(_._2).toArray,
      touchesMedia,
      assignments.map((finish, _) => name(finish.ref)).toVector,
      (context, integrator) => maker(context, integrator, families.familyBuilder(context)),
      ofShape,
      split(_)._1
    )

  /** Makes the named materials known. */
  def define(context: BuildContext): Unit =
    for (name, d) <- context.description.namedMaterials do
      context.resources.materials.define(
        name,
        d.pos,
        Materials.nestedNames(d),
        other => Materials.build(context.in(other).site(d))
      )

  private def isWornAlike(a: ShapeDescription, b: ShapeDescription): Boolean =
    a.oneSided == b.oneSided && a.insideMedium == b.insideMedium &&
      a.outsideMedium == b.outsideMedium

  /** A material and whether it is black from behind. */
  private final case class Finish(ref: MaterialRef, isOneSided: Boolean):
    def of(material: Material): Material =
      if isOneSided then material.oneSided else material

  private def name(ref: MaterialRef): String = ref match
    case MaterialRef.Default => "default"
    case MaterialRef.Inline(d) => StatementName(d)
    case MaterialRef.Named(name, _) => name

  /** @param inPlace builds a material that is written in place */
  private def finished(
      context: BuildContext,
      integrator: IntegratorPlan,
      ref: MaterialRef,
      inPlace: Declaration => Material
  ): Material =
    material(context, ref, inPlace) match
      case made if made.isInterface => made
      case made if context.resources.settings.diffuse =>
        integrator.finish(DiffuseEquivalent(made, transmits = true))
      case made => integrator.finish(made)

  private def material(
      context: BuildContext,
      ref: MaterialRef,
      inPlace: Declaration => Material
  ): Material = ref match
    case MaterialRef.Default => Materials.default
    case MaterialRef.Inline(d) => inPlace(d)
    case MaterialRef.Named(name, at) =>
      context.resources.materials(name, at, context.resources, context.problems)

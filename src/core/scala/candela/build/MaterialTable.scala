package candela.build

import scala.collection.mutable

import candela.bsdf.{DiffuseEquivalent, Material}
import candela.build.integrators.IntegratorPlan
import candela.build.materials.{Materials, ShapeMaterials}
import candela.media.MediumBorder
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
    val names: Vector[String],
    make: (BuildContext, IntegratorPlan) => Array[Material],
    dressed: ShapeDescription => DressedShape
):
  /** The materials in another colour basis, in the same order. */
  def in(context: BuildContext, integrator: IntegratorPlan): Array[Material] =
    make(context, integrator)

  def dress(shape: ShapeDescription): DressedShape = dressed(shape)

  def needsTangents: Boolean = materials.exists(_.isAnisotropic)

  def describe: String =
    s"${materials.length}, ${materials.count(_.isConstant)} of them constant"

  def describeSubsurface(integrator: IntegratorPlan): String =
    val count = materials.count(_.isSubsurface)
    if count == 0 then "none"
    else if integrator.goesBeneath then s"subsurface scattering in $count materials"
    else s"ignored for $count materials: this integrator does not support it, as in pbrt"

private[build] object MaterialTable:

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

    val borders = shapes.map(media.border)
    def wear(s: ShapeDescription, b: MediumBorder) =
      (Finish(split(s)._2, s.oneSided), media.seen(b))
    val worn = shapes.zip(borders).map(wear).distinct
    val number = worn.zipWithIndex.toMap
    def make(context: BuildContext, integrator: IntegratorPlan): Array[Material] =
      for (name, d) <- named do
        context.resources.materials.define(
          name,
          d.at,
          Materials.parts(d),
          () => Materials.build(context.site(d))
        )
      val made = mutable.HashMap.empty[MaterialRef, Material]
      worn.map: (finish, _) =>
        finish.of(made.getOrElseUpdate(finish.ref, finished(context, integrator, finish.ref)))
      .toArray
    new MaterialTable(
      make(context, integrator),
      worn.map(_._2).toArray,
      borders.exists(b => b.inside >= 0 || b.outside >= 0),
      worn.map((finish, _) => name(finish.ref)),
      make,
      s =>
        DressedShape(s, split(s)._1, number(wear(s, media.border(s))))
    )

  /** A material and whether it is black from behind. */
  private final case class Finish(ref: MaterialRef, isOneSided: Boolean):
    def of(made: Material): Material =
      if isOneSided then made.oneSided else made

  private def name(ref: MaterialRef): String = ref match
    case MaterialRef.Default => "default"
    case MaterialRef.Inline(d) => StatementName(d)
    case MaterialRef.Named(name, _) => name

  private def finished(
      context: BuildContext,
      integrator: IntegratorPlan,
      ref: MaterialRef
  ): Material =
    material(context, ref) match
      case made if made.isInterface => made
      case made if context.resources.switches.diffuse =>
        integrator.finish(DiffuseEquivalent(made, transmits = true))
      case made => integrator.finish(made)

  private def material(context: BuildContext, ref: MaterialRef): Material = ref match
    case MaterialRef.Default => Materials.default
    case MaterialRef.Inline(d) => Materials.build(context.site(d))
    case MaterialRef.Named(name, at) =>
      context.resources.materials(name, at, context.resources, context.problems)

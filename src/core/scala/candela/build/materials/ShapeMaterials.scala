package candela.build.materials

import candela.build.shapes.Shapes
import candela.scenefile.{Declaration, Dialect, MaterialRef}

/** Moves material parameters of `Shape` statements to the material. In v2 and v3 they override
  * those of the material for this shape. v2 does not apply them to named materials.
  */
final class ShapeMaterials(dialect: Dialect, named: Map[String, Declaration]):

  /** Returns the shape without material parameters and the material with them. */
  def split(shape: Declaration, material: MaterialRef): (Declaration, MaterialRef) =
    val pair =
      for
        said <- declaration(shape, material)
        surface <- Materials.all.lookUp(said.name, dialect)
        geometry <- Shapes.all.lookUp(shape.name, dialect)
        moved = shape.params.filter: p =>
          surface.hasParameter(p.name, dialect) && !geometry.hasParameter(p.name, dialect)
        if moved.nonEmpty
      yield
        val remaining = said.params.filterNot(p => moved.exists(_.name == p.name))
        (
          shape.copy(params = shape.params.filterNot(moved.contains)),
          MaterialRef.Inline(said.copy(params = remaining ++ moved))
        )
    pair.getOrElse((shape, material))

  private def declaration(shape: Declaration, material: MaterialRef): Option[Declaration] =
    material match
      case _ if dialect == Dialect.V4 => None
      case MaterialRef.Inline(d) => Some(d)
      case MaterialRef.Named(name, _) => named.get(name).filter(_ => dialect == Dialect.V3)
      case MaterialRef.Default =>
        Some(shape.copy(category = "Material", name = "matte", params = Vector.empty))

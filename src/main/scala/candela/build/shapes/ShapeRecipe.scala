package candela.build.shapes

import candela.build.recipe.*
import candela.scenefile.Dialect

/** What all shapes have.
  *
  * Its holes are read by [[Alpha]].
  *
  * @param alphaIn the dialects in which the shape can have holes
  */
abstract class ShapeRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect] = every,
    alphaIn: Set[Dialect] = onlyV4
) extends Recipe[Option[ShapeGeometry]](name, meaning, dialects):
  if alphaIn.exists(dialects) then
    val _ = floatTexture("alpha", "0 where the surface has holes", alphaIn)(1f)

/** What meshes have beside. */
abstract class MeshRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends ShapeRecipe(name, meaning, dialects, alphaIn = dialects):
  protected val shadowAlpha: Field[?] =
    floatTexture("shadowalpha", "0 where it casts no shadow", onlyV3)(1f)

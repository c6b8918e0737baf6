package candela.build

import candela.scenefile.Dialect

/** Recipes of shapes. */
object Shapes:
  val all: Recipes[Option[ShapeGeometry]] =
    Recipes(
      "shape",
      Vector(SphereRecipe, DiskRecipe, TriangleMeshRecipe, PlyMeshRecipe, LoopSubdivRecipe),
      Vector("cylinder", "cone", "paraboloid", "hyperboloid", "heightfield", "nurbs", "curve",
        "bilinearmesh")
        .map(_ -> "it is left out")
        .toMap
    )

/** What all shapes have. */
abstract class ShapeRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect] = Dialect.values.toSet
) extends Recipe[Option[ShapeGeometry]](name, meaning, dialects):
  notYet("the shape is opaque")(
    floatTexture("alpha", "0 where the surface has holes")(1f)
  )
  notYet("the shape casts full shadows")(
    floatTexture("shadowalpha", "0 where it casts no shadow", onlyV3)(1f)
  )

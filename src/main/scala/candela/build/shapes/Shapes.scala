package candela.build.shapes

import candela.build.recipe.*

/** Recipes of shapes. */
object Shapes:
  val all: Recipes[Option[ShapePlan]] =
    Recipes(
      "shape",
      Vector(
        SphereRecipe, CylinderRecipe, DiskRecipe, ConeRecipe, ParaboloidRecipe, HyperboloidRecipe,
        TriangleMeshRecipe, PlyMeshRecipe, BilinearMeshRecipe, LoopSubdivRecipe, CurveRecipe,
        HeightFieldRecipe, NurbsRecipe
      )
    )

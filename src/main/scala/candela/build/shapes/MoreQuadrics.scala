package candela.build

import candela.math.Vec3

object CylinderRecipe
    extends ShapeRecipe("cylinder", "a cylinder about the z axis, whole or a part")
    with LeftOut:
  declare(
    float("radius", "radius", unit = "scene units")(1f),
    float("zmin", "z of its lower end", unit = "scene units")(-1f),
    float("zmax", "z of its upper end", unit = "scene units")(1f),
    float("phimax", "sweep about z", unit = "degrees")(360f)
  )

object ConeRecipe
    extends ShapeRecipe("cone", "a cone about the z axis, its base at z = 0", untilV3)
    with LeftOut:
  declare(
    float("radius", "radius of the base", unit = "scene units")(1f),
    float("height", "z of its tip", unit = "scene units")(1f),
    float("phimax", "sweep about z", unit = "degrees")(360f)
  )

object ParaboloidRecipe
    extends ShapeRecipe("paraboloid", "a paraboloid about the z axis, whole or a part", untilV3)
    with LeftOut:
  declare(
    float("radius", "radius at `zmax`", unit = "scene units")(1f),
    float("zmin", "z of the lower clip plane", unit = "scene units")(0f),
    float("zmax", "z of the upper clip plane", unit = "scene units")(1f),
    float("phimax", "sweep about z", unit = "degrees")(360f)
  )

object HyperboloidRecipe
    extends ShapeRecipe("hyperboloid", "a segment turned about the z axis", untilV3)
    with LeftOut:
  declare(
    point("p1", "one end of the segment")(Vec3.Zero),
    point("p2", "its other end")(Vec3(1f, 1f, 1f)),
    float("phimax", "sweep about z", unit = "degrees")(360f)
  )

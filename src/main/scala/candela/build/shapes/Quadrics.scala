package candela.build.shapes

import candela.build.recipe.*
import candela.math.*
import candela.shapes.{Disk, Sphere}

object SphereRecipe extends ShapeRecipe("sphere", "a sphere about the origin, whole or a part"):
  private val radius = float("radius", "radius", unit = "scene units")(1f)
  private val zmin =
    float("zmin", "z of the lower clip plane", shown = "-radius")(Float.NegativeInfinity)
  private val zmax =
    float("zmax", "z of the upper clip plane", shown = "radius")(Float.PositiveInfinity)
  private val phimax = float("phimax", "sweep about z", unit = "degrees")(360f)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val r = radius()
    val (z0, z1) = (clamp(zmin(), -r, r), clamp(zmax(), -r, r))
    val phi = radians(clamp(phimax(), 0f, 360f))
    if !(r > 0f) then
      site.error(s"a sphere's radius must be above 0; found $r")
      None
    else if z0 == z1 || phi == 0f then
      site.warn("this sphere has no surface between its limits: it is left out")
      None
    else
      Some(
        ShapeGeometry.Solid((toWorld, reversed) =>
          Sphere(toWorld, r, Math.min(z0, z1), Math.max(z0, z1), phi, reversed)
        )
      )

object DiskRecipe
    extends ShapeRecipe("disk", "a disk or ring in a plane of constant z, whole or a part"):
  private val height = float("height", "its place along z", unit = "scene units")(0f)
  private val radius = float("radius", "outer radius", unit = "scene units")(1f)
  private val inner = float("innerradius", "radius of the hole", unit = "scene units")(0f)
  private val phimax = float("phimax", "sweep about z", unit = "degrees")(360f)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val (r, i) = (radius(), inner())
    if !(r > 0f) || !(i >= 0f && i < r) then
      site.error(s"a disk needs 0 ≤ innerradius < radius; found innerradius $i, radius $r")
      None
    else if !(phimax() > 0f) then
      site.warn(s"this disk has no surface, as its `phimax` is ${phimax()}: it is left out")
      None
    else
      val (h, phi) = (height(), radians(clamp(phimax(), 0f, 360f)))
      Some(ShapeGeometry.Solid((toWorld, reversed) => Disk(toWorld, h, r, i, phi, reversed)))

package candela.build.shapes

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{Disk, Profile, Quadric, Spheres}

object SphereRecipe extends ShapeRecipe("sphere", "sphere about the origin, whole or partial"):
  private val radius =
    float("radius", "radius", unit = "scene units", range = Range.atLeast(0f).deferred)(1f)
  private val zmin = float(
    "zmin",
    "z of the lower clip plane",
    shown = "-radius",
    range = Range.Unlimited
  )(Float.NegativeInfinity)
  private val zmax = float(
    "zmax",
    "z of the upper clip plane",
    shown = "radius",
    range = Range.Unlimited
  )(Float.PositiveInfinity)
  private val phimax =
    float("phimax", "sweep angle about z", unit = "degrees", range = Swept.Degrees)(360f)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val r = Math.abs(radius())
    if radius() < 0f then
      site.warn(
        Code.CorrectedValue,
        s"`radius` of this sphere is ${radius()}; its absolute value counts, but pbrt also turns " +
          "its normals",
        Some(s"write \"float radius\" $r")
      )
    val (z0, z1) = (clamp(zmin(), -r, r), clamp(zmax(), -r, r))
    val phi = radians(phimax())
    if r == 0f then
      site.warn(Code.NoSurface, "this sphere has no surface, because `radius` is 0; it is ignored")
      None
    else if z0 == z1 || phi == 0f then
      site.warn(Code.NoSurface, "this sphere has no surface within its bounds; it is ignored")
      None
    else
      // One for all that the plan places
      val spheres = Spheres(r, Math.min(z0, z1), Math.max(z0, z1), phi)
      Some(ShapeGeometry.Solid(spheres(_, _)))

object DiskRecipe
    extends ShapeRecipe("disk", "disk or annulus in a plane of constant z, whole or partial"):
  private val height = float("height", "position along z", unit = "scene units")(0f)
  private val radius = float("radius", "outer radius", unit = "scene units")(1f)
  private val inner = float("innerradius", "inner radius", unit = "scene units")(0f)
  private val phimax =
    float("phimax", "sweep angle about z", unit = "degrees", range = Swept.Degrees)(360f)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val (r, i) = (radius(), inner())
    def leftOut(why: String) =
      site.warn(Code.NoSurface, s"this disk has no surface, because $why; it is ignored")
      None
    if r == 0f then leftOut("`radius` is 0")
    else if !(Math.abs(i) < Math.abs(r)) then
      leftOut(s"`innerradius`, $i, is not below `radius`, $r")
    else if phimax() == 0f then leftOut("`phimax` is 0")
    else
      if r < 0f || i < 0f then
        site.warn(
          Code.CorrectedValue,
          s"radii of this disk are negative: $r and $i; as in pbrt, their squares count"
        )
      val (h, phi) = (height(), radians(phimax()))
      def disk(toWorld: Transform, reversed: Boolean) =
        Disk(toWorld, h, r, i, phi, reversed, site.rules.diskU)
      Some(ShapeGeometry.Solid(disk, turned = r < 0f))

private object Swept:
  val Degrees: Range = Range(0f, 360f).limited

/** Base of surfaces of revolution about the z-axis. */
abstract class SweptRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends ShapeRecipe(name, meaning, dialects):
  private val phimax =
    float("phimax", "sweep angle about z", unit = "degrees", range = Swept.Degrees)(360f)

  protected final def swept(profile: Profile)(using site: Site): Option[ShapeGeometry] =
    val phi = radians(phimax())
    if phi > 0f then
      Some(ShapeGeometry.Solid((toWorld, reversed) => Quadric(toWorld, profile, phi, reversed)))
    else leftOut("`phimax` is 0")

  /** Ignores a shape without a surface, with a warning: pbrt renders such scenes. */
  protected final def leftOut(why: String)(using site: Site): Option[ShapeGeometry] =
    site.warn(Code.NoSurface, s"this $name has no surface, because $why; it is ignored")
    None

object CylinderRecipe extends SweptRecipe("cylinder", "open cylinder about the z-axis", every):
  private val radius = float("radius", "radius", unit = "scene units")(1f)
  private val zmin = float("zmin", "z of one end")(-1f)
  private val zmax = float("zmax", "z of the other end")(1f)

  protected def geometry()(using Site): Option[ShapeGeometry] =
    val (z0, z1) = (Math.min(zmin(), zmax()), Math.max(zmin(), zmax()))
    if radius() == 0f then leftOut("`radius` is 0")
    else if z0 == z1 then leftOut(s"`zmin` and `zmax` are both $z0")
    else swept(Profile.cylinder(radius(), z0, z1))

object ConeRecipe extends SweptRecipe("cone", "open cone about z, from z = 0 to its apex", untilV3):
  private val radius = float("radius", "radius at z = 0", unit = "scene units")(1f)
  private val height = float("height", "z of the apex", range = Range.above(0f).deferred)(1f)

  protected def geometry()(using Site): Option[ShapeGeometry] =
    if radius() == 0f then leftOut("`radius` is 0")
    else if !(height() > 0f) then leftOut(s"`height` is ${height()}")
    else swept(Profile.cone(radius(), height()))

object ParaboloidRecipe
    extends SweptRecipe("paraboloid", "paraboloid about z, with its apex at 0", untilV3):
  private val radius = float("radius", "radius at `zmax`", unit = "scene units")(1f)
  private val zmin = float("zmin", "z of the lower clip plane")(0f)
  private val zmax = float("zmax", "z of the upper clip plane")(1f)

  protected def geometry()(using Site): Option[ShapeGeometry] =
    val (z0, z1) = (Math.min(zmin(), zmax()), Math.max(zmin(), zmax()))
    if radius() == 0f then leftOut("`radius` is 0")
    else if z0 == z1 then leftOut(s"`zmin` and `zmax` are both $z0")
    else if z1 == 0f then leftOut("`zmax`, where `radius` applies, is 0")
    else swept(Profile.paraboloid(radius(), z0, z1))

object HyperboloidRecipe
    extends SweptRecipe("hyperboloid", "hyperboloid: surface of a line rotated about z", untilV3):
  private val p1 = point("p1", "start of the line")(Vec3.Zero)
  private val p2 = point("p2", "end of the line")(Vec3(1f, 1f, 1f))

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    Profile.hyperboloid(p1(), p2()) match
      case None => leftOut(s"`p1` and `p2` have the same z, ${p1().z}")
      case Some(profile) =>
        if profile.loose then
          site.warn(
            Code.CorrectedValue,
            "the line from `p1` to `p2` is not closest to the z-axis at z = 0; the hyperboloid " +
              "is symmetric about z = 0 and passes through `p2` only, but has the normals of the " +
              "line's surface, as in pbrt; where the two face apart, rounding decides which " +
              "light arrives, and pbrt's image may be brighter"
          )
        swept(profile)

package candela.build.textures

import candela.build.recipe.*
import candela.math.*
import candela.scenefile.Dialect
import candela.textures.*

/** Base of textures with a 2D mapping. */
abstract class MappedRecipe[A](name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[A](name, meaning, dialects):
  private val mapping =
    oneOf("mapping", "2D mapping", MappedRecipe.Mappings, forgiven = true)("uv")
  private val uscale = float("uscale", "scale of u")(1f)
  private val vscale = float("vscale", "scale of v")(1f)
  private val udelta = float("udelta", "offset of u")(0f)
  private val vdelta = float("vdelta", "offset of v")(0f)
  private val cross = Vector("u" -> "v", "v" -> "u").map: (of, by) =>
    float(s"${of}skew", s"what $by adds to $of", onlyOthers)(0f)
  private val second = bool("uv2", "use the second set of u and v of meshes", onlyGltf)(false)
  private val axis1 = vector("v1", "direction of s in a \"planar\" mapping")(Vec3.X)
  private val axis2 = vector("v2", "direction of t in a \"planar\" mapping")(Vec3.Y)

  /** @param period with which the texture repeats over s and t; 0: it does not */
  protected def mapped(period: Double)(using site: Site): Mapping2D = mapping() match
    case "spherical" => SphericalMapping(site.toWorld)
    case "cylindrical" =>
      CylindricalMapping(site.toWorld, onUnitSphere = site.dialect != Dialect.V4)
    case "planar" =>
      val world = site.resources.origin.toOrigin
      val space = if site.dialect == Dialect.V4 then site.toWorld else world
      if site.resources.origin.isOrigin then
        PlanarMapping(space, axis1(), axis2(), udelta(), vdelta())
      else
        // Whole periods are dropped in Double: s and t may be as far out as the scene
        val o = space.inverse.position(Position.Origin)
        def offset(axis: Vec3, delta: Float) =
          val far = o.x * axis.x + o.y * axis.y + o.z * axis.z + delta
          val withinPeriod = if period > 0 then far - period * Math.rint(far / period) else far
          withinPeriod.toFloat
        PlanarMapping(
          space * o.fromOrigin,
          axis1(),
          axis2(),
          offset(axis1(), udelta()),
          offset(axis2(), vdelta())
        )
    case _ if second() =>
      SecondUvMapping(uscale(), cross(0)(), udelta(), cross(1)(), vscale(), vdelta())
    case _ if cross.exists(_() != 0f) =>
      AffineUvMapping(uscale(), cross(0)(), udelta(), cross(1)(), vscale(), vdelta())
    case _ => UvMapping(uscale(), vscale(), udelta(), vdelta())

private object MappedRecipe:
  val Mappings: Vector[String] = Vector("uv", "spherical", "cylindrical", "planar")

/** Mappings of solid textures. */
private[build] object Solid:
  /** pbrt-v2 and v3 use the statement's transform as world-to-texture transform, not its inverse.
    */
  def mapping(using Site): Mapping3D = Mapping3D(worldToTexture)

  /** For a texture that repeats after `period` along each axis: whole periods may be left out. */
  def repeating(period: Double)(using site: Site): Mapping3D =
    if site.resources.origin.isOrigin then mapping
    else
      val far = worldToTexture.position(Position.Origin)
      def wholePeriods(x: Double) = period * Math.rint(x / period)
      Mapping3D(Position(
        wholePeriods(far.x),
        wholePeriods(far.y),
        wholePeriods(far.z)
      ).toOrigin * worldToTexture)

  private def worldToTexture(using site: Site): Transform =
    val origin = site.resources.origin
    if site.dialect == Dialect.V4 then site.toWorld.inverse
    else if origin.isOrigin then site.toWorld
    else origin.fromOrigin * site.toWorld * origin.fromOrigin

  /** Requests ray differentials, which limit the number of octaves. */
  def filtered(using site: Site): Mapping3D =
    site.resources.askForFootprints("solid textures")
    if site.resources.origin.isOrigin then mapping
    else
      val far = worldToTexture.position(Position.Origin)
      Mapping3D(far.toOrigin * worldToTexture, far)

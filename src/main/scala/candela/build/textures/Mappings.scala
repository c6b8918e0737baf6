package candela.build.textures

import candela.build.recipe.*
import candela.math.*
import candela.scenefile.Dialect
import candela.textures.*

/** The parameters of a two-dimensional mapping, which many textures share. */
abstract class MappedRecipe[A](name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[A](name, meaning, dialects):
  private val mapping =
    oneOf("mapping", "how the surface gets coordinates", MappedRecipe.Mappings)("uv")
  private val uscale = float("uscale", "repetitions along u")(1f)
  private val vscale = float("vscale", "repetitions along v")(1f)
  private val udelta = float("udelta", "shift along u")(0f)
  private val vdelta = float("vdelta", "shift along v")(0f)
  private val axis1 = vector("v1", "of `planar`: the direction of s")(Vec3.X)
  private val axis2 = vector("v2", "of `planar`: the direction of t")(Vec3.Y)

  protected def mapped()(using site: Site): Mapping2D = mapping() match
    case "spherical" => SphericalMapping(site.toWorld)
    case "cylindrical" =>
      CylindricalMapping(site.toWorld, onUnitSphere = site.dialect != Dialect.V4)
    case "planar" =>
      val space = if site.dialect == Dialect.V4 then site.toWorld else Transform.Identity
      PlanarMapping(space, axis1(), axis2(), udelta(), vdelta())
    case _ => UvMapping(uscale(), vscale(), udelta(), vdelta())

private object MappedRecipe:
  val Mappings: Vector[String] = Vector("uv", "spherical", "cylindrical", "planar")

/** What textures through space have in common. */
private[build] object Solid:
  /** pbrt-v2 and v3 take the statement's transform itself from world to texture, not its
    * inverse.
    */
  def mapping(using site: Site): Mapping3D =
    Mapping3D(if site.dialect == Dialect.V4 then site.toWorld.inverse else site.toWorld)

  /** Asks for the footprint, by which octaves are left out. */
  def filtered(using site: Site): Mapping3D =
    site.resources.askForFootprints("solid textures")
    mapping

package candela.build.lights

import candela.build.recipe.*
import candela.build.shapes.EmitterHoles
import candela.color.{ColorBasis, Rgb}
import candela.geometry.Bounds3
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{Shape, SurfaceSampler, TriangleSampler, TriangleSoup}

/** Recipes of lights that are surfaces. */
object AreaLights:
  val all: Recipes[Option[AreaLightPlan]] =
    Recipes(
      "area light",
      Vector(DiffuseLightRecipe("diffuse", every), DiffuseLightRecipe("area", untilV3))
    )

/** What an area light statement says; it applies to the shapes that follow.
  *
  * @param emitted radiance, or factor of the picture
  * @param power   v4's total of the whole shape, whatever its area; ≤ 0: none
  * @param perUnit luminance of the picture's mean; 1 if there is none
  */
final class AreaLightPlan(
    emitted: Rgb,
    picture: Option[Picture],
    perUnit: Float,
    power: Float,
    twoSided: Boolean,
    val samples: Int
):

  /** Emission of a shape of this area: v4's `power` fixes it, whatever the area. */
  private def radiance(area: => Float): Rgb =
    if power > 0f then
      val sides = if twoSided then 2f else 1f
      emitted * (power / (perUnit * area * Pi * sides))
    else emitted

  /** Every triangle is a shape of its own, as in pbrt-v4: each has all of the power. */
  def ofTriangle(triangle: TriangleSampler): SurfaceLight =
    light(triangle, Bounds3.of(triangle.vertices), triangle.normal, 1f, contrary = false)

  /** @param contrary as in [[candela.lights.Light.isContrary]] */
  def ofShape(shape: Shape, contrary: Boolean): SurfaceLight =
    val (axis, cosSpread) = shape.normals
    light(shape, shape.bounds, axis, cosSpread, contrary && !twoSided)

  private def light(
      surface: SurfaceSampler,
      bounds: Bounds3,
      axis: Vec3,
      cosSpread: Float,
      contrary: Boolean
  ): SurfaceLight =
    val emitted = radiance(surface.area)
    val plain = AreaLight(surface, emitted, twoSided, bounds, axis, cosSpread, contrary)
    picture.fold(plain)(PictureLight(plain, surface, _))

/** Makes nothing where nothing would shine. */
final class DiffuseLightRecipe(
    name: String,
    dialects: Set[Dialect]
) extends Recipe[Option[AreaLightPlan]](name, "a surface that emits evenly, or a picture", dialects)
    with SampleCounts:
  private val radiance =
    color("L", "emitted radiance", SpectrumRole.Emission, unit = "W/(m² sr)")(Rgb.White)
  private val colored =
    color("scale", "factor of `L`", SpectrumRole.Reflectance, untilV3)(Rgb.White)
  private val scale = float("scale", "factor of `L`, or of the picture", onlyV4)(1f)
  private val twoSided = bool("twosided", "does the inside emit too?", sinceV3)(false)
  private val power =
    float(
      "power", "total of each shape or triangle, instead of the size of `L`", onlyV4, "lm", "none"
    )(
      -1f
    )
  private val filename =
    string("filename", "image over the surface's uv, instead of `L`", onlyV4, "none")("")

  protected def make()(using site: Site): Option[AreaLightPlan] =
    val isPicture = site.dialect == Dialect.V4 && filename().nonEmpty
    if isPicture && radiance.given_().isDefined then
      site.error("give a diffuse light `L` or `filename`, not both")
    val image = if isPicture then LightImages.read("filename") else None
    val picture = image.map(Picture(_, PictureLookup.Smooth))
    val emitted = radiance() * colored() * scale()
    val perUnit = picture.fold(1f)(DiffuseLightRecipe.luminance(_, site.resources.basis))
    if isPicture && picture.isEmpty then None
    else if !(emitted.isFinite && emitted.max > 0f && perUnit > 0f) then
      site.warn("it emits nothing: shapes that follow are no lights")
      None
    else Some(AreaLightPlan(emitted, picture, perUnit, power(), twoSided(), sampleCount()))

private object DiffuseLightRecipe:
  def luminance(picture: Picture, basis: ColorBasis): Float =
    picture.mean((c, _, _) => basis.toSrgb(c).luminance)

/** The lights of an emitting mesh, to be made as soon as all triangles are known.
  *
  * @param first of its triangles
  */
private[build] final case class MeshLights(
    plan: AreaLightPlan,
    holes: EmitterHoles,
    first: Int,
    count: Int,
    site: Site
):
  def of(triangles: TriangleSoup): Vector[Light] =
    val samplers = Vector.tabulate(count)(k => TriangleSampler(triangles, first + k))
    val flat = samplers.count(s => !(s.area > 0f))
    if flat > 0 then
      site.warn(s"$flat of $count triangles of this light have no area: they emit nothing")
    samplers.map(s => holes.light(plan.ofTriangle(s), s))

package candela.build.lights

import candela.build.recipe.*
import candela.build.shapes.EmitterHoles
import candela.color.{ColorBasis, Rgb}
import candela.geometry.Bounds3
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{RectangleSampler, Shape, SurfaceSampler, TriangleSampler, TriangleSoup}

/** Recipes of area lights. */
object AreaLights:
  val all: Recipes[Option[AreaLightPlan]] =
    Recipes(
      "area light",
      Vector(DiffuseLightRecipe("diffuse", every), DiffuseLightRecipe("area", untilV3))
    )

/** An area light statement; it applies to the shapes that follow.
  *
  * @param emitted emitted radiance, or scale of the image
  * @param power   v4's total power per shape, independent of its area; not set if ≤ 0
  * @param perUnit mean luminance of the image; 1 without an image
  */
final class AreaLightPlan(
    emitted: Rgb,
    picture: Option[Picture],
    perUnit: Float,
    power: Float,
    twoSided: Boolean,
    val samples: Int
):

  /** Does each point emit alike? */
  def isUniform: Boolean = picture.isEmpty

  /** Radiance of a shape of this area; v4's `power` sets the total. */
  private def radiance(area: => Float): Rgb =
    if power > 0f then
      val sides = if twoSided then 2f else 1f
      emitted * (power / (perUnit * area * Pi * sides))
    else emitted

  /** Light of one triangle. Each triangle of a mesh has the full power, as in pbrt-v4. */
  def ofTriangle(triangle: TriangleSampler, box: Bounds3): SurfaceLight =
    light(triangle, box, triangle.normal, 1f, contrary = false)

  /** Light of two triangles that form a rectangle. */
  def ofRectangle(rectangle: RectangleSampler, box: Bounds3): SurfaceLight =
    AreaLight(rectangle, radiance(rectangle.area / 2), twoSided, box, rectangle.normal, 1f)

  /** @param contrary see [[candela.lights.Light.isContrary]] */
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

/** Creates no light if nothing is emitted. */
final class DiffuseLightRecipe(
    name: String,
    dialects: Set[Dialect]
) extends Recipe[Option[AreaLightPlan]](
      name,
      "diffuse area light, uniform or from an image",
      dialects
    )
    with SampleCounts:
  private val radiance =
    color("L", "emitted radiance", SpectrumRole.Emission, unit = "W/(m² sr)")(Rgb.White)
  private val colored =
    color("scale", "scale of `L`", SpectrumRole.Reflectance, untilV3)(Rgb.White)
  private val scale = float("scale", "scale of `L` or the image", onlyV4)(1f)
  private val twoSided = bool("twosided", "emit from both sides", sinceV3)(false)
  private val power =
    float(
      "power", "power per shape or triangle, overrides the magnitude of `L`", onlyV4, "lm", "none"
    )(
      -1f
    )
  private val filename =
    string("filename", "image over the surface's uv, instead of `L`", onlyV4, "none")("")

  protected def make()(using site: Site): Option[AreaLightPlan] =
    val isPicture = site.dialect == Dialect.V4 && filename().nonEmpty
    if isPicture && radiance.given_().isDefined then
      site.error("`L` and `filename` of a diffuse area light are mutually exclusive")
    val image = if isPicture then LightImages.read("filename") else None
    val picture = image.map(Picture(_, PictureLookup.Smooth, LightImages.conversion))
    val unit = if isPicture then Spectra.white else radiance()
    val emitted = unit * colored() * scale()
    val perUnit = picture.fold(1f): p =>
      site.resources.once(site.declaration, "luminance"):
        DiffuseLightRecipe.luminance(p, site.resources.basis)
    val shines = site.resources.basis.isSpectral || (emitted.isFinite && emitted.max > 0f)
    if isPicture && picture.isEmpty then None
    else if !(shines && perUnit > 0f) then
      site.warn("this area light emits nothing; it is ignored")
      None
    else Some(AreaLightPlan(emitted, picture, perUnit, power(), twoSided(), sampleCount()))

private object DiffuseLightRecipe:
  def luminance(picture: Picture, basis: ColorBasis): Float =
    picture.mean((c, _, _) => basis.toSrgb(c).luminance)

/** Lights of an emitting mesh, created once all triangles are known.
  *
  * @param first index of its first triangle
  */
private[build] final class MeshLights(holes: EmitterHoles, first: Int, count: Int, site: Site):
  // The geometry, which all colour bases share
  private var emitters = Vector.empty[(TriangleSampler, Bounds3)]

  def of(plan: AreaLightPlan, triangles: TriangleSoup): Vector[Light] =
    if emitters.isEmpty then
      val samplers = Vector.tabulate(count)(k => TriangleSampler(triangles, first + k))
      val flat = samplers.count(s => !(s.area > 0f))
      if flat > 0 then
        site.warn(s"$flat of $count triangles of this area light have no area; they emit nothing")
      emitters = samplers.map(s => (s, Bounds3.of(s.vertices)))
    emitters.map((s, box) => holes.light(plan.ofTriangle(s, box), s))

/** Lights of an emitting mesh of rectangles.
  *
  * @param first   index of its first triangle
  * @param corners of each rectangle, which consists of two triangles
  */
private[build] final class RectangleLights(
    first: Int,
    corners: Vector[RectangleSampler.Corners]
):
  // The geometry, which all colour bases share
  private var emitters = Vector.empty[(RectangleSampler, Bounds3)]

  def of(plan: AreaLightPlan, triangles: TriangleSoup): Vector[Light] =
    if emitters.isEmpty then
      def triangle(i: Int) = TriangleSampler(triangles, i)
      emitters = corners.zipWithIndex.map: (c, k) =>
        val i = first + 2 * k
        val sampler = RectangleSampler(c, triangle(i), triangle(i + 1))
        (sampler, Bounds3.of(sampler.vertices))
    emitters.map((s, box) => plan.ofRectangle(s, box))

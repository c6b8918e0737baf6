package candela.build.lights

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.build.shapes.EmitterHoles
import candela.color.Rgb
import candela.geometry.Bounds3
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{RectangleSampler, Shape, SurfaceSampler, TriangleSampler, TriangleSoup}
import candela.build.textures.WrapModes
import candela.textures.{AffineUvMapping, Mapping2D}

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
  * @param mapping of u and v to the image
  * @param power   v4's total power per shape, independent of its area; not set if ≤ 0
  * @param beam    where it is brightest; none: everywhere alike
  * @param perUnit mean luminance of the image; 1 without an image
  */
final class AreaLightPlan(
    emitted: Rgb,
    picture: Option[Picture],
    mapping: Mapping2D,
    perUnit: Float,
    power: Float,
    twoSided: Boolean,
    beam: Option[Beam],
    isInView: Boolean,
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

  /** Light of one triangle. Each triangle of a mesh has the full power, as in pbrt-v4.
    *
    * @param contrary see [[candela.lights.Light.isContrary]]
    */
  def ofTriangle(triangle: TriangleSampler, contrary: Boolean): SurfaceLight =
    val cosSpread = if triangle.isTwisted then -1f else 1f
    light(triangle, triangle.bounds, triangle.normal, cosSpread, contrary && !twoSided)

  /** Light of two triangles that form a rectangle. */
  def ofRectangle(rectangle: RectangleSampler): SurfaceLight =
    val emitted = radiance(rectangle.area / 2)
    beamed(AreaLight(
      rectangle,
      emitted,
      twoSided,
      rectangle.bounds,
      rectangle.normal,
      1f,
      isInView = isInView
    ))

  private def beamed(light: AreaLight): SurfaceLight = beam.fold(light)(BeamLight(light, _))

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
    val plain =
      AreaLight(surface, emitted, twoSided, bounds, axis, cosSpread, contrary, isInView)
    picture.fold(beamed(plain))(PictureLight(plain, surface, _, mapping))

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
    string("filename", "image over the surface's uv, instead of `L`", onlyV4, shown = "none")("")
  declare(bool("raw", LightImages.Raw, onlyMitsuba)(false))
  private val tint =
    color("tint", "colour that scales the image", SpectrumRole.Reflectance, onlyGltf)(Rgb.White)
  private val wrap =
    oneOf(
      "wrap",
      "wrap mode outside the image",
      WrapModes.Names,
      onlyOthers
    )("clamp")
  private val wrapDown =
    oneOf("wrapt", "wrap mode along t, if it differs", WrapModes.Names, onlyGltf, shown = "`wrap`")(
      ""
    )
  private val filter =
    oneOf(
      "filter",
      "filter of the image",
      Vector("bilinear", "point"),
      onlyOthers
    )("bilinear")
  private val imageUv =
    numbers(
      "imageuv",
      "float[6]",
      "s and t of the image, by u, v and 1",
      onlyOthers
    )
  private val second = bool("uv2", "use the second set of u and v of meshes", onlyGltf)(false)

  private val axis =
    vector("axis", "axis of the beam, in world space", onlyGltf)(Vec3.Z)
  private val cone =
    float(
      "coneangle",
      "angle between the axis and the edge of the beam",
      onlyGltf,
      "degrees",
      "none",
      Range(0f, 180f)
    )(180f)
  private val fading =
    float(
      "conedeltaangle",
      "angular width of the falloff inside the edge, a smoothstep of the cosine",
      onlyGltf,
      "degrees",
      range = Range(0f, 180f)
    )(0f)
  private val spread =
    float(
      "spread",
      "angle of the beam of a grid before the light, of the same power; 180: no grid",
      onlyGltf,
      "degrees",
      range = Range(0f, 180f)
    )(180f)
  private val isInView = bool("inview", "whether the camera sees the light", onlyGltf)(true)

  private def beam(using Site): Option[Beam] =
    val along = axis().normalized
    if cone() < 180f then
      Some(Cone(along, cos(radians(cone())), cos(radians(Math.max(0f, cone() - fading())))))
    else if spread() < 180f then Some(Grid(along, Math.toRadians(spread() / 2.0)))
    else None

  private def lookup(using Site): PictureLookup =
    PictureLookup(filter() == "bilinear", WrapModes.of(wrap(), wrapDown()))

  protected def create()(using site: Site): Option[AreaLightPlan] =
    val isPicture = site.dialect == Dialect.V4 && filename().nonEmpty
    if isPicture && radiance.given_().isDefined then
      site.error(
        Code.ExclusiveParameters,
        "`L` and `filename` of a diffuse area light are mutually exclusive"
      )
    val picture = if isPicture then LightImages.picture("filename", lookup) else None
    val unit = if isPicture then Spectra.white else radiance()
    val emitted = unit * colored() * tint() * scale()
    val perUnit = picture.fold(1f)(LightImages.luminance("filename", _))
    val shines = site.resources.basis.isSpectral || (emitted.isFinite && emitted.max > 0f)
    if isPicture && picture.isEmpty then None
    else if !(shines && perUnit > 0f) then
      site.warn(Code.DarkLight, "this area light emits nothing; it is ignored")
      None
    else
      val mapping = AffineUvMapping.of(imageUv(), second())
      Some(AreaLightPlan(
        emitted,
        picture,
        mapping,
        perUnit,
        power(),
        twoSided(),
        beam,
        isInView(),
        sampleCount()
      ))

/** Lights of an emitting mesh, created once all triangles are known.
  *
  * @param samplersOf the surface of each, which all colour bases share
  */
private[build] final class MeshLights[S](
    samplersOf: TriangleSoup => Vector[S],
    light: (AreaLightPlan, S) => Light
):
  private var surfaces = Vector.empty[S]

  def of(plan: AreaLightPlan, triangles: TriangleSoup): Vector[Light] =
    if surfaces.isEmpty then surfaces = samplersOf(triangles)
    surfaces.map(light(plan, _))

private[build] object MeshLights:
  /** One light for each triangle.
    *
    * @param first    index of the first triangle
    * @param contrary see [[candela.lights.Light.isContrary]]
    */
  def ofTriangles(
      holes: EmitterHoles,
      first: Int,
      count: Int,
      contrary: Boolean,
      site: Site
  ): MeshLights[TriangleSampler] =
    def samplersOf(triangles: TriangleSoup) =
      val samplers = Vector.tabulate(count)(k => TriangleSampler(triangles, first + k, contrary))
      val flat = samplers.count(s => !(s.area > 0f))
      if flat > 0 then
        site.warn(
          Code.DarkLight,
          s"$flat of $count triangles of this area light have no area; they emit nothing"
        )
      samplers
    MeshLights(samplersOf, (plan, s) => holes.light(plan.ofTriangle(s, contrary), s))

  /** One light for each rectangle of two triangles.
    *
    * @param first index of the first triangle
    */
  def ofRectangles(first: Int, corners: Vector[RectangleSampler.Corners])
      : MeshLights[RectangleSampler] =
    def samplersOf(triangles: TriangleSoup) =
      def triangle(i: Int) = TriangleSampler(triangles, i)
      corners.zipWithIndex.map: (c, k) =>
        RectangleSampler(c, triangle(first + 2 * k), triangle(first + 2 * k + 1))
    MeshLights(samplersOf, _.ofRectangle(_))

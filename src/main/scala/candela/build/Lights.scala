package candela.build

import candela.base.loop
import candela.color.{ColorBasis, Rgb}
import candela.geometry.Bounds3
import candela.image.Image
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{Shape, SurfaceSampler, TriangleSampler}

/** A light to be placed: `make` takes its transform and whether every direction must be sampled
  * (only integrators without BSDF sampling need that).
  *
  * @param samples how often v2's and v3's direct lighting samples it
  */
final case class LightPlan(make: (Transform, Boolean) => Option[Light], samples: Int)

/** Recipes of lights that are no surfaces. */
object Lights:
  val all: Recipes[LightPlan] = Recipes(
    "light",
    Vector(Point, Distant, Infinite),
    Vector("spot", "goniometric", "projection").map(_ -> "it is left out").toMap
  )

  abstract class LightRecipe(name: String) extends Recipe[LightPlan](name):
    private val scale = color("scale", "factor of the light", SpectrumRole.Reflectance)(Rgb.White)
    private val nsamples = integer("nsamples", "light samples of directlighting", untilV3)(1)
    private val samples = integer("samples", "another name of `nsamples`", untilV3)(1)

    protected def scaled(c: Rgb)(using Site): Rgb = c * scale()
    protected def sampleCount()(using Site): Int =
      Math.max(1, samples.given_().getOrElse(nsamples()))

  object Point extends LightRecipe("point"):
    private val intensity = color("I", "radiant intensity", SpectrumRole.Emission)(Rgb.White)
    private val from = point("from", "where it is")(Vec3.Zero)
    private val power = float("power", "total; scales `I`", onlyV4)(-1f)

    protected def make()(using Site): LightPlan =
      val wanted = if power() > 0f then Rgb.gray(power() / (4f * Pi)) else Rgb.White
      val (i, p) = (scaled(intensity()) * wanted, from())
      LightPlan((toWorld, _) => Some(PointLight(toWorld.point(p), i)), sampleCount())

  object Distant extends LightRecipe("distant"):
    private val radiance =
      color("L", "irradiance on a facing plane", SpectrumRole.Emission)(Rgb.White)
    private val from = point("from", "with `to`: the direction of light")(Vec3.Zero)
    private val to = point("to", "where it shines to")(Vec3.Z)
    private val illuminance = float("illuminance", "on a facing plane; scales `L`", onlyV4)(-1f)

    protected def make()(using site: Site): LightPlan =
      val lit = if illuminance() > 0f then Rgb.gray(illuminance()) else Rgb.White
      val (l, d) = (scaled(radiance()) * lit, from() - to())
      if d.isZero then site.error("`from` and `to` of a distant light are the same point")
      LightPlan(
        (toWorld, _) => Option.when(!d.isZero)(DistantLight(toWorld.vector(d).normalized, l)),
        sampleCount()
      )

  object Infinite extends LightRecipe("infinite"):
    private val radiance =
      color("L", "radiance, or factor of the image", SpectrumRole.Emission)(Rgb.White)
    private val mapname = string("mapname", "equirectangular image", untilV3)("")
    private val filename = string("filename", "equal-area octahedral image", onlyV4)("")
    private val illuminance = float("illuminance", "on a plane; scales the light", onlyV4)(-1f)
    notYet("portal", "the light shines from all sides")

    protected def make()(using site: Site): LightPlan =
      val named = if site.dialect == Dialect.V4 then "filename" else "mapname"
      val given_ = if site.dialect == Dialect.V4 then filename() else mapname()
      val p = site.declaration.param(named).filter(_ => given_.nonEmpty)
      val map = p.flatMap(site.resources.image(_, site.declaration, site.problems))
      val l = scaled(radiance())
      val octahedral = site.dialect == Dialect.V4
      for image <- map if octahedral && image.width != image.height do
        site.error(
          s"`$given_` is ${image.width}×${image.height}; an equal-area map is square",
          Some("pbrt-v4's `imgtool makeequiarea` turns an equirectangular image into one")
        )
      val e = if illuminance() > 0f then Rgb.gray(illuminance() / Pi) else Rgb.White
      if illuminance() > 0f && map.isDefined then
        site.warn(
          "`illuminance` of an image light is not supported yet; the image is used as it is"
        )
      LightPlan(
        (toWorld, complete) =>
          map match
            case Some(image) =>
              val layout = if octahedral then EqualAreaMap else LatLongMap
              val pixels = rebased(image.toImage.linear.toRgb, site.resources.basis)
              Some(ImageEnvironment(toWorld, pixels, layout, l, smooth = !octahedral, complete))
            case None if p.isDefined => None
            case None => Some(ConstantEnvironment(l * e, complete))
        ,
        sampleCount()
      )

  private def rebased(image: Image, basis: ColorBasis): Image =
    if basis.isSrgb then image
    else
      val data = new Array[Float](image.data.length)
      loop(data.length / 3): i =>
        val c = basis.fromSrgb(Rgb(image.data(3 * i), image.data(3 * i + 1), image.data(3 * i + 2)))
        data(3 * i) = c.r
        data(3 * i + 1) = c.g
        data(3 * i + 2) = c.b
      Image(image.width, image.height, image.channelNames, data)

/** What an area light statement says; it applies to the shapes that follow. */
final class AreaLightPlan(emitted: Rgb, power: Float, twoSided: Boolean, val samples: Int):

  /** Emission of the whole shape of `area`: v4's `power` fixes it, whatever the area. */
  private def radiance(area: Float): Rgb =
    if power > 0f then
      val sides = if twoSided then 2f else 1f
      emitted * (power / (area * Pi * sides))
    else emitted

  def ofTriangle(triangle: TriangleSampler, meshArea: Float): Light =
    AreaLight(
      triangle, radiance(meshArea), twoSided, Bounds3.of(triangle.vertices), triangle.normal, 1f
    )

  def ofShape(shape: Shape): Light =
    val (axis, cosSpread) = shape.normals
    AreaLight(shape: SurfaceSampler, radiance(shape.area), twoSided, shape.bounds, axis, cosSpread)

/** Recipes of lights that are surfaces. */
object AreaLights:
  val all: Recipes[AreaLightPlan] =
    Recipes("area light", Vector(Diffuse("diffuse"), Diffuse("area")))

  final class Diffuse(name: String) extends Recipe[AreaLightPlan](name):
    private val radiance = color("L", "emitted radiance", SpectrumRole.Emission)(Rgb.White)
    private val scale = color("scale", "factor of `L`", SpectrumRole.Reflectance)(Rgb.White)
    private val twoSided = bool("twosided", "does the inside emit too?")(false)
    private val power = float("power", "total; scales `L`", onlyV4)(-1f)
    private val nsamples = integer("nsamples", "light samples of directlighting", untilV3)(1)
    private val samples = integer("samples", "another name of `nsamples`", untilV3)(1)
    notYet("filename", "the surface emits `L` all over")

    protected def make()(using Site): AreaLightPlan =
      AreaLightPlan(
        radiance() * scale(),
        power(),
        twoSided(),
        Math.max(1, samples.given_().getOrElse(nsamples()))
      )

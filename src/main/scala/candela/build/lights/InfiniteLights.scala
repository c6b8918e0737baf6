package candela.build

import candela.base.loop
import candela.color.{ColorBasis, Rgb}
import candela.image.Image
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect

final class InfiniteLights(name: String, dialects: Set[Dialect])
    extends LightRecipe(name, "surrounds the scene, in one colour or as an image", dialects)
    with SampleCounts:
  private val radiance =
    color("L", "radiance, or factor of the image", SpectrumRole.Emission, unit = "W/(m² sr)")(
      Rgb.White
    )
  private val mapname = string("mapname", "equirectangular image", untilV3, "none")("")
  private val filename = string("filename", "equal-area octahedral image", onlyV4, "none")("")
  private val illuminance =
    float("illuminance", "on a plane, instead of the size of `L`", onlyV4, "lx", "none")(-1f)
  notYet("the light shines from all sides")(
    numbers("portal", "point3[4]", "corners of the window that light comes through", onlyV4)
  )

  protected def make()(using site: Site): LightPlan =
    val named = if site.dialect == Dialect.V4 then "filename" else "mapname"
    val given_ = if site.dialect == Dialect.V4 then filename() else mapname()
    val p = site.declaration.param(named).filter(_ => given_.nonEmpty)
    val map = p.map: q =>
      site.resources.image(q, site.declaration, site.problems).getOrElse(StandIns.picture)
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

package candela.build.lights

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.Rgb
import candela.image.Image
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect

object GoniometricLightRecipe
    extends LightRecipe("goniometric", "point light scaled by an image over directions"):
  private val intensity =
    color("I", "scale of the image", SpectrumRole.Emission, unit = "W/sr")(Rgb.White)
  private val mapname =
    string(
      "mapname",
      "equirectangular image, or a photometric file, `.ies`",
      untilV3,
      shown = "none"
    )("")
  private val filename =

    string(
      "filename",
      "equal-area octahedral image, whose channels are averaged, or a photometric file, `.ies`",
      onlyV4,
      shown = "none"
    )("")
  private val power =
    float("power", "total power, overrides the magnitude of `I`", onlyV4, "lm", "none")(-1f)
  private val means = Once[Float]()
  private val grays = Once[Image]()

  protected def create()(using site: Site): LightPlan =
    val isV4 = site.dialect == Dialect.V4
    if IesFile.isNamed(if isV4 then filename() else mapname()) then
      measured(if isV4 then "filename" else "mapname")
    else pictured()

  /** The light of a photometric file, in candelas. */
  private def measured(name: String)(using site: Site): LightPlan =
    LightImages.photometry(name) match
      case None => LightPlan.nothing
      case Some(image) =>
        def light(i: Rgb) = sphere(image, LatLongMap, i, smooth = true)
        val mean = means.of(image)(light(Rgb.White).meanOfMax)
        val i = scaled(intensity(), power(), 4f * Pi * mean)
        shining(i, light(i))

  private def pictured()(using site: Site): LightPlan =
    if site.dialect == Dialect.V4 then
      if filename().isEmpty then
        site.error(Code.MissingParameter, "a goniometric light needs `filename`")
      LightImages.read("filename").filter(i => LightImages.isSquare(i.width, i.height)) match
        case None => LightPlan.nothing
        case Some(image) =>
          val gray = grays.of(image)(LightImages.gray(image))
          val mean = gray.data.foldLeft(0.0)(_ + _) / gray.data.length
          val i = scaled(intensity(), power(), 4f * Pi * mean.toFloat)
          ScaledLight.warn(onlyV4, UniformScale.isOne, "looks up its image in wrong directions")
          shining(i, sphere(gray, EqualAreaMap, i, smooth = false))
    else
      val i = scaled(intensity())
      if mapname().isEmpty then
        if !shines(i) then LightPlan.leftOut(LightPlan.Black)
        else
          LightPlan((toWorld, _) => Some(PointLight(toWorld.point(Vec3.Zero), i)), samples = 1)
      else
        LightImages.read("mapname") match
          case None => LightPlan.nothing
          case Some(image) => shining(i, sphere(image, LatLongMap, i, smooth = true))

  private def sphere(image: Image, layout: SphereMap, scale: Rgb, smooth: Boolean)(using Site) =
    SphereImage(image, layout, scale, smooth, LightImages.conversion)

  private def shining(i: Rgb, image: SphereImage)(using site: Site): LightPlan =
    val isLit = site.resources.basis.isSpectral || image.meanOfMax > 0f
    if !shines(i) || !isLit then LightPlan.leftOut(LightPlan.Black)
    else
      LightPlan(
        (toWorld, _) => Some(GoniometricLight(LightFrame(toWorld), image)),
        samples = 1
      )

object ProjectionLightRecipe extends LightRecipe("projection", "slide projector"):
  private val intensity =
    color("I", "scale of the image", SpectrumRole.Emission, untilV3, "W/sr")(Rgb.White)
  private val mapname =
    string("mapname", "image of the slide; none: white", untilV3, shown = "none")("")
  private val filename = string("filename", "image of the slide", onlyV4, shown = "none")("")
  declare(bool("raw", LightImages.Raw, onlyMitsuba)(false))
  private val fov =
    float(
      "fov",
      "field of view along the shorter side",
      unit = "degrees",
      range = Range.exclusive(0f, 180f).deferred
    )(if v4 then 90f else 45f)
  private val power =
    float("power", "total power, overrides the magnitude of the image", onlyV4, "lm", "none")(-1f)
  private val powers = Once[Float]()

  protected def create()(using site: Site): LightPlan =
    val isV4 = site.dialect == Dialect.V4
    val (name, given_) = if isV4 then ("filename", filename()) else ("mapname", mapname())
    if isV4 && given_.isEmpty then
      site.error(Code.MissingParameter, "a projection light needs `filename`")
    val lookup = if isV4 then PictureLookup.Nearest else PictureLookup.SmoothRepeating
    val slide = if given_.isEmpty then None else LightImages.picture(name, lookup)
    val isLost = slide.isEmpty && (isV4 || given_.nonEmpty) // already reported
    val onPlane = site.rules.fovOfWidth
    val narrow = slide.fold(1f)(s => if onPlane then Math.max(1f, s.aspect) else 1f)
    val tanHalf = Math.tan(Math.toRadians(fov() / 2.0)).toFloat / narrow
    val basis = site.resources.basis
    val perUnit = slide.fold(1f): s =>
      powers.of((site.declaration.folder, given_, lookup, tanHalf)):
        ProjectionLight.power(s, tanHalf, basis.toSrgb(_).luminance)
    def isBlack = slide.exists(s => !(s.meanOfMax > 0f))
    val scaling = scaled(intensity(), power(), perUnit)
    ScaledLight.warn(onlyV4, _.nonEmpty, SpotLightRecipe.Cone)
    if isLost then LightPlan.nothing
    else if !shines(scaling) || (!basis.isSpectral && isBlack) then
      LightPlan.leftOut(LightPlan.Black)
    else if !(fov() > 0f && fov() < 180f) then
      LightPlan.leftOut(
        s"`fov` must be between 0 and 180 degrees, found ${DefaultText.number(fov())}"
      )
    else
      LightPlan(
        (toWorld, _) =>
          Some(ProjectionLight(
            LightFrame(toWorld), scaling, tanHalf, slide, upright = isV4, onPlane
          )),
        samples = 1
      )

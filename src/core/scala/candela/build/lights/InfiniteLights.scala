package candela.build.lights

import candela.base.loop
import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.Rgb
import candela.geometry.Frame
import candela.image.Image
import candela.lights.*
import candela.math.*
import candela.sampling.Distribution2D
import candela.scenefile.Dialect

import java.util.Locale

final class InfiniteLightRecipe(name: String, dialects: Set[Dialect])
    extends LightRecipe(name, "environment light, constant or from an image", dialects)
    with SampleCounts:
  private val radiance =
    color("L", "radiance, or scale of the image", SpectrumRole.Emission, unit = "W/(m² sr)")(
      Rgb.White
    )
  private val mapname = string("mapname", "equirectangular image", untilV3, shown = "none")("")
  private val filename =
    string(
      "filename",
      "equal-area octahedral image, or an equirectangular one",
      onlyV4,
      shown = "none"
    )("")
  private val illuminance =
    float(
      "illuminance", "illuminance on a plane, overrides the magnitude of `L`", onlyV4, "lx", "none"
    )(-1f)
  private val irradiances = Once[Float]()
  private val uncompensated, compensated = Once[Distribution2D]()
  private val portals = Once[PortalEnvironment]()
  private val portal = numbers(
    "portal",
    "point3[4]",
    "corners of the rectangular portal that light passes through, in world space",
    onlyV4
  )

  protected def create()(using site: Site): LightPlan =
    val octahedral = site.dialect == Dialect.V4
    val (named, given_) =
      if octahedral then ("filename", filename()) else ("mapname", mapname())
    if octahedral && given_.nonEmpty && radiance.given_().isDefined then
      site.error(
        Code.ExclusiveParameters,
        "`L` and `filename` of an infinite light are mutually exclusive"
      )
    if given_.nonEmpty then
      val environment = LightImages.environment(named)
      def isLatLong(i: EnvironmentImage) = !octahedral || i.width == 2 * i.height
      environment.filter(i => isLatLong(i) || LightImages.isSquare(i.width, i.height)) match
        case None => LightPlan.nothing
        case Some(read) =>
          val isEqualArea = !isLatLong(read)
          if octahedral && !isEqualArea then warnOfLatLong(read)
          val isPolar = !octahedral && site.rules.flatMaps
          val image = if isPolar then read.withEquator else read
          val unit = if octahedral then Spectra.white else radiance()
          if portal().isEmpty then
            val dialects = Set(Dialect.V3, Dialect.V4)
            ScaledLight.warn(dialects, UniformScale.isOne, "weights its light by the scale")
          def perUnit =
            if octahedral then irradiances(onThePlane(image, isEqualArea))
            else 1f
          val l = scaled(unit, illuminance(), perUnit)
          val (layout, mapping) =
            if isEqualArea then (EqualAreaMap, "octahedral")
            else if isPolar then (PolarLatLongMap(image.height), "polar")
            else (LatLongMap, "even")
          val sphere = image.onSphere(layout, l, smooth = !isEqualArea)
          val basis = site.resources.basis
          val colors =
            if basis.isSpectral then "as stored" else s"${basis.isSrgb} ${l.r} ${l.g} ${l.b}"
          imagePlan(l, sphere): complete =>
            image.distribution(sphere, s"$mapping $colors", complete)
    else
      val l = scaled(radiance(), illuminance(), Pi)
      if portal().nonEmpty then
        val white = Image(1, 1, Image.RgbNames, Array(1f, 1f, 1f))
        val sphere = SphereImage(white, EqualAreaMap, l, smooth = false)
        imagePlan(l, sphere)(ImageEnvironment.distribution(sphere, _))
      else if !shines(l) then LightPlan.leftOut(LightPlan.Black)
      else
        LightPlan(
          (_, finds) => Some(ConstantEnvironment(l, complete = finds == SkySampling.All)),
          sampleCount()
        )

  private def warnOfLatLong(image: EnvironmentImage)(using site: Site): Unit =
    for p <- site.declaration.param("filename") do
      site.problems.warn(
        Code.UnlikePbrt,
        p.valuesAt,
        s"an image of ${image.width}×${image.height} pixels is taken for equirectangular, which " +
          "pbrt-v4 rejects",
        Some(LightImages.EqualArea)
      )

  /** @param table its sampling table; see [[ImageEnvironment.distribution]] */
  private def imagePlan(l: Rgb, image: SphereImage)(table: Boolean => Distribution2D)(using
      site: Site
  ): LightPlan =
    val resources = site.resources
    val isLit = resources.basis.isSpectral || image.isLit
    if !shines(l) || !isLit then LightPlan.leftOut(LightPlan.Black)
    else
      val p = corners()
      if p.isEmpty then
        def light(toWorld: Transform, finds: SkySampling) =
          val complete = finds != SkySampling.Bright
          val cache = if complete then uncompensated else compensated
          val distribution = cache(table(complete))
          Some(new ImageEnvironment(LightFrame(toWorld), image, distribution))
        LightPlan(light, sampleCount())
      else
        window(p) match
          case None => LightPlan.nothing
          case Some(frame) =>
            val (corner, opposite) = (p(0), p(2))
            def light(toWorld: Transform) =
              val plain = portals:
                PortalEnvironment(LightFrame(toWorld), image, corner, opposite, frame)
              val basis = resources.basis
              if !basis.isSpectral then plain
              else
                val (day, lookUp) = (basis.ofLight(Rgb.White), basis.lookUpLight)
                plain.converted(c => lookUp(resources.plainBasis.toSrgb(c)) * day)
            LightPlan((toWorld, _) => Some(light(toWorld)), sampleCount())

  /** Corners of the portal, around the render origin. */
  private def corners()(using site: Site): Vector[Vec3] =
    val origin = site.resources.origin
    val numbers = portal()
    val written = site.declaration.param("portal").filter(_.rests.length == numbers.length)
    def number(i: Int) = written.fold(numbers(i).toDouble)(_.number(i))
    def relative(i: Int) = Vec3(
      (number(i) - origin.x).toFloat,
      (number(i + 1) - origin.y).toFloat,
      (number(i + 2) - origin.z).toFloat
    )
    Vector.tabulate((numbers.length + 2) / 3)(i =>
      if 3 * i + 2 < numbers.length then relative(3 * i) else Vec3.Zero
    )

  /** Frame of the portal, which must be a rectangle. */
  private def window(corners: Vector[Vec3])(using site: Site): Option[Frame] =
    val frame =
      if corners.size != 4 || portal().length != 12 then None
      else
        val (up, across) = (corners(1) - corners(0), corners(3) - corners(0))
        val closes = ((corners(2) - corners(1)) - across).length <= 1e-3f * across.length
        val (t, s) = (up.normalized, across.normalized)
        Option.when(closes && Math.abs(s dot t) <= 1e-3f)(Frame(s, t, s cross t))
    if frame.isEmpty then
      site.error(
        Code.ParameterValue,
        "`portal` must be the four corners of a rectangle, in order along its edge"
      )
    frame

  /** Illuminance by `image` on the plane below its pole, as computed by pbrt-v4: half of the true
    * value, because it gives each pixel 2π over their count instead of 4π. For EXR files, whose
    * channel order is B, G, R, pbrt-v4 also swaps red and blue.
    */
  private def onThePlane(image: EnvironmentImage, isEqualArea: Boolean)(using
      site: Site
  ): Float =
    var sum = 0.0
    val (width, height) = (image.width, image.height)
    val basis = site.resources.basis
    val isSwapped = isEqualArea && filename().toLowerCase(Locale.ROOT).endsWith(".exr")
    val map = if isEqualArea then EqualAreaMap else LatLongMap
    val luminances = image.onSphere(map, Rgb.White, smooth = false).ofPixels: (r, g, b) =>
      val srgb = basis.toSrgb(Rgb(r, g, b))
      val weighed = if isSwapped then Rgb(srgb.b, srgb.g, srgb.r) else srgb
      weighed.luminance
    loop(height): y =>
      val share = map.stretch((y + 0.5f) / height) / (4f * Pi)
      loop(width): x =>
        val d = map.toDirection((x + 0.5f) / width, (y + 0.5f) / height)
        if d.z > 0f then sum += luminances(y * width + x) * d.z * share
    (sum * 2 * Math.PI / (width.toDouble * height)).toFloat

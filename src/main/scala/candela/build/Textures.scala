package candela.build

import candela.color.{Encoding, Rgb}
import candela.image.StoredImage
import candela.math.*
import candela.scenefile.{Dialect, TextureDescription}
import candela.textures.*

/** Recipes of textures: numbers and colours over a surface. A texture's own transform is that of
  * its statement.
  */
object Textures:
  private val pending =
    Vector("dots", "fbm", "wrinkled", "windy", "marble", "uv", "ptex", "directionmix")
      .map(_ -> "0.5 is used all over")
      .toMap

  def floats(toWorld: Transform): Recipes[FloatTexture] = Recipes(
    "float texture",
    Vector(FloatConstant, FloatScale, FloatMix, FloatChecks(toWorld), FloatBilerp(toWorld),
      FloatMap(toWorld)),
    pending
  )

  def colors(toWorld: Transform): Recipes[RgbTexture] = Recipes(
    "spectrum texture",
    Vector(RgbConstant, RgbScale, RgbMix, RgbChecks(toWorld), RgbBilerp(toWorld), RgbMap(toWorld)),
    pending
  )

  /** Makes a texture and gives it its name, for the statements that follow. */
  def define(t: TextureDescription, site: Site): Unit =
    val toWorld = t.textureToWorld.start
    if t.valueType == "float" then
      val made = floats(toWorld).build(site).getOrElse(ConstantFloat(0.5f))
      site.resources.define(t.name, made)
    else
      val made = colors(toWorld).build(site).getOrElse(ConstantRgb(Rgb.gray(0.5f)))
      site.resources.define(t.name, made)

  object FloatConstant extends Recipe[FloatTexture]("constant"):
    private val value = float("value", "the number")(1f)
    protected def make()(using Site): FloatTexture = ConstantFloat(value())

  object RgbConstant extends Recipe[RgbTexture]("constant"):
    private val value = color("value", "the colour", SpectrumRole.Reflectance)(Rgb.White)
    protected def make()(using Site): RgbTexture = ConstantRgb(value())

  object FloatScale extends Recipe[FloatTexture]("scale"):
    private val tex1 = floatTexture("tex1", "one factor", untilV3)(1f)
    private val tex2 = floatTexture("tex2", "the other", untilV3)(1f)
    private val tex = floatTexture("tex", "one factor", onlyV4)(1f)
    private val scale = floatTexture("scale", "the other", onlyV4)(1f)
    protected def make()(using site: Site): FloatTexture =
      if site.dialect == Dialect.V4 then ScaledFloat.of(tex(), scale())
      else ScaledFloat.of(tex1(), tex2())

  object RgbScale extends Recipe[RgbTexture]("scale"):
    private val tex1 = rgbTexture("tex1", "one factor", untilV3)(Rgb.White)
    private val tex2 = rgbTexture("tex2", "the other", untilV3)(Rgb.White)
    private val tex = rgbTexture("tex", "the colour", onlyV4)(Rgb.White)
    private val scale = floatTexture("scale", "its factor", onlyV4)(1f)
    protected def make()(using site: Site): RgbTexture =
      if site.dialect == Dialect.V4 then ScaledRgb.of(tex(), scale())
      else ProductRgb.of(tex1(), tex2())

  object FloatMix extends Recipe[FloatTexture]("mix"):
    private val tex1 = floatTexture("tex1", "where `amount` is 0")(0f)
    private val tex2 = floatTexture("tex2", "where `amount` is 1")(1f)
    private val amount = floatTexture("amount", "between the two, 0 to 1")(0.5f)
    protected def make()(using Site): FloatTexture = MixFloat.of(tex1(), tex2(), amount())

  object RgbMix extends Recipe[RgbTexture]("mix"):
    private val tex1 =
      rgbTexture("tex1", "where `amount` is 0")(if v4 then Rgb.Black else Rgb.Black)
    private val tex2 = rgbTexture("tex2", "where `amount` is 1")(Rgb.White)
    private val amount = floatTexture("amount", "between the two, 0 to 1")(0.5f)
    protected def make()(using Site): RgbTexture = MixRgb.of(tex1(), tex2(), amount())

  /** The parameters of a two-dimensional mapping, which many textures share. */
  abstract class Mapped[A](name: String, toWorld: Transform) extends Recipe[A](name):
    private val mapping =
      oneOf(
        "mapping", "how the surface gets coordinates", "uv", "spherical", "cylindrical", "planar"
      )("uv")
    private val uscale = float("uscale", "repetitions along u")(1f)
    private val vscale = float("vscale", "repetitions along v")(1f)
    private val udelta = float("udelta", "moves along u")(0f)
    private val vdelta = float("vdelta", "moves along v")(0f)
    private val axis1 = point("v1", "of `planar`: the direction of s")(Vec3.X)
    private val axis2 = point("v2", "of `planar`: the direction of t")(Vec3.Y)

    protected def mapped()(using site: Site): Mapping2D = mapping() match
      case "spherical" => SphericalMapping(toWorld)
      case "cylindrical" => CylindricalMapping(toWorld, onUnitSphere = site.dialect != Dialect.V4)
      case "planar" =>
        val space = if site.dialect == Dialect.V4 then toWorld else Transform.Identity
        PlanarMapping(space, axis1(), axis2(), udelta(), vdelta())
      case _ => UvMapping(uscale(), vscale(), udelta(), vdelta())

  abstract class Checks[A](toWorld: Transform) extends Mapped[A]("checkerboard", toWorld):
    private val dimension = integer("dimension", "2, or 3 for cubes in space")(2)
    irrelevant("aamode")
    protected def warnOfCubes()(using site: Site): Unit =
      if dimension() == 3 then
        site.warn("a checkerboard of dimension 3 is not supported yet: one of dimension 2 is used")

  final class FloatChecks(toWorld: Transform) extends Checks[FloatTexture](toWorld):
    private val tex1 = floatTexture("tex1", "of even squares")(1f)
    private val tex2 = floatTexture("tex2", "of odd squares")(0f)
    protected def make()(using Site): FloatTexture =
      warnOfCubes()
      CheckerboardFloat(mapped(), tex1(), tex2())

  final class RgbChecks(toWorld: Transform) extends Checks[RgbTexture](toWorld):
    private val tex1 = rgbTexture("tex1", "of even squares")(Rgb.White)
    private val tex2 = rgbTexture("tex2", "of odd squares")(Rgb.Black)
    protected def make()(using Site): RgbTexture =
      warnOfCubes()
      CheckerboardRgb(mapped(), tex1(), tex2())

  final class FloatBilerp(toWorld: Transform) extends Mapped[FloatTexture]("bilerp", toWorld):
    private val corners = Vector("v00", "v01", "v10", "v11").zip(Vector(0f, 1f, 0f, 1f)).map:
      (n, d) =>
        float(n, s"value at the corner $n")(d)
    protected def make()(using Site): FloatTexture =
      BilerpFloat(mapped(), corners(0)(), corners(1)(), corners(2)(), corners(3)())

  final class RgbBilerp(toWorld: Transform) extends Mapped[RgbTexture]("bilerp", toWorld):
    private val corners = Vector("v00", "v01", "v10", "v11").zip(Vector(0f, 1f, 0f, 1f)).map:
      (n, d) =>
        color(n, s"colour at the corner $n", SpectrumRole.Reflectance)(Rgb.gray(d))
    protected def make()(using Site): RgbTexture =
      BilerpRgb(mapped(), corners(0)(), corners(1)(), corners(2)(), corners(3)())

  abstract class ImageMap[A](toWorld: Transform) extends Mapped[A]("imagemap", toWorld):
    private val filename = string("filename", "png, tga, jpg, exr or hdr")("")
    private val wrap =
      oneOf("wrap", "beyond the image", "repeat", "black", "clamp", "octahedralsphere")("repeat")
    protected val scale = float("scale", "factor of the values")(1f)
    protected val invert = bool("invert", "1 − value", onlyV4)(false)
    private val gammaNumber = float("gamma", "exponent that makes values linear", onlyV2)(1f)
    private val gammaFlag = bool("gamma", "are values sRGB-encoded?", onlyV3)(true)
    private val encoding =
      string("encoding", "sRGB, linear, or `gamma` and an exponent", onlyV4)("sRGB")
    private val filter =
      oneOf("filter", "of the lookup", "point", "bilinear", "trilinear", "ewa", "EWA")("bilinear")
    irrelevant("trilinear", "maxanisotropy")

    /** The picture's lookup; None after a problem was reported. */
    protected def lookup(texels: (StoredImage, Float => Float) => Texels)(using
        site: Site
    ): Option[ImageLookup] =
      site.declaration.param("filename").filter(_ => filename().nonEmpty) match
        case None =>
          site.error("an imagemap needs a `filename`")
          None
        case Some(p) =>
          for stored <- site.resources.image(p, site.declaration, site.problems) yield
            val wrapping = wrap() match
              case "black" => Wrap.Black
              case "clamp" => Wrap.Clamp
              case "octahedralsphere" => Wrap.OctahedralSphere
              case _ => Wrap.Repeat
            for f <- filter.given_() if f != "point" && f != "bilinear" do
              site.warn(s"filter `$f` is not supported yet: the finest level is read bilinearly")
            val filtering = filter() match
              case "point" => TextureFilter.Point
              case "trilinear" => TextureFilter.Trilinear
              case "ewa" | "EWA" => TextureFilter.Ewa
              case _ => TextureFilter.Bilinear
            val bottomUp = site.dialect != Dialect.V2 || filename().toLowerCase.endsWith(".tga")
            ImageLookup(texels(stored, decoding(stored)), wrapping, filtering, bottomUp)

    private def decoding(stored: StoredImage)(using site: Site): Float => Float =
      site.dialect match
        case Dialect.V2 =>
          // Scaled before the exponent, as v2 does; `scale` is therefore not applied again
          val (s, g) = (scale(), gammaNumber())
          x => pow(s * x, g)
        case Dialect.V3 =>
          val eightBit = Seq(".png", ".tga").exists(filename().toLowerCase.endsWith)
          if gammaFlag.given_().getOrElse(eightBit) then Encoding.Srgb.decode(_) else identity
        case Dialect.V4 =>
          // `encoding` speaks of PNG; floating-point pictures are linear, TGA and JPEG sRGB
          if filename().toLowerCase.endsWith(".png") then encoded()
          else if stored.encoding == Encoding.Linear then identity
          else Encoding.Srgb.decode(_)

    private def encoded()(using site: Site): Float => Float =
      encoding().split(' ') match
        case Array("sRGB") => Encoding.Srgb.decode(_)
        case Array("linear") => identity
        case Array("gamma", g) if g.toFloatOption.exists(_ > 0f) =>
          val exponent = g.toFloat
          x => pow(x, exponent)
        case _ =>
          site.error(s"`encoding` is sRGB, linear or gamma and a number; found `${encoding()}`")
          identity

    protected def outerScale(using site: Site): Float =
      if site.dialect == Dialect.V2 then 1f else scale()

  final class FloatMap(toWorld: Transform) extends ImageMap[FloatTexture](toWorld):
    protected def make()(using site: Site): FloatTexture =
      val read = if site.dialect == Dialect.V4 then Texels.meanOrAlpha else Texels.luminance
      lookup(read).fold(ConstantFloat(0.5f))(FloatImageTexture(mapped(), _, outerScale, invert()))

  final class RgbMap(toWorld: Transform) extends ImageMap[RgbTexture](toWorld):
    protected def make()(using site: Site): RgbTexture =
      lookup(Texels.color).fold(ConstantRgb(Rgb.gray(0.5f))): found =>
        val basis = site.resources.basis
        val image = RgbImageTexture(mapped(), found, outerScale, invert())
        if basis.isSrgb then image else RebasedTexture(image, basis)

package candela.build.recipe

import org.scalatest.funsuite.AnyFunSuite

import candela.color.{ColorBasis, ColorSpace, Rgb, Spectrum}
import candela.scenefile.Dialect
import candela.testing.SceneTexts

final class SpectraSuite extends AnyFunSuite:

  private def close(a: Rgb, b: Rgb, tolerance: Float): Boolean =
    Seq(a.r - b.r, a.g - b.g, a.b - b.b).forall(d => Math.abs(d) <= tolerance)

  /** The colour of an emission parameter of this text, in the scene's basis. */
  private def emission(param: String, dialect: Dialect): Option[Rgb] =
    val light = SceneTexts.parse(s"WorldBegin\nLightSource \"point\" $param\n", dialect).lights.head
    val basis = if dialect == Dialect.V4 then ColorBasis.Sharp else ColorBasis.Srgb
    val site = Site(light.light, dialect, Resources(basis), Findings())
    Spectra.rgb(light.light.params.head, SpectrumRole.Emission, site)

  test("an rgb value is itself in v2 and v3, and in v4 in the basis of the scene"):
    val written = "\"rgb I\" [0.2 0.4 0.8]"
    assert(emission(written, Dialect.V3).contains(Rgb(0.2f, 0.4f, 0.8f)))
    val v4 = emission(written, Dialect.V4).get
    assert(close(ColorBasis.Sharp.toSrgb(v4), Rgb(0.2f, 0.4f, 0.8f), 1e-6f)) // rounding

  test("a colour is converted from its space; that of an attribute is its own"):
    val rec2020 = ColorSpace.named("rec2020").get
    def read(text: String, name: String) =
      val light = SceneTexts.parse(text, Dialect.V4).lights.head.light
      val site = Site(light, Dialect.V4, Resources(ColorBasis.Srgb), Findings())
      Spectra.rgb(light.param(name).get, SpectrumRole.Emission, site).get
    val wanted = rec2020.light(Rgb(0.5f, 1f, 0.5f))
    val own = "\"rgb I\" [0.5 1 0.5]"
    val light = s"ColorSpace \"Rec2020\" WorldBegin LightSource \"point\" $own"
    assert(close(read(light, "I"), wanted, 1e-6f) && wanted.r < 0.4f)
    val attribute =
      s"ColorSpace \"rec2020\" WorldBegin Attribute \"light\" $own " +
        "ColorSpace \"srgb\" LightSource \"point\""
    assert(close(read(attribute, "I"), wanted, 1e-6f))

  test("reflectances keep white, and light that is not given has the white of its space"):
    val text = "ColorSpace \"aces2065-1\" WorldBegin LightSource \"point\""
    val site =
      Site(
        SceneTexts.parse(text, Dialect.V4).lights.head.light,
        Dialect.V4,
        Resources(ColorBasis.Srgb),
        Findings()
      )
    val aces = ColorSpace.named("aces2065-1").get
    assert(Spectra.default(Rgb.White, SpectrumRole.Emission, site) == aces.light(Rgb.White))
    assert(Spectra.default(Rgb.White, SpectrumRole.Reflectance, site) == Rgb.White)

  /** The colour of a parameter, and what is told of it. */
  private def told(parameter: String, dialect: Dialect, role: SpectrumRole) =
    val text = s"WorldBegin\nLightSource \"point\" $parameter\n"
    val light = SceneTexts.parse(text, dialect).lights.head.light
    val findings = Findings()
    val site = Site(light, dialect, Resources(ColorBasis.Srgb), findings)
    (Spectra.rgb(light.params.head, role, site).get, findings.result.map(_.message))

  test("colours that v4 refuses are told of, and taken"):
    def messages(numbers: String, role: SpectrumRole, dialect: Dialect = Dialect.V4) =
      object PlainRecipe extends Recipe[Rgb]("point", "a colour"):
        private val i = color("I", "colour", role)(Rgb.White)
        protected def create()(using Site): Rgb = i()
      val text = s"WorldBegin\nLightSource \"point\" \"rgb I\" [$numbers]\n"
      val light = SceneTexts.parse(text, dialect).lights.head.light
      val site = Site(light, dialect, Resources(ColorBasis.Srgb), Findings())
      assert(Vector(
        PlainRecipe.build(site)
      ).flatMap(c => Vector(c.r, c.g, c.b)) == numbers.split(' ').toVector.map(_.toFloat))
      site.problems.result.map(_.message)
    import SpectrumRole.*
    for role <- SpectrumRole.values do
      assert(messages("0 0.5 1", role).isEmpty)
      val range = if role == Reflectance then "from 0 to 1" else "at least 0"
      val used = s"`I` should be $range, found -0.5, which is not clamped"
      assert(messages("1 -0.5 0", role) == Vector(used))
      for dialect <- Seq(Dialect.V2, Dialect.V3) do
        assert(messages("1 -0.5 2", role, dialect).isEmpty)
    for role <- Seq(Unbounded, Emission) do assert(messages("1 2 3", role).isEmpty)
    val refused = "`I` should be from 0 to 1, found 2, which is not clamped"
    assert(messages("1 2 3", Reflectance) == Vector(refused))

  test("wavelengths that do not ascend are sorted, and told of in v4, which refuses them"):
    def read(numbers: String, dialect: Dialect) =
      told(s"\"spectrum I\" [$numbers]", dialect, SpectrumRole.Emission)
    val (sorted, nothing) = read("400 1 500 3 600 2", Dialect.V4)
    val (mixed, messages) = read("500 3 400 1 600 2", Dialect.V4)
    assert(nothing.isEmpty && mixed == sorted)
    assert(
      messages == Vector(
        "the wavelengths of `I` must ascend in pbrt-v4; sorting them"
      )
    )
    assert(read("500 3 400 1 600 2", Dialect.V3)._2.isEmpty)

  test("xyz is turned into sRGB: the white point of D65 is white"):
    // Four digits of the white point
    val white = emission("\"xyz I\" [0.9505 1 1.089]", Dialect.V3).get
    assert(close(white, Rgb.White, 1e-3f))

  test("a constant spectrum is equal-energy white in v3 and of luminance 1 in v4"):
    val v3 = emission("\"spectrum I\" [300 1 900 1]", Dialect.V3).get
    assert(v3.r > v3.b && Math.abs(v3.luminance - 1f) < 1e-3f) // six digits in the matrix
    val v4 = ColorBasis.Sharp.toSrgb(emission("\"spectrum I\" [300 7 900 7]", Dialect.V4).get)
    assert(Math.abs(v4.luminance - 1f) < 1e-3f)

  test("a reflectance of 1 is white in v4"):
    val one = Spectrum(Array(550f), Array(1f))
    val c = Spectra.toRgb(one, SpectrumRole.Reflectance, Dialect.V4)
    assert(close(c, Rgb.White, 1e-3f)) // see ColorimetrySuite

  test("blackbody takes a scale after the temperature in v3"):
    val (one, two) = (
      emission("\"blackbody I\" [5000 1]", Dialect.V3).get,
      emission("\"blackbody I\" [5000 2]", Dialect.V3).get
    )
    assert(close(one * 2f, two, 1e-5f)) // rounding
    assert(one.r > one.b)

  test("blackbody is scaled to 1 at 555 nm in v2, at its maximum in v3"):
    val v2 = emission("\"blackbody I\" [3500 2]", Dialect.V2).get
    val v3 = emission("\"blackbody I\" [3500 2]", Dialect.V3).get
    // 3500 K has 0.6387 of its maximum (828 nm) there: Planck's law by hand, four digits
    assert(close(v2 * 0.6387f, v3, 2e-4f * v3.r))

  test("an illuminant that pbrt-v4 has otherwise is named where it is used"):
    def warned(name: String) =
      val text = s"WorldBegin\nLightSource \"point\" \"spectrum I\" \"stdillum-$name\"\n"
      SceneTexts.problems(text, Dialect.V4).filter(_.message.contains("pbrt-v4's table"))
    assert(warned("D50").flatMap(_.pos).map(_.line) == Vector(2))
    assert(warned("D65").isEmpty)

  test("a name that is neither a spectrum nor a file is an error"):
    val text = "WorldBegin\nLightSource \"point\" \"spectrum I\" \"stdillum-D66\"\n"
    val p = SceneTexts.problems(text, Dialect.V4).head
    assert(p.message.contains("`stdillum-D66` is neither a named spectrum nor a file"))
    assert(p.help.exists(_.contains("`stdillum-D65`")))

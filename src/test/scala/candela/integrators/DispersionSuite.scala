package candela.integrators

import candela.bsdf.{Bsdf, BsdfLaws, Directions, Lambert, Lobes, Scaled, SentThrough}
import candela.bsdf.microfacet.{Dielectric, Dispersive, TrowbridgeReitz}
import candela.color.{ColorBasis, Rgb}
import candela.math.lerp
import candela.sampling.Wavelengths
import candela.scenefile.Dialect
import candela.testing.SceneTexts

class DispersionSuite extends BsdfLaws:
  private def glass(alpha: Float)(nm: Float) =
    Dielectric(TrowbridgeReitz(alpha, alpha), 1.6f - 2e-4f * (nm - 589f))
  private def splitting(alpha: Float) = Dispersive(glass(alpha)(589f), glass(alpha))

  obeysLaws("smooth, unasked", splitting(0f), isLossless = true)
  obeysLaws("rough, unasked", splitting(0.3f))
  obeysLaws("rough, of one wavelength", splitting(0.3f).atWavelength(450f))

  for (name, basis) <- Seq("sRGB" -> ColorBasis.Srgb, "the sharp basis" -> ColorBasis.Sharp) do
    test(s"the colours of wavelengths are white on average, in $name"):
      val wavelengths = Wavelengths(basis)
      val n = 100000
      val mean = (0 until n).map(k => wavelengths.weight((k + 0.5f) / n)).reduce(_ + _) * (1f / n)
      // Sums of Floats
      assert((mean - Rgb.White).map(Math.abs(_)).max < 2e-3f, mean)
      val reds = (0 until n).map(k => (k + 0.5f) / n).filter(wavelengths.sample(_) > 600f)
      val red = reds.map(wavelengths.weight).reduce(_ + _)
      assert(red.r > 3 * Math.abs(red.g) && red.r > 3 * Math.abs(red.b), red)

  private def scene(eta: String): String =
    "LookAt 0 -4 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 40\n" +
      "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n" +
      "Sampler \"zsobol\" \"integer pixelsamples\" 256\nIntegrator \"path\"\nWorldBegin\n" +
      "LightSource \"infinite\" \"rgb L\" [.4 .5 .6]\n" +
      "Material \"diffuse\" \"rgb reflectance\" [.6 .4 .3]\n" +
      "Shape \"disk\" \"float radius\" 3 \"float height\" -1\n" +
      s"Material \"dielectric\" $eta\nShape \"sphere\"\n"

  /** A lamp behind a ball of glass: how much of it is seen depends on where the ball focuses. */
  private def lens(eta: String): String =
    s"""LookAt 0 -4 0  0 0 0  0 0 1
       |Camera "orthographic" "float screenwindow" [-.6 .6 -.6 .6]
       |Film "rgb" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "zsobol" "integer pixelsamples" 1024
       |Integrator "path"
       |WorldBegin
       |AttributeBegin
       |  Translate 0 2 0
       |  Rotate 90 1 0 0
       |  AreaLightSource "diffuse" "bool twosided" true "rgb L" [1 1 1]
       |  Shape "disk" "float radius" .15
       |AttributeEnd
       |Material "dielectric" $eta
       |Shape "sphere"
       |""".stripMargin

  test("each wavelength goes its own way, and their colours add up to what is seen"):
    // For each wavelength what glass of its index shows
    val steps = 24
    def eta(k: Int) = 1.3f + 0.6f * k / steps
    val brightness =
      (0 to steps).map(k => SceneTexts.mean(lens(s"\"float eta\" ${eta(k)}"), Dialect.V4).g)
    def shown(nm: Float): Float =
      val x = (nm - 360f) / 470f * steps
      val k = Math.min(x.toInt, steps - 1)
      lerp(x - k, brightness(k), brightness(k + 1))
    val basis = ColorBasis.Sharp // v4's
    val wavelengths = Wavelengths(basis)
    val n = 10000
    val sum = (0 until n).map(k => (k + 0.5f) / n)
      .map(u => wavelengths.weight(u) * shown(wavelengths.sample(u))).reduce(_ + _)
    val wanted = basis.toSrgb(sum * (1f / n))
    val seen = SceneTexts.mean(lens("\"spectrum eta\" [360 1.3 830 1.9]"), Dialect.V4)
    // Chance: one wavelength for each of 65,000 paths; 1.4 % at most for this seed
    for (s, w) <- Seq(seen.r -> wanted.r, seen.g -> wanted.g, seen.b -> wanted.b) do
      assert(Math.abs(s - w) < 0.03f * w, s"$seen, not $wanted")
    // The index at 589 nm alone would give a gray
    assert(wanted.largest > 1.3f * Math.min(wanted.r, Math.min(wanted.g, wanted.b)), wanted)

  test("the plan names it"):
    val text = scene("\"spectrum eta\" \"glass-BK7\"")
    val features = SceneTexts.plan(text, Dialect.V4).features.toMap
    assert(features("dispersion").contains("one wavelength"))
    val plain = SceneTexts.plan(scene("\"float eta\" 1.5"), Dialect.V4).features.toMap
    assert(plain("dispersion") == "none")
    assert(SceneTexts.problems(text, Dialect.V4).isEmpty)

  test("where light is not split, a warning says so"):
    val glass = "\"spectrum eta\" \"glass-BK7\""
    def warning(text: String): String =
      val found = SceneTexts.problems(text, Dialect.V4)
      assert(found.size == 1, found)
      found.head.message
    val fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
    val foggy = scene(glass)
      .replace("\"path\"", "\"volpath\"")
      .replace(
        "Material \"dielectric\"",
        s"${fog}MediumInterface \"fog\" \"\"\nMaterial \"dielectric\""
      )
    assert(warning(foggy).startsWith("this integrator does not support dispersion yet"))
    val coated = scene(glass).replace("\"dielectric\"", "\"coateddiffuse\"")
    assert(warning(coated).startsWith("dispersion of \"coateddiffuse\" is not supported"))

  test("what wraps glass keeps its dispersion, regularized or not"):
    val glass = splitting(0.2f)
    val wrapped = Seq[Bsdf => Bsdf](
      Scaled(_, Rgb.gray(0.5f)),
      SentThrough(_),
      b => Lobes(Array(Lambert(Rgb.White), b), Array(0.5f, 0.5f))
    )
    val pairs = Seq((20.0, 0.0), (160.0, 170.0)).map(Directions.at(_, _))
    for wrap <- wrapped; bsdf <- Seq(wrap(glass), wrap(glass).regularized) do
      assert(bsdf.isDispersive)
      def values(b: Bsdf) = for wo <- pairs; wi <- pairs yield b.f(wo, wi)
      assert(values(bsdf.atWavelength(700f)) != values(bsdf))

  test("a mixture of glasses splits light as the glass does"):
    val named = "MakeNamedMaterial \"a\" \"string type\" \"dielectric\" " +
      "\"spectrum eta\" \"glass-F11\"\n"
    val mixed = scene("").replace(
      "Material \"dielectric\"",
      named + "Material \"mix\" \"string materials\" [\"a\" \"a\"]"
    )
    assert(SceneTexts.problems(mixed, Dialect.V4).isEmpty)
    assert(SceneTexts.plan(mixed, Dialect.V4).features.toMap.apply("dispersion").contains("one"))

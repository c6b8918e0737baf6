package candela.integrators

import candela.bsdf.{Bsdf, BsdfLaws, Lambert, Lobes, Scaled, SentThrough}
import candela.bsdf.microfacet.{Dielectric, Dispersive, TrowbridgeReitz}
import candela.color.{Cauchy, Rgb, SmoothSpectra, Wavelengths}
import candela.math.lerp
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.SceneTexts
import org.scalatest.tagobjects.Slow

class DispersionSuite extends BsdfLaws:
  private def splitting(alpha: Float) = Dispersive(Dielectric(TrowbridgeReitz(alpha, alpha), 1.6f))

  obeysLaws("smooth", splitting(0f), isLossless = true)
  obeysLaws("rough", splitting(0.3f))

  private def scene(eta: String): String =
    "LookAt 0 -4 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 40\n" +
      "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\n" +
      "Sampler \"zsobol\" \"integer pixelsamples\" 256\nIntegrator \"path\"\nWorldBegin\n" +
      "LightSource \"infinite\" \"rgb L\" [.4 .5 .6]\n" +
      "Material \"diffuse\" \"rgb reflectance\" [.6 .4 .3]\n" +
      "Shape \"disk\" \"float radius\" 3 \"float height\" -1\n" +
      s"Material \"dielectric\" $eta\nShape \"sphere\"\n"

  /** An emitter behind a ball of glass: how much of it is seen depends on where the ball
    * focuses.
    */
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

  test("glass of glTF disperses as a dielectric of the indices that it stands for", Slow):
    def mean(material: String, dialect: Dialect) =
      val text = lens("").replace("Material \"dielectric\" \n", material)
      SceneTexts.mean(SceneTexts.parse(text, Dialect.V4).copy(dialect = dialect))
    val index = Cauchy(1.5f, 6f)
    val pairs = index.lambda.zip(index.values).map((nm, n) => s"$nm $n").mkString(" ")
    val wanted = mean(s"Material \"dielectric\" \"spectrum eta\" [$pairs]\n", Dialect.V4)
    val glass = "MakeNamedMaterial \"a\" \"string type\" \"gltf\" \"float metallic\" 0 " +
      "\"float roughness\" 0 \"bool thin\" false \"float transmission\" 1 \"float eta\" 1.5"
    val c = mean(s"$glass \"float dispersion\" 6\nNamedMaterial \"a\"\n", Dialect.Gltf)
    val plain = mean(s"$glass\nNamedMaterial \"a\"\n", Dialect.Gltf) // all light at 587.56 nm
    // Noise, and highlights that are not perfectly sharp
    def off(a: Rgb) = (a - wanted).map(Math.abs(_)).max / wanted.max
    assert(off(c) < 0.03f && off(plain) > 0.1f, s"$c $plain, not $wanted")

  test("each wavelength goes its own way, and their colours add up to what is seen", Slow):
    // For each wavelength what glass of its index shows
    val steps = 24
    def eta(k: Int) = 1.3f + 0.6f * k / steps
    val brightness =
      (0 to steps).map(k => SceneTexts.mean(lens(s"\"float eta\" ${eta(k)}"), Dialect.V4).g)
    def shown(nm: Float): Float =
      val x = (nm - 360f) / 470f * steps
      val k = Math.min(x.toInt, steps - 1)
      lerp(x - k, brightness(k), brightness(k + 1))
    val bases = Wavelengths.covering(1000, SmoothSpectra())
    val wanted = bases
      .map: basis =>
        val light = basis.ofLight(Rgb.White).r * shown(basis.nm(0))
        basis.toSrgb(Rgb(3f * light, 0f, 0f))
      .reduce(_ + _) * (1f / bases.size)
    val seen = SceneTexts.mean(lens("\"spectrum eta\" [360 1.3 830 1.9]"), Dialect.V4)
    // Chance: one wavelength for each of 65,000 paths; 1.4 % at most for this seed
    for (s, w) <- Seq(seen.r -> wanted.r, seen.g -> wanted.g, seen.b -> wanted.b) do
      assert(Math.abs(s - w) < 0.03f * w, s"$seen, not $wanted")
    // The index at 589 nm alone would give a gray
    assert(wanted.largest > 1.3f * Math.min(wanted.r, Math.min(wanted.g, wanted.b)), wanted)

  test("dispersion needs spectral colour, which scenes get unless it is turned off"):
    val text = scene("\"spectrum eta\" \"glass-BK7\"")
    def features(text: String) = SceneTexts.plan(text, Dialect.V4).features.toMap
    assert(features(text)("color").endsWith("glass disperses light"))
    assert(!features(scene("\"float eta\" 1.5"))("color").contains("disperses"))
    assert(SceneTexts.problems(text, Dialect.V4).isEmpty)
    val plain = RenderSettings(color = ColorMode.Rgb)
    val problems = SceneTexts.problems(text, Dialect.V4, options = plain)
    assert(problems.map(_.message).exists(_.startsWith("dispersion of \"dielectric\" needs")))

  test("what wraps glass keeps its dispersion, regularized or not"):
    val glass = splitting(0.2f)
    val wrapped = Seq[Bsdf => Bsdf](
      Scaled(_, Rgb.gray(0.5f)),
      SentThrough(_),
      b => Lobes(Array(Lambert(Rgb.White), b), Array(0.5f, 0.5f))
    )
    for wrap <- wrapped; bsdf <- Seq(wrap(glass), wrap(glass).regularized) do
      assert(bsdf.isDispersive)

  test("a mixture of glasses splits light as the glass does"):
    val named = "MakeNamedMaterial \"a\" \"string type\" \"dielectric\" " +
      "\"spectrum eta\" \"glass-F11\"\n"
    val mixed = scene("").replace(
      "Material \"dielectric\"",
      named + "Material \"mix\" \"string materials\" [\"a\" \"a\"]"
    )
    assert(SceneTexts.problems(mixed, Dialect.V4).isEmpty)
    val features = SceneTexts.plan(mixed, Dialect.V4).features.toMap
    assert(features("color").startsWith("spectral"))

package candela.mitsuba

import candela.color.Rgb

import java.nio.file.Path

/** Surfaces within others, against Mitsuba 3.9.1. */
final class SurfacesSuite extends MitsubaPictures:
  private val Diffuse = "<bsdf type=\"diffuse\"/>"
  private val Nothing = "<bsdf type=\"null\"/>"
  private val Frosted = "<bsdf type=\"roughdielectric\"/>"
  private val Metal =
    "<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\".3\"/></bsdf>"

  private def blend(weight: String, a: String, b: String) =
    s"<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"$weight\"/>$a$b</bsdf>"
  private def mask(inner: String) =
    s"<bsdf type=\"mask\"><float name=\"opacity\" value=\".4\"/>$inner</bsdf>"
  private def twoSided(inner: String) = s"<bsdf type=\"twosided\">$inner</bsdf>"

  private def bumpy(inner: String, options: String = "") =
    s"<bsdf type=\"normalmap\">$options<texture name=\"normalmap\" type=\"bitmap\">" +
      s"<string name=\"filename\" value=\"$normals\"/><boolean name=\"raw\" value=\"true\"/>" +
      s"</texture>$inner</bsdf>"
  private val normals = Path.of("scenes/textures/normals.png").toAbsolutePath

  private val White =
    "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>"

  /** The middle of a ball under a white sky. */
  private def ball(bsdf: String): Rgb =
    val shape = s"<shape type=\"sphere\"><float name=\"radius\" value=\"3\"/>$bsdf</shape>"
    mean(view(2, 256) + shape + White)

  /** Four standard deviations of 12,288 samples, most of them 0 or 1. */
  private val Noise = 0.018f

  private def agrees(bsdf: String, mitsubas: Float): Unit =
    val found = ball(bsdf).g
    assert(Math.abs(found - mitsubas) < Noise, s"$found instead of $mitsubas"): Unit

  test("the back of a one-sided part of a blend is black, whatever the other part is"):
    agrees(blend(".5", Frosted, Diffuse), 0.505f)
    agrees(blend(".6", blend(".3", Frosted, Diffuse), Metal), 0.744f)

  test("light passes unscattered through what a blend has of null or of a mask"):
    agrees(blend(".5", Nothing, Diffuse), 0.499f)
    agrees(blend(".5", mask(Diffuse), Diffuse), 0.440f)
    agrees(blend(".5", blend(".5", Nothing, Metal), blend(".5", Nothing, Diffuse)), 0.626f)

  test("masks within masks cover what both cover"):
    agrees(mask(mask(Diffuse)), 0.786f)

  test("a mask does not dim the emitter that it is on"):
    val emitter = "<emitter type=\"area\"><rgb name=\"radiance\" value=\".5\"/></emitter>"
    // Le, what the mask reflects, and what comes through both sides
    agrees(emitter + mask(Diffuse), 0.5f + 0.4f * 0.5f + 0.6f * 0.6f)

  private val Sun = "<emitter type=\"directional\"><vector name=\"direction\" " +
    "x=\"-1\" y=\"-.5\" z=\"-1\"/><rgb name=\"irradiance\" value=\"1\"/></emitter>"

  /** Sheets in the sun: no noise but that of the pixels' area. */
  private def lit(bsdf: String, isBack: Boolean, mitsubas: Float): Unit =
    val turned = s"<boolean name=\"flip_normals\" value=\"$isBack\"/>"
    val found = mean(view(20, 64) + s"<shape type=\"rectangle\">$turned$bsdf</shape>$Sun")
    assert(Math.abs(found.g - mitsubas) < 0.01f * mitsubas, s"$found instead of $mitsubas"): Unit

  test("normal maps lie around blends and within them"):
    lit(bumpy(blend(".5", Diffuse, Metal)), isBack = false, 0.09706f)
    lit(blend(".5", bumpy(Diffuse), Metal), isBack = false, 0.11414f)

  test("a normal map within another one has its frame, and is turned with it where it faces away"):
    lit(bumpy(bumpy(Diffuse)), isBack = false, 0.05622f)
    lit(bumpy(blend(".5", bumpy(Diffuse), Diffuse)), isBack = false, 0.06966f)
    val oblique = view(20, 256, from = "-4,-3,1") +
      s"<shape type=\"rectangle\">${bumpy(bumpy(Diffuse))}</shape>$Sun"
    val found = mean(oblique).g
    // 2 %: pixels hold many changes of light and shadow
    assert(Math.abs(found - 0.01161f) < 0.02f * 0.01161f, found)

  test("normals that face away are turned, and edges of shadows softened, unless a scene says no"):
    def seen(name: String) =
      val bsdf = bumpy(Diffuse, s"<boolean name=\"$name\" value=\"false\"/>")
      mean(view(20, 1024, from = "-3,-4,1") + s"<shape type=\"rectangle\">$bsdf</shape>$Sun").g
    // 1 %: pixels hold many changes of light and shadow. Else, 0.01490
    for
      (name, expected) <-
        Seq("flip_invalid_normals" -> 0.01072f, "use_shadowing_function" -> 0.01519f)
    do
      val found = seen(name)
      assert(Math.abs(found - expected) < 0.01f * expected, s"$name: $found")

  test("a radius below 0 turns a sphere inside out, and no cylinder"):
    def seen(shape: String, radius: Int, isBack: Boolean) =
      val turned = s"<boolean name=\"flip_normals\" value=\"$isBack\"/>"
      val size = s"<float name=\"radius\" value=\"$radius\"/>"
      mean(view(30, 16) + s"<shape type=\"$shape\">$size$turned$Diffuse</shape>$Sun").g
    for isBack <- Seq(false, true) do
      assert(seen("sphere", -1, isBack) == seen("sphere", 1, !isBack))
      assert(seen("cylinder", -1, isBack) == seen("cylinder", 1, isBack))
    assert(seen("sphere", -1, isBack = false) != seen("sphere", 1, isBack = false))

  test("a mirrored instance keeps the outside of its shapes"):
    def instanced(shape: String) = mean(
      view(30, 256) + "<shape type=\"shapegroup\" id=\"g\">" +
        s"<shape type=\"$shape\">$Diffuse</shape></shape>" +
        "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\">" +
        s"<scale x=\"-1\"/><rotate x=\"1\" angle=\"30\"/></transform></shape>$White"
    ).g
    // 12,288 samples, half of them without noise: 0.002; more within a cylinder
    assert(Math.abs(instanced("sphere") - 0.6965f) < 0.004f)
    assert(Math.abs(instanced("disk") - 0.7435f) < 0.004f)
    assert(Math.abs(instanced("cylinder") - 0.7113f) < 0.006f)

  /** An emitter, a pane, and the floor behind it. */
  private def behind(pane: String, integrator: String): Float =
    def square(scale: String, z: String, bsdf: String) =
      "<shape type=\"rectangle\"><transform name=\"to_world\">" +
        s"<scale value=\"$scale\"/><translate z=\"$z\"/></transform>$bsdf</shape>"
    mean(
      view(20, 256, integrator) + square("4", "-1", Diffuse) + square("1.5", ".5", pane) +
        "<emitter type=\"point\"><point name=\"position\" x=\"0.2\" y=\"0.1\" z=\"2\"/>" +
        "<rgb name=\"intensity\" value=\"4\"/></emitter>"
    ).g

  test("light samples of volpath pass what a blend has of null or of a mask, those of path don't"):
    val emitter =
      mask(Diffuse) +
        "<emitter type=\"area\"><rgb name=\"radiance\" value=\".1\"/></emitter>"
    for
      (pane, byPath, byVolpath) <- Seq(
        (blend(".5", Nothing, Diffuse), 0.11446f, 0.13045f),
        (blend(".5", mask(Diffuse), Diffuse), 0.16023f, 0.16596f),
        (blend(".5", blend(".5", Nothing, Metal), Diffuse), 0.3239f, 0.32782f),
        (emitter, 0.1914f, 0.21558f)
      )
      (integrator, expected) <- Seq("path" -> byPath, "volpath" -> byVolpath)
    do
      val found = behind(pane, integrator)
      // A quarter of the smallest difference between the two
      assert(Math.abs(found - expected) < 0.005f * expected, s"$integrator: $found, not $expected")

  test("bumps within a two-sided surface are seen from behind as from the front"):
    lit(twoSided(bumpy(Diffuse)), isBack = true, 0.08265f)
    lit(bumpy(twoSided(Diffuse)), isBack = true, 0.0831f)
    lit(twoSided(blend(".5", bumpy(Diffuse), Metal)), isBack = true, 0.11389f)
    lit(twoSided(Diffuse + bumpy(Metal)), isBack = true, 0.11085f)

  test("a principled surface of a dielectric that reflects nothing is no metal, either"):
    def principled(metallic: String) =
      ball("<bsdf type=\"principled\"><float name=\"specular\" value=\"0\"/>" +
        s"<float name=\"metallic\" value=\"$metallic\"/></bsdf>").g
    assert(principled("1") == 0f)
    // Half of the diffuse light is left; four standard deviations
    assert(Math.abs(principled(".5") - 0.2508f) < 0.01f)

  test("spectra of metals are seen under D65, as Mitsuba's RGB variants see them"):
    def metal(eta: String, k: String) =
      val bsdf =
        s"<bsdf type=\"conductor\"><spectrum name=\"eta\" $eta/><spectrum name=\"k\" $k/>" +
          "</bsdf>"
      val scene = read(s"<sensor type=\"perspective\"/><shape type=\"sphere\">$bsdf</shape>")
      val params = scene.shapes.head.material match
        case candela.scenefile.MaterialRef.Inline(d) => d
        case other => fail(other.toString)
      for name <- Seq("eta", "k") yield params.param(name).get.floats.toSeq
    val varied = metal("value=\"400:.2,500:.4,600:1.5,700:2.5\"", "value=\"300:3,900:3\"")
    // 0.2 %: Mitsuba's tables of D65 and of the observer have other digits
    for
      (found, expected) <-
        varied.zip(Seq(Seq(1.96157f, 0.839369f, 0.21652f), Seq(2.99696f, 2.99662f, 2.99641f)))
      (x, y) <- found.zip(expected)
    do assert(Math.abs(x - y) < 0.002f * y, s"$found instead of $expected")

  test("a reflectance that leaves the gamut is moved into it"):
    val spectrum = "<spectrum name=\"reflectance\" value=\"400:.2,500:.4,600:1.5,700:2.5\"/>"
    val shape = s"<shape type=\"sphere\"><bsdf type=\"diffuse\">$spectrum</bsdf></shape>"
    val d = read(s"<sensor type=\"perspective\"/>$shape").shapes.head.material match
      case candela.scenefile.MaterialRef.Inline(d) => d
      case other => fail(other.toString)
    val found = d.param("reflectance").get.floats
    for (x, y) <- found.zip(Seq(1f, 0.839369f, 0.21652f)) do
      // Digits of the observer's table, as of white to 1e-3 in ColorimetrySuite
      assert(Math.abs(x - y) < 0.002f * y, found.toSeq)

package candela.convert

import candela.build.SceneBuilder
import candela.image.Image
import candela.render.{ReferenceScenes, Renderer}
import candela.scenefile.*
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{Blocks, TempFolder}
import org.scalatest.funsuite.AnyFunSuite

/** Every scene of the `scenes` folder, written in another dialect, looks the same; or the converter
  * says why not.
  */
class ConverterSuite extends AnyFunSuite:
  import ConverterSuite.*

  private val pairs =
    for
      name <- ReferenceScenes.names(ReferenceScenes.Scenes, ".pbrt") if !LeftOut(name)
      to <- Vector(Dialect.V3, Dialect.V4) if !name.startsWith(to.toString.toLowerCase)
    yield (name, to)

  for (name, to) <- pairs do
    test(s"$name in $to"):
      TempFolder.use: folder =>
        val scene = Parser.parse(ReferenceScenes.Scenes.resolve(s"$name.pbrt"))
        val converted = Converter.convert(scene, to, folder)
        val again = Descriptions.read(Descriptions.text(converted.scene), folder)
        assert(again.dialect == to && again.warnings.isEmpty)
        // Colours that multiply as spectra are not lost, and here hardly seen
        val lost = converted.warnings.filterNot(_.message.contains("multiplies spectra"))
        val warnings = lost.map(_.message).mkString("\n")
        if lost.isEmpty then
          assert(Exact((name, to)), "it loses nothing: list it among the exact ones")
        else assert(!Exact((name, to)), warnings)
        assert(converted.warnings.forall(_.pos.exists(_.file.endsWith(s"$name.pbrt"))))
        val most = Differing.getOrElse((name, to), Most)
        assert(difference(image(scene, 1), image(again, 2), 2) < most, warnings)

  test("the lists name pairs that there are, and none as exact that differs"):
    assert((Exact ++ Differing.keySet).diff(pairs.toSet).isEmpty)
    assert(Exact.intersect(Differing.keySet).isEmpty)

object ConverterSuite:

  /** Of a quarter's mean: what noise alone makes of the same picture. */
  private val Most = 0.1

  /** The demo; and what is too noisy in so few samples: fog, and caustics of small emitters. */
  private val LeftOut =
    Set("showcase", "v4-fog-gap") ++ Set("glass", "mist", "pool", "ring").map("v4-caustics-" + _)

  /** Scenes that lose nothing. */
  private val Exact: Set[(String, Dialect)] =
    val inV3 =
      "v2-alpha v2-defaults-bare v2-defaults-shapes v2-defaults-textures v2-filter-gaussian " +
        "v2-filter-triangle v2-motion v2-panorama v2-point-lights v2-swept-quadrics v2-textures " +
        "v4-bdpt v4-bdpt-stretched v4-bdpt-turned v4-conductor v4-curves " +
        "v4-defaults-bare v4-defaults-emission v4-defaults-lights v4-defaults-shapes " +
        "v4-depth-of-field v4-dielectric v4-diffuse-transmission v4-environment-map " +
        "v4-filter-gaussian v4-filter-mitchell " +
        "v4-instances v4-media v4-mirrored-glass v4-motion " +
        "v4-panorama v4-realistic v4-simplepath v4-sppm"
    val inV4 =
      "v2-alpha v2-defaults-bare v2-filter-gaussian v2-filter-triangle v2-motion v2-panorama " +
        "v2-textures v3-curves v3-defaults-bare v3-defaults-lights " +
        "v3-defaults-noise v3-filter-mitchell v3-filter-sinc v3-fog v3-media " +
        "v3-meshes v3-mirrored-glass v3-motion v3-orthographic-crop v3-panorama v3-quadrics " +
        "v3-realistic v3-textures"
    (inV3.split(' ').map(_ -> Dialect.V3) ++ inV4.split(' ').map(_ -> Dialect.V4)).toSet

  /** Scenes that lose what is seen, and the difference that this makes: a quarter more than it was
    * for two pairs of seeds.
    */
  private val Differing: Map[(String, Dialect), Double] =
    val inV3 = Map(
      "v2-ambientocclusion" -> 2.55,
      "v2-blends" -> 0.45,
      "v2-bump" -> 0.25,
      "v2-defaults-emission" -> 12.75,
      "v2-defaults-lights" -> 0.5,
      "v2-defaults-noise" -> 22.1,
      "v2-metropolis" -> 0.4,
      "v2-procedural" -> 3.4,
      "v2-subsurface" -> 0.35,
      "v2-volumes" -> 1.3,
      "v2-volumes-whitted" -> 1.3,
      "v4-alpha" -> 0.15,
      "v4-ambientocclusion" -> 2.45,
      "v4-bdpt-media" -> 0.25,
      "v4-bump" -> 0.3,
      "v4-coated-diffuse" -> 0.7,
      "v4-defaults-materials" -> 1.75,
      "v4-defaults-names" -> 0.4,
      "v4-defaults-noise" -> 12.1,
      "v4-defaults-paths" -> 0.25,
      "v4-defaults-spelling" -> 0.25,
      "v4-displacement" -> 0.15,
      "v4-film" -> 1.05,
      "v4-fog" -> 0.4,
      "v4-force-diffuse" -> 0.2,
      "v4-interfaces" -> 3.3,
      "v4-layers" -> 0.25,
      "v4-lightpath" -> 0.85,
      "v4-measured" -> 0.35,
      "v4-media-cloud" -> 0.15,
      "v4-media-emission" -> 9.65,
      "v4-mlt" -> 0.5,
      "v4-panorama-equalarea" -> 1.05,
      "v4-picture-lights" -> 10.05,
      "v4-pixel-centres" -> 0.25,
      "v4-point-lights" -> 3.55,
      "v4-spectral-fog" -> 1.3,
      "v4-spectral-lamps" -> 0.4,
      "v4-procedural" -> 2.55,
      "v4-randomwalk" -> 0.4,
      "v4-sensor" -> 0.75,
      "v4-simplevolpath" -> 0.35,
      "v4-spectral" -> 0.4,
      "v4-subsurface" -> 0.15
    )
    val inV4 = Map(
      "v2-ambientocclusion" -> 1.4,
      "v2-blends" -> 0.5,
      "v2-bump" -> 0.35,
      "v2-defaults-emission" -> 13.95,
      "v2-defaults-lights" -> 0.5,
      "v2-defaults-noise" -> 0.4,
      "v2-defaults-spelling" -> 0.15,
      "v2-materials" -> 0.2,
      "v2-metropolis" -> 0.4,
      "v2-path-grid" -> 0.25,
      "v2-point-lights" -> 0.95,
      "v2-procedural" -> 0.6,
      "v2-subsurface" -> 1.3,
      "v2-volumes" -> 1.25,
      "v2-volumes-whitted" -> 1.3,
      "v3-ambientocclusion" -> 2.8,
      "v3-bump" -> 0.4,
      "v3-defaults-materials" -> 0.13,
      "v3-defaults-shapes" -> 0.15,
      "v3-defaults-spelling" -> 0.2,
      "v3-disney-subsurface" -> 0.25,
      "v3-glass" -> 0.15,
      "v3-glossy" -> 0.25,
      "v3-heightfield-nurbs" -> 0.35,
      "v3-matte-directlighting" -> 0.4,
      "v3-matte-whitted" -> 0.4,
      "v3-mlt" -> 0.3,
      "v3-point-lights" -> 0.5,
      "v3-procedural" -> 3.4,
      "v3-subsurface" -> 0.65
    )
    inV3.map((name, most) => (name, Dialect.V3) -> most) ++
      inV4.map((name, most) => (name, Dialect.V4) -> most)

  private def image(scene: SceneDescription, seed: Int): Image =
    // Colours of v2 and v3 are three numbers
    val options =
      RenderSettings(samples = Some(32), seed = seed, quick = true, color = ColorMode.Rgb)
    val (plan, _) = SceneBuilder.build(scene, options)
    val made = Renderer.render(plan, 2).image(plan.development)
    if made.colorSpace.isSrgb then made else made.toRgb

  /** The largest difference of the means of `parts` × `parts` blocks, in any channel, in parts of
    * the darker one; what is darker than a tenth of the image counts as that bright.
    */
  private def difference(a: Image, b: Image, parts: Int): Double =
    val (x, y) = (Blocks.means(a, parts), Blocks.means(b, parts))
    val least = 0.1 * x.sum / x.length
    x.indices.map(i => Math.abs(x(i) - y(i)) / Math.max(Math.min(x(i), y(i)), least)).max

package candela.render

import java.nio.file.{Files, Path}

import candela.build.{RenderSettings, SceneBuilder}
import candela.guiding.GuidingMode
import candela.image.{Image, ImageFiles}
import candela.integrators.CausticsMode
import candela.mitsuba.MitsubaScene
import candela.scenefile.Parser

import org.scalatest.funsuite.AnyFunSuite

/** Scene files go in, and images come out that agree with the real pbrt's.
  *
  * Every scene of the `scenes` folder that `reference-images` has an image of is rendered with a
  * few samples and several seeds, and compared as [[Agreement]] says. The seeds are fixed: an
  * unchanged renderer always gets the same answer. Images that disagree are left under
  * `target/render-diff`.
  */
class RenderSuite extends AnyFunSuite:
  import RenderSuite.*

  for scene <- ReferenceScenes.all do
    test(s"${scene.name} agrees with its reference"):
      val agreement = compare(scene, Files.readString(scene.file))
      val wrong = agreement.disagreements(Significance)
      if wrong.nonEmpty then
        val first = wrong.take(5).map(_.what).mkString("\n  ")
        val paths = keep(scene, agreement).mkString("\n  ")
        fail(s"${wrong.size} disagreements, first\n  $first\nsee\n  $paths")

  test("guided paths in fog agree with the reference"):
    val scene = ReferenceScenes.named("v4-fog-gap")
    val agreement = compare(scene, Files.readString(scene.file), GuidingMode.On)
    assert(agreement.disagreements(Significance).isEmpty)

  test("light paths bring the rainbow of a prism to path"):
    val scene = ReferenceScenes.named("v4-prism")
    val text = Files.readString(scene.file)
    assert(text.contains("\"bdpt\""))
    val caustics = Some(CausticsMode.On)
    val asked = text.replace("\"bdpt\"", "\"path\"")
    // What is below is seen through the prism, where only bdpt connects what the rainbow lights
    val agreement = compare(scene, asked, caustics = caustics, rows = Some(30))
    assert(agreement.disagreements(Significance).isEmpty)

  test("every reference has its scene, its place in the manifest and its noise"):
    val images = ReferenceScenes.names(ReferenceScenes.References, ".exr")
    assert(images == ReferenceScenes.manifest.map(_("scene")).sorted)
    assert(images == ReferenceScenes.all.map(_.name))
    assert(ReferenceScenes.all.forall(s => s.noise > 0 && s.allowance >= 0))

  // The same comparison must see when something is wrong: (scene, what is broken, as written,
  // instead)
  private val broken = Vector(
    ("v3-matte-directlighting", "an albedo 5 % too high", "[.7 .3 .2]", "[.735 .315 .21]"),
    ("v3-matte-whitted", "a rough surface taken for a smooth one", "\"float sigma\" 60", ""),
    ("v3-glossy", "a roughness 40 % too high", "\"float roughness\" .1", "\"float roughness\" .14"),
    ("v3-meshes", "shading normals left out", "\"normal N\"", "\"normal Nothing\""),
    ("v3-textures", "a texture read upside down", "\"float vscale\" 1.2", "\"float vscale\" -1.2"),
    ("v3-environment-map", "a sky turned by 2 degrees", "Rotate 130", "Rotate 132"),
    ("v3-filter-mitchell", "another filter", "PixelFilter \"mitchell\"", "PixelFilter \"box\""),
    ("v4-conductor", "gold without its colour", "metal-Au-", "metal-Ag-"),
    (
      "v4-dielectric",
      "an index of refraction 0.05 too high",
      "\"float eta\" 1.3",
      "\"float eta\" 1.35"
    ),
    (
      "v4-depth-of-field",
      "a lens 40 % too wide",
      "\"float lensradius\" .18",
      "\"float lensradius\" .25"
    )
  )

  for (name, what, written, instead) <- broken do
    test(s"$what is seen in $name"):
      val scene = ReferenceScenes.named(name)
      val text = Files.readString(scene.file)
      assert(text.contains(written))
      val agreement = compare(scene, text.replace(written, instead))
      assert(agreement.disagreements(Significance).nonEmpty)

  test("one thread and two make the same image, bit for bit"):
    for name <- Seq("v2-path-grid", "v3-lights", "v4-coated-diffuse") do
      val scene = ReferenceScenes.named(name)
      val text = Files.readString(scene.file)
      val one = render(scene, text, seed = 5, spp = 4, threads = 1)
      val two = render(scene, text, seed = 5, spp = 4, threads = 2)
      assert(one.data.map(bits).sameElements(two.data.map(bits)), name)
      val other = render(scene, text, seed = 6, spp = 4, threads = 2)
      assert(!one.data.map(bits).sameElements(other.data.map(bits)), s"$name: the seed is ignored")

object RenderSuite:
  /** Renderings of each scene, and the samples of each: enough for a noise of some 0.5 % in the
    * mean of a small block, where the broken scenes above must show.
    */
  private val Seeds = 4
  private val SamplesPerPixel = 16

  /** Chance that correct renderings of one scene are accused; of a thousand changes to the random
    * numbers of correct code, this suite would stop fewer than three.
    */
  private val Significance = 1e-4

  private val Differences = Path.of("target", "render-diff")

  private def bits(f: Float): Int = java.lang.Float.floatToRawIntBits(f)

  /** @param rows how many are compared, from the top; None: all */
  private def compare(
      scene: ReferenceScene,
      text: String,
      guiding: GuidingMode = GuidingMode.Off,
      caustics: Option[CausticsMode] = None,
      rows: Option[Int] = None
  ): Agreement =
    def upper(image: Image) = rows.fold(image): n =>
      val values = n * image.width * image.channels
      Image(image.width, n, image.channelNames, image.data.take(values))
    val threads = Runtime.getRuntime.availableProcessors
    val renders = Vector.tabulate(Seeds): seed =>
      render(scene, text, seed + 1, SamplesPerPixel, threads, guiding, caustics)
    val plan = planned(scene, text, seed = 1, SamplesPerPixel)
    val alike = if plan.sharesSamples then plan.filter.correlation else 1.0
    Agreement(renders.map(upper), upper(scene.image), scene.noise, scene.allowance, alike)

  private def render(
      scene: ReferenceScene,
      text: String,
      seed: Int,
      spp: Int,
      threads: Int,
      guiding: GuidingMode = GuidingMode.Off,
      caustics: Option[CausticsMode] = None
  ): Image =
    val plan = planned(scene, text, seed, spp, guiding, caustics)
    val rendering = Renderer.render(plan, threads)
    assert(rendering.refused.isEmpty, s"not a number: ${rendering.refused}")
    rendering.image(plan.development)

  private def planned(
      scene: ReferenceScene,
      text: String,
      seed: Int,
      spp: Int,
      guiding: GuidingMode = GuidingMode.Off,
      caustics: Option[CausticsMode] = None
  ): RenderPlan =
    val description =
      if scene.isMitsubas then
        Parser.whole(MitsubaScene.readable(scene.file, Map.empty, keepGoing = false))
      else Parser.parseText(scene.file.toString, text, ReferenceScenes.Scenes)
    val settings = RenderSettings(
      Some(spp),
      seed,
      guiding = Some(guiding),
      caustics = Some(caustics.getOrElse(scene.caustics))
    )
    SceneBuilder.build(description, settings)._1

  /** Leaves images to look at; their paths. */
  private def keep(scene: ReferenceScene, agreement: Agreement): Vector[Path] =
    val _ = Files.createDirectories(Differences)
    val apart = agreement.difference
    val magnitude = Image(apart.width, apart.height, Image.RgbNames, apart.data.map(Math.abs))
    Vector(
      ("", "exr", agreement.image),
      ("", "png", agreement.image),
      ("-reference", "exr", scene.image),
      ("-reference", "png", scene.image),
      ("-difference", "exr", apart),
      ("-difference", "png", magnitude)
    ).map: (suffix, format, image) =>
      val path = Differences.resolve(s"${scene.name}$suffix.$format")
      ImageFiles.write(path, image)
      path.toAbsolutePath

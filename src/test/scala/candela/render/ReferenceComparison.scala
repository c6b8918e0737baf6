package candela.render

import java.nio.file.{Files, Path}

import candela.build.SceneBuilder
import candela.image.{Image, ImageFiles}
import candela.integrators.CausticsMode

/** Renders reference scenes, and compares them with their references. */
object ReferenceComparison:
  /** Renderings of each scene, and the samples of each: enough for a noise of some 0.5 % in the
    * mean of a small block, where the broken scenes of [[RenderSuite]] must show.
    */
  private val Seeds = 4
  private val SamplesPerPixel = 16

  /** Chance that correct renderings of one scene are accused; of a thousand changes to the random
    * numbers of correct code, the suites would stop fewer than three.
    */
  val Significance = 1e-4

  private val Differences = Path.of("target", "render-diff")

  /** @param text     what is rendered, instead of the scene's file
    * @param caustics how caustics are looked for, where not as the scene says
    * @param rows     how many are compared, from the top; None: all
    */
  def apply(
      scene: ReferenceScene,
      text: String,
      caustics: Option[CausticsMode] = None,
      rows: Option[Int] = None
  ): Agreement =
    def upper(image: Image) = rows.fold(image): n =>
      val values = n * image.width * image.channels
      Image(image.width, n, image.channelNames, image.data.take(values))
    val renders = Vector.tabulate(Seeds): seed =>
      render(planned(scene, text, seed + 1, SamplesPerPixel, caustics), threads = 1)
    val plan = planned(scene, text, seed = 1, SamplesPerPixel, caustics)
    val alike = if plan.sharesSamples then plan.filter.correlation else 1.0
    Agreement(renders.map(upper), upper(scene.image), scene.noise, scene.allowance, alike)

  def render(scene: ReferenceScene, text: String, seed: Int, spp: Int, threads: Int): Image =
    render(planned(scene, text, seed, spp), threads)

  private def render(plan: RenderPlan, threads: Int): Image =
    val rendering = Renderer.render(plan, threads)
    assert(rendering.discarded.isEmpty, s"not a number: ${rendering.discarded}")
    rendering.image(plan.development)

  private def planned(
      scene: ReferenceScene,
      text: String,
      seed: Int,
      spp: Int,
      caustics: Option[CausticsMode] = None
  ): RenderPlan =
    val settings = scene.settings(spp, seed)
    SceneBuilder.build(
      scene.description(text),
      settings.copy(caustics = caustics.orElse(settings.caustics))
    )._1.piloted

  /** Leaves images to look at; their paths. */
  def write(scene: ReferenceScene, agreement: Agreement): Vector[Path] =
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
      val path = Differences.resolve(s"${scene.title}$suffix.$format")
      ImageFiles.write(path, image)
      path.toAbsolutePath

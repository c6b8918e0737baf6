package candela.gallery

import candela.diagnostics.Problem
import java.nio.file.{Files, Path}

import candela.aov.Layer
import candela.build.{Category, SceneBuilder}
import candela.build.recipe.Recipe
import candela.image.{Image, ImageFiles, Oidn}
import candela.job.Denoising
import candela.render.{ReferenceScenes, Renderer, RenderPlan}
import candela.scenefile.{Dialect, Parser}
import candela.settings.RenderSettings

/** One type of the gallery.
  *
  * @param example empty if no example has been written
  */
final case class Exhibit(category: Category, recipe: Recipe[?], example: Option[Example]):
  def dialect: Dialect = Examples.dialect(recipe)

  /** Reason for the absence of an image. */
  def reason: Option[String] = recipe.substitute.map(p => s"substituted: $p").orElse:
    example.collect { case Example.Unseen(why) => why }

  def isShown: Boolean = reason.isEmpty && example.nonEmpty

  /** The scene of the example, for an image of this width. */
  private def scene(width: Int): String = example match
    case Some(Example.Lines(text)) => Template.scene(category.name, dialect, text, width)
    case _ => throw IllegalArgumentException(s"$file has no scene")

  /** File name of its image, without extension. */
  def file: String =
    def slug(words: String) = words.toLowerCase.replaceAll("[^a-z0-9]+", "-").stripSuffix("-")
    val same = category.recipes.all.count(_.name == recipe.name)
    val suffix = if same > 1 then s"-${dialect.toString.toLowerCase}" else ""
    s"${slug(category.name)}-${slug(recipe.name)}$suffix"

  def plan(width: Int, options: RenderSettings): (RenderPlan, Vector[Problem]) =
    val description =
      Parser.parseText(s"$file.pbrt", scene(width), ReferenceScenes.Scenes, Some(dialect))
    SceneBuilder.build(description, options)

/** Renders an image of each type of scene files and writes the gallery page. Needs Open Image
  * Denoise.
  *
  * Usage: `./sbt "Test/runMain candela.gallery.Gallery"` renders all images; with arguments, only
  * those whose names contain one of them. The page is always written.
  */
object Gallery:
  val Page: Path = Path.of("docs", "GALLERY.md")
  val Pictures: Path = Path.of("docs", "gallery")
  val Ending = ".jpg"
  val Width = 400

  /** Before denoising. */
  private val SamplesPerPixel = 16

  /** About as many as the references have. */
  private val ComparedSamples = 1024

  private val threads = Runtime.getRuntime.availableProcessors

  val exhibits: Vector[Exhibit] =
    for category <- Examples.categories; recipe <- category.recipes.all
    yield Exhibit(category, recipe, Examples.of(category, recipe))

  def picture(file: String): Path = Pictures.resolve(s"$file$Ending")

  def main(words: Array[String]): Unit =
    val _ = Files.createDirectories(Pictures)
    val denoising = Denoising(Oidn.load(), threads)
    val options = RenderSettings(samples = Some(SamplesPerPixel), layers = Layer.denoising)
    for e <- exhibits if e.isShown && (words.isEmpty || words.exists(e.file.contains)) do
      val (plan, problems) = e.plan(Width, options)
      problems.foreach(p => println(s"${e.file}: ${p.message}"))
      write(e.file, Denoising.displayed(denoising(render(plan))))
      println(s"${e.file}: ${Looks.of(ImageFiles.read(picture(e.file)))}")
    for c <- Comparisons.all if words.isEmpty || words.exists(c.own.contains) do
      val reference = ImageFiles.read(ReferenceScenes.References.resolve(s"${c.name}.exr"))
      write(c.own, enlarged(render(c.plan(ComparedSamples)).toRgb))
      write(c.pbrt, enlarged(reference.toRgb))
      println(c.own)
    val _ = Files.writeString(Page, GalleryPage(exhibits).text)
    println(s"wrote $Page")

  private def write(file: String, image: Image): Unit = ImageFiles.write(picture(file), image.toRgb)

  /** Pixels as squares: the references are small. */
  private def enlarged(image: Image): Image =
    val times = (Width + image.width - 1) / image.width
    val large = Image.rgb(times * image.width, times * image.height)
    for y <- 0 until large.height; x <- 0 until large.width; c <- 0 until 3 do
      large.data((y * large.width + x) * 3 + c) = image(x / times, y / times, c)
    large

  def render(plan: RenderPlan): Image = Renderer.render(plan, threads).image(plan.development)

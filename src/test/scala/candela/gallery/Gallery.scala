package candela.gallery

import java.nio.file.{Files, Path}

import candela.base.Problem
import candela.build.{Category, RenderSettings, SceneBuilder}
import candela.build.recipe.Recipe
import candela.image.{Image, ImageFiles}
import candela.render.{ReferenceScenes, Renderer, RenderPlan}
import candela.scenefile.{Dialect, Parser}

/** One type of the gallery.
  *
  * @param example empty if no example has been written
  */
final case class Exhibit(category: Category, recipe: Recipe[?], example: Option[Example]):
  def dialect: Dialect = Examples.dialect(recipe)

  /** Reason for the absence of an image. */
  def reason: Option[String] = recipe.substitute.map(p => s"substituted: $p").orElse:
    example.collect { case Example.Unseen(why) => why }

  /** The scene of the example. */
  def scene: Option[String] = example.collect:
    case Example.Lines(text) if reason.isEmpty => Template.scene(category.name, dialect, text)

  /** File name of its image, without extension. */
  def file: String =
    def slug(words: String) = words.toLowerCase.replaceAll("[^a-z0-9]+", "-").stripSuffix("-")
    val same = category.recipes.all.count(_.name == recipe.name)
    val suffix = if same > 1 then s"-${dialect.toString.toLowerCase}" else ""
    s"${slug(category.name)}-${slug(recipe.name)}$suffix"

  def plan(options: RenderSettings): (RenderPlan, Vector[Problem]) =
    val description =
      Parser.parseText(s"$file.pbrt", scene.get, ReferenceScenes.Scenes, Some(dialect))
    SceneBuilder.build(description, options)

/** Renders a small image of each type of scene files and writes the gallery page.
  *
  * Usage: `./sbt "Test/runMain candela.gallery.Gallery"` renders all images; with arguments, only
  * those whose names contain one of them. The page is always written.
  */
object Gallery:
  val Page: Path = Path.of("docs", "GALLERY.md")
  val Pictures: Path = Path.of("docs", "gallery")
  private val SamplesPerPixel = 64

  /** About as many as the references have. */
  private val ComparedSamples = 1024

  val exhibits: Vector[Exhibit] =
    for category <- Examples.categories; recipe <- category.recipes.all
    yield Exhibit(category, recipe, Examples.of(category, recipe))

  def main(words: Array[String]): Unit =
    val _ = Files.createDirectories(Pictures)
    for e <- exhibits if e.scene.nonEmpty && (words.isEmpty || words.exists(e.file.contains)) do
      val (plan, problems) = e.plan(RenderSettings(samples = Some(SamplesPerPixel)))
      problems.foreach(p => println(s"${e.file}: ${p.message}"))
      write(e.file, render(plan))
      println(e.file)
    for c <- Comparisons.all if words.isEmpty || words.exists(c.own.contains) do
      val reference = ImageFiles.read(ReferenceScenes.References.resolve(s"${c.name}.exr"))
      write(c.own, render(c.plan(ComparedSamples)))
      write(c.pbrt, reference)
      println(c.own)
    val _ = Files.writeString(Page, GalleryPage(exhibits).text)
    println(s"wrote $Page")

  private def write(file: String, image: Image): Unit =
    ImageFiles.write(Pictures.resolve(s"$file.png"), image.toRgb)

  def render(plan: RenderPlan): Image =
    Renderer.render(plan, Runtime.getRuntime.availableProcessors).image(plan.development)

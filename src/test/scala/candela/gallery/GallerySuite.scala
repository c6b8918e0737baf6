package candela.gallery

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

import candela.base.SceneError
import candela.build.RenderSettings
import candela.image.{DisplayTransform, Image, ImageFiles}
import candela.render.{ReferenceScenes, Renderer}
import candela.testing.Blocks

/** Checks that the gallery shows every type. */
final class GallerySuite extends AnyFunSuite:

  for e <- Gallery.exhibits do
    test(s"${e.category.name} \"${e.recipe.name}\" of ${e.dialect} has an example or a reason"):
      assert(e.reason.nonEmpty || e.scene.nonEmpty, "write one in src/test/scala/candela/gallery")

  for e <- Gallery.exhibits if e.scene.nonEmpty do
    test(s"the example of ${e.file} builds without problems and matches its picture"):
      val (plan, problems) =
        try e.plan(RenderSettings(samples = Some(8)))
        catch case error: SceneError => fail(error.problems.map(_.message).mkString("\n"))
      assert(problems.isEmpty, problems.map(_.message))
      val rendering = Renderer.render(plan, threads = 1)
      assert(rendering.refused.isEmpty)
      val seen = shades(rendering.image(plan.development))
      val drawn = shades(ImageFiles.read(Gallery.Pictures.resolve(s"${e.file}.png")).linear)
      val worst = seen.indices.map(i => Math.abs(seen(i) - drawn(i))).max
      // Noise: 0.05 at most, in blocks of 256 pixels
      assert(worst < 0.1)

  for c <- Comparisons.all do
    test(s"the pictures of ${c.name} are alike, and pbrt's is its reference"):
      def drawn(file: String) =
        shades(ImageFiles.read(Gallery.Pictures.resolve(s"$file.png")).linear)
      val stored = ImageFiles.read(ReferenceScenes.References.resolve(s"${c.name}.exr"))
      val reference = DisplayTransform()(stored.toRgb)
      val own = drawn(c.own)
      for (what, other) <- Vector("pbrt's" -> drawn(c.pbrt), "reference" -> shades(reference)) do
        // Rounding to 8 bits and noise
        assert(own.lazyZip(other).forall((a, b) => Math.abs(a - b) < 0.03), what)

  /** The means of blocks, as a screen shows them: at most 1. */
  private def shades(image: Image): Array[Double] =
    val shown = image.data.map(Math.min(_, 1f))
    Blocks.means(Image(image.width, image.height, image.channelNames, shown), 6)

  test("no example is of an unknown type"):
    assert(Examples.strays.isEmpty)

  test("the page matches the recipes"):
    val found = Files.readString(Gallery.Page)
    val help = "regenerate it: ./sbt \"Test/runMain candela.gallery.Gallery\""
    assert(found == GalleryPage(Gallery.exhibits).text, help)

  test("images exist for exactly the examples and are small in total"):
    val compared = Comparisons.all.flatMap(c => Vector(c.own, c.pbrt))
    val wanted = (Gallery.exhibits.filter(_.scene.nonEmpty).map(_.file) ++ compared).sorted
    assert(wanted.distinct == wanted)
    assert(ReferenceScenes.names(Gallery.Pictures, ".png") == wanted)
    val sizes = wanted.map(name => Files.size(Gallery.Pictures.resolve(s"$name.png")))
    assert(sizes.sum < 1_500_000)

  test("every link leads to a heading of the reference"):
    val reference = Files.readString(java.nio.file.Path.of("docs", "REFERENCE.md"))
    val headings =
      reference.linesIterator.filter(_.startsWith("##")).map(_.dropWhile(_ == '#').trim)
    val anchors = headings.map(h => s"REFERENCE.md#${GalleryPage.anchor(h)}").toSet
    val page = GalleryPage(Gallery.exhibits)
    val broken = Gallery.exhibits.map(page.link).filterNot(anchors)
    assert(broken.isEmpty)

package candela.gallery

import candela.diagnostics.SceneError
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.image.{DisplayTransform, Image, ImageFiles}
import candela.render.{ReferenceScenes, Renderer}
import candela.settings.RenderSettings
import candela.testing.Blocks

/** Checks that the gallery shows every type. */
final class GallerySuite extends AnyFunSuite:

  for e <- Gallery.exhibits do
    test(s"${e.category.name} \"${e.recipe.name}\" of ${e.dialect} has an example or a reason"):
      assert(e.reason.nonEmpty || e.isShown, "write one in src/test/scala/candela/gallery")

  for e <- Gallery.exhibits if e.isShown do
    test(s"the example of ${e.file} builds without problems and matches its picture"):
      val (plan, problems) =
        try e.plan(96, RenderSettings(samples = Some(8)))
        catch case error: SceneError => fail(error.problems.map(_.message).mkString("\n"))
      assert(problems.isEmpty, problems.map(_.message))
      val rendering = Renderer.render(plan, threads = 1)
      assert(rendering.discarded.isEmpty)
      val seen = shades(rendering.image(plan.development))
      val drawn = shades(ImageFiles.read(Gallery.picture(e.file)).linear)
      val worst = seen.indices.map(i => Math.abs(seen(i) - drawn(i))).max
      // Noise: 0.05 at most, in blocks of 192 pixels
      assert(worst < 0.1)

    test(s"the picture of ${e.file} is neither black nor white nor noisy, and large", Slow):
      val picture = ImageFiles.read(Gallery.picture(e.file))
      assert(picture.width >= 400)
      val looks = Looks.of(picture)
      assert(looks.faults.isEmpty, looks)

  test("pictures that show nothing are found"):
    def faults(brightness: Int => Double) =
      val picture = Image.rgb(100, 75)
      for i <- picture.data.indices do picture.data(i) = brightness(i / 3).toFloat
      Looks.of(picture).faults
    val random = scala.util.Random(1)
    assert(faults(i => 0.2 + 0.6 * (i % 100) / 100).isEmpty)
    assert(faults(i => if i < 200 then 0.9 else 0) == Vector("black"))
    assert(faults(i => if i < 4000 then 0.2 else 1) == Vector("white"))
    assert(faults(i => 0.5 + 0.0001 * i / 75) == Vector("of one colour"))
    assert(faults(i => 0.2 + 0.6 * (i % 100) / 100 + 0.02 * random.nextGaussian) == Vector("noisy"))

  for c <- Comparisons.all do
    test(s"the pictures of ${c.name} are alike, and pbrt's is its reference"):
      def drawn(file: String) =
        shades(ImageFiles.read(Gallery.picture(file)).linear)
      val stored = ImageFiles.read(ReferenceScenes.References.resolve(s"${c.name}.exr"))
      val reference = DisplayTransform()(stored.toRgb)
      val own = drawn(c.own)
      for (what, other) <- Vector("pbrt's" -> drawn(c.pbrt), "reference" -> shades(reference)) do
        val worst = own.lazyZip(other).map((a, b) => Math.abs(a - b)).max
        // Noise, and what JPEG loses of saturated colours
        assert(worst < 0.05, what)

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
    val wanted = (Gallery.exhibits.filter(_.isShown).map(_.file) ++ compared).sorted
    assert(wanted.distinct == wanted)
    val files = wanted.map(_ + Gallery.Ending).sorted
    assert(ReferenceScenes.names(Gallery.Pictures, "") == files)
    val sizes = wanted.map(name => Files.size(Gallery.picture(name)))
    assert(sizes.sum < 6_000_000)

  test("every link leads to a heading of the reference"):
    val reference = Files.readString(java.nio.file.Path.of("docs", "REFERENCE.md"))
    val headings =
      reference.linesIterator.filter(_.startsWith("##")).map(_.dropWhile(_ == '#').trim)
    val anchors = headings.map(h => s"REFERENCE.md#${GalleryPage.anchor(h)}").toSet
    val page = GalleryPage(Gallery.exhibits)
    val broken = Gallery.exhibits.map(page.link).filterNot(anchors)
    assert(broken.isEmpty)

package candela.render

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

class ImageDigestsSuite extends AnyFunSuite:
  private def image(change: Array[Float] => Unit = _ => (), width: Int = 3): Image =
    val data = Array.tabulate(18)(i => i * 0.1f)
    change(data)
    Image(width, 6 / width, Image.RgbNames, data)

  test("equal images have equal digests"):
    assert(ImageDigests.of(image()) == ImageDigests.of(image()))

  test("the last bit of any value changes the digest, as do another shape and another zero"):
    val plain = ImageDigests.of(image())
    for i <- 0 until 18 do
      assert(ImageDigests.of(image(d => d(i) = Math.nextUp(d(i)))) != plain, s"value $i")
    assert(ImageDigests.of(image(_(0) = -0f)) != plain)
    assert(ImageDigests.of(image(width = 2)) != plain)

  test("a scene that is changed has another digest"):
    val scene = ReferenceScenes.named("v4-conductor")
    val text = java.nio.file.Files.readString(scene.file)
    def digest(text: String) =
      ImageDigests.of(ReferenceComparison.render(scene, text, seed = 1, spp = 1, threads = 1))
    assert(digest(text) == digest(text))
    assert(digest(text) != digest(text.replace("metal-Au-", "metal-Ag-")))

  test("rows are read as they are written"):
    val row = ImageDigests.Row("v4-conductor", "0123abcd", "dd6a2bd4+")
    assert(ImageDigests.Row.of(row.line) == row)

package candela.image

import candela.color.ColorSpace

import org.scalatest.funsuite.AnyFunSuite

class ImageEditsSuite extends AnyFunSuite:
  private val names = Image.RgbNames :+ "A"
  private def image(values: Float*) = Image(values.size / 4, 1, names, values.toArray)
  private def error(body: => Any) = intercept[ImageError] { val _ = body }.getMessage

  test("channels are selected by name, in the order asked for"):
    val picked = ImageEdits.select(image(1, 2, 3, 4, 5, 6, 7, 8), Vector("A", "R"))
    assert(picked.channelNames == Vector("A", "R"))
    assert(picked.data.toVector == Vector(4f, 1f, 8f, 5f))
    assert(error(ImageEdits.select(image(), Vector("R", "Z"))) == "no channel Z, only R, G, B, A")

  test("alpha is not scaled"):
    assert(ImageEdits.scaled(image(1, 2, 3, 0.5f), 2f).data.toVector == Vector(2f, 4f, 6f, 0.5f))

  test("clamping keeps the hue of bright pixels, and dim ones as they are"):
    val made = ImageEdits.clamped(image(1, 2, 8, 0, 1, 1, 1, 0), 4f)
    assert(made.data.toVector == Vector(0.5f, 1f, 4f, 0f, 1f, 1f, 1f, 0f))
    val endless = ImageEdits.clamped(image(1, Float.PositiveInfinity, 8, 0), 4f)
    assert(endless.data.toVector == Vector(0f, 4f, 0f, 0f))

  test("rows are turned upside down"):
    val made = ImageEdits.flipped(Image(2, 3, Vector("Y"), Array(1f, 2f, 3f, 4f, 5f, 6f)))
    assert(made.data.toVector == Vector(5f, 6f, 3f, 4f, 1f, 2f))

  test("other primaries describe the same light"):
    val space = ColorSpace.named("rec2020").get
    val light = image(0.25f, 0.5f, 1f, 0.75f)
    val there = ImageEdits.inColorSpace(light, space)
    assert(there.colorSpace eq space)
    assert(there.data(3) == 0.75f && there.data(0) > 0.25f)
    val back = there.toRgb
    // Single precision, by two matrices
    for c <- 0 until 3 do assert(Math.abs(back.data(c) - light.data(c)) < 4e-6f)
    val gray = Image(1, 1, Vector("Y"), Array(1f))
    assert(error(ImageEdits.inColorSpace(gray, space)).contains("R, G and B"))

  test("means are taken in double precision; images that differ are refused"):
    val many = Iterator.fill(1000)("a" -> image(0.1f, 1e7f, -1f, 1f))
    assert(ImageEdits.mean(many).data.toVector == Vector(0.1f, 1e7f, -1f, 1f))
    val two = Iterator("a" -> image(1, 2, 3, 4), "b" -> image(3, 0, 3, 4))
    assert(ImageEdits.mean(two).data.toVector == Vector(2f, 1f, 3f, 4f))
    def refusal(other: Image) =
      error(ImageEdits.mean(Iterator("a" -> Image.rgb(2, 1), "b" -> other)))
    assert(refusal(Image.rgb(1, 2)) == "b and a differ in size")
    assert(refusal(Image(2, 1, names, new Array(8))) == "b and a differ in their channels")
    val space = ColorSpace.named("rec2020").get
    assert(refusal(ImageEdits.inColorSpace(
      Image.rgb(2, 1),
      space
    )) == "b and a differ in their colour space")

  test("resizing keeps the mean of light of any range, and makes nothing negative"):
    val light = Image(64, 32, Vector("Y", "z"), Array.fill(64 * 32 * 2)(0f))
    light.data(2 * (15 * 64 + 31)) = 5000f
    light.data(2 * (15 * 64 + 31) + 1) = 1f
    val small = Resample(light, 16, 8)
    assert((small.width, small.height, small.channelNames) == (16, 8, Vector("Y", "z")))
    assert(small.data.forall(_ >= 0f))
    def mean(image: Image, c: Int) =
      image.data.indices.by(2).map(i => image.data(i + c).toDouble).sum / image.width / image.height
    for c <- 0 until 2 do assert(Math.abs(mean(small, c) / mean(light, c) - 1) < 1e-5): Unit
    val large = Resample(Image(2, 1, Vector("Y"), Array(0f, 1f)), 4, 1)
    assert(large.data.zip(Array(0f, 0.25f, 0.75f, 1f)).forall((a, b) => Math.abs(a - b) < 1e-6f))

  test("formats of pixels hold CIE's X, Y and Z, or Y, beside all other channels"):
    // Mitsuba 3.9.1's
    def isNear(image: Image, expected: Float*) =
      for (a, b) <- image.data.toVector.zip(expected) do assert(Math.abs(a - b) < 2e-4f, image.data)
    val xyz = PixelFormat.Tristimulus(image(0.2f, 0.5f, 0.9f, 0.4f))
    assert(xyz.channelNames == Vector("X", "Y", "Z", "A"))
    isNear(xyz, 0.42366f, 0.46507f, 0.91867f, 0.4f)
    val luminance = PixelFormat.Luminance(image(0.2f, 0.5f, 0.9f, 0.4f))
    assert(luminance.channelNames == Vector("Y", "A"))
    isNear(luminance, 0.46507f, 0.4f)

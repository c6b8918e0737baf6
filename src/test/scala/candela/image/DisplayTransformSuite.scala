package candela.image

import candela.color.{ColorSpace, Gamut, Magma, Rgb, Srgb, ToneCurve}
import org.scalatest.funsuite.AnyFunSuite

class DisplayTransformSuite extends AnyFunSuite:

  private def gray(values: Float*): Image =
    Image(values.size, 1, Image.RgbNames, values.flatMap(Vector.fill(3)(_)).toArray)

  private def reds(image: Image): Vector[Float] =
    Vector.tabulate(image.width)(image(_, 0, 0))

  test("without a choice, the image is shown as it is"):
    val image = gray(0.5f, 7f)
    assert(DisplayTransform.Plain(image) eq image)
    assert(DisplayTransform.Plain.describe(image).isEmpty)

  test("deep colours are shown without negative components"):
    val image = Image(1, 1, Image.RgbNames, Array(-0.2f, 0.8f, 0.3f))
    val wanted = Gamut.desaturate(Rgb(-0.2f, 0.8f, 0.3f))
    for display <- Seq(DisplayTransform.Plain, DisplayTransform(exposure = Exposure.Stops(0f))) do
      assert(display(image).data.sameElements(Array(wanted.r, wanted.g, wanted.b)))
    val brighter = DisplayTransform(exposure = Exposure.Stops(1f))(image).data
    assert(brighter.sameElements(Array(0f, 2 * wanted.g, 2 * wanted.b)))

  test("colours of other spaces are shown in sRGB"):
    val space = ColorSpace.named("dci-p3").get
    val image = Image(1, 1, Image.RgbNames, Array(0.5f, 0.4f, 0.3f), colorSpace = space)
    val c = space.toSrgb * Rgb(0.5f, 0.4f, 0.3f)
    assert(DisplayTransform.Plain(image).data.sameElements(Array(c.r, c.g, c.b)))

  test("a stop doubles the light, before the tone curve"):
    val brighter = DisplayTransform(exposure = Exposure.Stops(1f))
    assert(reds(brighter(gray(0.25f, 3f))) == Vector(0.5f, 6f))
    val filmic = DisplayTransform(ToneCurve.Filmic, Exposure.Stops(-2f))
    val plain = DisplayTransform(ToneCurve.Filmic)
    assert(reds(filmic(gray(4f))) == reds(plain(gray(1f))))

  test("auto exposure makes the geometric mean grey; black, NaN and infinity don't count"):
    val auto = DisplayTransform(exposure = Exposure.Auto)
    val image = gray(1f, 4f, 0f, Float.NaN, Float.PositiveInfinity)
    val shown = reds(auto(image))
    assert(Math.abs(shown(0) - 0.09f) < 1e-6f)
    assert(Math.abs(shown(1) - 0.36f) < 1e-6f)
    assert(auto.describe(image).head == ("exposure" -> "-3.47 stops"))
    assert(reds(auto(gray(0f, 0f))) == Vector(0f, 0f))

  test("false colours span twelve stops about middle grey; no light is black"):
    val view = DisplayTransform(falseColor = true)
    val shown = view(gray(0.18f, 0.18f * 64, 0.18f / 64, 1e9f, 0f, Float.NaN))
    for (place, x) <- Vector(0.5, 1.0, 0.0, 1.0, 0.0, 0.0).zipWithIndex; c <- 0 until 3 do
      assert(Math.abs(shown(x, 0, c) - Magma(place, c)) < 1e-5f, s"pixel $x")

  test("dithering keeps the mean between two codes, and values that are codes"):
    val value = Srgb.decode(100.25f / 255)
    val image = Image(100, 100, Image.RgbNames, Array.fill(30000)(value))
    def codes(display: DisplayTransform) =
      StbReader.read(Png.write(image, Vector.empty, WriteOptions(display = display))) match
        case read: ByteImage => read.bytes.map(_ & 0xff)
        case other => fail(s"$other")
    assert(codes(DisplayTransform.Plain).toSet == Set(100))
    val dithered = codes(DisplayTransform(dithers = true))
    assert(dithered.toSet == Set(100, 101))
    // Three standard deviations of the mean of 30,000 choices.
    assert(Math.abs(dithered.map(_.toDouble).sum / dithered.length - 100.25) < 3 * 0.0025)

  test("16 bits store finer steps than 8"):
    val image = gray(Srgb.decode(0.5f), Srgb.decode(0.5f + 1 / 65535f), 1f, 0f)
    val file = Png.write(image, Vector.empty, WriteOptions(display = DisplayTransform(bits = 16)))
    val read = reds(StbReader.read(file).toImage).map(v => Math.round(v * 65535))
    assert(read == Vector(32768, 32769, 65535, 0))
    val luminance = Image(2, 1, Vector("Y"), Array(Srgb.decode(0.25f), 1f))
    val grays =
      Png.write(luminance, Vector.empty, WriteOptions(display = DisplayTransform(bits = 16)))
    assert(StbReader.read(grays).toImage.data.map(v => Math.round(v * 65535)).toVector ==
      Vector(16384, 65535))

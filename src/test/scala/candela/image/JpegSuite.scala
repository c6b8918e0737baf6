package candela.image

import candela.color.Srgb
import org.scalatest.funsuite.AnyFunSuite

class JpegSuite extends AnyFunSuite:

  private val slope =
    val data = Array.tabulate(64 * 48 * 3)(i => Srgb.decode((i / 3 % 64) / 63f))
    Image(64, 48, Image.RgbNames, data)

  test("a smooth picture comes back within two codes"):
    val back = StbReader.read(Jpeg.write(slope, Vector.empty)).toImage
    assert((back.width, back.height) == (64, 48))
    val errors = back.data.indices.map(i => Math.abs(back.data(i) - Srgb.encode(slope.data(i))))
    // Two codes, and half a one of rounding
    assert(errors.max < 2.5f / 255)

  test("metadata is stored as a comment"):
    val file = Jpeg.write(slope, Vector("software" -> "Candela 0.1", "scene" -> "küche.pbrt"))
    assert(String(file, "UTF-8").contains("software: Candela 0.1\nscene: küche.pbrt"))

  test("16 bits are for PNG alone; tone curves are for both"):
    val options =
      WriteOptions(display = DisplayTransform(bits = 16, exposure = Exposure.Stops(-1f)))
    val back = StbReader.read(Jpeg.write(slope, Vector.empty, options)).toImage
    // Two codes, as above
    assert(Math.abs(back(63, 20, 0) - Srgb.encode(0.5f)) < 2.5f / 255)

  test("both extensions select it"):
    Samples.inFolder: folder =>
      for name <- Vector("a.jpg", "b.JPEG") do
        ImageFiles.write(folder.resolve(name), slope)
        assert(ImageFiles.read(folder.resolve(name)).width == 64)

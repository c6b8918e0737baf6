package candela.film

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Colorimetry
import candela.image.Image

final class SpectralBandsSuite extends AnyFunSuite:
  private val bands = SpectralBands(4, 400f, 700f)

  test("channels are named by the wavelength in the middle of each band"):
    val names = Vector("S0.437,500nm", "S0.512,500nm", "S0.587,500nm", "S0.662,500nm")
    assert(bands.channels == names)

  test("white has the spectrum of D65, behind the colours as they are to be written"):
    val colors = Image.rgb(2, 1)
    java.util.Arrays.fill(colors.data, 0, 3, 2f)
    val written = Image.rgb(2, 1)
    written.data(0) = 9f
    val image = bands.appendTo(written, colors)
    assert(image.channelNames == Image.RgbNames ++ bands.channels && image.data(0) == 9f)
    for i <- 0 until 4 do
      val nm = (400 + 75 * i until 475 + 75 * i).map(l => Colorimetry.radianceOfD65(l + 0.5f))
      // Eight points stand for a band
      assert(Math.abs(image.data(3 + i) - 2 * nm.sum / nm.size) < 0.01f * nm.max)
    assert(image.data.drop(7).forall(_ == 0f))

  test("an even spectrum of 1 would have luminance 1"):
    val y = (360 until 830).map(l => Colorimetry.radianceOfD65(l + 0.5f))
    // D65 is nearly even where eyes see most
    assert(Math.abs(y.slice(150, 250).sum / 100 - 1) < 0.1)

package candela.color

import org.scalatest.funsuite.AnyFunSuite

class WavelengthsSuite extends AnyFunSuite:
  private val smooth = SmoothSpectra()

  /** Colour of light by a set of bases. */
  private def seen(bases: Vector[Wavelengths])(light: Wavelengths => Rgb): Rgb =
    bases.map(b => b.toSrgb(light(b))).reduce(_ + _) * (1f / bases.size)

  private def relative(c: Rgb, to: Rgb): Float = (c - to).map(Math.abs(_)).max / to.max

  test("daylight is white, whatever light wavelengths are chosen for"):
    for light <- Seq(Colorimetry.D65, Spectrum.blackbody(2400f)) do
      val bases = Wavelengths.covering(64, smooth, light(_).toDouble)
      // 192 wavelengths are the quadrature, chosen for another light than this in one case
      assert(relative(seen(bases)(_.ofLight(Rgb.White)), Rgb.White) < 6e-3f)

  test("light that is looked up has its colour, however dark, as images of skies are"):
    val bases = Wavelengths.covering(64, smooth)
    val sky = Rgb(.0072f, .0386f, .0748f)
    for color <- Seq(sky, sky * 10f, sky * 100f) do
      val found = seen(bases)(b => b.lookUpLight(color) * b.ofLight(Rgb.White))
      // The quadrature of 192 wavelengths, as above, and a table of spectra
      assert(relative(found, color) < 6e-3f, s"$found, not $color")

  test("emitters have their colours, and bands between the observer's samples, too"):
    val band = Spectrum(Array(551f, 552f, 558f, 559f), Array(0f, 1f, 1f, 0f), Spectrum.Outside.Zero)
    for emitter <- Seq(Spectrum.blackbody(2400f), NamedSpectra("stdillum-F11").get, band) do
      val color = Colorimetry.unitLuminance(emitter)
      val bases = Wavelengths.covering(64, smooth, nm => 0.1 + emitter(nm))
      val found = seen(bases)(_.ofLight(emitter(_), color))
      // Few of the 192 wavelengths lie in a band of 8 nm or the lines of a fluorescent lamp
      assert(relative(found, color) < 1e-2f, s"$found, not $color")

  test("wavelengths lie where the scene's light is"):
    def red(light: Spectrum) =
      val bases = Wavelengths.covering(64, smooth, light(_).toDouble)
      bases.flatMap(_.nm).count(_ > 600f) / (3.0 * bases.size)
    assert(red(Spectrum.blackbody(2400f)) > red(Colorimetry.D65) + 0.03)

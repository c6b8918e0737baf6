package candela.color

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** The bound, against the exact error of rooms whose light can be computed: closed cubes with
  * diffuse walls, by their form factors, wavelength by wavelength.
  */
class ColorErrorSuite extends AnyFunSuite:
  import ColorError.wavelengths

  private val basis = ColorBasis.Sharp
  private val depth = 12

  /** Between faces of a cube: opposite, adjacent. */
  private def formFactor(i: Int, j: Int): Double =
    if i == j then 0.0 else if i / 2 == j / 2 then 0.1998 else 0.20005

  /** What leaves each face, for these reflectances. */
  private def radiosity(
      walls: Vector[Double],
      direct: Vector[Double],
      emitter: Double
  ): Vector[Double] =
    var light = direct.map(_ * emitter)
    var sum = Vector.fill(6)(0.0)
    for _ <- 0 until depth do
      val sent = light.zip(walls).map(_ * _)
      sum = sum.zip(sent).map(_ + _)
      light = Vector.tabulate(6)(i => (0 until 6).map(j => formFactor(i, j) * sent(j)).sum)
    sum

  private def error(
      emitter: ColoredSpectrum,
      direct: Vector[Double],
      walls: Vector[ColoredSpectrum]
  ): Double =
    val bySpectrum = wavelengths.indices.map: w =>
      radiosity(walls.map(_.values(w)), direct, emitter.values(w))
    val byComponent =
      Vector[Rgb => Float](_.r, _.g, _.b).map: c =>
        radiosity(walls.map(x => c(x.components).toDouble), direct, c(emitter.components).toDouble)
    val errors =
      for face <- 0 until 6 yield
        val three = Rgb(
          byComponent(0)(face).toFloat,
          byComponent(1)(face).toFloat,
          byComponent(2)(face).toFloat
        )
        ColorError.difference(bySpectrum.map(_(face)).toArray, basis.toSrgb(three))
    errors.max

  private def colored(c: Rgb): ColoredSpectrum =
    val s = SmoothSpectra.spectrum(c)
    ColoredSpectrum(wavelengths.map(s(_).toDouble), basis.fromSrgb(c))

  private def measured(s: Float => Float): ColoredSpectrum =
    ColoredSpectrum(wavelengths.map(s(_).toDouble), basis.ofReflectance(s))

  private def light(s: Float => Float): ColoredSpectrum =
    val values = wavelengths.map(nm => (s(nm) / Colorimetry.D65(nm)).toDouble)
    val c = ColorError.srgb(values)
    ColoredSpectrum(values, basis.fromSrgb(Rgb(c(0).toFloat, c(1).toFloat, c(2).toFloat)))

  private val grey = ColoredSpectrum(wavelengths.map(_ => 0.7), Rgb.gray(0.7f))
  private val random = java.util.Random(11)
  private def unit(low: Float, high: Float): Float = low + (high - low) * random.nextFloat

  /** A colour between grey and deep. */
  private def color(): Rgb =
    val saturation = random.nextFloat
    val brightness = unit(0.2f, 0.9f)
    Rgb(random.nextFloat, random.nextFloat, random.nextFloat)
      .map(c => brightness * (1 - saturation + saturation * c))

  private def emitter(): ColoredSpectrum = random.nextInt(4) match
    case 0 => light(Spectrum.blackbody(unit(2000f, 9000f))(_))
    case 1 => light(Colorimetry.D65(_))
    case _ =>
      val s = SmoothSpectra.spectrum(color() * 0.5f)
      light(nm => s(nm) * Colorimetry.D65(nm))

  private def wall(): ColoredSpectrum =
    if random.nextInt(4) > 0 then colored(color())
    else
      val (middle, width, top) = (unit(420f, 680f), unit(15f, 80f), unit(0.3f, 0.9f))
      measured: nm =>
        val x = (nm - middle) / width
        0.03f + (top - 0.03f) * Math.exp(-x * x).toFloat

  test("the error of a room is within the bound, which is not much larger", Slow):
    val found =
      for _ <- 0 until 400 yield
        val bulb = emitter()
        val colors = Vector.fill(1 + random.nextInt(3))(wall())
        val walls =
          Vector.tabulate(6)(i => if i < 2 + colors.size && i >= 2 then colors(i - 2) else grey)
        // Of each face, the light of the emitter that reaches it; some are in the shade
        val direct = Vector.fill(6)(Math.max(0.0, unit(-0.5f, 1f))).updated(0, 0.5)
        val exact = error(bulb, direct, walls)
        val bound = ColorError.bound(Seq(bulb), walls, basis, depth)
        (exact, bound / Math.max(exact, 1e-6))
    val ratios = found.map(_._2)
    val median = ratios.sorted.apply(ratios.size / 2)
    info(
      f"bound over error: median $median%.2f, least ${ratios.min}%.3f, largest ${ratios.max}%.1f"
    )
    // Smaller errors are those of the numbers
    for (exact, ratio) <- found if exact > 1e-3 do assert(ratio >= 1, s"error $exact")
    assert(median <= 3)

  test("distances are exact up to a bound, and no less than it beyond"):
    val random = java.util.Random(1)
    def values = Array.fill(95)(random.nextDouble)
    for _ <- 0 until 100 do
      val (a, b, most) = (values, values, 60 * random.nextDouble)
      val exact = a.lazyZip(b).map((x, y) => Math.abs(x - y)).sum
      assert(Math.abs(ColoredSpectrum.distance(a, b) - exact) < 1e-12 * exact)
      val found = ColoredSpectrum.distance(a, b, most)
      assert(if exact < most then found == ColoredSpectrum.distance(a, b) else found >= most)

  test("without colours there is no error"):
    // Digits of sRGB's and the basis' matrices
    assert(ColorError.bound(Seq(light(Colorimetry.D65(_))), Seq(grey), basis, depth) < 1e-4)

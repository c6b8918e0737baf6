package candela.bsdf.composite

import candela.color.{ColorBasis, Colorimetry, Rgb, SmoothSpectra, Spectrum, Wavelengths}

import org.scalatest.funsuite.AnyFunSuite

class ThinFilmSuite extends AnyFunSuite:
  private val ofNumbers = FilmColors.of(ColorBasis.Srgb)
  private val cosines = Vector(1f, 0.7f, 0.3f)

  private def difference(a: Rgb, b: Rgb): Float = (a - b).map(Math.abs(_)).max

  /** The reflectance as KHR_materials_iridescence computes it, of a grey surface, in Double. */
  private def extension(eta: Double, nm: Double, f0: Double, cosTheta: Double): Vector[Double] =
    def schlick(r0: Double, c: Double) = r0 + (1 - r0) * Math.pow(1 - c, 5)
    def normal(n: Double, m: Double) = Math.pow((n - m) / (n + m), 2)
    val cosInside = Math.sqrt(1 - (1 - cosTheta * cosTheta) / (eta * eta))
    val r12 = schlick(normal(eta, 1), cosTheta)
    val base = (1 + Math.sqrt(f0)) / (1 - Math.sqrt(f0))
    val r23 = schlick(normal(base, eta), cosInside)
    val phi = Math.PI + (if base < eta then Math.PI else 0)
    val rs = (1 - r12) * (1 - r12) * r23 / (1 - r12 * r23)
    def sensitivity(m: Int) =
      val phase = 2 * Math.PI * m * 2 * eta * nm * cosInside * 1e-9
      def lobe(v: Double, p: Double, s: Double) =
        v * Math.sqrt(2 * Math.PI * s) * Math.cos(p * phase + m * phi) *
          Math.exp(-s * phase * phase) / 1.0685e-7
      val x = lobe(5.4856e-13, 1.6810e6, 4.3278e9) + lobe(9.7470e-14, 2.2399e6, 4.5282e9)
      val y = lobe(4.4201e-13, 1.7953e6, 9.3046e9)
      val z = lobe(5.2481e-13, 2.2084e6, 6.6121e9)
      Vector(
        3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
        -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
        0.0556434 * x - 0.2040259 * y + 1.0572252 * z
      )
    val (first, second) = (sensitivity(1), sensitivity(2))
    Vector.tabulate(3): c =>
      val cm = rs - (1 - r12)
      val r = Math.sqrt(r12 * r23)
      Math.max(0, Math.min(1, r12 + rs + 2 * cm * r * first(c) + 2 * cm * r * r * second(c)))

  test("reflectances are those of the extension"):
    for
      eta <- Vector(1.2f, 1.5f, 2f); nm <- Vector(150f, 400f, 900f); f0 <- Vector(0.05f, 0.6f)
      c <- cosines
    do
      val f = ofNumbers.reflectance(eta, nm, Rgb.gray(f0), c)
      val Vector(r, g, b) = extension(eta, nm, f0, c).map(_.toFloat): @unchecked
      // Phases of some radians, in Float
      assert(difference(f, Rgb(r, g, b)) < 1e-4f, s"$eta $nm $f0 $c")

  test("at wavelengths, films have the colours that they have as numbers"):
    val bases = Wavelengths.covering(100, SmoothSpectra())
    for eta <- Vector(1.3f, 1.8f); nm <- Vector(200f, 400f, 700f); c <- cosines do
      def at(thickness: Float) = ofNumbers.reflectance(eta, thickness, Rgb.gray(0.04f), c)
      // So thick a film has no colours
      val mean = at(1e5f)
      val samples = bases.flatMap: basis =>
        val f = FilmColors.of(basis).reflectance(eta, nm, Rgb.gray(0.04f), c)
        basis.nm.toVector.zip(Vector(f.r, f.g, f.b))
      val (wavelengths, values) = samples.sortBy(_._1).unzip
      val spectrum = Spectrum(wavelengths.toArray, values.toArray)
      val seen = Colorimetry.rgb((x: Float) => spectrum(x) - mean.g, Colorimetry.White.EqualEnergy)
      // The extension's matching functions are sums of Gaussians
      assert(difference(at(nm) - mean, seen) < 0.012f, s"$eta $nm $c: ${at(nm) - mean}, $seen")

  test("components of another basis are those of its colours"):
    val f0 = Rgb(0.9f, 0.6f, 0.2f)
    val basis = ColorBasis.Sharp
    val f = FilmColors.of(basis).reflectance(1.4f, 350f, basis.fromSrgb(f0), 0.8f)
    assert(difference(basis.toSrgb(f), ofNumbers.reflectance(1.4f, 350f, f0, 0.8f)) < 1e-5f)

  test("a film whose light can't leave the surface reflects all of it"):
    assert(ofNumbers.reflectance(1f, 400f, Rgb.gray(0.04f), 0f).r > 0.99f)

package candela.mitsuba

import candela.color.{Rgb, Spectrum}

/** Radiance of the sun's disk, seen through the atmosphere, in W/(m² sr nm).
  *
  * Source: Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999,
  * appendix 1; the coefficients of aerosols are Mitsuba 0.6's.
  */
private[mitsuba] object PreethamSun:

  /** @param zenithAngle of the sun, in radians, at most π / 2 */
  def radiance(zenithAngle: Double, turbidity: Double): Rgb =
    val mass = 1 /
      (Math.cos(zenithAngle) + 0.15 * Math.pow(93.885 - Math.toDegrees(zenithAngle), -1.253))
    val aerosols = 0.04608365822050 * turbidity - 0.04586025928522
    def transmittance(nm: Float): Double =
      val micrometres = nm / 1000.0
      val (mixed, water) = (MixedGases(nm) * mass, WaterVapour(nm) * VapourCentimetres * mass)
      val depth = mass * 0.008735 * Math.pow(micrometres, -4.08) +
        mass * aerosols * Math.pow(micrometres, -1.3) +
        mass * Ozone(nm) * OzoneCentimetres +
        1.41 * mixed / Math.pow(1 + 118.93 * mixed, 0.45) +
        0.2385 * water / Math.pow(1 + 20.07 * water, 0.45)
      Math.exp(-depth)
    val lambda = Array.range(350, 805, 5).map(_.toFloat)
    val values = lambda.map(nm => (BeyondAir(nm) * transmittance(nm)).toFloat)
    Role.Emission.color(Spectrum(lambda, values, Spectrum.Outside.Zero)).map(Math.max(_, 0f))

  private val OzoneCentimetres = 0.35f
  private val VapourCentimetres = 2f

  private def table(first: Int, step: Int)(values: Float*): Spectrum =
    val lambda = Array.tabulate(values.size)(i => (first + i * step).toFloat)
    Spectrum(lambda, values.toArray, Spectrum.Outside.Zero)

  /** The sun's radiance outside the atmosphere. */
  private val BeyondAir = table(380, 10)(
    16559.0f, 16233.7f, 21127.5f, 25888.2f, 25829.1f, 24232.3f, 26760.5f, 29658.3f, 30545.4f,
    30057.5f, 30663.7f, 28830.4f, 28712.1f, 27825.0f, 27100.6f, 27233.6f, 26361.3f, 25503.8f,
    25060.2f, 25311.6f, 25355.9f, 25134.2f, 24631.5f, 24173.2f, 23685.3f, 23212.1f, 22827.7f,
    22339.8f, 21970.2f, 21526.7f, 21097.9f, 20728.3f, 20240.4f, 19870.8f, 19427.2f, 19072.4f,
    18628.9f, 18259.2f
  )

  /** Absorption per centimetre. */
  private val Ozone: Spectrum =
    val ultraviolet = table(300, 5)(10f, 4.8f, 2.7f, 1.35f, .8f, .38f, .16f, .075f, .04f, .019f,
      .007f, 0f)
    val fine = table(445, 5)(
      .003f, .003f, .004f, .006f, .008f, .009f, .012f, .014f, .017f, .021f,
      .025f, .03f, .035f, .04f, .045f, .048f, .057f, .063f, .07f, .075f, .08f, .085f, .095f, .103f,
      .11f, .12f, .122f, .12f, .118f, .115f, .12f, .125f, .13f, .12f
    )
    val coarse = table(620, 10)(.105f, .09f, .079f, .067f, .057f, .048f, .036f, .028f, .023f, .018f,
      .014f, .011f, .01f, .009f, .007f, .004f, 0f, 0f)
    val segments = Seq(ultraviolet, fine, coarse)
    Spectrum(
      segments.flatMap(_.lambda).toArray,
      segments.flatMap(_.values).toArray,
      Spectrum.Outside.Zero
    )

  private val MixedGases =
    Spectrum(Array(759f, 760f, 770f, 771f), Array(0f, 3f, .21f, 0f), Spectrum.Outside.Zero)

  private val WaterVapour = Spectrum(
    689f +: Array.range(690, 810, 10).map(_.toFloat),
    Array(
      0f, .016f, .024f, .0125f, 1f, .87f, .061f, .001f, .00001f, .00001f, .0006f, .0175f, .036f
    ),
    Spectrum.Outside.Zero
  )

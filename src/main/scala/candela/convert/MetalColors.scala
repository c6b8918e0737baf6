package candela.convert

import candela.color.{ColorError, ColoredSpectrum, Rgb}
import candela.math.clamp
import candela.scenefile.{Declaration, Dialect, Param, ParamType, SceneDescription}

/** pbrt-v4 has the reflectance of metals by wavelength, other programs of red, green and blue: in
  * white light, its colour is kept by another absorption. Textured metals stay as they are.
  */
private[convert] object MetalColors:

  /** The scene in pbrt-v4's form, from a program that multiplies three numbers. */
  def inSpectra(scene: SceneDescription): SceneDescription =
    val values = Values(Dialect.V3, Dialect.V4, (_, _) => ())
    mapped(scene): (eta, k, d) =>
      for n <- values.color(eta, d); a <- values.color(k, d)
      yield
        val spectrum = smooth(n)
        val isGray = Values.isGray(n) && Values.isGray(a)
        def converted = absorption(ConductorAlbedo.ofIndex(n, a), a): k =>
          albedo(spectrum, smooth(k)).components
        (n, if isGray then a else converted)

  /** The scene of pbrt-v4, in its form, for a program that multiplies three numbers. */
  def inNumbers(scene: SceneDescription): SceneDescription =
    mapped(scene): (eta, k, d) =>
      for n <- V4.color(eta, d); a <- V4.color(k, d); s <- albedo(d)
      yield (n, absorption(s.components, a)(ConductorAlbedo.ofIndex(n, _)))

  /** What a metal of pbrt-v4 reflects of light from all sides, if it has a constant index, and what
    * one of three numbers can.
    */
  def albedo(d: Declaration): Option[ColoredSpectrum] =
    for
      (eta, k) <- index(d)
      n <- spectrum(eta, d)
      a <- spectrum(k, d)
      exact = albedo(n, a)
    yield ColoredSpectrum(exact.values, exact.components.map(Math.min(_, 1f)))

  private def albedo(eta: Array[Double], k: Array[Double]): ColoredSpectrum =
    val values = eta.lazyZip(k).map((n, a) => ConductorAlbedo.mean(n.toFloat, a.toFloat).toDouble)
    ColoredSpectrum(values, color(ColorError.srgb(values).map(_.toFloat)))

  private def mapped(scene: SceneDescription)(
      change: (Param, Param, Declaration) => Option[(Rgb, Rgb)]
  ): SceneDescription = Declarations.map(scene): d =>
    val changed =
      for
        (eta, k) <- index(d)
        (n, a) <- change(eta, k, d)
      yield
        val params = d.params.filterNot(p => p.name == eta.name || p.name == k.name)
        d.copy(params = params :+ Values.rgb(eta, n) :+ Values.rgb(k, a))
    changed.getOrElse(d)

  /** The absorption of this albedo, by Newton's method for each channel. */
  private def absorption(target: Rgb, start: Rgb)(albedo: Rgb => Rgb): Rgb =
    val wanted = channels(target)
    def of(k: Array[Float]) = channels(albedo(color(k)))
    def step(k: Array[Float]): Array[Float] =
      val albedos = of(k)
      Array.tabulate(3): c =>
        val slope = of(k.updated(c, k(c) * Ratio))(c) - albedos(c)
        val powers = if slope > 0f then (wanted(c) - albedos(c)) / slope else 0f
        k(c) * Math.pow(Ratio, clamp(powers, -MaxPower, MaxPower)).toFloat
    color(Iterator.iterate(channels(start))(step).drop(Iterations).next())

  private def channels(c: Rgb): Array[Float] = Array(c.r, c.g, c.b)
  private def color(c: Array[Float]): Rgb = Rgb(c(0), c(1), c(2))

  private def smooth(c: Rgb): Array[Double] = SpectralColors.spectrum(c, false).values

  private def spectrum(p: Param, d: Declaration): Option[Array[Double]] =
    if p.paramType == ParamType.Rgb then V4.color(p, d).map(smooth)
    else if p.paramType != ParamType.Spectrum then None
    else V4.spectrum(p, d).map(s => ColorError.wavelengths.map(s(_).toDouble))

  /** Index and absorption; copper's where the scene is silent. */
  private def index(d: Declaration): Option[(Param, Param)] =
    def param(prefix: String, name: String) = d.param(prefix + name).getOrElse:
      val copper = Vector(s"metal-Cu-$name")
      Param(ParamType.Spectrum, prefix + name, d.pos, d.pos, strings = copper)
    Prefixes.get(d.name)
      .filter(_ => d.category == "Material" && d.param("reflectance").isEmpty)
      .map(prefix => (param(prefix, "eta"), param(prefix, "k")))

  private val Prefixes = Map("conductor" -> "", "coatedconductor" -> "conductor.")
  private val V4 = Values(Dialect.V4, Dialect.V4, (_, _) => ())
  private val Iterations = 6

  /** Of absorptions, to measure the slope, and steps of this ratio at most. */
  private val Ratio = 1.02f
  private val MaxPower = 15f

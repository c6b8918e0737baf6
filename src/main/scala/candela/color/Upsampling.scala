package candela.color

import candela.math.clamp

/** The smooth spectrum, between 0 and 1, that looks like a given reflectance under D65: the
  * logistic function of a parabola over wavelength, as pbrt-v4 gives every RGB colour.
  *
  * Source: Jakob and Hanika, "A Low-Dimensional Function Space for Efficient Spectral Upsampling",
  * Eurographics 2019. Fitted here by Newton's method along the way from grey to the colour.
  */
object Upsampling:

  /** @param reflectance linear sRGB; held to [0.001, 0.999], where the fit stays smooth */
  def spectrum(reflectance: Rgb): Float => Float =
    val target = reflectance.map(clamp(_, 1e-3f, 0.999f))
    val grey = (target.r == target.g) && (target.g == target.b)
    if grey then _ => target.r
    else
      val c = fit(Array(target.r.toDouble, target.g.toDouble, target.b.toDouble))
      nm => logistic(c, nm)

  /** A spectrum of any size (an index of refraction, say): scaled down to fit, then up again. */
  def unbounded(value: Rgb): Float => Float =
    val scale = 2f * value.max
    if scale <= 0f then _ => 0f
    else
      val unit = spectrum(value * (1f / scale))
      nm => scale * unit(nm)

  private def logistic(c: Array[Double], nm: Float): Float =
    val x = (nm - 360.0) / 470.0
    val t = (c(0) * x + c(1)) * x + c(2)
    (0.5 + t / (2 * Math.sqrt(1 + t * t))).toFloat

  private def color(c: Array[Double]): Array[Double] =
    val rgb = Colorimetry.rgb(logistic(c, _), Colorimetry.White.D65)
    Array(rgb.r.toDouble, rgb.g.toDouble, rgb.b.toDouble)

  private val Steps = 20
  private val Iterations = 12

  private def fit(target: Array[Double]): Array[Double] =
    val c = Array(0.0, 0.0, 0.0)
    for step <- 1 to Steps do
      val share = step.toDouble / Steps
      val aim = target.map(v => 0.5 + (v - 0.5) * share)
      var left = Iterations
      while left > 0 do
        val off = color(c).zip(aim).map(_ - _)
        if off.forall(e => Math.abs(e) < 2e-6) then left = 0
        else
          left -= 1
          newton(c, off)
    c

  /** One step; its size is held to 50 units, beyond which the parabola is no guide. */
  private def newton(c: Array[Double], off: Array[Double]): Unit =
    val h = 1e-3
    val columns = Array.tabulate(3): k =>
      val up = c.clone()
      val down = c.clone()
      up(k) += h
      down(k) -= h
      color(up).zip(color(down)).map((a, b) => (a - b) / (2 * h))
    def det(a: Array[Double], b: Array[Double], d: Array[Double]): Double =
      a(0) * (b(1) * d(2) - b(2) * d(1)) - b(0) * (a(1) * d(2) - a(2) * d(1)) +
        d(0) * (a(1) * b(2) - a(2) * b(1))
    val all = det(columns(0), columns(1), columns(2))
    if Math.abs(all) > 1e-18 then
      val step = Array(
        det(off, columns(1), columns(2)) / all,
        det(columns(0), off, columns(2)) / all,
        det(columns(0), columns(1), off) / all
      )
      val largest = step.map(Math.abs).max
      val scale = if largest > 50 then 50 / largest else 1.0
      for k <- 0 until 3 do c(k) = Math.max(-500, Math.min(500, c(k) - step(k) * scale))

package candela.color

import candela.math.clamp

/** Spectral upsampling: a smooth spectrum between 0 and 1 with the colour of a given reflectance
  * under D65, namely a logistic function of a parabola over wavelength, as pbrt-v4 assigns to every
  * RGB colour.
  *
  * Source: Jakob and Hanika, "A Low-Dimensional Function Space for Efficient Spectral Upsampling",
  * Eurographics 2019. Fitted here by Newton's method, stepping from grey to the colour.
  */
object Upsampling:

  /** @param reflectance linear sRGB; clamped to [0.001, 0.999], where the fit is smooth */
  def spectrum(reflectance: Rgb): Float => Float =
    val target = reflectance.map(clamp(_, 1e-3f, 0.999f))
    val grey = (target.r == target.g) && (target.g == target.b)
    if grey then _ => target.r
    else
      val walk = Walk()
      walk.go(Array(target.r.toDouble, target.g.toDouble, target.b.toDouble))
      walk(_)

  /** Spectrum of an unbounded quantity (such as an index of refraction): scaled down to fit, then
    * up again.
    */
  def unbounded(value: Rgb): Float => Float =
    val scale = 2f * value.max
    if scale <= 0f then _ => 0f
    else
      val unit = spectrum(value * (1f / scale))
      nm => scale * unit(nm)

  /** Moves from colour to colour, starting at grey, and holds the spectrum of the current one.
    * Mutable.
    */
  private[color] final class Walk:
    private val c = Array(0.0, 0.0, 0.0)
    private var here = Array(0.5, 0.5, 0.5)

    def apply(nm: Float): Float = logistic(c, nm)

    /** Moves to a reflectance with components in [0.001, 0.999]. */
    def go(target: Array[Double]): Unit =
      val way = target.lazyZip(here).map((a, b) => Math.abs(a - b)).max
      val steps = Math.ceil(way * Steps / 0.5).toInt
      for step <- 1 to steps do
        val share = step.toDouble / steps
        near(target.lazyZip(here).map((to, from) => from + (to - from) * share))
      here = target

    /** Newton's method, which converges for nearby colours. */
    private def near(aim: Array[Double]): Unit =
      var left = Iterations
      while left > 0 do
        val off = color(c).lazyZip(aim).map(_ - _)
        if off.forall(e => Math.abs(e) < 2e-6) then left = 0
        else
          left -= 1
          newton(c, off)

  private def logistic(c: Array[Double], nm: Float): Float =
    val x = (nm - 360.0) / 470.0
    val t = (c(0) * x + c(1)) * x + c(2)
    (0.5 + t / (2 * Math.sqrt(1 + t * t))).toFloat

  /** Contribution of each wavelength to X, Y and Z under D65, over the Y of white. */
  private lazy val seen: Array[Array[Double]] =
    Colorimetry.responses.map: (nm, _) =>
      val share = 5 * Colorimetry.D65(nm) / Colorimetry.luminanceOfD65
      Array(nm.toDouble) ++ Colorimetry.observers.map(_(nm) * share)

  private def color(c: Array[Double]): Array[Double] =
    var x, y, z = 0.0
    for row <- seen do
      val s = logistic(c, row(0).toFloat)
      x += s * row(1)
      y += s * row(2)
      z += s * row(3)
    (Colorimetry.rgbOfXyz * Vector(x, y, z)).toArray

  /** Number of steps from grey to black or white. */
  private val Steps = 20
  private val Iterations = 12

  /** One step, of at most 50 units, beyond which the linearisation is useless. */
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

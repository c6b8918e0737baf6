package candela.color

import java.util.concurrent.ConcurrentHashMap

import candela.base.loop
import candela.math.clamp

/** Spectral upsampling: a smooth spectrum between 0 and 1 with the colour of a given reflectance
  * under its space's illuminant, namely a logistic function of a parabola over wavelength, as
  * pbrt-v4 assigns to every RGB colour.
  *
  * Source: Jakob and Hanika, "A Low-Dimensional Function Space for Efficient Spectral Upsampling",
  * Eurographics 2019. Fitted here by Newton's method, stepping from grey to the colour.
  */
object Upsampling:

  /** @param reflectance clamped to [0.001, 0.999], where the fit is smooth */
  def spectrum(reflectance: Rgb, space: ColorSpace = ColorSpace.Srgb): Float => Float =
    val target = reflectance.map(clamp(_, 1e-3f, 0.999f))
    val grey = (target.r == target.g) && (target.g == target.b)
    if grey then _ => target.r
    else
      val c = coefficients(target, space)
      nm => logistic(c, nm)

  /** Fits so far: a scene names a colour for each of many materials, and a fit takes a millisecond.
    */
  private val fits = ConcurrentHashMap[(Rgb, ColorSpace), Array[Double]]()

  private def coefficients(target: Rgb, space: ColorSpace): Array[Double] =
    if fits.size > MostFits then fits.clear()
    fits.computeIfAbsent(
      (target, space),
      _ =>
        val walk = Walk(space)
        walk.go(Array(target.r.toDouble, target.g.toDouble, target.b.toDouble))
        walk.coefficients
    )

  /** Spectrum of an unbounded quantity (such as an index of refraction): scaled down to fit, then
    * up again.
    */
  def unbounded(value: Rgb, space: ColorSpace = ColorSpace.Srgb): Float => Float =
    val scale = 2f * value.max
    if scale <= 0f then _ => 0f
    else
      val unit = spectrum(value * (1f / scale), space)
      nm => scale * unit(nm)

  /** Moves from colour to colour, starting at grey, and holds the spectrum of the current one.
    * Mutable.
    */
  private[color] final class Walk(space: ColorSpace = ColorSpace.Srgb):
    private val c = Array(0.0, 0.0, 0.0)
    def coefficients: Array[Double] = c.clone()
    private var here = Array(0.5, 0.5, 0.5)

    def apply(nm: Float): Float = logistic(c, nm)

    /** Moves to a reflectance with components in [0.001, 0.999]; towards one that no such spectrum
      * has, as far as the straight way there goes.
      */
    def go(target: Array[Double]): Unit =
      val from = here
      def at(share: Double) = target.lazyZip(from).map((to, from) => from + (to - from) * share)
      val way = target.lazyZip(from).map((a, b) => Math.abs(a - b)).max
      val steps = Math.ceil(way * Steps / 0.5).toInt
      var step = 0
      while step < steps && near(at((step + 1).toDouble / steps)) do step += 1
      if step == steps then here = target
      else
        var (low, high) = (step.toDouble / steps, (step + 1).toDouble / steps)
        for _ <- 1 to Halvings do
          val middle = (low + high) / 2
          if near(at(middle)) then low = middle else high = middle
        here = at(low)

    /** Newton's method, which converges for nearby colours; if not, nothing changes. */
    private def near(aim: Array[Double]): Boolean =
      val before = c.clone()
      var left = Iterations
      var isThere = false
      while left >= 0 && !isThere do
        val off = color(c, space).lazyZip(aim).map(_ - _)
        isThere = off.forall(e => Math.abs(e) < 2e-6)
        if !isThere && left > 0 then newton(c, off, space)
        left -= 1
      if !isThere then System.arraycopy(before, 0, c, 0, 3)
      isThere

  private def logistic(c: Array[Double], nm: Float): Float =
    val x = (nm - 360.0) / 470.0
    val t = (c(0) * x + c(1)) * x + c(2)
    (0.5 + t / (2 * Math.sqrt(1 + t * t))).toFloat

  private def color(c: Array[Double], space: ColorSpace): Array[Double] =
    var x, y, z = 0.0
    val rows = space.seen
    loop(rows.length): i =>
      val row = rows(i)
      val s = logistic(c, row(0).toFloat)
      x += s * row(1)
      y += s * row(2)
      z += s * row(3)
    (space.rgbOfXyz * Vector(x, y, z)).toArray

  /** Number of steps from grey to black or white. */
  private val Steps = 20
  private val Iterations = 12
  private val MostFits = 10000

  /** Halvings of the last step of a walk. */
  private val Halvings = 6

  /** One step, of at most 50 units, beyond which the linearisation is useless. */
  private def newton(c: Array[Double], off: Array[Double], space: ColorSpace): Unit =
    val h = 1e-3
    val columns = Array.tabulate(3): k =>
      val up = c.clone()
      val down = c.clone()
      up(k) += h
      down(k) -= h
      color(up, space).zip(color(down, space)).map((a, b) => (a - b) / (2 * h))
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

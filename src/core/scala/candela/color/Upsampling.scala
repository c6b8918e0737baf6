package candela.color

import java.util.concurrent.ConcurrentHashMap

import candela.math.clamp

/** Spectral upsampling: a smooth spectrum between 0 and 1 with the colour of a given reflectance
  * under its space's illuminant, namely a logistic function of a parabola over wavelength, as
  * pbrt-v4 assigns to every RGB colour.
  *
  * Source: Jakob and Hanika, "A Low-Dimensional Function Space for Efficient Spectral Upsampling",
  * Eurographics 2019. Fitted here by Newton's method, from a table of near colours ([[FitStarts]])
  * or, where none is near enough, stepping from grey to the colour.
  */
object Upsampling:

  /** @param reflectance clamped to [0.001, 0.999], where the fit is smooth; if no such spectrum has
    *                    it, or one that pbrt-v4's table can't hold, to [0, 1]; see [[GamutEdge]]
    */
  def spectrum(reflectance: Rgb, space: ColorSpace = ColorSpace.Srgb): Float => Float =
    val target = reflectance.map(inRange)
    if isGrey(target) then _ => target.r
    else
      val c = fit(reflectance, space).coefficients
      nm => logistic(c, nm)

  /** Whether the spectrum has this colour, in a space other than sRGB. */
  private[color] def isExact(reflectance: Rgb, space: ColorSpace): Boolean =
    isGrey(reflectance.map(inRange)) || fit(reflectance, space).isExact

  private def isGrey(c: Rgb): Boolean = (c.r == c.g) && (c.g == c.b)

  private def inRange(c: Float): Float = clamp(c, 1e-3f, 0.999f)

  /** Bounds of the components of a reflectance that is fitted. */
  private[color] val MinComponent = 1e-3
  private[color] val MaxComponent = 0.999

  private[color] final class Fit(val coefficients: Array[Double], val isExact: Boolean)

  /** Fits so far: a scene names a colour for each of many materials. */
  private val fits = ConcurrentHashMap[(Rgb, ColorSpace), Fit]()

  private def fit(color: Rgb, space: ColorSpace): Fit =
    if fits.size > MaxFits then fits.clear()
    fits.computeIfAbsent(
      (color.map(clamp(_, 0f, 1f)), space),
      (c, _) => fromTable(c, space).getOrElse(fromGrey(c, space))
    )

  private def doubles(c: Rgb) = Array(c.r.toDouble, c.g.toDouble, c.b.toDouble)

  /** From the table, where that leads to the colour, and no bound of another space's fit. */
  private[color] def fromTable(c: Rgb, space: ColorSpace): Option[Fit] =
    val fit = SpectrumFit(space.responses)
    val target = doubles(c.map(inRange))
    val isThere =
      (space.isSrgb || c == c.map(inRange)) && FitStarts.initialize(space, target, fit.c) &&
        fit.reach(target)
    Option.when(isThere && (space.isSrgb || fit.c.max < GamutEdge.Largest - 1e-6)):
      Fit(fit.c, isExact = true)

  /** From grey. */
  private[color] def fromGrey(c: Rgb, space: ColorSpace): Fit =
    val walk = Walk(space)
    val target = doubles(c.map(inRange))
    walk.moveTo(target)
    val settled = walk.coefficients
    if !space.isSrgb then GamutEdge.settle(settled, doubles(c), space)
    val isExact = walk.isAt(target) && settled.max < GamutEdge.Largest - 1e-6
    Fit(if isExact || space.isSrgb then walk.coefficients else settled, isExact)

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
    private val fit = SpectrumFit(space.responses)
    private val c = fit.c
    def coefficients: Array[Double] = c.clone()
    private var current = Array(0.5, 0.5, 0.5)

    def apply(nm: Float): Float = logistic(c, nm)

    /** Whether the last walk ended at its goal. */
    def isAt(target: Array[Double]): Boolean = current eq target

    /** Moves to a reflectance with components in [0.001, 0.999]; towards one that no such spectrum
      * has, as far as the straight way there goes.
      */
    def moveTo(target: Array[Double]): Unit =
      val start = current
      def interpolated(share: Double) =
        target.lazyZip(start).map((to, from) => from + (to - from) * share)
      val distance = target.lazyZip(start).map((a, b) => Math.abs(a - b)).max
      val steps = Math.ceil(distance * Steps / 0.5).toInt
      var step = 0
      while step < steps && advance(interpolated((step + 1).toDouble / steps)) do step += 1
      if step == steps then current = target
      else
        var (low, high) = (step.toDouble / steps, (step + 1).toDouble / steps)
        for _ <- 1 to Halvings do
          val middle = (low + high) / 2
          if advance(interpolated(middle)) then low = middle else high = middle
        current = interpolated(low)

    /** Newton's method, which converges for nearby colours; if not, nothing changes. */
    private def advance(aim: Array[Double]): Boolean =
      val saved = c.clone()
      val isThere = fit.reach(aim)
      if !isThere then System.arraycopy(saved, 0, c, 0, 3)
      isThere

  /** From 0 to 1 over the wavelengths of a spectrum. */
  private[color] def position(nm: Float): Double = (nm - 360.0) / 470.0

  private def logistic(c: Array[Double], nm: Float): Float =
    val x = position(nm)
    val t = (c(0) * x + c(1)) * x + c(2)
    (0.5 + t / (2 * Math.sqrt(1 + t * t))).toFloat

  /** Number of steps from grey to black or white. */
  private val Steps = 20
  private val MaxFits = 10000

  /** Halvings of the last step of a walk. */
  private val Halvings = 6

  /** The three factors of the columns whose sum is `residual`, if there are such. */
  private[color] def solve(
      columns: Array[Array[Double]],
      residual: Array[Double]
  ): Option[Array[Double]] =
    def det(a: Array[Double], b: Array[Double], d: Array[Double]): Double =
      a(0) * (b(1) * d(2) - b(2) * d(1)) - b(0) * (a(1) * d(2) - a(2) * d(1)) +
        d(0) * (a(1) * b(2) - a(2) * b(1))
    val determinant = det(columns(0), columns(1), columns(2))
    Option.when(Math.abs(determinant) > 1e-18):
      Array(
        det(residual, columns(1), columns(2)) / determinant,
        det(columns(0), residual, columns(2)) / determinant,
        det(columns(0), columns(1), residual) / determinant
      )

package candela.color

import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.AtomicReferenceArray

import candela.math.*

/** Smooth spectra of colours in linear sRGB; see [[Upsampling]] for the spectra and their source.
  * Safe for threads.
  */
final class SmoothSpectra:
  private val fitted = ConcurrentHashMap[Rgb, Float => Float]()

  /** The spectrum of one colour, fitted exactly: for the colours of a scene file. */
  def exact(color: Rgb): Float => Float =
    val cached = fitted.get(color)
    if cached != null then cached
    else
      // Threads that meet here fit the same
      val fresh = SmoothSpectra.spectrum(color)
      fitted.put(color, fresh): Unit
      fresh

  /** For colours that are known while rendering only. */
  val table: SpectrumTable = SpectrumTable()

object SmoothSpectra:
  /** Bounds of the largest component of a colour that is fitted. */
  private[color] inline val MinComponent = 1e-4f
  private[color] inline val MaxComponent = 0.9999f

  /** Steps from grey to a colour, where the table is too coarse to start from. */
  private val Steps = 6

  /** The spectrum of one colour with components in [0, 1], fitted exactly. */
  def spectrum(color: Rgb): Float => Float =
    val fit = SpectrumFit()
    val target =
      Array(color.r, color.g, color.b).map(c => clamp(c, MinComponent, MaxComponent).toDouble)
    if !(FitStarts.initialize(ColorSpace.Srgb, target, fit.c) && fit.reach(target)) then
      fit.restart()
      for step <- 1 to Steps do
        fit.to(target.map(c => 0.5 + (c - 0.5) * step / Steps))
    val (c0, c1, c2) = (fit.c(0).toFloat, fit.c(1).toFloat, fit.c(2).toFloat)
    nm => logistic(c0, c1, c2, nm)

  private[color] def logistic(c0: Float, c1: Float, c2: Float, nm: Float): Float =
    val x = (nm - 360f) * (1f / 470f)
    val t = (c0 * x + c1) * x + c2
    0.5f + 0.5f * t / sqrt(1f + t * t)

/** Coefficients of smooth spectra on a grid of colours, fitted where they are looked up. Safe for
  * threads.
  *
  * As in Jakob and Hanika's tables, the grid has three parts by the largest component; its value
  * is the third coordinate, in steps that are finer near black and white, and the other two
  * components are relative to it.
  */
final class SpectrumTable:
  import SmoothSpectra.*
  import SpectrumTable.*

  /** The coefficients of all levels, for a part and two relative components; null: not yet fitted.
    */
  private val columns = AtomicReferenceArray[Array[Float]](3 * Size * Size)

  private def column(largest: Int, j: Int, i: Int): Array[Float] =
    val index = (largest * Size + j) * Size + i
    val cached = columns.getAcquire(index)
    if cached != null then cached
    else
      // Threads that meet here fit the same
      val fresh = fit(largest, j, i)
      columns.setRelease(index, fresh)
      fresh

  /** The spectrum of a colour with components in [0, 1], at three wavelengths in nm. */
  def at(r: Float, g: Float, b: Float, nm0: Float, nm1: Float, nm2: Float): Rgb =
    val largest = if r >= g && r >= b then 0 else if g >= b then 1 else 2
    val z =
      clamp(if largest == 0 then r else if largest == 1 then g else b, MinComponent, MaxComponent)
    val x = step(if largest == 0 then g else if largest == 1 then b else r, z)
    val y = step(if largest == 0 then b else if largest == 1 then r else g, z)
    val i = Math.min(x.toInt, Size - 2)
    val j = Math.min(y.toInt, Size - 2)
    var k = Starts((z * Starts.length).toInt).toInt
    while k < Size - 2 && Levels(k + 1) <= z do k += 1
    val tx = x - i
    val ty = y - j
    val tz = (z - Levels(k)) / (Levels(k + 1) - Levels(k))
    val c00 = column(largest, j, i)
    val c10 = column(largest, j, i + 1)
    val c01 = column(largest, j + 1, i)
    val c11 = column(largest, j + 1, i + 1)
    inline def level(n: Int): Float =
      lerp(ty, lerp(tx, c00(n), c10(n)), lerp(tx, c01(n), c11(n)))
    inline def mix(n: Int): Float = lerp(tz, level(n), level(n + 3))
    val n = 3 * k
    val c0 = mix(n)
    val c1 = mix(n + 1)
    val c2 = mix(n + 2)
    Rgb(logistic(c0, c1, c2, nm0), logistic(c0, c1, c2, nm1), logistic(c0, c1, c2, nm2))

  private def step(c: Float, largest: Float): Float =
    clamp(c, 0f, largest) / largest * (Size - 1)

object SpectrumTable:
  import SmoothSpectra.{MinComponent, MaxComponent}
  private inline val Size = 40

  /** Values of the largest component. */
  private val Levels: Array[Float] = Array.tabulate(Size): k =>
    def smoothStep(t: Double) = t * t * (3 - 2 * t)
    val t = smoothStep(k.toDouble / (Size - 1))
    (MinComponent + (MaxComponent - MinComponent) * t).toFloat

  /** Index of a level at or below `z`, by the integer part of `z * Starts.length`. */
  private val Starts: Array[Byte] = Array.tabulate(256): cell =>
    Math.max(Levels.lastIndexWhere(_ <= cell / 256f), 0).toByte

  /** The other components relative to the largest. */
  private def share(i: Int): Double = i.toDouble / (Size - 1)

  /** Fits a column, from the middle level outwards, each colour from the last. */
  private def fit(largest: Int, j: Int, i: Int): Array[Float] =
    val column = new Array[Float](3 * Size)
    val fit = SpectrumFit()
    def fitLevels(levels: Range): Unit =
      fit.restart()
      for k <- levels do
        val z = Levels(k).toDouble
        val c = Array(z, z, z)
        c((largest + 1) % 3) = z * share(i)
        c((largest + 2) % 3) = z * share(j)
        fit.to(c)
        for n <- 0 until 3 do column(3 * k + n) = fit.c(n).toFloat
    fitLevels(Size / 2 until Size)
    fitLevels(Size / 2 - 1 to 0 by -1)
    column

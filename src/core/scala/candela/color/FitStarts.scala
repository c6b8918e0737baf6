package candela.color

import candela.base.loop
import java.nio.ByteBuffer

import scala.util.Using

/** Coefficients of smooth spectra on a coarse grid of each space's colours, from which fits start:
  * a few of Newton's steps away, where a walk from grey takes dozens.
  *
  * The grid has three parts by the largest component. Its value is the third coordinate, in steps
  * that are finer near black and white; the other two components are relative to it. Coefficients
  * are rounded to 1/65 of a unit. A resource has them: `FitStartsFile` makes it.
  *
  * Source: Jakob and Hanika; see [[Upsampling]].
  */
private[color] object FitStarts:
  /** Colours along an edge of the grid. */
  private inline val Size = 12

  private val Scale = Short.MaxValue / SpectrumFit.MaxCoefficient

  /** Numbers in the table of a colour space. */
  private inline val NumbersPerSpace = 3 * Size * Size * Size * 3

  /** The name of the resource. */
  val Resource = "/candela/spectra/starts.bin"

  private lazy val table: Array[Short] =
    Using.resource(getClass.getResourceAsStream(Resource)): stream =>
      val bytes = ByteBuffer.wrap(stream.readAllBytes())
      val read = new Array[Short](bytes.remaining / 2)
      bytes.asShortBuffer.get(read)
      read

  /** Sets `c` to coefficients near those of a reflectance with components in [0, 1]; false if the
    * space has no table.
    */
  def initialize(space: ColorSpace, target: Array[Double], c: Array[Double]): Boolean =
    val index = ColorSpace.all.indexOf(space)
    if index >= 0 then interpolate(table, index * NumbersPerSpace, target, c)
    index >= 0

  private def interpolate(
      values: Array[Short],
      first: Int,
      target: Array[Double],
      c: Array[Double]
  ): Unit =
    val largest =
      if target(0) >= target(1) && target(0) >= target(2) then 0
      else if target(1) >= target(2) then 1
      else 2
    val z = Math.max(Level(0), Math.min(Level(Size - 1), target(largest)))
    val x = share(target((largest + 1) % 3), z)
    val y = share(target((largest + 2) % 3), z)
    val i = Math.min(x.toInt, Size - 2)
    val j = Math.min(y.toInt, Size - 2)
    var k = 0
    while k < Size - 2 && Level(k + 1) <= z do k += 1
    val tz = (z - Level(k)) / (Level(k + 1) - Level(k))
    java.util.Arrays.fill(c, 0.0)
    loop(8): corner =>
      val (di, dj, dk) = (corner & 1, corner >> 1 & 1, corner >> 2)
      val weight =
        (1 - di + (2 * di - 1) * (x - i)) * (1 - dj + (2 * dj - 1) * (y - j)) *
          (1 - dk + (2 * dk - 1) * tz)
      val start = first + offset(largest, j + dj, i + di, k + dk)
      c(0) += weight * values(start) / Scale
      c(1) += weight * values(start + 1) / Scale
      c(2) += weight * values(start + 2) / Scale

  private def share(c: Double, largest: Double): Double =
    Math.max(0.0, Math.min(1.0, c / largest)) * (Size - 1)

  private def offset(largest: Int, j: Int, i: Int, k: Int): Int =
    3 * (((largest * Size + j) * Size + i) * Size + k)

  /** Values of the largest component. */
  private val Level: Array[Double] = Array.tabulate(Size): k =>
    import Upsampling.{MaxComponent, MinComponent}
    val t = k.toDouble / (Size - 1)
    MinComponent + (MaxComponent - MinComponent) * t * t * (3 - 2 * t)

  /** The resource's bytes, by the fit alone. */
  def resourceBytes: Array[Byte] =
    val bytes = ByteBuffer.allocate(2 * NumbersPerSpace * ColorSpace.all.size)
    val _ = bytes.asShortBuffer.put(ColorSpace.all.flatMap(fitted(_)).toArray)
    bytes.array

  /** Colours that no spectrum of the space has are those where the way from grey ends. */
  private def fitted(space: ColorSpace): Array[Short] =
    val values = new Array[Short](NumbersPerSpace)
    for largest <- 0 until 3; j <- 0 until Size; i <- 0 until Size do
      val middle = Size / 2
      def fitLevels(levels: Range): Unit =
        val walk = Upsampling.Walk(space)
        for k <- levels do
          val target = Array.fill(3)(Level(k))
          target((largest + 1) % 3) *= i.toDouble / (Size - 1)
          target((largest + 2) % 3) *= j.toDouble / (Size - 1)
          walk.moveTo(target.map(c => Math.max(c, Upsampling.MinComponent)))
          val coefficients = walk.coefficients
          loop(3)(n =>
            values(offset(largest, j, i, k) + n) = Math.round(coefficients(n) * Scale).toShort
          )
      fitLevels(middle until Size)
      fitLevels(middle - 1 to 0 by -1)
    values

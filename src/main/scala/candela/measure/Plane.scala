package candela.measure

import candela.base.loop

/** One number for each pixel, row by row, for the filters of [[Flip]]. */
private[measure] final class Plane(val width: Int, val height: Int, val data: Array[Float]):

  /** Convolved with the product of two kernels of odd length, along x and along y. Beyond its
    * border a picture goes on with the pixel at the border.
    */
  def convolved(alongX: Array[Double], alongY: Array[Double]): Plane =
    val rows = new Array[Float](data.length)
    val radiusX = alongX.length / 2
    loop(height): y =>
      loop(width): x =>
        var sum = 0.0
        loop(alongX.length): k =>
          sum += alongX(k) * data(y * width + inside(x + k - radiusX, width))
        rows(y * width + x) = sum.toFloat
    val result = new Array[Float](data.length)
    val radiusY = alongY.length / 2
    loop(height): y =>
      loop(width): x =>
        var sum = 0.0
        loop(alongY.length): k =>
          sum += alongY(k) * rows(inside(y + k - radiusY, height) * width + x)
        result(y * width + x) = sum.toFloat
    Plane(width, height, result)

  def +(other: Plane): Plane =
    Plane(width, height, Array.tabulate(data.length)(i => data(i) + other.data(i)))

  private def inside(i: Int, size: Int): Int =
    if i < 0 then 0 else if i >= size then size - 1 else i

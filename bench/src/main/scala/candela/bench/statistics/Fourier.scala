package candela.bench.statistics

/** Discrete Fourier transform of any length, by its prime factors (Cooley, Tukey, "An algorithm for
  * the machine calculation of complex Fourier series", Mathematics of Computation 19, 1965): fast
  * for lengths of small factors.
  *
  * @param length of what is transformed
  */
final class Fourier(length: Int):
  require(length > 0, s"length $length")
  private val cosines, sines = new Array[Double](length)
  for i <- 0 until length do
    cosines(i) = Math.cos(2 * Math.PI * i / length)
    sines(i) = -Math.sin(2 * Math.PI * i / length)
  private val readRe, readIm, partRe, partIm = new Array[Double](length)

  /** Transforms complex numbers in place: those from `start` on, `stride` apart. */
  def transform(re: Array[Double], im: Array[Double], start: Int, stride: Int): Unit =
    var i = 0
    while i < length do
      readRe(i) = re(start + i * stride)
      readIm(i) = im(start + i * stride)
      i += 1
    transformed(re, im, start, stride, 0, 1, length)

  /** Transforms `n` of the numbers that were read, from `from` on, `step` apart. */
  private def transformed(
      re: Array[Double],
      im: Array[Double],
      start: Int,
      stride: Int,
      from: Int,
      step: Int,
      n: Int
  ): Unit =
    if n == 1 then
      re(start) = readRe(from)
      im(start) = readIm(from)
    else
      val factor = smallestFactor(n)
      val size = n / factor
      var r = 0
      while r < factor do
        transformed(re, im, start + r * size * stride, stride, from + r * step, step * factor, size)
        r += 1
      var k = 0
      while k < size do
        joined(re, im, start + k * stride, size * stride, k, factor, n)
        k += 1

  /** Joins the k-th results of all parts. */
  private def joined(
      re: Array[Double],
      im: Array[Double],
      start: Int,
      stride: Int,
      k: Int,
      factor: Int,
      n: Int
  ): Unit =
    val turn = length / n
    var r = 0
    while r < factor do
      partRe(r) = re(start + r * stride)
      partIm(r) = im(start + r * stride)
      r += 1
    var q = 0
    while q < factor do
      var sumRe, sumIm = 0.0
      r = 0
      while r < factor do
        val angle = (r.toLong * (k + q * (n / factor)) % n).toInt * turn
        sumRe += partRe(r) * cosines(angle) - partIm(r) * sines(angle)
        sumIm += partRe(r) * sines(angle) + partIm(r) * cosines(angle)
        r += 1
      re(start + q * stride) = sumRe
      im(start + q * stride) = sumIm
      q += 1

  private def smallestFactor(n: Int): Int =
    var factor = 2
    while factor * factor <= n && n % factor != 0 do factor += 1
    if n % factor == 0 then factor else n

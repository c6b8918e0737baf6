package candela.testing

import candela.base.loop
import candela.image.Image

/** What a picture shows from afar. */
object Blocks:

  /** The means of `parts` × `parts` blocks, in each of the first three channels. */
  def means(image: Image, parts: Int): Array[Double] =
    val sums = new Array[Double](parts * parts * 3)
    val counts = new Array[Int](parts * parts * 3)
    loop(image.height): y =>
      loop(image.width): x =>
        val block = y * parts / image.height * parts + x * parts / image.width
        loop(3): c =>
          sums(block * 3 + c) += image(x, y, c)
          counts(block * 3 + c) += 1
    sums.indices.map(i => sums(i) / counts(i)).toArray

  /** Means of blocks of 8 × 8 pixels, in each of the first three channels. */
  def ofEight(image: Image): Vector[Double] =
    for
      y <- Vector.range(0, image.height, 8)
      x <- Vector.range(0, image.width, 8)
      c <- Vector(0, 1, 2)
    yield
      val all = for j <- y until y + 8; i <- x until x + 8 yield image(i, j, c).toDouble
      all.sum / all.size

  /** The difference of the means of two samples, in its deviations. */
  def score(a: Vector[Double], b: Vector[Double]): Double =
    def mean(v: Vector[Double]) = v.sum / v.size
    def variance(v: Vector[Double]) =
      v.map(x => (x - mean(v)) * (x - mean(v))).sum / (v.size - 1) / v.size
    (mean(a) - mean(b)) / Math.sqrt(variance(a) + variance(b))

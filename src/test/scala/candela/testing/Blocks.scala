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

package candela.render

import candela.film.Film

/** A part of a rendering after which every pixel has the same number of samples.
  *
  * @param samples that every pixel has now
  * @param begin   seconds since the rendering began, without those that a witness took
  * @param workers how long each worker had something to do
  */
final case class Pass(samples: Int, begin: Double, end: Double, workers: Vector[Double])

/** Who sees an image grow: after 1, 2, 4, 8, … samples a pixel, and at the end.
  *
  * All workers pause for it, and its time is not counted: figures about a rendering must not slow
  * down what they are about. The pause between passes is all that it costs.
  */
abstract class Witness:

  /** Called in the caller's thread; no sample is added meanwhile. Not called for a pass that was
    * stopped on its way.
    */
  def passed(pass: Pass, film: Film): Unit

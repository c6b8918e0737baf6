package candela.film

import candela.color.{Rgb, Wavelengths}

/** Receives splats from light subpaths, anywhere on the film. Thread-safe. */
abstract class Splats:

  /** Counts a sample: splats are averaged over the number of samples. */
  def countSample(): Unit

  /** @param x     in pixels from the left edge of the full image, `y` from its top; may be outside
    * @param group of the light, if its groups are told apart
    */
  def add(x: Float, y: Float, light: Rgb, group: Int): Unit

  /** Adds light of a strategy that is kept beside the image. */
  def addStrategy(x: Float, y: Float, light: Rgb, strategy: Int): Unit = ()

  /** Adds the same splat to bands of wavelengths, if there are any.
    *
    * @param light at the wavelengths of `basis`
    */
  def addToBands(x: Float, y: Float, basis: Wavelengths, light: Rgb): Unit

object Splats:
  /** Discards splats: for tracing a single sample, whose splats would land in other pixels. */
  object Discarded extends Splats:
    def countSample(): Unit = ()
    def add(x: Float, y: Float, light: Rgb, group: Int): Unit = ()
    def addToBands(x: Float, y: Float, basis: Wavelengths, light: Rgb): Unit = ()

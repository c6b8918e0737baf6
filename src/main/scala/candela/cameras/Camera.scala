package candela.cameras

import candela.geometry.Ray

/** Turns a place on the film into a ray into the world. */
abstract class Camera:

  /** Writes the ray through the film at (`x`, `y`).
    *
    * @param x in pixels from the left edge of the full image, `y` from its top
    * @param lensU with `lensV` a point in the unit square, for the aperture
    */
  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit

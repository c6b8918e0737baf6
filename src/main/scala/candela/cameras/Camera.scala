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

  /** Fills in the differential of a ray that `generate` has written, from the rays one pixel to the
    * right and one below, through the same point of the aperture.
    *
    * @param scale   by which its rays are moved towards the first: samples of a pixel lie closer
    * @param scratch is written to
    */
  final def differential(
      x: Float,
      y: Float,
      lensU: Float,
      lensV: Float,
      scale: Float,
      ray: Ray,
      scratch: Ray
  ): Unit =
    val (o, d) = (ray.origin, ray.direction)
    val neighbours = ray.differential
    generate(x + 1f, y, lensU, lensV, scratch)
    neighbours.xOrigin = o + (scratch.origin - o) * scale
    neighbours.xDirection = d + (scratch.direction - d) * scale
    generate(x, y + 1f, lensU, lensV, scratch)
    neighbours.yOrigin = o + (scratch.origin - o) * scale
    neighbours.yDirection = d + (scratch.direction - d) * scale
    neighbours.isKnown = true

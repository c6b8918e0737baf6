package candela.lights

import candela.color.Rgb
import candela.math.*

/** A point that shines as measured: its intensity into each direction is in an image.
  *
  * The image's pole (+z of its map) is the light's +y, as in all of pbrt.
  */
final class GoniometricLight(frame: LightFrame, image: SphereImage)
    extends RoundLight(frame.position):

  def intensity(w: Vec3): Rgb =
    val d = frame.toLight(w)
    image(Vec3(d.x, d.z, d.y))

  def bounds: Option[LightBounds] =
    Some(LightBounds.everywhere(frame.position, 4f * Pi * image.meanOfMax))

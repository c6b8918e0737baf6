package candela.integrators

import candela.cameras.{Camera, Shutter}
import candela.color.Rgb

/** Takes light that paths from the lights bring to any place of the film. Safe for all workers at
  * once.
  */
abstract class Splats:

  /** A path sets out from the lights: what all of them add is divided by their number. */
  def begin(): Unit

  /** @param x in pixels from the left edge of the full image, `y` from its top; perhaps outside */
  def add(x: Float, y: Float, light: Rgb): Unit

/** An [[Integrator]] that does more than find what arrives along a ray. */
trait Splatting:
  /** From now on, `camera` takes the picture, and what light paths bring to it goes to `splats`;
    * null: such light is lost.
    */
  def aim(camera: Camera, splats: Splats | Null): Unit

/** An [[Integrator]] whose samples of one number belong together, all over the image. They are
  * taken before those of the next but one.
  */
trait Stepping:
  /** Sample `number` of some pixel is next; so many `pixels` are rendered.
    *
    * @param shutter when light is on its way
    */
  def step(number: Int, pixels: Long, shutter: Shutter): Unit

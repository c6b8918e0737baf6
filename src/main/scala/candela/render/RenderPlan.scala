package candela.render

import candela.cameras.{Camera, Shutter}
import candela.color.ColorBasis
import candela.film.Filter
import candela.integrators.Integrator
import candela.sampling.Sampler

/** The pixels to render, as half-open ranges of the full image: x0 ≤ x < x1, y0 ≤ y < y1. */
final case class PixelBounds(x0: Int, y0: Int, x1: Int, y1: Int):
  def width: Int = x1 - x0
  def height: Int = y1 - y0
  def pixels: Long = width.toLong * height

/** A scene made ready to render: just the objects that it needs, each the plainest that is right.
  *
  * @param width        of the full image in pixels, of which `crop` is rendered
  * @param basis        of the radiance that the integrator returns
  * @param maxComponent radiance samples are scaled down to this (pbrt's `maxcomponentvalue`); if
  *                     infinity, never
  * @param differentialScale of camera rays' differentials; 0: nothing in the scene asks for them
  * @param features     what the plan holds and what it left out, for people: (what, value)
  * @param shutter      when it is open, if anything moves; else all rays have the same time
  */
final class RenderPlan(
    val width: Int,
    val height: Int,
    val crop: PixelBounds,
    val camera: Camera,
    val filter: Filter,
    val sampler: Sampler,
    val integrator: Integrator,
    val basis: ColorBasis,
    val maxComponent: Float,
    val imageScale: Float,
    val filename: String,
    val features: Vector[(String, String)],
    val differentialScale: Float = 0f,
    val shutter: Option[Shutter] = None
)

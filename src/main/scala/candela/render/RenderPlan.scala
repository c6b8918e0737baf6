package candela.render

import candela.cameras.{Camera, Shutter}
import candela.color.ColorBasis
import candela.film.*
import candela.sampling.Sampler

/** A scene made ready to render: just the objects that it needs, each the plainest that is right.
  *
  * @param width        of the full image in pixels, of which `crop` is rendered
  * @param method       takes the samples
  * @param basis        of the radiance that the method finds
  * @param limit        of samples, if the scene sets one
  * @param development  makes the image of what the film has gathered
  * @param differentialScale of camera rays' differentials; 0: nothing in the scene asks for them
  * @param features     what the plan holds and what it left out, for people: (what, value)
  * @param shutter      when it is open, if anything moves; else all rays have the same time
  * @param weighsFirst  is the limit one of the light as the camera weighs it, not as it arrives?
  * @param layers       what else the image holds, if anything
  * @param sharesSamples does a sample count in all pixels that the filter reaches? Else it counts
  *                      in one, and is placed as the filter says
  */
final class RenderPlan(
    val width: Int,
    val height: Int,
    val crop: PixelBounds,
    val camera: Camera,
    val filter: Filter,
    val sampler: Sampler,
    val method: RenderMethod,
    val basis: ColorBasis,
    val limit: Option[SampleLimit],
    val development: Development,
    val filename: String,
    val features: Vector[(String, String)],
    val differentialScale: Float = 0f,
    val shutter: Option[Shutter] = None,
    val weighsFirst: Boolean = true,
    val layers: Option[LayerPlan] = None,
    val sharesSamples: Boolean = false
):
  /** The pixels whose samples count in those of `crop`: these and some around them, if shared. */
  def sampled: PixelBounds =
    if !sharesSamples then crop
    else
      val reach = FilterReach(filter)
      PixelBounds(
        crop.x0 - reach.beyondX,
        crop.y0 - reach.beyondY,
        crop.x1 + reach.beyondX,
        crop.y1 + reach.beyondY
      )

  /** What the method sees of it.
    *
    * @param splats receives what paths from the lights bring
    */
  def view(splats: Splats): View =
    View(
      camera,
      splats,
      width,
      height,
      crop,
      filter,
      sampler.samplesPerPixel,
      shutter,
      differentialScale
    )

/** Layers of an image, and the surface that they are taken from. */
final case class LayerPlan(layers: Vector[Layer], surface: VisibleSurface)

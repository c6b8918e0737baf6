package candela.report

import candela.image.Image
import candela.measure.CurvePoint

/** A stretch of time, in seconds since the program began. */
final case class Span(name: String, begin: Double, end: Double):
  def seconds: Double = end - begin

/** What a page shows beside figures.
  *
  * @param isReference whether others are to be compared with it
  */
final case class Picture(name: String, image: Image, isReference: Boolean = false)

/** All that there is to say about one rendering.
  *
  * @param options what was asked for, for people: (option, value)
  * @param plan    what the scene was built of: (what, value)
  * @param points  the error after each pass; without a reference an estimate, none after the first
  * @param passes  seconds since rendering began, of each pass, with the time that each worker had
  *                something to do
  */
final case class RenderReport(
    scene: String,
    version: String,
    machine: Machine,
    options: Vector[(String, String)],
    plan: Vector[(String, String)],
    reference: Option[String],
    points: Vector[CurvePoint],
    phases: Vector[Span],
    passes: Vector[PassSpan],
    pictures: Vector[Picture],
    rays: Long
):
  def width: Int = pictures.head.image.width
  def height: Int = pictures.head.image.height

/** One pass on the timeline. */
final case class PassSpan(samples: Int, begin: Double, end: Double, workers: Vector[Double])

package candela.cli.files

import candela.base.Figures
import candela.image.Image
import candela.job.Denoising
import candela.measure.Errors

/** A denoised image, and the time that denoising took.
  *
  * @param image with the noisy colours
  */
private[cli] final case class Denoised(image: Image, renderSeconds: Double, seconds: Double):

  /** Relative error of the noisy and of the denoised image; between them that of the noisy image if
    * the time had been spent on samples, whose MSE falls as 1/time.
    */
  def errors(reference: Image): String =
    def error(of: Image) = Errors.quickly(reference)(of).relativeMse
    val noisy = error(image.toRgb)
    val atEqualTime = noisy * renderSeconds / (renderSeconds + seconds)
    val figures = Vector(noisy, atEqualTime, error(Denoising.displayed(image).toRgb))
    val names = Vector("noisy", "noisy in the same time", "denoised")
    figures.map(e => Figures.percentage(Math.sqrt(e))).zip(names).map((e, name) =>
      s"$e $name"
    ).mkString(", ")

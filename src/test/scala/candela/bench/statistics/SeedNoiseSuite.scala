package candela.bench.statistics

import org.scalatest.funsuite.AnyFunSuite

import candela.image.{Image, ImageError}
import candela.testing.Draws

class SeedNoiseSuite extends AnyFunSuite:

  private def flat(value: Float, width: Int = 4, height: Int = 3): Image =
    val image = Image.rgb(width, height)
    java.util.Arrays.fill(image.data, value)
    image

  // Squares of differences of 0.1 between Floats that are rounded to 3e-8
  private def close(a: Double, b: Double) = Math.abs(a - b) < 1e-6 * Math.abs(b) + 1e-12

  test("the mean of the errors is the variance between the seeds, that of one its distance"):
    val errors = SeedNoise.of(Vector(0.4f, 0.5f, 0.6f).map(flat(_)), flat(0.5f))
    assert(close(errors.map(_.mse).sum / 3, 0.01) && close(errors(0).mse, 0.015))
    assert(errors(1).mse < 1e-12)
    assert(close(errors.map(_.relativeMse).sum / 3, 0.01 / (0.51 * 0.51)))
    assert(errors.forall(e => e.flip.isEmpty && e.mae.isEmpty && e.psnr.isEmpty))

  test("few seeds have the variance of many, in the mean"):
    val draws = Draws(1)
    def image() =
      val image = Image.rgb(50, 40)
      for i <- image.data.indices do image.data(i) = draws.between(0f, 2f)
      image
    for seeds <- Seq(2, 3, 8) do
      val errors = SeedNoise.of(Vector.fill(seeds)(image()), flat(1f, 50, 40))
      // Uniform between 0 and 2: a variance of 1/3
      assert(Math.abs(errors.map(_.mse).sum / seeds - 1.0 / 3) < 0.02, s"$seeds seeds"): Unit

  test("mean ratios are those to the scene's mean; pixels that are not finite don't count"):
    val images = Vector(0.2f, 0.3f, 0.4f).map(flat(_))
    images(1).data(0) = Float.NaN
    val errors = SeedNoise.of(images, flat(0.6f))
    assert(errors.forall(e => e.mse.isFinite && e.relativeMse.isFinite))
    assert(close(errors(2).meanRatio.head, 0.4 / 0.6))

  test("images of different sizes are an error"):
    assert(intercept[ImageError](SeedNoise.mean(Vector(flat(1), flat(1, 5)))).getMessage
      .contains("5x3 and 4x3"))

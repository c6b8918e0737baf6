package candela.measure

import candela.image.Image

import java.util.SplittableRandom

import org.scalatest.funsuite.AnyFunSuite

class ReferenceMeanSuite extends AnyFunSuite:
  private val (width, height) = (16, 8)

  /** Values from 0.5 to 1.5, with a variance of 1 / 12. */
  private def images(count: Int): Vector[Image] =
    val random = SplittableRandom(3)
    Vector.fill(count):
      val image = Image.rgb(width, height)
      for i <- image.data.indices do image.data(i) = (0.5 + random.nextDouble()).toFloat
      image

  private def mean(images: Vector[Image]): ReferenceMean =
    images.tail.foldLeft(ReferenceMean.of(images.head))(_.and(_))

  test("it is the mean, and the variance of the mean"):
    val all = images(9)
    val found = mean(all)
    assert(found.runs == 9)
    for i <- 0 until 3 * width * height do
      val values = all.map(_.data(i).toDouble)
      val expected = values.sum / 9
      val variance = values.map(v => (v - expected) * (v - expected)).sum / 8 / 9
      // Nine roundings of floats
      assert(Math.abs(found.image.data(i) - expected) < 1e-6)
      assert(Math.abs(found.variance.get.data(i) - variance) < 1e-6)

  test("its relative error is that of docs/METRICS.md"):
    // √(1/12 / 9) of 1.01, from 384 values with eight degrees of freedom each: ± 1.3 %
    assert(Math.abs(mean(images(9)).relativeError.get / (Math.sqrt(1 / 108.0) / 1.01) - 1) < 0.08)
    assert(mean(images(1)).relativeError.isEmpty)

  test("one that goes on from what its file holds is the same, bit for bit"):
    val all = images(7)
    val whole = mean(all).stored
    for cut <- 1 to 6 do
      val begun = mean(all.take(cut))
      val again = ReferenceMean.of(begun.stored, cut).get
      assert(all.drop(cut).foldLeft(again)(_.and(_)).stored.data.sameElements(whole.data), cut)

  test("an image without the error, or of another number of runs, is no reference"):
    assert(ReferenceMean.of(images(1).head, 2).isEmpty)
    assert(ReferenceMean.of(mean(images(3)).stored, 1).isEmpty)
    assert(ReferenceMean.of(mean(images(3)).stored, 0).isEmpty)

  test("the error of a reference is subtracted from those of images"):
    // The truth is 1
    val truth = mean(images(8)).stored
    val image = Image.rgb(width, height)
    for i <- image.data.indices do image.data(i) = if i % 2 == 0 then 1.3f else 0.7f
    val errors = Errors.quickly(truth)(image)
    val own = errors.own.get
    // 384 squares with the variance 1/96, and 0.09: ± 0.003
    assert(Math.abs(own.mse - 1 / 96.0) < 0.001)
    assert(Math.abs(errors.mse - 0.09) < 0.01 && !errors.isUnresolved)
    val raw = Metrics.compare(image, truth)
    assert(Math.abs(raw.mse - own.mse - errors.mse) < 1e-9)
    assert(Math.abs(raw.relativeMse - own.relativeMse - errors.relativeMse) < 1e-9)

  test("an error below the reference's is 0, and marked"):
    val truth = mean(images(8)).stored
    val errors = Errors.quickly(truth)(truth.toRgb)
    assert(errors.mse == 0 && errors.relativeMse == 0 && errors.isUnresolved)

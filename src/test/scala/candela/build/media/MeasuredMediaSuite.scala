package candela.build.media

import candela.color.Rgb
import candela.scenefile.Dialect

import org.scalatest.funsuite.AnyFunSuite

class MeasuredMediaSuite extends AnyFunSuite:

  test("there are 47 media in each dialect, with the same names but for four"):
    val names = Dialect.ofPbrt.map(MeasuredMedia.names(_).toSet)
    assert(names.forall(_.size == 47))
    assert(names(1) == names(2))
    assert((names(0) -- names(1)) == Set(
      "Lemon Tea",
      "Orange Juice Powder",
      "Pink Lemonade",
      "Suisse Mocha"
    ))

  test("their numbers are those that were published"):
    val milk = MediumCoefficients(Rgb(0.0011f, 0.0024f, 0.014f), Rgb(2.55f, 3.21f, 3.77f))
    for d <- Dialect.ofPbrt do assert(MeasuredMedia.coefficients("Wholemilk", d).contains(milk))
    assert(MeasuredMedia.coefficients("Milk", Dialect.V4).isEmpty)

  test("none scatters or absorbs less than nothing"):
    for d <- Dialect.ofPbrt; m <- MeasuredMedia.names(d).flatMap(MeasuredMedia.coefficients(_, d))
    do
      val all = Seq(m.absorption, m.scattering).flatMap(c => Seq(c.r, c.g, c.b))
      assert(all.forall(x => x >= 0f && x < 100f), m)

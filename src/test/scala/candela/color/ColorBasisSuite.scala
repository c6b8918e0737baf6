package candela.color

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

final class ColorBasisSuite extends AnyFunSuite:
  private def close(a: Rgb, b: Rgb, tolerance: Float): Boolean =
    Seq(a.r - b.r, a.g - b.g, a.b - b.b).forall(d => Math.abs(d) <= tolerance)

  for (name, basis) <- Seq("Srgb" -> ColorBasis.Srgb, "Sharp" -> ColorBasis.Sharp) do
    test(s"$name keeps white"):
      // Six digits in each of three coefficients
      assert(close(basis.toSrgb(Rgb.White), Rgb.White, 3e-6f))
      assert(close(basis.fromSrgb(Rgb.White), Rgb.White, 3e-6f))

    test(s"$name: to and from sRGB are inverses"):
      val draws = Draws(7)
      for _ <- 1 to 1000 do
        val c = Rgb(draws.between(0, 2), draws.between(0, 2), draws.between(0, 2))
        // A few roundings of numbers of size 2
        assert(close(basis.toSrgb(basis.fromSrgb(c)), c, 2e-6f))
        assert(close(basis.fromSrgb(basis.toSrgb(c)), c, 2e-6f))

    test(s"in $name no sRGB colour has a negative component"):
      for c <- Seq(Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1)) do
        val b = basis.fromSrgb(c)
        assert(b.r >= 0f && b.g >= 0f && b.b >= 0f, b)

  test("only sRGB's own basis is sRGB"):
    assert(ColorBasis.Srgb.isSrgb && !ColorBasis.Sharp.isSrgb)

package candela.color

import org.scalatest.funsuite.AnyFunSuite

final class ColorResponseSuite extends AnyFunSuite:
  private val nm = Array.tabulate(95)(i => 360f + 5f * i)

  /** The observer itself, who sees X, Y and Z. */
  private val observer = ColorResponse(Colorimetry.observers.map: curve =>
    Detector(
      nm,
      nm.map(l => (5 * curve(l) * Colorimetry.D65(l) / Colorimetry.luminanceOfD65).toFloat)
    ))

  private def seen(response: ColorResponse, c: Rgb): Vector[Float] =
    val out = new Array[Float](4)
    response(c.r, c.g, c.b, out, 1)
    assert(out(0) == 0f)
    out.toVector.tail

  test("the observer sees of a colour what it is, however bright it is or on what side of black"):
    for
      r <- Seq(0f, 0.013f, 0.4f, 1f, 7f); g <- Seq(0f, 0.2f, 1.3f); b <- Seq(0f, 0.5f, 20f)
      sign <- Seq(1f, -1f)
    do
      val c = Rgb(sign * r, g, b)
      val xyz = seen(observer, c)
      val found = Colorimetry.fromXyz(xyz(0), xyz(1), xyz(2))
      val most = Math.max(r, Math.max(g, b))
      for (x, y) <- Seq(found.r -> c.r, found.g -> c.g, found.b -> c.b) do
        // The darkest component of a spectrum's colour is 2/1000 of the largest; whites are
        // constants, whose colour is that to 1e-3
        assert(Math.abs(x - y) <= 6e-3f * most, s"$found, not $c")

  test("a narrow band sees of grey light what it has of D65, and nothing of black"):
    val detectors = Vector(Detector(Array(550f), Array(2f)), Detector(Array(700f), Array(1f)))
    val band = ColorResponse(detectors)
    val out = new Array[Float](2)
    band(3f, 3f, 3f, out, 0)
    assert(Math.abs(out(0) - 6f) < 1e-5f && Math.abs(out(1) - 3f) < 1e-5f)
    band(0f, 0f, 0f, out, 0)
    assert(out.forall(_ == 0f))
    // Of red light the long wavelengths
    band(1f, 0f, 0f, out, 0)
    assert(out(1) > 0.9f && out(0) < 0.2f)

  test("between the colours that are kept it is as if they were fitted themselves"):
    val band = ColorResponse(Vector.tabulate(16)(i => Detector(Array(370f + 30 * i), Array(1f))))
    val out = new Array[Float](16)
    for c <- Seq(Rgb(0.37f, 0.21f, 0.83f), Rgb(0.55f, 0.9f, 0.12f), Rgb(0.7f, 0.33f, 0.27f)) do
      band(c.r, c.g, c.b, out, 0)
      val right = Upsampling.unbounded(c)
      for i <- 0 until 16 do
        // Half a cell of 1/24 is where the table errs most
        assert(Math.abs(out(i) - right(370f + 30 * i)) < 4e-3f, s"$c at ${370 + 30 * i} nm")

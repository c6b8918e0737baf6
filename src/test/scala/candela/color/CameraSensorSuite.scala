package candela.color

import org.scalatest.funsuite.AnyFunSuite

final class CameraSensorSuite extends AnyFunSuite:

  private def photographed(sensor: CameraSensor, kelvin: Float, c: Rgb): Vector[Double] =
    val cells = new Array[Float](3)
    sensor.response(c.r, c.g, c.b, cells, 0)
    Matrix3(sensor.toRgb(kelvin).map(_.toDouble).toVector) * cells.toVector.map(_.toDouble)

  test("every sensor is measured, and sees what the observer does, more or less"):
    for name <- CameraSensor.names do
      val sensor = CameraSensor.named(name).get
      val colors =
        Seq(Rgb.White, Rgb(0.5f, 0.4f, 0.3f), Rgb(0.2f, 0.3f, 0.5f), Rgb(0.3f, 0.5f, 0.2f))
      for c <- colors do
        val found = photographed(sensor, 6500f, c)
        // Cells are no linear maps of the observer's: 7 % were seen, for a drone's green
        for (a, b) <- found.zip(Seq(c.r, c.g, c.b)) do
          assert(Math.abs(a - b) < 0.1 * c.max, s"$name: $found, not $c")
    assert(CameraSensor.named("cie1931").isEmpty)

  test("the fit is that of PBRT's formulas to the 24 colours of the chart"):
    // Computed with double numbers from all 24 spectra
    val expected = Vector(
      1.80400, 0.04731, 0.19925, 0.68760, 0.97983, -0.33786, 0.13944, -0.40497, 1.96389
    )
    val rows = CameraSensor.named("canon_eos_100d").get.toRgb(6500f).map(_.toDouble).toVector
    val found = Colorimetry.xyzOfRgb * Matrix3(rows)
    for i <- 0 until 9 do
      // The chart's lesser components are lost
      val number = found(i / 3, i % 3)
      assert(Math.abs(number - expected(i)) < 1e-3, s"number $i: $number")

  test("balanced for warm light, D65 is blue"):
    val sensor = CameraSensor.named("sony_ilce_9").get
    val Vector(r, g, b) = photographed(sensor, 4000f, Rgb.White): @unchecked
    assert(r < 0.8 && b > 1.3 && g > r && g < b)

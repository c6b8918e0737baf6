package candela.build.materials

import candela.base.Decimal
import candela.io.{FileName, InputFile, IoReason}
import java.nio.{ByteBuffer, ByteOrder}

import candela.bsdf.measured.{HalfAngleReflection, ScatteredReflection}
import candela.color.Spectrum
import candela.math.*

/** Reads pbrt-v2's two formats of measured BRDFs.
  *
  * A `.brdf` file is text: the number of wavelengths, these in nm, and for each measurement θ and φ
  * of the light, θ and φ of the viewer (radians), and a value in sr⁻¹ for each wavelength; `#`
  * begins a comment. Any other file is MERL's binary table: three little-endian 32-bit sizes (90,
  * 90, 180), then all red, all green, all blue values as doubles.
  */
private[build] object BrdfFile:

  /** Returns the BRDF, or an error message. */
  def read(file: InputFile): Either[String, MeasuredBsdf] =
    val isText = FileName.suffix(file.path) == "brdf"
    try if isText then scattered(file) else table(file)
    catch case e: java.io.IOException => Left(IoReason(e))

  private def scattered(file: InputFile): Either[String, MeasuredBsdf] =
    val words = file.words()
    words.find(Decimal.float(_).isEmpty) match
      case Some(word) => Left(s"${file.quoted(word)} is not a number")
      case None =>
        val numbers = words.map(_.toFloat).toArray
        val count = numbers.headOption.fold(0)(_.toInt)
        val size = 4 + count
        if count < 1 || numbers.length <= 1 + count || (numbers.length - 1 - count) % size != 0 then
          Left(
            s"${numbers.length} numbers don't form complete measurements of $count wavelengths"
          )
        else
          val lambda = numbers.slice(1, 1 + count)
          val measured = numbers.drop(1 + count).grouped(size).toArray
          val points = measured.flatMap: m =>
            val p = ScatteredReflection.pair(direction(m(2), m(3)), direction(m(0), m(1)))
            Array(p.x, p.y, p.z)
          val spectra = measured.map(m => Spectrum(lambda, m.drop(4)))
          Right(MeasuredBsdf.OfSpectra: toRgb =>
            val values = spectra.map(toRgb).flatMap(c => Array(c.r, c.g, c.b))
            ScatteredReflection(points, values))

  private def direction(theta: Float, phi: Float): Vec3 =
    Vec3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta))

  private def table(file: InputFile): Either[String, MeasuredBsdf] =
    import HalfAngleReflection.{Azimuths, HalfAngles, Polar}
    val entries = HalfAngles * Polar * Azimuths
    val expected = 12L + 24L * entries
    if file.size != expected then
      Left(s"size must be $expected bytes (90 × 90 × 180 values), found ${file.size}")
    else
      val buffer = ByteBuffer.wrap(file.bytes()).order(ByteOrder.LITTLE_ENDIAN)
      val sizes = Vector.fill(3)(buffer.getInt)
      if sizes != Vector(HalfAngles, Polar, Azimuths) then
        Left(s"table must have 90 × 90 × 180 values, found ${sizes.mkString(" × ")}")
      else
        val values = new Array[Float](3 * entries)
        for c <- 0 until 3; i <- 0 until entries do
          values(3 * i + c) = Math.max(0.0, buffer.getDouble() * Scales(c)).toFloat
        Right(MeasuredBsdf.OfColors(HalfAngleReflection(values)))

  // Channel scales of the MERL database
  private val Scales = Array(1.0 / 1500, 1.15 / 1500, 1.66 / 1500)

package candela.build.materials

import candela.io.{InputFile, IoReason}
import java.nio.{ByteBuffer, ByteOrder}
import java.nio.charset.StandardCharsets.ISO_8859_1

import candela.bsdf.measured.FourierTable

/** Reads the `.bsdf` files of pbrt-v3's "fourier", as written by Jakob's layerlab.
  *
  * All numbers are little-endian with 4 bytes. `SCATFUN` and a byte of 1 precede the flags, the
  * number n of cosines, the number of all coefficients, the maximum length of a series, channels,
  * bases, three numbers that pbrt ignores, the index of refraction, and four more ignored numbers.
  * Then come n cosines, n² integrals over cosines, n² pairs of offset and length, and the
  * coefficients.
  */
private[build] object BsdfFile:
  private val Magic = "SCATFUN\u0001"
  private inline val HeaderBytes = 64

  /** Keeps n² within an Int; real files have some hundred cosines. */
  private inline val MaxCosines = 4096

  /** Returns the table, or an error message. */
  def read(file: InputFile): Either[String, FourierTable] =
    try
      if file.size > Int.MaxValue then
        Left(s"size must be below 2 GiB, found ${file.size} bytes")
      else parse(file.bytes())
    catch case e: java.io.IOException => Left(IoReason(e))

  def parse(bytes: Array[Byte]): Either[String, FourierTable] =
    val buffer = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN)
    val isOurs = bytes.length >= HeaderBytes && String(bytes, 0, 8, ISO_8859_1) == Magic
    if !isOurs then Left("header must begin with \"SCATFUN\" version 1")
    else
      buffer.position(8)
      val Array(flags, n, coefficients, _, channels, bases) =
        Array.fill(6)(buffer.getInt): @unchecked
      buffer.position(44)
      val eta = buffer.getFloat
      val expected = HeaderBytes + 4L * (n + 3L * n * n + coefficients)
      if flags != 1 then Left(s"flags must be 1 (a plain BSDF), found $flags")
      else if channels != 1 && channels != 3 then
        Left(s"number of channels must be 1 or 3, found $channels")
      else if bases != 1 then Left(s"number of bases must be 1, found $bases")
      else if n < 2 || n > MaxCosines || coefficients < 0 then
        Left(s"invalid table of $n cosines and $coefficients coefficients")
      else if bytes.length < expected then
        Left(s"size must be at least $expected bytes by its header, found ${bytes.length}")
      else if !(eta > 0f && eta < Float.PositiveInfinity) then
        Left(s"index of refraction must be above 0, found $eta")
      else table(buffer, n, coefficients, channels, eta)

  private def table(
      in: ByteBuffer,
      n: Int,
      count: Int,
      channels: Int,
      eta: Float
  ): Either[String, FourierTable] =
    in.position(HeaderBytes)
    val cosines = Array.fill(n)(in.getFloat)
    in.position(in.position + 4 * n * n) // the integrals, which are recomputed
    val pairs = Array.fill(2 * n * n)(in.getInt)
    val offsets = Array.tabulate(n * n)(i => pairs(2 * i))
    val lengths = Array.tabulate(n * n)(i => pairs(2 * i + 1))
    val coefficients = Array.fill(count)(in.getFloat)
    // Some files have the horizon twice, where reflection becomes transmission
    val falling = (1 until n).find(i => !(cosines(i) >= cosines(i - 1)))
    val isRising = falling.isEmpty && cosines(n - 1) > cosines(0)
    val fits = offsets.indices.forall: i =>
      lengths(i) >= 0 && offsets(i) >= 0 && offsets(i) + lengths(i).toLong * channels <= count
    if !isRising || cosines.exists(c => !(Math.abs(c) <= 1f)) then
      val detail = falling.fold("")(i => s", found ${cosines(i)} after ${cosines(i - 1)}")
      Left(s"cosines must increase within [-1, 1]$detail")
    else if !fits then Left(s"a series extends past the $count coefficients")
    else if coefficients.exists(c => !java.lang.Float.isFinite(c)) then
      Left("a coefficient is NaN or infinite")
    else if lengths.max == 0 then Left("the table has no series")
    else Right(FourierTable(cosines, offsets, lengths, coefficients, channels, eta))

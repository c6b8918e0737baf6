package candela.build.materials

import java.nio.{ByteBuffer, ByteOrder}
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}

import candela.bsdf.measured.FourierTable

/** Reads the `.bsdf` files of pbrt-v3's "fourier", as Jakob's layerlab writes them.
  *
  * All numbers are little-endian and of 4 bytes. After `SCATFUN` and a byte of 1 there are flags,
  * the count n of cosines, the count of all coefficients, the most of a series, channels, bases,
  * three numbers for what pbrt doesn't read, the index of refraction, and four more of those. Then
  * come n cosines, n² integrals over cosines, n² pairs of offset and length, and the coefficients.
  */
private[build] object BsdfFile:
  private val Magic = "SCATFUN\u0001"
  private inline val HeaderBytes = 64

  /** No more than a machine can square; real files have some hundred. */
  private inline val MostCosines = 4096

  /** The table, or what is wrong with the file. */
  def read(path: Path): Either[String, FourierTable] =
    try
      val size = Files.size(path)
      if size > Int.MaxValue then Left(s"it has $size bytes: that is too much")
      else parse(Files.readAllBytes(path))
    catch case e: java.io.IOException => Left(s"cannot be read: ${e.getMessage}")

  def parse(bytes: Array[Byte]): Either[String, FourierTable] =
    val in = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN)
    val isOurs = bytes.length >= HeaderBytes && String(bytes, 0, 8, ISO_8859_1) == Magic
    if !isOurs then Left("it does not begin with a header of \"SCATFUN\" version 1")
    else
      in.position(8)
      val Array(flags, n, coefficients, _, channels, bases) = Array.fill(6)(in.getInt): @unchecked
      in.position(44)
      val eta = in.getFloat
      val expected = HeaderBytes + 4L * (n + 3L * n * n + coefficients)
      if flags != 1 then Left(s"flags $flags are not supported: only those of a plain BSDF are, 1")
      else if channels != 1 && channels != 3 then Left(s"it has $channels channels, not 1 or 3")
      else if bases != 1 then Left(s"it has $bases bases: only one is supported")
      else if n < 2 || n > MostCosines || coefficients < 0 then
        Left(s"$n cosines and $coefficients coefficients make no table")
      else if bytes.length < expected then
        Left(s"it has ${bytes.length} bytes, not the $expected that its header asks for")
      else if !(eta > 0f && eta < Float.PositiveInfinity) then Left(s"its index is $eta")
      else table(in, n, coefficients, channels, eta)

  private def table(
      in: ByteBuffer,
      n: Int,
      count: Int,
      channels: Int,
      eta: Float
  ): Either[String, FourierTable] =
    in.position(HeaderBytes)
    val cosines = Array.fill(n)(in.getFloat)
    in.position(in.position + 4 * n * n) // the integrals, which can be made anew
    val pairs = Array.fill(2 * n * n)(in.getInt)
    val offsets = Array.tabulate(n * n)(i => pairs(2 * i))
    val lengths = Array.tabulate(n * n)(i => pairs(2 * i + 1))
    val coefficients = Array.fill(count)(in.getFloat)
    val isRising = (1 until n).forall(i => cosines(i) > cosines(i - 1))
    val fits = offsets.indices.forall: i =>
      lengths(i) >= 0 && offsets(i) >= 0 && offsets(i) + lengths(i).toLong * channels <= count
    if !isRising || cosines.exists(c => !(Math.abs(c) <= 1f)) then
      Left("its cosines do not rise within -1 and 1")
    else if !fits then Left(s"its series reach beyond its $count coefficients")
    else if coefficients.exists(c => !java.lang.Float.isFinite(c)) then
      Left("its coefficients are no numbers")
    else if lengths.max == 0 then Left("it has no series")
    else Right(FourierTable(cosines, offsets, lengths, coefficients, channels, eta))

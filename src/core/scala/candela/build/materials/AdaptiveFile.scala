package candela.build.materials

import candela.io.{InputFile, IoReason}
import java.nio.{ByteBuffer, ByteOrder}

import candela.bsdf.measured.AdaptiveReflection
import candela.color.{Rgb, Spectrum}
import candela.sampling.WarpTable

/** Reads measured reflectance in Dupuy and Jakob's adaptive parameterisation (`.bsdf`). */
private[build] object AdaptiveFile:

  /** Returns the BRDF, or an error message. */
  def read(file: InputFile): Either[String, MeasuredBsdf.OfSpectra] =
    for
      fields <- TensorFile.read(file)
      bsdf <- Reader(fields).result
    yield bsdf

  private final class Reader(fields: Map[String, Tensor]):
    private def table(name: String, dimensions: Int): Either[String, Tensor] =
      fields.get(name) match
        case None => Left(s"field `$name` is missing")
        case Some(t) if t.kind != TensorFile.Floats || t.shape.size != dimensions =>
          Left(s"field `$name` must be an array of floats with $dimensions dimensions")
        case Some(t) if t.length == 0 => Left(s"field `$name` is empty")
        case Some(t) => Right(t)

    private def check(isRight: Boolean, problem: => String): Either[String, Unit] =
      Either.cond(isRight, (), problem)

    private def ascends(values: Array[Float]): Boolean =
      values.indices.drop(1).forall(i => values(i - 1) < values(i))

    def result: Either[String, MeasuredBsdf.OfSpectra] =
      for
        theta <- table("theta_i", 1)
        phi <- table("phi_i", 1)
        ndf <- table("ndf", 2)
        sigma <- table("sigma", 2)
        vndf <- table("vndf", 4)
        luminance <- table("luminance", 4)
        spectra <- table("spectra", 5)
        wavelengths <- table("wavelengths", 1)
        pairs = Vector(phi.length, theta.length)
        _ <- check(
          vndf.shape.take(2) == pairs && luminance.shape.take(2) == pairs &&
            spectra.shape.take(3) == pairs :+ wavelengths.length &&
            spectra.shape.drop(3) == luminance.shape.drop(2),
          "the sizes of its arrays don't match"
        )
        _ <- check(
          Seq(ndf, sigma, vndf, luminance).forall(_.shape.takeRight(2).forall(_ > 1)),
          "an array has only one row or column"
        )
        angles = Seq(theta, phi, wavelengths).map(_.floats)
        _ <- check(angles.forall(ascends), "angles and wavelengths must be strictly increasing")
        turn = angles(1).last - angles(1).head
        _ <- check(
          phi.length <= 2 || Math.rint(2 * Math.PI / turn) == 1.0,
          "azimuths must cover 360 degrees"
        )
      yield
        val (p, t) = (phi.floats, theta.floats)
        def fixed(of: Tensor) =
          WarpTable(of.shape(1), of.shape(0), of.floats, Array(0f), Array(0f))
        def density(of: Tensor) =
          WarpTable(of.shape(3), of.shape(2), of.floats, p, t, isDensity = true)
        val (normals, projected) = (fixed(ndf), fixed(sigma))
        val (visible, brightness) = (density(vndf), density(luminance))
        val (lambda, values) = (wavelengths.floats, spectra.floats)
        MeasuredBsdf.OfSpectra: toRgb =>
          AdaptiveReflection(
            normals,
            projected,
            visible,
            brightness,
            WarpTable(
              spectra.shape(4),
              spectra.shape(3),
              colors(spectra.shape, values, lambda, toRgb),
              p,
              t,
              channels = 3
            ),
            isIsotropic = phi.length <= 2
          )

    /** Projects the spectra to three channels, one wavelength at a time. */
    private def colors(
        shape: Vector[Int],
        values: Array[Float],
        wavelengths: Array[Float],
        toRgb: Spectrum => Rgb
    ): Array[Float] =
      val hats = wavelengths.indices.map: i =>
        val hat = Array.tabulate(wavelengths.length)(j => if i == j then 1f else 0f)
        val c = toRgb(Spectrum(wavelengths, hat))
        Array(c.r, c.g, c.b)
      val size = shape(3) * shape(4)
      val slices = shape(0) * shape(1)
      val result = new Array[Float](slices * 3 * size)
      for slice <- 0 until slices; i <- wavelengths.indices; channel <- 0 until 3 do
        val (from, to) = ((slice * wavelengths.length + i) * size, (slice * 3 + channel) * size)
        val share = hats(i)(channel)
        var k = if share == 0f then size else 0
        while k < size do
          result(to + k) += share * values(from + k)
          k += 1
      result

/** One array of a tensor file.
  *
  * @param kind  element type, 1: unsigned bytes, 10: floats; others are not read
  * @param shape length of each dimension; the last varies fastest
  */
private[build] final class Tensor(val kind: Int, val shape: Vector[Int], bytes: ByteBuffer):
  val length: Int = shape.product

  def floats: Array[Float] = Array.tabulate(length)(i => bytes.getFloat(4 * i))

/** Reads the container format of Dupuy and Jakob's measurements: `tensor_file`, a zero, version
  * 1.0, the number of fields, and for each its name, dimensions, type, offset in the file, and
  * sizes. All numbers are little-endian.
  */
private[build] object TensorFile:
  val Bytes = 1
  val Floats = 10
  private val Magic = "tensor_file\u0000".getBytes("ISO-8859-1")
  private val Sizes = Map(Bytes -> 1, Floats -> 4)

  /** Returns the arrays by name, or an error message. */
  def read(file: InputFile): Either[String, Map[String, Tensor]] =
    try Right(fields(ByteBuffer.wrap(file.bytes()).order(ByteOrder.LITTLE_ENDIAN)))
    catch
      case e: java.io.IOException => Left(IoReason(e))
      case _: java.nio.BufferUnderflowException => Left("unexpected end of file")
      case e: Malformed => Left(e.getMessage)

  private final class Malformed(message: String) extends RuntimeException(message)

  private def fields(in: ByteBuffer): Map[String, Tensor] =
    val magic = new Array[Byte](Magic.length)
    val _ = in.get(magic)
    if !magic.sameElements(Magic) then throw Malformed("not a tensor file")
    val version = (in.get().toInt, in.get().toInt)
    if version != (1, 0) then
      throw Malformed(s"version must be 1.0, found ${version._1}.${version._2}")
    val count = in.getInt()
    if count < 0 || count > 1000 then
      throw Malformed(s"number of fields must be between 0 and 1000, found $count")
    Vector.fill(count)(field(in)).toMap

  private def field(in: ByteBuffer): (String, Tensor) =
    val name = new Array[Byte](in.getShort() & 0xffff)
    val _ = in.get(name)
    val dimensions = in.getShort() & 0xffff
    val kind = in.get().toInt
    val offset = in.getLong()
    val word = String(name, "ISO-8859-1")
    if dimensions > 8 then
      throw Malformed(s"field `$word` must have at most 8 dimensions, found $dimensions")
    val shape = Vector.fill(dimensions)(in.getLong())
    // Products of malicious sizes must not overflow
    val entries = shape.foldLeft(BigInt(1))(_ * _)
    val size = entries * Sizes.getOrElse(kind, 1)
    if shape.exists(_ < 0) || offset < 0 || offset + size > in.limit() then
      throw Malformed(s"field `$word` extends past the end of the file")
    val bytes = in.slice(offset.toInt, size.toInt).order(ByteOrder.LITTLE_ENDIAN)
    word -> Tensor(kind, shape.map(_.toInt), bytes)

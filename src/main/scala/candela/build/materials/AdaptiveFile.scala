package candela.build.materials

import java.nio.file.Path

import candela.bsdf.{AdaptiveReflection, Bsdf}
import candela.color.{Rgb, Spectrum}
import candela.sampling.WarpTable

/** Reads measured reflectance in Dupuy and Jakob's adaptive parameterisation (`.bsdf`). */
private[build] object AdaptiveFile:

  /** The reflection, or what is wrong with the file. */
  def read(path: Path, toRgb: Spectrum => Rgb): Either[String, Bsdf] =
    for
      fields <- TensorFile.read(path)
      bsdf <- Reader(fields, toRgb).result
    yield bsdf

  private final class Reader(fields: Map[String, Tensor], toRgb: Spectrum => Rgb):
    private def table(name: String, dimensions: Int): Either[String, Tensor] =
      fields.get(name) match
        case None => Left(s"it has no field `$name`")
        case Some(t) if t.kind != TensorFile.Floats || t.shape.size != dimensions =>
          Left(s"`$name` is no array of floats of $dimensions dimensions")
        case Some(t) if t.length == 0 => Left(s"`$name` is empty")
        case Some(t) => Right(t)

    private def check(isRight: Boolean, problem: => String): Either[String, Unit] =
      Either.cond(isRight, (), problem)

    private def ascends(values: Array[Float]): Boolean =
      values.indices.drop(1).forall(i => values(i - 1) < values(i))

    def result: Either[String, Bsdf] =
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
          "the sizes of its arrays don't fit together"
        )
        _ <- check(
          Seq(ndf, sigma, vndf, luminance).forall(_.shape.takeRight(2).forall(_ > 1)),
          "an array has a single row or column"
        )
        angles = Seq(theta, phi, wavelengths).map(_.floats)
        _ <- check(angles.forall(ascends), "its angles or wavelengths don't ascend")
        turn = angles(1).last - angles(1).head
        _ <- check(
          phi.length <= 2 || Math.rint(2 * Math.PI / turn) == 1.0,
          "its azimuths go only a part of the way around"
        )
      yield
        val (p, t) = (phi.floats, theta.floats)
        def fixed(of: Tensor) =
          WarpTable(of.shape(1), of.shape(0), of.floats, Array(0f), Array(0f))
        def density(of: Tensor) =
          WarpTable(of.shape(3), of.shape(2), of.floats, p, t, isDensity = true)
        AdaptiveReflection(
          fixed(ndf),
          fixed(sigma),
          density(vndf),
          density(luminance),
          WarpTable(
            spectra.shape(4),
            spectra.shape(3),
            colors(spectra, wavelengths.floats),
            p,
            t,
            channels = 3
          ),
          isIsotropic = phi.length <= 2
        )

    /** The spectra as three channels: each wavelength adds its own colour. */
    private def colors(spectra: Tensor, wavelengths: Array[Float]): Array[Float] =
      val hats = wavelengths.indices.map: i =>
        val hat = Array.tabulate(wavelengths.length)(j => if i == j then 1f else 0f)
        val c = toRgb(Spectrum(wavelengths, hat))
        Array(c.r, c.g, c.b)
      val size = spectra.shape(3) * spectra.shape(4)
      val slices = spectra.shape(0) * spectra.shape(1)
      val values = spectra.floats
      val result = new Array[Float](slices * 3 * size)
      for slice <- 0 until slices; i <- wavelengths.indices; channel <- 0 until 3 do
        val (from, to) = ((slice * wavelengths.length + i) * size, (slice * 3 + channel) * size)
        val share = hats(i)(channel)
        var k = 0
        while k < size do
          result(to + k) += share * values(from + k)
          k += 1
      result

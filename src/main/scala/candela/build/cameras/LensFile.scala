package candela.build.cameras

import java.io.IOException
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}

import candela.cameras.LensSurface

/** Reads a table of lens surfaces, from the scene to the film: for each its radius of curvature in
  * mm (0: the aperture stop), its distance to the next in mm, the index of refraction up to there
  * (0 or 1: air), and its diameter in mm. `#` begins a comment.
  */
private[build] object LensFile:
  private val Columns = 4

  /** The surfaces, in metres, or what is wrong with the file. */
  def read(path: Path): Either[String, Vector[LensSurface]] =
    try surfaces(Files.readString(path, ISO_8859_1))
    catch case e: IOException => Left(s"cannot be read: ${e.getMessage}")

  private[build] def surfaces(text: String): Either[String, Vector[LensSurface]] =
    val lines = text.linesIterator.map(_.takeWhile(_ != '#').trim).zipWithIndex
    val words = lines.flatMap((l, i) => l.split("\\s+").filter(_.nonEmpty).map(_ -> (i + 1)))
    val all = words.toVector
    all.find((word, _) => !word.toDoubleOption.exists(java.lang.Double.isFinite)) match
      case Some((word, line)) => Left(s"`$word` in line $line is no number")
      case None if all.isEmpty => Left("it holds no surface")
      case None if all.size % Columns != 0 =>
        Left(s"${all.size} numbers are no whole surfaces of $Columns each")
      case None =>
        val rows = all.map(_._1.toDouble).grouped(Columns).toVector
        val read = rows.map: row =>
          LensSurface(row(0) / 1000, row(1) / 1000, row(2), row(3) / 2000)
        rows.indexWhere(row => row(3) <= 0 || row(2) < 0 || row(1) < 0) match
          case -1 => Right(read)
          case i =>
            Left(s"surface ${i + 1} has no positive diameter, or a thickness or index below 0")

package candela.cli.commands

import candela.base.{loop, Figures}
import candela.color.Encoding
import candela.io.{ForeignFile, ForeignKind, InputFile}
import java.nio.file.Path
import java.util.Locale

import candela.cli.files.{FilmInput, InputImages, OutputFiles}
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.image.{ByteImage, Image, ImageFiles, StoredImage}
import candela.render.storage.FilmHeader

/** `candela info`: prints size, channels, metadata and statistics of images, and what saved
  * renderings are.
  */
final class InfoCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded:
    val several = options.files.size > 1
    for (name, i) <- options.files.zipWithIndex do
      if several && i > 0 then terminal.out.println()
      if several then terminal.out.println(name)
      val path = OutputFiles.path(name)
      val infoLines =
        if isFilm(path) then described(FilmInput.open(name, report).header)
        else
          InputImages.warn(path, report)
          lines(path, ImageFiles.load(InputFile.named(path)))
      infoLines.foreach(terminal.out.println)
    terminal.out.flush()
    ExitCode.Done

  private def isFilm(path: Path): Boolean =
    ForeignFile.of(path).exists(_.kind == ForeignKind.Film)

  private def described(film: FilmHeader): Vector[String] =
    val share = film.shards.size.toDouble / film.count
    val done = Figures.general(film.done * share)
    val samples =
      if film.done > film.samples then s"$done per pixel, ${film.samples} planned"
      else s"$done of ${film.samples} per pixel"
    val about = Vector(
      "scene" -> film.scene,
      "size" -> film.size,
      "samples" -> (if film.isComplete && film.isWhole then s"$samples: complete" else samples)
    ) ++ Option.when(film.count > 1):
      "part" -> (if film.isComplete then s"${film.label}: complete" else film.label)
    ++
      Option.when(film.words.nonEmpty)("options" -> film.words.mkString(" ")) ++
      Option.when(film.outfiles.nonEmpty)("images" -> film.outfiles.mkString(", ")) ++
      Vector(
        "files" -> s"${film.files.size} of the scene",
        "written by" -> s"Candela ${film.version}"
      )
    table(about)

  private def table(about: Vector[(String, String)]): Vector[String] =
    val width = about.map(_._1.length).max.max(12)
    about.map((name, text) => s"${name.padTo(width, ' ')}  $text")

  private def lines(path: Path, stored: StoredImage): Vector[String] =
    val bits = stored match
      case _: ByteImage => "8 bits"
      case _ if stored.encoding == Encoding.Srgb => "16 bits"
      case _ => ImageFiles.precision(path).getOrElse("floats")
    val encoding = stored.encoding.toString.toLowerCase(Locale.ROOT)
    val about = Vector(
      "size" -> s"${stored.width}x${stored.height}",
      "channels" -> s"${stored.channelNames.mkString(", ")}, $bits, $encoding",
      "primaries" -> stored.colorSpace.name
    ) ++ ImageFiles.facts(path)
    table(about) ++ InfoCommand.statistics(stored.toImage.linear)

object InfoCommand:

  /** A table of the linear values of each channel. */
  private[cli] def statistics(image: Image): Vector[String] =
    val n = image.channels
    val rows = image.channelNames.zipWithIndex.map: (name, c) =>
      var minimum = Double.PositiveInfinity
      var maximum = Double.NegativeInfinity
      var sum = 0.0
      var nans = 0
      var infinities = 0
      loop(image.width * image.height): pixel =>
        val v = image.data(pixel * n + c).toDouble
        if v.isNaN then nans += 1
        else if v.isInfinite then infinities += 1
        else
          minimum = Math.min(minimum, v)
          maximum = Math.max(maximum, v)
          sum += v
      val finite = image.width * image.height - nans - infinities
      val figures =
        if finite == 0 then Vector("-", "-", "-")
        else Vector(minimum, maximum, sum / finite).map(Figures.scientific)
      (name +: figures) ++ Vector(nans.toString, infinities.toString)
    Comparison.aligned(Vector("channel", "least", "greatest", "mean", "NaN", "infinite") +: rows)

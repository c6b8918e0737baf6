package candela.cli

import java.nio.file.Path

import candela.base.loop
import candela.image.{ByteImage, Image, ImageFiles, StoredImage}

/** `candela info`: prints size, channels, metadata and statistics of images. */
final class InfoCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded:
    val several = options.files.size > 1
    for (name, i) <- options.files.zipWithIndex do
      if several then terminal.out.println((if i > 0 then "\n" else "") + name)
      val path = OutputFiles.path(name)
      lines(path, ImageFiles.load(path)).foreach(terminal.out.println)
    terminal.out.flush()
    ExitCode.Done

  private def lines(path: Path, stored: StoredImage): Vector[String] =
    val bits = stored match
      case _: ByteImage => "8 bits"
      case _ => "floats"
    val encoding = stored.encoding.toString.toLowerCase
    val about = Vector(
      "size" -> s"${stored.width}x${stored.height}",
      "channels" -> s"${stored.channelNames.mkString(", ")}, $bits, $encoding",
      "primaries" -> stored.colorSpace.name
    ) ++ ImageFiles.facts(path)
    val width = about.map(_._1.length).max.max(12)
    about.map((name, text) => s"${name.padTo(width, ' ')}  $text") ++
      InfoCommand.statistics(stored.toImage.linear)

object InfoCommand:

  /** A table of the linear values of each channel. */
  private[cli] def statistics(image: Image): Vector[String] =
    val n = image.channels
    val rows = image.channelNames.zipWithIndex.map: (name, c) =>
      var least = Double.PositiveInfinity
      var most = Double.NegativeInfinity
      var sum = 0.0
      var nans = 0
      var infinities = 0
      loop(image.width * image.height): pixel =>
        val v = image.data(pixel * n + c).toDouble
        if v.isNaN then nans += 1
        else if v.isInfinite then infinities += 1
        else
          least = Math.min(least, v)
          most = Math.max(most, v)
          sum += v
      val finite = image.width * image.height - nans - infinities
      val figures =
        if finite == 0 then Vector("-", "-", "-")
        else Vector(least, most, sum / finite).map(Figures.scientific)
      (name +: figures) ++ Vector(nans.toString, infinities.toString)
    Comparison.aligned(Vector("channel", "least", "greatest", "mean", "NaN", "infinite") +: rows)

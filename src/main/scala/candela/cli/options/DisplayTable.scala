package candela.cli.options

import candela.cli.terminal.ThumbnailKind
import candela.color.ToneCurve
import candela.image.{Contents, DisplayTransform, Exposure, OutputFormat}

import scopt.{OParser, Read}

/** Options of pictures: how linear light is displayed. Each call makes new rows: scopt gives a row
  * one parent.
  */
private[cli] object DisplayTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private given Read[ThumbnailKind] = Read.reads: word =>
    ThumbnailKind.values.find(_.word.equalsIgnoreCase(word)).getOrElse:
      val known = ThumbnailKind.values.map(_.word).mkString(", ")
      throw IllegalArgumentException(s"expected one of $known")

  private def show[A](
      change: (A, DisplayTransform) => DisplayTransform
  ): (A, Options) => Options =
    setOutput((value, w) => w.copy(display = change(value, w.display)))

  private val pictures = OutputFormat.listed(Contents.Display)

  def options: Vector[Row] = shown :+ thumbnail

  /** All but those of the terminal. */
  def shown: Vector[Row] = Vector(
    opt[ToneCurve]("tonemap").valueName(ToneCurve.values.map(_.word).mkString("|"))
      .text(OptionText(
        s"tone curve of $pictures: " +
          ToneCurve.values.map(c => s"${c.word} (${c.meaning})").mkString(", ") +
          "; default linear",
        "[The curves and their sources](PICTURES.md)."
      ))
      .action(show((c, d) => d.copy(curve = c))),
    opt[Exposure]("exposure").valueName("STOPS")
      .text(s"scale of the light in $pictures, in stops; auto: the mean becomes middle grey")
      .action(show((e, d) => d.copy(exposure = e))),
    opt[Unit]("falsecolor")
      .text(s"show luminance in false colours in $pictures: from -6 to 6 stops about middle grey")
      .action(show((_, d) => d.copy(falseColor = true))),
    opt[Int]("bits").valueName("8|16")
      .text("bits per channel of .png (default 8)")
      .validate: n =>
        if n == 8 || n == 16 then success else failure(s"--bits must be 8 or 16, found `$n`")
      .action(show((n, d) => d.copy(bits = n))),
    opt[Unit]("dither")
      .text("round 8-bit values at random, which hides banding")
      .action(show((_, d) => d.copy(dithers = true)))
  )

  private def thumbnail: Row =
    opt[ThumbnailKind]("thumbnail").valueName(ThumbnailKind.values.map(_.word).mkString("|"))
      .text("show the image in the terminal, by this protocol; auto: what the terminal supports")
      .action((k, o) => o.copy(thumbnail = Some(k)))

package candela.cli

import candela.color.ToneCurve
import candela.image.{Contents, DisplayTransform, Exposure, OutputFormat}

import scopt.{OParser, Read}

/** Options of pictures: how linear light is displayed. Each call makes new rows: scopt gives a row
  * one parent.
  */
private[cli] object DisplayTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private given Read[ToneCurve] = Read.reads: word =>
    ToneCurve.values.find(_.word.equalsIgnoreCase(word)).getOrElse:
      throw IllegalArgumentException(s"expected ${ToneCurve.values.map(_.word).mkString(", ")}")

  private given Read[Exposure] = Read.reads: text =>
    if text.equalsIgnoreCase("auto") then Exposure.Auto
    else
      text.toFloatOption.filter(s => Math.abs(s) <= 100).map(Exposure.Stops(_)).getOrElse:
        throw IllegalArgumentException("expected stops, e.g. 1.5 or -2, or auto")

  private given Read[ThumbnailKind] = Read.reads: word =>
    ThumbnailKind.values.find(_.word.equalsIgnoreCase(word)).getOrElse:
      val known = ThumbnailKind.values.map(_.word).mkString(", ")
      throw IllegalArgumentException(s"expected one of $known")

  private def change(o: Options)(f: DisplayTransform => DisplayTransform): Options =
    o.copy(display = f(o.display))

  private val pictures = OutputFormat.listed(Contents.Display)

  def options: Vector[Row] = shown :+ thumbnail

  /** All but those of the terminal. */
  def shown: Vector[Row] = Vector(
    opt[ToneCurve]("tonemap").valueName("CURVE")
      .text(
        s"tone curve of $pictures: " +
          ToneCurve.values.map(c => s"${c.word} (${c.meaning})").mkString(", ") +
          "; default linear"
      )
      .action((c, o) => change(o)(_.copy(curve = c))),
    opt[Exposure]("exposure").valueName("STOPS")
      .text(s"scale of the light in $pictures, in stops; auto: the mean becomes middle grey")
      .action((e, o) => change(o)(_.copy(exposure = e))),
    opt[Unit]("falsecolor")
      .text(s"show luminance in false colours in $pictures: from -6 to 6 stops about middle grey")
      .action((_, o) => change(o)(_.copy(falseColor = true))),
    opt[Int]("bits").valueName("8|16")
      .text("bits per channel of .png (default 8)")
      .validate: n =>
        if n == 8 || n == 16 then success else failure(s"--bits must be 8 or 16, found `$n`")
      .action((n, o) => change(o)(_.copy(bits = n))),
    opt[Unit]("dither")
      .text("round 8-bit values at random, which hides banding")
      .action((_, o) => change(o)(_.copy(dithers = true)))
  )

  private def thumbnail: Row =
    opt[ThumbnailKind]("thumbnail").valueName("KIND")
      .text(
        "show the image in the terminal: " +
          s"${ThumbnailKind.values.map(_.word).mkString(", ")}; auto: what the terminal supports"
      )
      .action((k, o) => o.copy(thumbnail = Some(k)))

package candela.cli.options

import candela.cli.terminal.ThumbnailKind

import scopt.{OParser, Read}

/** Options of pictures: how linear light is displayed. Each call makes new rows: scopt gives a row
  * one parent.
  */
private[cli] object DisplayTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.opt

  private given Read[ThumbnailKind] = Read.reads: word =>
    ThumbnailKind.values.find(_.word.equalsIgnoreCase(word)).getOrElse:
      val kinds = ThumbnailKind.values.map(_.word).mkString(", ")
      throw IllegalArgumentException(s"expected one of $kinds")

  def options: Vector[Row] = imageRows ++ thumbnails

  /** All but those of the terminal. */
  def imageRows: Vector[Row] = settings("tonemap", "exposure", "falsecolor", "bits", "dither")

  def thumbnails: Vector[Row] = Vector(
    opt[ThumbnailKind]("thumbnail").valueName(ThumbnailKind.values.map(_.word).mkString("|"))
      .text("show the image in the terminal, by this protocol; auto: what the terminal supports")
      .action((k, o) => o.copy(thumbnail = Some(k)))
  )

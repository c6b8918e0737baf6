package candela.cli

import candela.build.sampling.PointChoice

import scopt.{OParser, Read}

/** Rows of the option table about samples. Each call makes new rows: scopt gives a row one
  * parent.
  */
private[cli] object PointTable:
  private given Read[PointChoice] = Read.reads: text =>
    PointChoice.all.find(_.word.equalsIgnoreCase(text)).getOrElse:
      throw IllegalArgumentException(s"expected one of ${words.mkString(", ")}")

  private def words: Vector[String] = PointChoice.all.map(_.word)

  def render: Vector[OParser[?, Options]] = Vector(
    OParser.builder[Options].opt[PointChoice]("sampler").valueName(words.mkString("|"))
      .text(
        "sample points: those with the least noise instead of the scene's (best, the default), " +
          "the scene's own, or these"
      )
      .action((p, o) => o.copy(points = p)),
    FireflyTable.row
  )

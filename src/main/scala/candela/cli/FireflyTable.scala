package candela.cli

import candela.film.Fireflies

import scopt.{OParser, Read}

/** The option about fireflies. Each call makes a new row: scopt gives a row one parent. */
private[cli] object FireflyTable:
  private given Read[Fireflies] = Read.reads: text =>
    val found = text.toLowerCase match
      case "keep" => Some(Fireflies.Kept)
      case "reweight" => Some(Fireflies.Reweighted)
      case s"clamp:$most" =>
        most.toFloatOption.filter(m => m > 0 && m < Float.PositiveInfinity).map(Fireflies.Clamped(
          _
        ))
      case _ => None
    found.getOrElse:
      throw IllegalArgumentException("expected keep, reweight, or clamp:X with X > 0")

  def row: OParser[?, Options] =
    OParser.builder[Options].opt[Fireflies]("fireflies").valueName("keep|reweight|clamp:X")
      .text(
        "less noise, but bias: leave out light that few samples have found, or limit each " +
          "sample's indirect light to X (default: keep)"
      )
      .action((f, o) => o.copy(fireflies = f))

  /** The option as words of a command line; none if nothing is done. */
  def words(fireflies: Fireflies): Vector[String] = fireflies match
    case Fireflies.Kept => Vector.empty
    case Fireflies.Reweighted => Vector("--fireflies", fireflies.word)
    case Fireflies.Clamped(most) => Vector("--fireflies", s"${fireflies.word}:$most")

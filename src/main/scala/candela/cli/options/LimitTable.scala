package candela.cli.options

import candela.diagnostics.Limit
import candela.settings.SceneLimits

import scopt.{OParser, Read}

/** Rows of the option table. Each call makes new rows: scopt gives a row one parent. */
private[cli] object LimitTable:
  private val b = OParser.builder[Options]
  import b.opt

  private final case class Changed(limit: Limit, bound: Option[Long])

  private given Read[Changed] = Read.reads: text =>
    val (name, value) = text.trim.span(_ != '=')
    val limit = Limit.values.find(_.word.equalsIgnoreCase(name)).getOrElse:
      throw UsageErrors.unread(s"NAME=N with a NAME of $names", text)
    val amount = value.drop(1).trim
    if amount.equalsIgnoreCase("none") then Changed(limit, None)
    else
      val bound = SceneLimits.form(limit).read(amount)
      Changed(limit, Some(bound.getOrElse(throw UsageErrors.unread(expected(limit), text))))

  private def names: String = Limit.values.map(_.word).mkString(", ")

  private def expected(limit: Limit): String = limit match
    case Limit.Time => "a duration, e.g. time=90s, time=10m or time=none"
    case Limit.Bytes => "a size, e.g. bytes=500MB, bytes=2GB or bytes=none"
    case other => s"a number, e.g. ${other.word}=1000, ${other.word}=20M or ${other.word}=none"

  private def limiting(o: Options)(change: SceneLimits => SceneLimits): Options =
    o.controlling(c => c.copy(limits = change(c.limits)))

  def options: Vector[OParser[?, Options]] = Vector(
    opt[Unit]("sandbox")
      .text(OptionText(
        "for untrusted scenes: read only files of the scene's folder, write only there or beside " +
          "--outfile, and apply the limits of --limit",
        "[What it guarantees](../SECURITY.md)."
      ))
      .action((_, o) => limiting(o)(_.copy(sandbox = true))),
    opt[Seq[Changed]]("limit").unbounded().valueName("NAME=N[,NAME=N]")
      .text(
        s"fail at more than N $names, e.g. bytes=2GB,time=10m " +
          s"(default: none; with --sandbox: ${defaults})"
      )
      .action: (all, o) =>
        limiting(o)(l => l.copy(changed = l.changed ++ all.map(c => c.limit -> c.bound)))
  )

  /** Those of the sandbox, as the option takes them. */
  private[cli] def defaults: String = Limit.values.map: limit =>
    val bound = limit.inSandbox
    val text = limit match
      case Limit.Time => s"${bound / 60_000}m"
      case Limit.Bytes => s"${bound / 1_000_000_000}GB"
      case _ if bound % 1_000_000 == 0 => s"${bound / 1_000_000}M"
      case _ => bound.toString
    s"${limit.word}=$text"
  .mkString(", ")

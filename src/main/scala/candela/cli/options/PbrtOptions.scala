package candela.cli.options

import candela.base.Decimal
import candela.build.recipe.Dialects
import candela.scenefile.Dialect
import candela.scenefile.Dialect.*

import java.util.Locale

/** What an option of pbrt's command line is here. */
enum Here:
  /** The same option, by the same name. */
  case Same(note: String = "")

  /** These options. */
  case As(words: String*)

  /** Accepted, without effect, which is said if `isTold`.
    *
    * @param values all that pbrt takes; empty: any
    */
  case Ignored(reason: String, isTold: Boolean = false, values: Vector[String] = Vector.empty)

  /** An error that says what to write instead. */
  case Refused(instead: String)

/** An option of pbrt's command lines.
  *
  * @param name  without dashes
  * @param value shown for what follows it; empty: nothing does
  */
final case class PbrtOption(name: String, value: String, dialects: Set[Dialect], here: Here):
  def usage: String = if value.isEmpty then s"--$name" else s"--$name $value"
  def takesValue: Boolean = value.nonEmpty

/** All options of the command lines of pbrt-v2, v3 and v4: the table of docs/PBRT-OPTIONS.md. */
object PbrtOptions:
  import Here.*

  private val LogLevel = Ignored(
    "warnings and errors are printed; `--verbose`: more",
    values = Vector("verbose", "error", "fatal")
  )
  private val Space =
    Ignored(
      "it affects rounding, and instances that turn: write `Option \"rendercoordsys\"` in the " +
        "scene",
      values = Vector("camera", "cameraworld", "world")
    )

  private val all3 = Dialect.ofPbrt.toSet
  private val fine = Same()

  private def v4(name: String, value: String, here: Here) = PbrtOption(name, value, Set(V4), here)
  private def v3(name: String, value: String, here: Here) = PbrtOption(name, value, Set(V3), here)

  val all: Vector[PbrtOption] = Vector(
    PbrtOption("outfile", "FILE", all3, Same("several scenes are several images here")),
    PbrtOption("quick", "", all3, Same("as in v4: a quarter of width and height, one sample")),
    PbrtOption("quiet", "", all3, fine),
    PbrtOption("verbose", "", Set(V2), fine),
    PbrtOption("help", "", all3, fine),
    PbrtOption("ncores", "N", Set(V2), As("--nthreads", "N")),
    PbrtOption("nthreads", "N", Set(V3, V4), fine),
    PbrtOption("cropwindow", "x0,x1,y0,y1", Set(V3, V4), Same("also with spaces, as v3 reads it")),
    PbrtOption("toply", "", Set(V3, V4), As("convert", "--to-ply", "1")),
    v3("cat", "", As("convert")),
    v3("logdir", "DIR", Ignored("no log files are written", isTold = true)),
    v3("logtostderr", "", Ignored("messages go to standard error anyway")),
    v3("minloglevel", "N", Ignored("warnings and errors are printed; `--quiet`: errors only")),
    v3("v", "N", As("--verbose")),
    v4("format", "", As("convert")),
    v4("upgrade", "", As("convert", "--to", "v4")),
    v4("debugstart", "VALUES", Refused("--pixel x,y --sample N --debug traces one sample")),
    v4("disable-image-textures", "", fine),
    v4("disable-pixel-jitter", "", fine),
    v4("disable-texture-filtering", "", fine),
    v4("disable-wavelength-jitter", "", Same("without effect where colours are three numbers")),
    v4("displacement-edge-scale", "X", fine),
    v4("display-server", "HOST:PORT", fine),
    v4("force-diffuse", "", fine),
    v4("fullscreen", "", Refused("--watch shows the image while it is rendered")),
    v4("gpu", "", Ignored("the image is the same; it is rendered by processors", isTold = true)),
    v4("gpu-device", "N", Ignored("rendering takes no GPU", isTold = true)),
    v4("interactive", "", Refused("`candela move` moves the camera on a page in the browser")),
    v4("log-file", "FILE", Ignored("messages go to standard error: `2> FILE`", isTold = true)),
    v4("log-level", "LEVEL", LogLevel),
    v4("log-utilization", "", Ignored("`--report` shows what the threads did", isTold = true)),
    v4("mse-reference-image", "FILE", fine),
    v4("mse-reference-out", "FILE", Same("at 1, 2, 4, 8, … samples per pixel")),
    v4("pixel", "x,y", Same("with `--debug`: traces one sample of it")),
    v4("pixelbounds", "x0,x1,y0,y1", fine),
    v4("pixelmaterial", "x,y", Same("the first surface that is no interface")),
    v4(
      "pixelstats",
      "",
      Refused("--aov variance shows where the noise is, and --report what rendering does")
    ),
    v4("render-coord-sys", "NAME", Space),
    v4("seed", "N", fine),
    v4("spp", "N", fine),
    v4("stats", "", As("--verbose")),
    v4("wavefront", "", Ignored("the image is the same: there is one renderer")),
    v4("write-partial-images", "", Same("at 1, 2, 4, 8, … samples per pixel"))
  )

  /** As pbrt-v4 compares names: without case and dashes. */
  private def plain(name: String): String =
    name.filter(c => c != '-' && c != '_').toLowerCase(Locale.ROOT)

  private val byName: Map[String, PbrtOption] = all.map(o => plain(o.name) -> o).toMap

  /** A command line in our words.
    *
    * @param command other than rendering, if an option asks for one
    * @param notes   what is ignored
    */
  final case class Translated(
      command: Option[String],
      words: Vector[String],
      notes: Vector[String]
  )

  /** Translates pbrt's words; the error says what to write instead of an option. */
  def translate(args: Seq[String]): Either[String, Translated] =
    val words = Vector.newBuilder[String]
    val notes = Vector.newBuilder[String]
    var command = Option.empty[String]
    var remaining = args.toList
    var problem = Option.empty[String]
    while remaining.nonEmpty && problem.isEmpty do
      val word = remaining.head
      remaining = remaining.tail
      val (name, joined) = word.split("=", 2) match
        case Array(n, value) => (n, Some(value))
        case _ => (word, None)
      option(name) match
        case None => words += word
        case Some(known) if !known.takesValue && joined.exists(_ != "true") =>
          if !joined.contains("false") then words += word
        case Some(known) =>
          val value = joined.toList ++ (
            if known.takesValue && joined.isEmpty then remaining.take(valuesOf(known, remaining))
            else Nil
          )
          if known.takesValue && joined.isEmpty then remaining = remaining.drop(value.size)
          known.here match
            case Same(_) if !known.takesValue => words += s"--${known.name}"
            case Same(_) => words ++= Vector(s"--${known.name}", value.mkString(","))
            case Ignored(_, _, values) if values.nonEmpty && !value.exists(values.contains) =>
              val actual = value.headOption.fold("but has no value")(v => s"found `$v`")
              val accepted = s"${values.init.mkString(", ")} or ${values.last}"
              problem = Some(s"--${known.name} must be $accepted, $actual")
            case Ignored(reason, isTold, _) =>
              if isTold then notes += s"--${known.name} has no effect: $reason"
            case Refused(instead) =>
              problem = Some(s"--${known.name} is an option of pbrt; here, $instead")
            case As("convert", others*) =>
              command = Some("convert")
              words ++= others
            case As(ours*) =>
              words ++= ours.map(w => if w == known.value then value.mkString else w)
    problem.toLeft(Translated(command, words.result(), notes.result()))

  private def option(word: String): Option[PbrtOption] =
    // "-j" and "-v" are short options; a single dash is pbrt's, too
    val isOption = word.startsWith("--") || (word.startsWith("-") && word.length > 2)
    if isOption then byName.get(plain(word)) else None

  /** Number of words that an option's value takes: four, if a crop window has spaces. */
  private def valuesOf(option: PbrtOption, remaining: List[String]): Int =
    val numbers = remaining.take(4)
    val hasSpaces = option.name == "cropwindow" && numbers.size == 4 &&
      numbers.forall(Decimal.float(_).isDefined)
    if hasSpaces then 4 else 1

  /** docs/PBRT-OPTIONS.md. */
  def page: String =
    val rows = all.map: o =>
      val meaning = o.here match
        case Same("") => "the same"
        case Same(note) => s"the same; $note"
        case As(words*) => s"`${words.mkString(" ")}`"
        case Ignored(reason, _, _) => s"accepted, without effect: $reason"
        case Refused(instead) => s"rejected: $instead"
      val versions = Dialect.ofPbrt.filter(o.dialects).map(Dialects.name).mkString(" ")
      s"| `${o.usage}` | $versions | $meaning |"
    (Introduction +: rows :+ "").mkString("\n")

  private val Introduction =
    """# pbrt's command lines
      |
      |`candela` takes the command lines of pbrt-v2, v3 and v4. This page has all of their options;
      |it is generated: `./sbt "run describe --pbrt-options --outfile docs/PBRT-OPTIONS.md"`. As in
      |pbrt-v4, case, dashes within a name and a second dash in front don't matter:
      |`-disablePixelJitter`.
      |
      |Several scene files are several images here; in pbrt they are one scene.
      |
      || option | pbrt | here |
      ||---|---|---|""".stripMargin

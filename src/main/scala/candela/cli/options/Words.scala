package candela.cli.options

import candela.diagnostics.Limit
import candela.aov.Layer
import candela.build.Language
import candela.image.OutputFormat
import candela.job.SceneFormat
import candela.render.storage.FilmFile

import scopt.OptionDef

/** What may stand at a place of a command line: shells offer it. */
private[candela] enum Words:
  /** Files with these suffixes, or with any if there are none; and folders. */
  case Files(suffixes: Vector[String])
  case Folders

  /** One of these words. */
  case Of(words: Vector[String])

  /** Several of these words, parted by commas. */
  case Listed(words: Vector[String])
  case Anything

  /** Categories of statements: naming them takes all recipes, which other commands don't need. */
  case Categories

  /** The same, by its words. */
  def named: Words = this match
    case Categories => Of(Language.categories.map(_.name.takeWhile(_ != ' ')).distinct)
    case other => other

private[candela] object Words:
  val shells: Vector[String] = Vector("bash", "zsh", "fish", "powershell")

  val scenes: Words = Files(SceneFormat.all.flatMap(_.suffixes).flatMap(s => Vector(s, s"$s.gz")))
  val films: Words = Files(Vector(FilmFile.Suffix))

  /** Those of images that are written or read. */
  val imageSuffixes: Vector[String] =
    val written = OutputFormat.all.flatMap(f => f.suffix +: f.aliases)
    (written ++ Vector("hdr", "bmp", "gif", "ppm", "psd")).distinct
  val images: Words = Files(imageSuffixes :+ FilmFile.Suffix)

  /** The value of an option, by what its help calls it; None: it has no value. */
  def of(option: OptionDef[?, Options]): Option[Words] = option.valueName.map:
    case "FOLDER" | "[FOLDER]" => Folders
    case s"[FILE.$suffix]" => Files(Vector(suffix))
    case name if name.contains("FILE") => Files(Vector.empty)
    case s"LAYER$_" => Listed(Layer.values.toVector.map(_.word))
    case s"NAME=N$_" => Listed(Limit.values.toVector.map(l => s"${l.word}="))
    case name if name.contains('|') =>
      Of(name.split('|').toVector.filterNot(_.exists(_.isUpper)) ++
        name.split('|').collect { case s"$word:X" => s"$word:" })
    case _ => Anything

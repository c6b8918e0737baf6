package candela.cli.options

import candela.base.ByteCount
import java.nio.file.{Files, InvalidPathException, Path}

import candela.job.SceneFormat
import candela.settings.{TextForm, TextureControl}

import scala.util.Try

import scopt.{OParser, Read}

/** Rows of the option table on image textures. Each call makes new rows: scopt gives a row one
  * parent.
  */
private[cli] object TextureTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private given Read[Path] = Read.reads: text =>
    try Path.of(text)
    catch
      case e: InvalidPathException =>
        throw IllegalArgumentException(s"expected a folder: ${e.getReason}")

  /** A cache of this size holds more than the tiles that one lookup needs. */
  private val MinBytes = 1_000_000L

  private def updating[A](change: (A, TextureControl) => TextureControl): (A, Options) => Options =
    (value, o) => o.controlling(c => c.copy(textures = change(value, c.textures)))

  /** Whether a word after `--scene-cache` is its folder, and not a scene or an option. */
  def isFolder(word: String): Boolean =
    def isOther(file: Path) =
      SceneFormat.named(file).nonEmpty || (Files.exists(file) && !Files.isDirectory(file))
    word.nonEmpty && !word.startsWith("-") && !Try(Path.of(word)).toOption.exists(isOther)

  /** Of prepared scenes. */
  def scenes: Vector[Row] = Vector(
    opt[Option[Path]]("scene-cache").valueName("[FOLDER]")
      .text(OptionText(
        "cache meshes, hierarchies and tables of environment maps for later renderings, in the " +
          "texture cache's folder or another one",
        "The image is the same: [the scene cache](FILMS.md#the-scene-cache)."
      ))
      .action((folder, o) => o.copy(keepsScenes = true, sceneFolder = folder))
  )

  def options: Vector[Row] = Vector(
    opt[Long]("texture-memory")(using reading(TextForm.size)).valueName("SIZE")
      .text(OptionText(
        "memory for textures and environment maps, e.g. 500M or 2G; larger ones are read in " +
          "tiles, from a cache (default: an eighth of the heap, at most 1G)",
        "The image is the same: [textures](TEXTURES.md)."
      ))
      .validate: n =>
        if n >= MinBytes then success
        else failure(s"--texture-memory must be at least 1M, found ${ByteCount.format(n)}")
      .action(updating((n, t) => t.copy(memory = Some(n)))),
    opt[Path]("texture-cache").valueName("FOLDER")
      .text(OptionText(
        "folder of the texture cache (default: candela/textures in the user's cache folder)",
        "It may be deleted at any time: [textures](TEXTURES.md#the-cache)."
      ))
      .validate: folder =>
        if folder.toString.nonEmpty then success
        else failure("--texture-cache must be a folder, found an empty name")
      .action(updating((f, t) => t.copy(folder = Some(f)))),
    opt[Long]("texture-cache-size")(using reading(TextForm.size)).valueName("SIZE")
      .text(OptionText(
        "maximum size of the texture cache; the least recently used files are deleted " +
          "(default 20G)",
        "Files of the current run stay until the next file is written."
      ))
      .action(updating((n, t) => t.copy(folderSize = n)))
  )

package candela.suite

import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** Scenes with changed text, in folders of their own that hold links to all that lay beside the
  * original: names of files within a scene stay right, and the original is left alone.
  */
final class SceneCopy(scratch: Path):
  private var count = 0

  /** The scene as it is if there is nothing to change. */
  def of(scene: Path, edits: Vector[Edit], fill: String => String): Path =
    if edits.isEmpty then scene
    else
      val text = edits.foldLeft(SceneCopy.read(scene)): (text, edit) =>
        edit.find.replaceAllIn(text, fill(edit.replacement))
      count += 1
      val folder = Files.createDirectory(scratch.resolve(s"scene-$count"))
      Using.resource(Files.list(scene.toAbsolutePath.getParent)): files =>
        for file <- files.iterator.asScala if file.getFileName != scene.getFileName do
          Files.createSymbolicLink(folder.resolve(file.getFileName), file)
      Files.writeString(folder.resolve(scene.getFileName), text, ISO_8859_1)

object SceneCopy:

  /** Each byte as one character: what isn't edited stays as it is, whatever it means. */
  private def read(scene: Path): String = Files.readString(scene, ISO_8859_1)

  /** Edits that find nothing: the program would render another scene than it should. */
  def useless(scene: Path, edits: Vector[Edit]): Option[Edit] =
    if edits.isEmpty then None
    else
      val text = read(scene)
      edits.find(_.find.findFirstIn(text).isEmpty)

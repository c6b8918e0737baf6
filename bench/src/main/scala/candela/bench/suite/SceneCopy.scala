package candela.bench.suite

import candela.io.WholeFile
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** Edited copies of scenes, in folders with links to everything beside the original: file names
  * within the scene stay valid, and the original unchanged.
  */
final class SceneCopy(scratch: Path):
  private var count = 0

  /** The original scene if there are no edits. */
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
      val copy = folder.resolve(scene.getFileName)
      WholeFile.write(copy, text.getBytes(ISO_8859_1))
      copy

object SceneCopy:

  /** Decodes each byte as one character, which preserves whatever isn't edited. */
  private def read(scene: Path): String = Files.readString(scene, ISO_8859_1)

  /** An edit without a match: the program would render a scene other than intended. */
  def useless(scene: Path, edits: Vector[Edit]): Option[Edit] =
    if edits.isEmpty then None
    else
      val text = read(scene)
      edits.find(_.find.findFirstIn(text).isEmpty)

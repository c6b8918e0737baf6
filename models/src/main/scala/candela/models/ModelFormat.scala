package candela.models

import candela.io.{SceneFolder, Sha256}
import candela.job.SceneFormat
import candela.scenefile.{Defines, SceneDescription}
import candela.settings.ReadSettings

import java.nio.file.Path

/** Formats of models: their files have no parameters, and name no image. */
abstract class ModelFormat private[models] (name: String, suffixes: Vector[String])
    extends SceneFormat(name, suffixes):
  def hasDialects: Boolean = false
  def keepsMeshesApart: Boolean = true
  def worlds: String = "images"
  def firstWorld: Int = 0
  override def isModel: Boolean = true

  /** @param world number of the image */
  private[models] def model(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String]
  ): SceneDescription

  protected def readable(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String],
      usedByCamera: Set[String]
  ): SceneDescription =
    Defines(reading.defines, usedByCamera).requireUse()
    model(file, within, reading, world, text)

  def digest(text: String): String = Sha256.of(text)

  def imageName(file: Path, within: SceneFolder, reading: ReadSettings): Option[Option[String]] =
    Some(None)

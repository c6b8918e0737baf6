package candela.models

import candela.io.{ForeignKind, SceneFolder, Sha256}
import candela.job.SceneFormat
import candela.scenefile.SceneDescription
import candela.settings.ReadSettings

import java.nio.file.Path

/** Models in glTF 2.0, as scenes. */
final class GltfFormat extends SceneFormat("glTF", Vector("glb", "gltf")):
  def hasDialects: Boolean = false
  override def owns(kind: ForeignKind): Boolean = kind == ForeignKind.Model
  def keepsMeshesApart: Boolean = true
  def worlds: String = "scenes"
  def firstWorld: Int = 0

  def read(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String]
  ): SceneDescription =
    checkSensors(file, reading)
    GltfScene.readable(file, within, reading, text)

  def digest(text: String): String = Sha256.of(text)

  def imageName(file: Path, within: SceneFolder, reading: ReadSettings): Option[Option[String]] =
    Some(None)

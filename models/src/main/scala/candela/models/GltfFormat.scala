package candela.models

import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{ForeignKind, SceneFolder, Sha256}
import candela.job.SceneFormat
import candela.scenefile.SceneDescription
import candela.settings.{ReadSettings, Sensors}

import java.nio.file.Path

/** Models in glTF 2.0, as scenes. */
final class GltfFormat extends SceneFormat("glTF", Vector("glb", "gltf")):
  def hasDialects: Boolean = false
  override def owns(kind: ForeignKind): Boolean = kind == ForeignKind.Model
  def keepsMeshesApart: Boolean = true
  def worlds: String = "images"
  def firstWorld: Int = 0

  def read(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String]
  ): SceneDescription =
    checkOptions(file, reading, hasSensors = true, isModel = true)
    if reading.model.turntable.nonEmpty && reading.sensors.contains(Sensors.All) then
      val help = "render a turntable of each: --sensor 0, --sensor 1 …"
      throw SceneError(Problem.general(
        Code.OptionMisfit,
        "a turntable is of one camera",
        Some(help)
      ))
    val scene = GltfScene.readable(file, within, reading, text, world.getOrElse(0))
    scene.copy(isFollowed = scene.isFollowed && world.isDefined)

  def digest(text: String): String = Sha256.of(text)

  def imageName(file: Path, within: SceneFolder, reading: ReadSettings): Option[Option[String]] =
    Some(None)

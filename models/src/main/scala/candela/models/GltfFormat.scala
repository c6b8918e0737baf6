package candela.models

import candela.diagnostics.{Code, Problem, Severity}
import candela.io.{ForeignKind, SceneFolder, Sha256}
import candela.job.SceneFormat
import candela.scenefile.{Defines, SceneDescription}
import candela.settings.{ReadSettings, Sensors}

import java.nio.file.Path

/** Models in glTF 2.0, as scenes. */
final class GltfFormat extends SceneFormat("glTF", Vector("glb", "gltf")):
  def hasDialects: Boolean = false
  override def owns(kind: ForeignKind): Boolean = kind == ForeignKind.Model
  def keepsMeshesApart: Boolean = true
  def worlds: String = "images"
  def firstWorld: Int = 0
  override def hasSensors: Boolean = true
  override def isModel: Boolean = true
  override def hasStates: Boolean = true

  protected def readable(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String]
  ): SceneDescription =
    Defines(reading.defines).requireUse()
    val scene =
      GltfScene.readable(file, within, reading, text, sensor(reading, world), world.getOrElse(0))
    val hasNext = reading.model.hasSeveralImages || reading.sensors.contains(Sensors.All)
    val firstOnly = Option.when(world.isEmpty && reading.model.state.times.exists(_.count > 1)):
      val message = "--at has several times; this is about the first"
      Problem(Code.SeveralWorlds, Severity.Warning, None, message)
    scene.copy(
      isFollowed = scene.isFollowed && world.isDefined && hasNext,
      warnings = scene.warnings ++ firstOnly
    )

  def digest(text: String): String = Sha256.of(text)

  def imageName(file: Path, within: SceneFolder, reading: ReadSettings): Option[Option[String]] =
    Some(None)

package candela.models

import candela.diagnostics.{Code, Problem, Severity}
import candela.io.{ForeignKind, SceneFolder}
import candela.scenefile.SceneDescription
import candela.settings.{ReadSettings, Sensors}

import java.nio.file.Path

/** Models in glTF 2.0, as scenes. */
final class GltfFormat extends ModelFormat("glTF", Vector("glb", "gltf")):
  override def owns(kind: ForeignKind): Boolean = kind == ForeignKind.Model
  override def hasSensors: Boolean = true
  override def hasStates: Boolean = true

  private[models] def model(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String]
  ): SceneDescription =
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

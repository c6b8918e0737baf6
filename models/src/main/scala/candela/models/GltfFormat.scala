package candela.models

import candela.io.{ForeignKind, SceneFolder}
import candela.scenefile.SceneDescription
import candela.settings.{ReadSettings, Sensors}

import java.nio.file.Path

/** Models in glTF 2.0, as scenes. */
final class GltfFormat extends NodeFormat("glTF", Vector("glb", "gltf")):
  override def owns(kind: ForeignKind): Boolean = kind == ForeignKind.Model

  private[models] def read(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      text: Option[String]
  )(describe: (GltfFile, Session) => SceneDescription): SceneDescription =
    val session = Session(file, within, reading.keepGoing, reading.resolution)
    describe(text.fold(GltfFile.read(session))(GltfFile.ofText(session, _)), session)

/** Formats of models that may have cameras, lights and animations: they are read as glTF is. */
abstract class NodeFormat private[models] (name: String, suffixes: Vector[String])
    extends ModelFormat(name, suffixes):
  override def hasSensors: Boolean = true
  override def hasStates: Boolean = true

  /** The scene that `describe` makes of a file, which is closed then. */
  private[models] def read(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      text: Option[String]
  )(describe: (GltfFile, Session) => SceneDescription): SceneDescription

  private[models] final def model(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String]
  ): SceneDescription =
    val scene = read(file, within, reading, text): (opened, session) =>
      GltfScene.readable(
        opened,
        session,
        reading,
        sensor(reading, world),
        world.getOrElse(0)
      )
    val hasNext = reading.model.hasSeveralImages || reading.sensors.contains(Sensors.All)
    scene.copy(isFollowed = scene.isFollowed && hasNext)

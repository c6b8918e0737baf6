package candela.models.assimp

import candela.diagnostics.{Code, Refusal}
import candela.image.{MissingNatives, Natives}
import candela.io.{FileName, ForeignKind, IoReason, SceneFolder}
import candela.job.MissingFormats
import candela.models.{GltfFile, MeshFormat, NodeFormat, Session}
import candela.scenefile.SceneDescription
import candela.settings.{ReadSettings, UpAxis}

import org.lwjgl.assimp.{AIScene, Assimp}
import org.lwjgl.system.MemoryUtil

import java.io.IOException
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path

/** Models in the formats of Assimp, the Open Asset Import Library, as scenes. Its native code has
  * the rights of the program, and damaged files may crash it: it is for trusted files alone.
  */
final class AssimpFormat extends NodeFormat("Assimp", MissingFormats.OfAssimp):
  import AssimpFormat.*

  override def owns(kind: ForeignKind): Boolean = true
  override def leavesUpOpen: Boolean = true

  private[models] def read(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      text: Option[String]
  )(describe: (GltfFile, Session) => SceneDescription): SceneDescription =
    if within.isConfined then throw new Refusal(MissingFormats.unconfined(file))
    val suffix = FileName.suffix(file)
    val defaultAxis = if UpwardZ(suffix) then UpAxis.Z else UpAxis.Y
    val native = imported(file, suffix, within, text)
    lazy val session: Session =
      Session(file, within, reading.keepGoing, reading.resolution, p => scene.label(p))
    lazy val scene: AssimpScene =
      AssimpScene(native, session, suffix, reading.model.up.getOrElse(defaultAxis))
    try
      val described = describe(scene.file, session)
      if SaysUp(suffix) then described
      else MeshFormat.withAxis(described, reading.model.up, defaultAxis)
    finally Assimp.aiReleaseImport(native)

private object AssimpFormat:
  /** Of formats whose axes Assimp leaves as they are: those whose z usually points up. */
  private val UpwardZ = Set("3mf", "amf", "off")

  /** Of formats whose files say which axis points up. */
  private val SaysUp = Set("fbx", "dae", "zae")

  private val Steps = Assimp.aiProcess_Triangulate | Assimp.aiProcess_JoinIdenticalVertices |
    Assimp.aiProcess_SortByPType | Assimp.aiProcess_LimitBoneWeights |
    Assimp.aiProcess_ValidateDataStructure | Assimp.aiProcess_FindInvalidData |
    Assimp.aiProcess_GenUVCoords | Assimp.aiProcess_TransformUVCoords | Assimp.aiProcess_FlipUVs

  private def fail(file: Path, code: Code, message: String, help: Option[String] = None) =
    Session.fail(Session(file, SceneFolder.Nowhere, false).position, message, code, help)

  /** A file by its name, so that Assimp finds those that belong to it; a text by its bytes. */
  private def imported(
      file: Path,
      suffix: String,
      within: SceneFolder,
      text: Option[String]
  ): AIScene =
    try
      Natives.require("assimp", "assimp")
      val input = within.scene(file)
      if text.isEmpty && input.isRegular then
        input.unpacks(input.size)
        input.digest(): Unit
        checked(file, Assimp.aiImportFile(file.toString, Steps))
      else
        val bytes = text.fold(input.bytes())(_.getBytes(UTF_8))
        val buffer = MemoryUtil.memAlloc(bytes.length)
        try
          buffer.put(bytes).flip()
          checked(file, Assimp.aiImportFileFromMemory(buffer, Steps, suffix))
        finally MemoryUtil.memFree(buffer)
    catch
      case e: MissingNatives => fail(file, Code.MissingLibrary, e.getMessage, Some(e.help))
      case e: IOException =>
        fail(file, Code.Unreadable, s"can't read the model: ${IoReason(e)}")

  private def checked(file: Path, scene: AIScene | Null): AIScene =
    if scene == null then
      fail(file, Code.DamagedMesh, s"Assimp can't read the model: ${Assimp.aiGetErrorString}")
    else if scene.mRootNode == null then
      fail(file, Code.NoSurface, "the model has no nodes")
    else scene

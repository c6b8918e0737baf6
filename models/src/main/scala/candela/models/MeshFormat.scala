package candela.models

import candela.color.{Encoding, Rgb}
import candela.diagnostics.SourcePos
import candela.io.{ForeignKind, InputFile, SceneFolder}
import candela.math.Transform
import candela.scenefile.{Dialect, GraphicsState, MaterialRef, SceneDescription, ShapeDescription}
import candela.settings.{ReadSettings, UpAxis}

import java.nio.ByteBuffer
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path
import java.util.Locale

/** Formats of models that have neither camera nor light, and leave open which axis points up.
  *
  * @param up the axis that usually does
  */
abstract class MeshFormat private[models] (name: String, suffix: String, up: UpAxis)
    extends ModelFormat(name, Vector(suffix)):
  override def owns(kind: ForeignKind): Boolean = kind match
    case ForeignKind.Model | ForeignKind.Triangles | ForeignKind.Other => true
    case _ => false
  override def isMesh: Boolean = true

  /** Shapes and materials of a file. */
  private[models] def surfaces(input: InputFile, session: Session): SceneDescription

  private[models] def model(
      file: Path,
      within: SceneFolder,
      reading: ReadSettings,
      world: Option[Int],
      text: Option[String]
  ): SceneDescription =
    val session = Session(file, within, reading.keepGoing, reading.resolution)
    val input = text.fold(within.scene(file))(MeshFormat.inMemory(file, within, _))
    val axis = reading.model.up.getOrElse(up)
    val turned = MeshFormat.upright(surfaces(input, session), axis)
    val complete =
      Studio.complete(turned, session, reading, world.getOrElse(0), isWhole = false)
    val scene = MeshFormat.withAxis(session.finished(complete), reading.model.up, up)
    scene.copy(isFollowed = scene.isFollowed && reading.model.turntable.nonEmpty)

private[models] object MeshFormat:
  /** Of surfaces without a material: that of Blender's. */
  val Gray = 0.8f

  private def inMemory(file: Path, within: SceneFolder, text: String): InputFile =
    val name = s"$file"
    within.withParts(Map(name -> ByteBuffer.wrap(text.getBytes(UTF_8)))).part(name).get

  /** From Blender's axes, which are those of most CAD: z is up, −y the front. */
  val Upright: Transform = Transform.rotate(-90, 1, 0, 0).get

  private def upright(scene: SceneDescription, axis: UpAxis): SceneDescription = axis match
    case UpAxis.Y => scene
    case UpAxis.Z =>
      val turn = GraphicsState.constant(Upright)
      scene.copy(shapes = scene.shapes.map(_.copy(objectToWorld = turn)))

  /** Tells which axis points up, unless it was asked for.
    *
    * @param usual the axis that does
    */
  def withAxis(
      scene: SceneDescription,
      asked: Option[UpAxis],
      usual: UpAxis
  ): SceneDescription =
    val opposite = if usual == UpAxis.Y then UpAxis.Z else UpAxis.Y
    def word(a: UpAxis) = a.toString.toLowerCase(Locale.ROOT)
    val upward = Option.when(asked.isEmpty):
      val turned = if usual == UpAxis.Z then ", turned to y" else ""
      s"${word(usual)} points up$turned: --up ${word(opposite)} changes that"
    scene.copy(additions = Some((scene.additions ++ upward).mkString("; ")).filter(_.nonEmpty))

  def shape(mesh: Mesh, surface: Surface, at: SourcePos, session: Session): ShapeDescription =
    ShapeDescription(
      session.declare("Shape", "trianglemesh", at, mesh.params(at) ++ surface.shape),
      GraphicsState.Identity,
      reverseOrientation = false,
      surface.material,
      surface.emission,
      insideMedium = surface.interior
    )

  /** A matte surface of an image and the colours of the vertices, if there are such. */
  def plain(
      hasColors: Boolean,
      pictures: Pictures,
      at: SourcePos,
      session: Session,
      image: Option[Picture] = None
  ): Surface =
    val tint = if hasColors || image.nonEmpty then Rgb.White else Rgb.gray(Gray)
    val color = pictures.colorOf("reflectance", tint, image, at, hasColors)
    val d = session.declare("Material", "diffuse", at, Vector(color))
    Surface(MaterialRef.Inline(d), Vector.empty, None, "")

  /** The scene of one mesh without materials. */
  def scene(mesh: Mesh, session: Session): SceneDescription =
    scene(Vector(mesh -> None), Pictures(session), session)

  /** The scene of meshes without materials, which may have images. */
  def scene(
      meshes: Vector[(Mesh, Option[Picture])],
      pictures: Pictures,
      session: Session
  ): SceneDescription =
    val at = session.position
    val shapes = meshes.map: (mesh, image) =>
      val surface = plain(mesh.colors.nonEmpty, pictures, at, session, image)
      val isVeiled = (3 until mesh.colors.length by 4).exists(mesh.colors(_) < 1f)
      val alpha = Option.when(isVeiled)(pictures.numberOf("alpha", 1, None, "a", at, true))
      shape(mesh, surface.copy(shape = alpha.toVector), at, session)
    SceneDescription(Dialect.Gltf, textures = pictures.result(), shapes = shapes)

  /** The linear value of an sRGB component, as files of meshes have them. */
  def linear(x: Float): Float = Encoding.Srgb.decode(Math.max(0f, Math.min(x, 1f)))

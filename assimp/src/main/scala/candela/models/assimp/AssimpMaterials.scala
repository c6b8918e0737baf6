package candela.models.assimp

import candela.base.loop
import candela.diagnostics.{Code, SourcePos}
import candela.models.{MtlMap, MtlMaterial, Session, WebPImages, Wraps}

import org.lwjgl.assimp.*
import org.lwjgl.assimp.Assimp.*

import java.awt.image.BufferedImage
import java.nio.ByteBuffer
import java.util.Locale

/** Materials of Assimp as those of MTL, which has the same: colours, exponents of Phong, roughness,
  * and an image of each.
  *
  * Source of what is FBX's own: Blender 5.0, scripts/addons_core/io_scene_fbx/import_fbx.py.
  */
private[assimp] final class AssimpMaterials(scene: AIScene, session: Session, suffix: String):
  import AssimpMaterials.*

  private val isFbx = suffix == "fbx"
  private val embedded = Arrays.all(scene.mTextures)(AITexture.create)

  /** Names of the images in the file. */
  private val names =
    embedded.zipWithIndex.map: (t, i) =>
      val kind = if t.mHeight == 0 then hint(t) else "png"
      s"${session.file.getFileName}#image $i.$kind"

  /** The images in the file. */
  def images: Map[String, ByteBuffer] = names.zip(embedded.map(content)).toMap

  val all: Vector[MtlMaterial] = Arrays.all(scene.mMaterials)(AIMaterial.create).map(material)

  private def hint(t: AITexture): String =
    val word = t.achFormatHintString.takeWhile(c => c.isLetterOrDigit).toLowerCase(Locale.ROOT)
    if word.isEmpty then "png" else word

  private def content(t: AITexture): ByteBuffer =
    if t.mHeight == 0 then
      val copy = ByteBuffer.allocate(t.mWidth)
      copy.put(t.pcDataCompressed).flip()
    else
      val image = BufferedImage(t.mWidth, t.mHeight, BufferedImage.TYPE_INT_ARGB)
      loop(t.mHeight): y =>
        loop(t.mWidth): x =>
          val p = t.pcData.get(y * t.mWidth + x)
          def byte(b: Byte) = b & 0xff
          image.setRGB(x, y, byte(p.a) << 24 | byte(p.r) << 16 | byte(p.g) << 8 | byte(p.b))
      WebPImages.encoded(image)

  private def material(m: AIMaterial): MtlMaterial =
    val name = string(m, AI_MATKEY_NAME)
    val at = AssimpScene.position(session, s"material $name")
    val numbers =
      if name == AI_DEFAULT_MATERIAL_NAME then Map.empty[String, Vector[Float]]
      else this.numbers(m, at)
    MtlMaterial(name, at, "", numbers, maps(m, at))

  private def numbers(m: AIMaterial, at: SourcePos): Map[String, Vector[Float]] =
    def number(key: String) = floats(m, key).map(_.head)
    def color(key: String) = floats(m, key).filter(_.length >= 3).map(_.take(3))
    val strength = number(AI_MATKEY_SHININESS_STRENGTH)
    val level =
      if isFbx then Some(Vector.fill(3)(2 * strength.getOrElse(FbxSpecular)))
      else color(AI_MATKEY_COLOR_SPECULAR).map(_.map(_ * strength.getOrElse(1f)))
    val roughness = number(AI_MATKEY_ROUGHNESS_FACTOR)
      .orElse(Option.when(isFbx)(1f - Math.sqrt(FbxShininess / 100).toFloat))
    val metallic = number(AI_MATKEY_METALLIC_FACTOR)
      .orElse(number(AI_MATKEY_REFLECTIVITY).filter(_ => isFbx))
    val opacity = number(AI_MATKEY_OPACITY)
    if opacity.exists(_ <= 0f) then
      session.warn(at, "it is invisible: its opacity is 0", Code.NoSurface)
    Vector(
      "kd" -> color(AI_MATKEY_BASE_COLOR).orElse(color(AI_MATKEY_COLOR_DIFFUSE)),
      "ks" -> level,
      "ke" -> color(AI_MATKEY_COLOR_EMISSIVE),
      "ns" -> number(AI_MATKEY_SHININESS).map(Vector(_)),
      "pr" -> roughness.map(Vector(_)),
      "pm" -> metallic.map(Vector(_)),
      "d" -> opacity.map(Vector(_)),
      // 1 is what Assimp has where a file has none
      "ni" -> number(AI_MATKEY_REFRACTI).filter(_ > 1f).map(Vector(_))
    ).collect { case (name, Some(values)) => name -> values }.toMap

  private def maps(m: AIMaterial, at: SourcePos): Map[String, MtlMap] =
    val kinds =
      (1 to aiTextureType_GLTF_METALLIC_ROUGHNESS).filter(aiGetMaterialTextureCount(m, _) > 0)
    for kind <- kinds if !Maps.contains(kind) && !Meaningless(kind) do
      val word = aiTextureTypeToString(kind).toLowerCase(Locale.ROOT)
      session.warn(at, s"images of the kind `$word` are not supported; left out")
    for kind <- kinds if Maps.contains(kind) && aiGetMaterialTextureCount(m, kind) > 1 do
      session.warn(at, s"the first of several images of its ${Maps(kind)} is used")
    val bump = floats(m, AI_MATKEY_BUMPSCALING).fold(1f)(_.head)
    kinds.reverse.flatMap(k => Maps.get(k).map(_ -> map(m, k, at).copy(bump = bump))).toMap

  private def map(m: AIMaterial, kind: Int, at: SourcePos): MtlMap =
    val path = AIString.calloc()
    try
      val mapping, uv, op = new Array[Int](1)
      val blend = new Array[Float](1)
      val modes, flags = new Array[Int](3)
      aiGetMaterialTexture(m, kind, 0, path, mapping, uv, blend, op, modes, flags): Unit
      if uv(0) > 1 then
        session.warn(at, s"uv set ${uv(0)} of its ${Maps(kind)} is not supported; using set 1")
      val file = path.dataString
      val part = embedded.indices.find: i =>
        file == s"*$i" || file.nonEmpty && embedded(i).mFilename.dataString == file
      MtlMap(
        part.fold(file)(names),
        wrap = Wraps(Modes(modes(0)), Modes(modes(1))),
        second = uv(0) > 0,
        at = at
      )
    finally path.free()

  private def floats(m: AIMaterial, key: String): Option[Vector[Float]] =
    val values = new Array[Float](4)
    val count = Array(4)
    val result = aiGetMaterialFloatArray(m, key, aiTextureType_NONE, 0, values, count)
    Option.when(result == aiReturn_SUCCESS && count(0) > 0):
      values.take(count(0)).toVector
    .filter(_.forall(_.isFinite))

  private def string(m: AIMaterial, key: String): String =
    val text = AIString.calloc()
    try
      aiGetMaterialString(m, key, aiTextureType_NONE, 0, text): Unit
      text.dataString
    finally text.free()

private object AssimpMaterials:
  /** What Blender has where an FBX file has none. */
  private val FbxSpecular = 0.25f
  private val FbxShininess = 20.0

  /** What images are of, in the words of [[MtlMap]]; of several, the first is used. */
  private val Maps = Map(
    aiTextureType_DIFFUSE -> "color",
    aiTextureType_BASE_COLOR -> "color",
    aiTextureType_MAYA_BASE -> "color",
    aiTextureType_SPECULAR -> "specular",
    aiTextureType_EMISSIVE -> "emission",
    aiTextureType_EMISSION_COLOR -> "emission",
    aiTextureType_HEIGHT -> "relief",
    aiTextureType_NORMALS -> "normals",
    aiTextureType_NORMAL_CAMERA -> "normals",
    aiTextureType_SHININESS -> "roughness",
    aiTextureType_DIFFUSE_ROUGHNESS -> "roughness",
    aiTextureType_MAYA_SPECULAR_ROUGHNESS -> "roughness",
    aiTextureType_METALNESS -> "metallic",
    aiTextureType_OPACITY -> "opacity"
  )

  /** Light is traced. */
  private val Meaningless =
    Set(aiTextureType_AMBIENT, aiTextureType_LIGHTMAP, aiTextureType_AMBIENT_OCCLUSION)

  private val Modes = Map(
    aiTextureMapMode_Clamp -> "clamp",
    aiTextureMapMode_Decal -> "clamp",
    aiTextureMapMode_Mirror -> "mirror"
  ).withDefaultValue("repeat")

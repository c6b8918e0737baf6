package candela.models

import candela.diagnostics.{SceneError, Severity}
import candela.io.SceneFolder
import candela.job.SceneFormat
import candela.scenefile.{SceneDescription, ShapeDescription}
import candela.settings.ReadSettings

import java.nio.file.Path
import java.nio.{ByteBuffer, ByteOrder}
import java.util.Base64

/** Models of a few triangles, as texts. */
trait GltfModels:
  val format: SceneFormat = SceneFormat.named(Path.of("model.glb")).get

  def read(
      json: String,
      isConfined: Boolean = false,
      reading: ReadSettings = ReadSettings()
  ): SceneDescription =
    val file = Path.of("models", "model.gltf")
    format.read(file, SceneFolder.of(file, isConfined), reading, None, Some(json))

  /** The first error, with its place. */
  def error(json: String): String =
    val problems =
      try read(json).errors
      catch case e: SceneError => e.problems
    val p = problems.find(_.severity == Severity.Error).get
    s"${p.pos.fold("")(_.file.dropWhile(_ != '#').drop(1))}: ${p.message}"

  def floats(values: Double*): Array[Byte] =
    val bytes = ByteBuffer.allocate(4 * values.size).order(ByteOrder.LITTLE_ENDIAN)
    values.foreach(x => bytes.putFloat(x.toFloat))
    bytes.array

  def uri(bytes: Array[Byte]): String =
    s"data:application/octet-stream;base64,${Base64.getEncoder.encodeToString(bytes)}"

  val square: Array[Byte] = floats(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
  val View: String = """{"buffer":0,"byteLength":48}"""
  val Position: String = """{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",""" +
    """"min":[0,0,0],"max":[1,1,0]}"""

  /** Accessors of vectors of floats, with their buffer views, after [[Position]]; data of these. */
  def arrays(all: (String, Array[Byte])*): (Seq[String], Seq[String], Array[Byte]) =
    val from = all.scanLeft(square.length)((at, array) => at + array._2.length)
    val accessors = all.zipWithIndex.map { case ((kind, bytes), i) =>
      val count = bytes.length / 4 / Accessors.Components(kind)
      s"""{"bufferView":${i + 1},"componentType":5126,"count":$count,"type":"$kind"}"""
    }
    val views = all.zip(from).map { case ((_, bytes), at) =>
      s"""{"buffer":0,"byteOffset":$at,"byteLength":${bytes.length}}"""
    }
    (accessors, views, all.flatMap(_._2).toArray)

  /** A model of one mesh of four vertices. */
  def model(
      primitive: String = "",
      accessors: Seq[String] = Nil,
      views: Seq[String] = Nil,
      data: Array[Byte] = Array.emptyByteArray,
      nodes: String = """{"mesh":0}""",
      roots: String = "0",
      others: String = ""
  ): String =
    val bytes = square ++ data
    s"""{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[$roots]}],"nodes":[$nodes],
       |"meshes":[{"primitives":[{"attributes":{"POSITION":0}$primitive}]}],
       |"accessors":[${(Position +: accessors).mkString(",")}],
       |"bufferViews":[${(View +: views).mkString(",")}],
       |"buffers":[{"byteLength":${bytes.length},"uri":"${uri(bytes)}"}]$others}""".stripMargin

  def shape(json: String): ShapeDescription =
    val scene = read(json)
    assert(scene.errors.isEmpty, scene.errors.map(_.message))
    scene.shapes.head

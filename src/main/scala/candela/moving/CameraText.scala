package candela.moving

import candela.convert.{NumberText, Statements}
import candela.math.{Transform, Vec3}
import candela.mitsuba.SensorAxes
import candela.scenefile.{Declaration, Dialect, Param, ParamType}

import java.io.StringWriter
import java.nio.file.Path

import scala.util.Try

/** A camera as text.
  *
  * @param dialect of the scene
  * @param width   of the image in pixels, as `height`
  */
final class CameraText(
    dialect: Dialect,
    camera: Declaration,
    pose: CameraPose,
    width: Int,
    height: Int
):
  import CameraText.*

  private val numbers = pose.numbers
  private val toCamera =
    Transform.lookAt(numbers.take(3), numbers.slice(3, 6), numbers.drop(6))
      .fold(pose.inside)(pose.inside * _)

  private def float(name: String): Option[Double] =
    camera.param(name).flatMap(_.floats.headOption).map(_.toDouble)

  /** Field of view along the shorter side, in degrees. */
  def fov: Double = float("fov").orElse(float("halffov").map(2 * _)).getOrElse(90)

  private def window: Option[Array[Float]] =
    camera.param("screenwindow").map(_.floats).filter(_.length == 4)

  /** Statements that `--camera` reads, and scenes of the pbrts have. */
  def statements: String = statements(identity)

  /** Likewise, for a file in a folder: it names other files from there. */
  def statementsIn(folder: Path): String =
    def relative(file: Path) =
      Try(folder.toAbsolutePath.relativize(file.toAbsolutePath)).getOrElse(file).toString
    statements(name => camera.folder.belonging(name).fold(name)(relative))

  private def statements(renamed: String => String): String =
    val out = StringWriter()
    val text = Statements(out, dialect.base)
    inside.foreach(text.line)
    val Vector(eye, target, up) = numbers.grouped(3).map(_.map(NumberText.of).mkString(" "))
      .toVector: @unchecked
    text.line(s"LookAt $eye  $target  $up")
    val params = camera.params.map: p =>
      if p.strings.isEmpty then p else p.withStrings(p.strings.map(renamed))
    text.declaration("Camera", camera.copy(params = params))
    out.toString

  /** What stands before `LookAt`. */
  private def inside: Option[String] =
    val m = pose.inside.m
    val isDiagonal = (0 until 12).forall(i => i % 5 == 0 || m(i) == 0)
    if pose.inside.isIdentity then None
    else if isDiagonal then
      Some(Seq(m(0), m(5), m(10)).map(NumberText.of).mkString("Scale ", " ", ""))
    else
      val columns = Vector.tabulate(16)(i => NumberText.of(m(i % 4 * 4 + i / 4)))
      Some(columns.mkString("Transform [ ", " ", " ]"))

  /** The same for programs that read the scene's own format; none for those of the pbrts. */
  def native: Option[NativeCamera] = dialect match
    case Dialect.Mitsuba => Some(NativeCamera("Mitsuba's <sensor>", sensor))
    case Dialect.Gltf => Some(NativeCamera("glTF's camera and node", gltf))
    case _ => None

  private def sensor: String =
    val isFlat = camera.name == "orthographic"
    val isThin = float("lensradius").exists(_ > 0)
    val kind = camera.name match
      case "orthographic" => if isThin then "telecentric" else "orthographic"
      case "perspective" if isThin => "thinlens"
      case other => other
    val axes = SensorAxes.of(camera.name)
    // In Mitsuba, the window of an orthographic camera is its scale
    val halfWidth = window.filter(_ => isFlat).fold(1.0)(w => (w(1) - w(0)) / 2.0)
    val size = Transform.scale(halfWidth, halfWidth, 1).getOrElse(Transform.Identity)
    val toWorld = toCamera.inverse * axes.inverse * size
    val plain = camera.name == "perspective" && (pose.inside * axes).isIdentity
    val placement =
      if plain then
        val Vector(eye, target, up) =
          numbers.grouped(3).map(_.map(NumberText.of).mkString(", ")).toVector: @unchecked
        s"""<lookat origin="$eye" target="$target" up="$up"/>"""
      else
        val rows = toWorld.m.toVector.map(CameraPose.rounded(_, 9)).map(NumberText.of)
        s"""<matrix value="${rows.mkString(" ")}"/>"""
    def number(name: String, value: Option[Double]) =
      value.map(x => s"""  <float name="$name" value="${NumberText.of(x.toFloat)}"/>""")
    val scale = if isFlat then toWorld.vector(Vec3.X).length.toDouble else 1.0
    val optics =
      if !isThin then Vector.empty
      else
        Vector("aperture_radius" -> "lensradius", "focus_distance" -> "focaldistance")
          .flatMap((theirs, ours) => number(theirs, float(ours).map(_ * scale)))
    val (halfX, halfY) =
      if width >= height then (width.toDouble / height, 1.0) else (1.0, height.toDouble / width)
    val shifts = window.filter(_ => camera.name == "perspective").toVector.flatMap: w =>
      Vector("x" -> (w(0) + w(1)) / (4 * halfX), "y" -> -(w(2) + w(3)) / (4 * halfY))
        .flatMap((side, x) => number(s"principal_point_offset_$side", Some(x)))
    val view =
      if camera.name != "perspective" then Vector.empty
      else
        number("fov", Some(fov)).toVector :+
          """  <string name="fov_axis" value="smaller"/>"""
    val clips = Vector(
      "near_clip" -> "nearclip",
      "far_clip" -> "farclip",
      "shutter_open" -> "shutteropen",
      "shutter_close" -> "shutterclose"
    )
      .flatMap((theirs, ours) => number(theirs, float(ours)))
    val film = Vector(
      "  <film type=\"hdrfilm\">",
      s"""    <integer name="width" value="$width"/>""",
      s"""    <integer name="height" value="$height"/>""",
      "  </film>"
    )
    (Vector(
      s"""<sensor type="$kind">""",
      "  <transform name=\"to_world\">",
      s"    $placement",
      "  </transform>"
    ) ++ view ++ shifts ++ optics ++ clips ++ film :+ "</sensor>").mkString("", "\n", "\n")

  private def gltf: String =
    val aspect = width.toDouble / height
    def n(x: Double) = NumberText.of(x.toFloat)
    val far = float("farclip").filter(_ < 1e30f).map(z => s""", "zfar": ${n(z)}""").getOrElse("")
    def near(least: Double) = n(Math.max(least, float("nearclip").getOrElse(0.0)))
    val view =
      if camera.name == "orthographic" then
        val w = window.getOrElse(Array(-1f, 1f, -1f, 1f))
        s""""type": "orthographic", "orthographic": {"xmag": ${n((w(1) - w(0)) / 2.0)}, """ +
          s""""ymag": ${n((w(3) - w(2)) / 2.0)}, "znear": ${near(0)}$far}"""
      else
        val shorter = Math.toRadians(fov)
        val height = if aspect >= 1 then shorter else 2 * Math.atan(Math.tan(shorter / 2) / aspect)
        s""""type": "perspective", "perspective": {"aspectRatio": ${n(aspect)}, """ +
          s""""yfov": ${n(height)}, "znear": ${near(1e-9)}$far}"""
    // Looks along -z, in right-handed axes
    val toWorld = toCamera.inverse * Backwards
    val columns = Vector.tabulate(16)(i => toWorld.m(i % 4 * 4 + i / 4))
      .map(CameraPose.rounded(_, 9)).map(NumberText.of)
    s"""{
       |  "cameras": [{$view}],
       |  "nodes": [{"camera": 0, "matrix": [${columns.mkString(", ")}]}]
       |}
       |""".stripMargin

/** A camera in a format of another program.
  *
  * @param title of the format
  */
final case class NativeCamera(title: String, text: String)

object CameraText:
  private val Backwards = Transform.scale(1, 1, -1).get

  /** The statement with another number. */
  def withFloats(camera: Declaration, name: String, values: Float*): Declaration =
    val params = camera.params.filterNot(_.name == name)
    camera.copy(params = params :+ Param.floats(ParamType.Float, name, camera.pos, values.toArray))

  def withoutParams(camera: Declaration, names: String*): Declaration =
    camera.copy(params = camera.params.filterNot(p => names.contains(p.name)))

/** The file of a camera. */
abstract class CameraOutput:
  def name: String

  /** Writes it, and returns what to tell viewers. */
  def write(camera: CameraText): String

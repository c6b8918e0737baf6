package candela.stability

import candela.math.Position
import candela.scenefile.Dialect

/** A small scene, written around a point.
  *
  * @param head what precedes `WorldBegin`, apart from view, film and sampler
  * @param body the world around a point: by transforms or by coordinates
  */
final case class FarScene(
    words: String,
    dialect: Dialect,
    body: Position => String,
    head: String = "",
    view: Position => String = FarText.view
):
  def text(at: Position): String =
    s"""${view(at)}
       |$head
       |PixelFilter "box"
       |Film "${if dialect == Dialect.V4 then "rgb" else "image"}"
       |  "integer xresolution" 20 "integer yresolution" 16
       |Sampler "${if dialect == Dialect.V4 then "independent" else "random"}"
       |  "integer pixelsamples" 8
       |WorldBegin
       |${body(at)}
       |""".stripMargin + (if dialect == Dialect.V4 then "" else "WorldEnd\n")

/** One scene of each kind of object. */

/** Parts of scenes around a point. */
object FarText:
  import Dialect.V4
  def look(p: Position) =
    s"LookAt ${p.x} ${p.y - 5} ${p.z + 1.6}  ${p.x} ${p.y} ${p.z + .1}  0 0 1"

  def view(p: Position): String = s"${look(p)}\nCamera \"perspective\" \"float fov\" 40"

  def viewed(camera: String)(p: Position): String = s"${look(p)}\nCamera $camera"

  def translate(p: Position) = s"Translate ${p.x} ${p.y} ${p.z}"

  /** Coordinates around the point, with all their digits. */
  def points(p: Position)(relative: Double*): String =
    relative.grouped(3).map(q => s"${p.x + q(0)} ${p.y + q(1)} ${p.z + q(2)}").mkString(" ")

  val floor = Seq(-4, -4, -.5, 4, -4, -.5, 4, 4, -.5, -4, 4, -.5)
  val indices = "\"integer indices\" [0 1 2 0 2 3]"

  /** A fine mesh of a ball, whose steps show. */
  def ball(p: Position): String =
    val (rings, sectors) = (24, 48)
    val all =
      for i <- 0 to rings; j <- 0 to sectors yield
        val (t, f) = (Math.PI * i / rings, 2 * Math.PI * j / sectors)
        Seq(.7 * Math.sin(t) * Math.cos(f), .7 * Math.sin(t) * Math.sin(f), .7 * Math.cos(t))
    val faces =
      for i <- 0 until rings; j <- 0 until sectors yield
        val k = i * (sectors + 1) + j
        s"$k ${k + 1} ${k + sectors + 1} ${k + 1} ${k + sectors + 2} ${k + sectors + 1}"
    s"\"integer indices\" [${faces.mkString(" ")}] \"point P\" [${points(p)(all.flatten*)}]"

  def ground(p: Position) =
    s"Shape \"trianglemesh\" $indices \"point P\" [${points(p)(floor*)}]"

  val sky = "LightSource \"infinite\" \"rgb L\" [.3 .35 .4]"
  val emitter =
    """AttributeBegin
      |AreaLightSource "diffuse" "rgb L" [40 38 34]
      |Translate -1.5 -1.5 2.5
      |Shape "sphere" "float radius" .25
      |AttributeEnd""".stripMargin
  val red4 = "Material \"diffuse\" \"rgb reflectance\" [.7 .3 .2]"
  val red = "Material \"matte\" \"rgb Kd\" [.7 .3 .2]"
  val grey4 = "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]"

  def lit(p: Position, shapes: String*): String =
    (Seq(sky, translate(p), emitter) ++ shapes).mkString("\n")

  def shape(text: String, before: String = "") =
    s"AttributeBegin\n$before\nShape $text\nAttributeEnd"

  val origin = Position.Origin
  def moving(by: String, text: String) =
    s"""AttributeBegin
       |ActiveTransform EndTime
       |$by
       |ActiveTransform All
       |$text
       |AttributeEnd""".stripMargin

  def textured(dialect: Dialect, kind: String, numbers: String) =
    val (t, m) =
      if dialect == V4 then ("spectrum", "Material \"diffuse\" \"texture reflectance\" \"t\"")
      else ("color", "Material \"matte\" \"texture Kd\" \"t\"")
    s"Texture \"t\" \"$t\" \"$kind\" $numbers\n$m"

  def numbered(dialect: Dialect, kind: String, numbers: String) =
    val m = if dialect == V4 then "reflectance" else "Kd"
    val name = if dialect == V4 then "diffuse" else "matte"
    val t = if dialect == V4 then "spectrum" else "color"
    s"""Texture "n" "float" "$kind" $numbers
       |Texture "t" "$t" "mix" "rgb tex1" [.1 .2 .3] "rgb tex2" [.9 .7 .5] "texture amount" "n"
       |Material "$name" "texture $m" "t"""".stripMargin

  /** Its textures are declared in the world, and the shapes moved. */
  val content4 = s"$grey4\n${ground(origin)}\n$red4\nShape \"sphere\" \"float radius\" .6"
  val content = s"$red\n${ground(origin)}\nShape \"sphere\" \"float radius\" .6"

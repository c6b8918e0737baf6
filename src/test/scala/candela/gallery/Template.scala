package candela.gallery

import candela.scenefile.Dialect

/** Small scenes into which examples are inserted, in each dialect. */
object Template:

  /** Scene with `text`, which declares a type of this category.
    *
    * @param width of the image, whose height is three quarters of that
    */
  def scene(category: String, dialect: Dialect, text: String, width: Int): String =
    val words = Words(dialect, width)
    category match
      case "Shape" => words.onFloor("LookAt 0 -6 3.2  0 0 .9  0 0 1", 26, words.clay + text)
      case "Material" =>
        val shown = if text.contains("Shape") then text else s"$text\n$ball"
        words.onFloor("LookAt 0 -6 2.6  0 0 .95  0 0 1", 24, shown)
      case "Texture (float)" => words.onFloor(Facing, 24, words.blend(text) + panel)
      case "Texture (spectrum)" => words.onFloor(Facing, 24, words.painted(text) + panel)
      case "LightSource" => words.lit(text)
      case "AreaLightSource" => words.lit(s"$text\n$emitter")
      case "Camera" => words.seenBy(text)
      case "MakeNamedMedium" | "Volume" => words.foggy(text)
      case other => throw IllegalArgumentException(s"no template for $other")

  private val Facing = "LookAt 0 -6 2.4  0 0 .95  0 0 1"

  private val ball = """Translate 0 0 .9
Rotate 30 0 0 1
Shape "sphere" "float radius" .9"""

  /** A sphere and a disk facing the camera, which differ in their texture coordinates. */
  private val panel = """AttributeBegin
  Translate -.82 .3 .95
  Rotate -15 0 0 1
  Shape "sphere" "float radius" .8
AttributeEnd
AttributeBegin
  Translate .86 .2 .95
  Rotate 75 1 0 0
  Scale .76 .76 1
  Shape "disk" "float radius" 1
AttributeEnd"""

  /** Faces the things on the floor, and the camera. */
  private val emitter = """Translate .8 .2 1.6
Rotate 220 0 0 1
Rotate 128 0 1 0
Shape "disk" "float radius" .5"""

/** Common parts of the templates, in the syntax of a dialect. */
private final class Words(dialect: Dialect, width: Int):
  private val isV4 = dialect == Dialect.V4
  private val isV2 = dialect == Dialect.V2

  private def film = if isV4 then "rgb" else "image"
  private def p = if isV4 then "point3" else "point"
  private def integrator(hasMedia: Boolean) =
    val bounces = s"\"integer maxdepth\" ${if hasMedia then 30 else 6}"
    if isV2 then
      val fog = if hasMedia then "\nVolumeIntegrator \"single\" \"float stepsize\" .1" else ""
      s"SurfaceIntegrator \"path\" $bounces$fog"
    else if isV4 || hasMedia then s"Integrator \"volpath\" $bounces"
    else s"Integrator \"path\" $bounces"

  private def matte(color: String) =
    if isV4 then s"Material \"diffuse\" \"rgb reflectance\" [$color]\n"
    else s"Material \"matte\" \"rgb Kd\" [$color]\n"

  def clay: String = matte(".65 .45 .3") + "Translate 0 0 1\nRotate 25 0 0 1\n"

  /** Blends two colours by the float texture `shown`. */
  def blend(text: String): String =
    painted(
      s"""$text
         |Texture "$Shown" "$spectrum" "mix" "rgb tex1" [.05 .12 .3] "rgb tex2" [.95 .85 .6]
         |  "texture amount" "$Shown"""".stripMargin
    )

  def painted(text: String): String =
    s"$text\nMaterial $textured \"$Shown\"\n"

  private def textured =
    if isV4 then "\"diffuse\" \"texture reflectance\"" else "\"matte\" \"texture Kd\""

  private def spectrum = if isV2 then "color" else "spectrum"
  private val Shown = "shown"

  private def head(camera: String, hasMedia: Boolean = false, sensor: String = ""): String =
    s"""$camera
       |PixelFilter "box"
       |Film "$film" "integer xresolution" $width "integer yresolution" ${width * 3 / 4} $sensor
       |${integrator(hasMedia)}
       |WorldBegin
       |""".stripMargin

  private def perspective(look: String, fov: Int) =
    s"$look\nCamera \"perspective\" \"float fov\" $fov"

  private def end = if isV4 then "" else "WorldEnd\n"

  private def quad(corners: String) =
    s"Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"$p P\" [$corners]\n"

  private def floor(size: Int) =
    quad(s"-$size -$size 0  $size -$size 0  $size $size 0  -$size $size 0")

  private def checks(of: Int) =
    s"""Texture "checks" "$spectrum" "checkerboard" "float uscale" $of "float vscale" $of
       |  "rgb tex1" [.5 .5 .5] "rgb tex2" [.25 .25 .25]
       |Material $textured "checks"
       |""".stripMargin

  private val sky =
    val map = if isV4 then "filename" else "mapname"
    val file = if isV4 then "sky-equalarea" else "sky-latlong"
    s"LightSource \"infinite\" \"string $map\" \"textures/$file.exr\"\n"

  private def square =
    if isV4 then "\"point2 uv\" [0 0 1 0 1 1 0 1]" else "\"float uv\" [0 0 1 0 1 1 0 1]"

  private def checkedFloor =
    s"""AttributeBegin
       |${checks(80)}Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "$p P" [-40 -40 0  40 -40 0  40 40 0  -40 40 0] $square
       |AttributeEnd
       |""".stripMargin

  /** On a checkerboard floor, lit by the environment and a distant light. */
  def onFloor(look: String, fov: Int, text: String): String =
    s"""${head(perspective(look, fov))}$sky
       |LightSource "distant" "$p from" [-2 -3 4] "rgb L" [1 1 .95]
       |${checkedFloor}AttributeBegin
       |$text
       |AttributeEnd
       |$end""".stripMargin

  /** Things before a wall, lit only by the example. */
  def lit(text: String): String =
    val column = "Shape \"cylinder\" \"float radius\" .22 \"float zmin\" 0 \"float zmax\" 1.3\n" +
      "Shape \"disk\" \"float radius\" .22 \"float height\" 1.3"
    s"""${head(perspective("LookAt 0 -6.5 3  0 0 .8  0 0 1", 26))}${matte(".6 .6 .6")}${floor(8)}
       |${quad("-8 2 0  8 2 0  8 2 6  -8 2 6")}${ball("-.5 0 .5", ".5", ".7 .7 .7")}
       |${ball(".65 -.5 .3", ".3", ".7 .2 .12")}${thing("-1.5 .9 0", ".15 .3 .6", column)}
       |AttributeBegin
       |$text
       |AttributeEnd
       |$end""".stripMargin

  private def ball(place: String, radius: String, color: String) =
    thing(place, color, s"Shape \"sphere\" \"float radius\" $radius")

  private def thing(place: String, color: String, shape: String) =
    s"""AttributeBegin
       |${matte(color)}Translate $place
       |$shape
       |AttributeEnd
       |""".stripMargin

  /** Spheres all around the camera, in metres. */
  def seenBy(camera: String): String =
    val balls = Vector(
      ("0 1.6 .35", ".35", ".8 .3 .2"),
      (".9 2.6 .5", ".5", ".25 .5 .3"),
      ("-.8 2.2 .3", ".3", ".3 .35 .8"),
      ("1.6 -.4 .5", ".5", ".8 .7 .2"),
      ("-1.5 -.6 .4", ".4", ".5 .25 .6"),
      ("0 -1.8 .6", ".6", ".3 .65 .7")
    ).map(ball(_, _, _))
    // Small apertures let little light through
    val sensor = if camera.contains("lensfile") then "\"float iso\" 400" else ""
    s"""${head(s"LookAt 0 0 .6  0 1 .5  0 0 1\n$camera", sensor = sensor)}$sky
       |LightSource "distant" "$p from" [-2 -3 4] "rgb L" [1 1 .95]
       |$checkedFloor${balls.mkString}$end""".stripMargin

  /** On a checkerboard floor, lit from the side. */
  def foggy(text: String): String =
    s"""${head(perspective("LookAt 0 -6 2.4  0 0 .95  0 0 1", 24), hasMedia = true)}$sky
       |LightSource "distant" "$p from" [3 -2 4] "rgb L" [2 2 1.9]
       |${checkedFloor}AttributeBegin
       |$text
       |AttributeEnd
       |$end""".stripMargin

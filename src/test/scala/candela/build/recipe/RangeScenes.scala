package candela.build.recipe

import candela.build.{Category, Language}
import candela.scenefile.{Dialect, ParamType}

import java.nio.file.Path

/** A scene in which one number of one parameter is as given.
  *
  * @param values of a number that is a Float, or of an integer
  */
final case class RangeScene(
    category: Category,
    recipe: Recipe[?],
    field: Field[?],
    dialect: Dialect,
    value: String
):
  private val isV4 = dialect == Dialect.V4

  def name: String =
    s"${category.name} \"${recipe.name}\", ${dialect.toString.toLowerCase}: ${field.name} $value"

  private val needed = RangeScenes.needed(category, recipe, dialect)

  private def written: String =
    val values = needed.find(_._1.name == field.name).map(_._2) match
      case Some(s"$_[$list]") if list.split(' ').length > 1 =>
        value +: list.trim.split(' ').toVector.tail
      case _ =>
        val count = field.typeName match
          case s"$_[$n]" if n.nonEmpty => n.toInt
          case s"point3$_" | s"vector3$_" | s"normal$_" | s"rgb$_" | s"spectrum$_" => 3
          case _ => 1
        Vector.fill(count)(value)
    s"${RangeScenes.typeOf(field, dialect)} ${field.name}\" [${values.mkString(" ")}]"

  private def parameters: String =
    val others = needed.filter(_._1.name != field.name).map: (f, value) =>
      s"\"${RangeScenes.typeOf(f, dialect)} ${f.name}\" $value"
    val small = RangeScenes.Small.collect:
      case (name, value)
          if name != field.name && recipe.fields.exists(f =>
            f.name == name && f.dialects(dialect)
          ) =>
        s"\"integer $name\" $value"
    (others ++ small).mkString(" ") + " \"" + written

  def text: String =
    val quoted = s"\"${recipe.name}\" $parameters"
    def of(name: String, otherwise: String) =
      if category.name == name then s"$name $quoted" else otherwise
    val film = if isV4 then "\"rgb\"" else "\"image\""
    val isMedium = category.name == "MakeNamedMedium"
    val tracer =
      if dialect == Dialect.V2 then "SurfaceIntegrator \"path\""
      else s"Integrator \"${if isMedium then "volpath" else "path"}\""
    val integrator =
      if category.name == "Integrator" && dialect == Dialect.V2 then s"SurfaceIntegrator $quoted"
      else of("Integrator", s"$tracer \"integer maxdepth\" 3")
    val matte = s"Material ${if isV4 then "\"diffuse\"" else "\"matte\""}"
    val textured = if isV4 then "reflectance" else "Kd"
    val size = "\"integer xresolution\" 4 \"integer yresolution\" 4"
    s"""LookAt 0 -5 1  0 0 0  0 0 1
       |${if category.name == "Option" then s"Option \"$written" else ""}
       |${of("Film", s"Film $film $size")}
       |${of("PixelFilter", "PixelFilter \"box\"")}
       |${of("Sampler", "Sampler \"halton\" \"integer pixelsamples\" 2")}
       |$integrator
       |${of("Camera", "Camera \"perspective\" \"float fov\" 40")}
       |${of("Renderer", "")}
       |${of("VolumeIntegrator", "")}
       |${of("Accelerator", "")}
       |WorldBegin
       |${of("LightSource", "LightSource \"infinite\" \"rgb L\" [1 1 1]")}
       |MakeNamedMaterial "a" "string type" ${if isV4 then "\"diffuse\"" else "\"matte\""}
       |${
        category.name match
          case "Texture (float)" =>
            val bump = if isV4 then "displacement" else "bumpmap"
            s"Texture \"t\" \"float\" $quoted\n$matte \"texture $bump\" \"t\""
          case "Texture (spectrum)" =>
            s"Texture \"t\" \"spectrum\" $quoted\n$matte \"texture $textured\" \"t\""
          case "Material" => s"Material $quoted"
          case "MakeNamedMedium" =>
            val none = if isV4 then "Material \"interface\"" else "Material \"\""
            s"MakeNamedMedium \"m\" \"string type\" $quoted\nMediumInterface \"m\" \"\"\n$none"
          case "Volume" => s"Volume $quoted \"point p0\" [-1 -1 -1]\n$matte"
          case "VolumeIntegrator" => "Volume \"homogeneous\" \"color sigma_s\" [1 1 1]"
          case _ => matte
      }
       |${of("AreaLightSource", "")}
       |${of("Shape", "Shape \"sphere\"")}
       |AttributeBegin
       |$matte
       |Translate 0 0 -2
       |Shape "disk" "float radius" 4
       |AttributeEnd
       |${if isV4 then "" else "WorldEnd"}
       |""".stripMargin

object RangeScenes:
  /** All parameters of numbers, in all dialects of pbrt. */
  def parameters: Vector[(Category, Recipe[?], Field[?], Dialect)] =
    for
      category <- Language.categories
      recipe <- category.recipes.all
      if !Unwritten.contains(recipe.name)
      field <- recipe.fields if isNumber(field)
      dialect <- Dialect.ofPbrt if recipe.dialects(dialect) && field.dialects(dialect)
    yield (category, recipe, field, dialect)

  /** Parameters that a type needs, with values. */
  def needed(
      category: Category,
      recipe: Recipe[?],
      dialect: Dialect
  ): Vector[(Field[?], String)] =
    for
      (name, value) <- Needed.getOrElse(s"${category.name} ${recipe.name}", Map.empty).toVector
      field <- recipe.fields.find(f => f.name == name && f.dialects(dialect))
    yield field -> value

  private def isNumber(f: Field[?]) =
    !Seq("bool", "string").exists(f.typeName.startsWith)

  def typeOf(f: Field[?], dialect: Dialect): String = kindOf(f, dialect).spelling

  /** pbrt-v2's pairs are plain numbers. */
  def kindOf(f: Field[?], dialect: Dialect): ParamType = f.typeName.takeWhile(_ != '[') match
    case "float texture" => ParamType.Float
    case "point2" if dialect == Dialect.V2 => ParamType.Float
    case "spectrum" | "spectrum texture" | "rgb" => ParamType.Rgb
    case other => ParamType.values.find(_.spelling == other).get

  private val Unwritten = Set("ptex", "measured", "fourier")

  /** So that tests are quick. */
  val Small: Map[String, Int] = Map(
    "pixelsamples" -> 2,
    "xsamples" -> 1,
    "ysamples" -> 2,
    "bootstrapsamples" -> 16,
    "chains" -> 2,
    "mutationsperpixel" -> 2,
    "samplesperpixel" -> 2,
    "numiterations" -> 2,
    "maxsamples" -> 2,
    "minsamples" -> 2,
    "photonsperiteration" -> 16,
    "maxdepth" -> 3,
    "xresolution" -> 4,
    "yresolution" -> 4
  )

  private val Square = "[-1 0 -1 1 0 -1 1 0 1]"
  private val Grid = Map("nx" -> "1", "ny" -> "1", "nz" -> "2", "p0" -> "[-1 -1 -1]")

  /** A file of the folder `scenes`, wherever the scene is. */
  private def file(name: String) =
    s"\"${Path.of("scenes", name).toAbsolutePath.toString.replace('\\', '/')}\""

  private val Chart = file("textures/chart.png")

  private val Needed: Map[String, Map[String, String]] = Map(
    "Shape trianglemesh" -> Map(
      "P" -> Square,
      "indices" -> "[0 1 2]",
      "N" -> "[0 -1 0 0 -1 0 0 -1 0]",
      "uv" -> "[0 0 1 0 1 1]"
    ),
    "Shape bilinearmesh" -> Map("P" -> "[-1 0 -1 1 0 -1 -1 0 1 1 0 1]", "indices" -> "[0 1 2 3]"),
    "Shape loopsubdiv" -> Map("P" -> Square, "indices" -> "[0 1 2]", "levels" -> "1"),
    "Shape plymesh" -> Map(
      "filename" -> file("geometry/sheet-quads.ply"),
      "displacement" -> ".1",
      "edgelength" -> "1e9"
    ),
    "Shape curve" -> Map("P" -> "[-1 0 0 0 0 1 0 0 -1 1 0 0]"),
    "Shape heightfield" -> Map("nu" -> "2", "nv" -> "2", "Pz" -> "[0 1 1 0]"),
    "Shape nurbs" -> Map(
      "nu" -> "2",
      "nv" -> "2",
      "uorder" -> "2",
      "vorder" -> "2",
      "uknots" -> "[0 0 1 1]",
      "vknots" -> "[0 0 1 1]",
      "P" -> "[-1 0 -1 1 0 -1 -1 0 1 1 0 1]"
    ),
    "Texture (float) imagemap" -> Map("filename" -> Chart),
    "Texture (spectrum) imagemap" -> Map("filename" -> Chart),
    "LightSource goniometric" -> Map("filename" -> file("textures/sky-equalarea.exr")),
    "LightSource projection" -> Map("filename" -> Chart),
    "Camera realistic" -> Map("lensfile" -> file("lenses/double-gauss-50mm.dat")),
    "Material mix" -> Map(
      "materials" -> "[\"a\" \"a\"]",
      "namedmaterial1" -> "\"a\"",
      "namedmaterial2" -> "\"a\""
    ),
    "MakeNamedMedium heterogeneous" -> (Grid + ("density" -> "[1 1]")),
    "MakeNamedMedium uniformgrid" -> (Grid + ("density" -> "[1 1]")),
    "MakeNamedMedium rgbgrid" ->
      (Grid + ("sigma_a" -> "[1 1 1 1 1 1]") + ("sigma_s" -> "[1 1 1 1 1 1]")),
    "MakeNamedMedium nanovdb" -> Map("filename" -> file("volumes/smoke.nvdb")),
    "MakeNamedMedium cloud" -> Map("p0" -> "[-1 -1 -1]"),
    "Volume volumegrid" -> (Grid + ("density" -> "[1 1]"))
  )

package candela.gallery

import candela.build.{Category, Language}
import candela.build.recipe.Recipe
import candela.scenefile.Dialect

/** How a type is shown in the gallery. */
enum Example:
  /** Lines of a scene that declare it, inserted into the category's [[Template]]. */
  case Lines(text: String)

  /** Not shown, for the given reason. */
  case Unseen(reason: String)

/** An example, or a reason for its absence, for every type of the visible categories. */
object Examples:
  import Example.*

  /** Categories whose types have images. */
  val categories: Vector[Category] = Language.categories.filter(c => tables.contains(c.name))

  /** The example of a type, if any. Materials without one are shown with their defaults. */
  def of(category: Category, recipe: Recipe[?]): Option[Example] =
    val byDefault =
      Option.when(category.name == "Material")(Lines(s"Material \"${recipe.name}\""))
    tables(category.name).get(key(recipe)).orElse(byDefault)

  /** Examples of unknown types. */
  def strays: Vector[String] =
    for
      category <- categories
      known = category.recipes.all.map(key).toSet
      name <- tables(category.name).keys.toVector.sorted if !known(name)
    yield s"${category.name} $name"

  /** The newest dialect with the type. */
  def dialect(recipe: Recipe[?]): Dialect = Dialect.values.filter(recipe.dialects).maxBy(_.ordinal)

  /** Name of a type; a name shared by different types is followed by the newest dialect. */
  private def key(recipe: Recipe[?]): String =
    val isTwice = Ambiguous(recipe.name)
    if isTwice then s"${recipe.name}/${dialect(recipe).toString.toLowerCase}" else recipe.name

  private val Ambiguous = Set("measured", "realistic")

  private lazy val tables: Map[String, Map[String, Example]] = Map(
    "Shape" -> (shown(ShapeExamples.all) + ("heightmap" -> Unseen("of Mitsuba's scenes"))),
    "Material" -> (shown(SurfaceExamples.materials) ++ SurfaceExamples.unseen),
    "Texture (float)" -> textures("float", SurfaceExamples.floats),
    "Texture (spectrum)" -> textures("spectrum", SurfaceExamples.colors),
    "LightSource" -> (shown(LightExamples.lights) ++ LightExamples.unseenLights),
    "AreaLightSource" -> shown(LightExamples.areaLights),
    "Camera" -> (shown(LightExamples.cameras) ++ LightExamples.unseenCameras),
    "MakeNamedMedium" -> shown(MediumExamples.media),
    "Volume" -> shown(MediumExamples.volumes)
  )

  private def shown(texts: Vector[(String, String)]): Map[String, Example] =
    texts.map((name, text) => name -> Lines(text)).toMap

  private def textures(kind: String, texts: Vector[(String, String)]): Map[String, Example] =
    shown(texts.map((name, rest) => name -> s"Texture \"shown\" \"$kind\" \"$name\" $rest")) +
      ("ptex" -> Unseen("input files are produced by other programs")) +
      ("grid" -> Unseen("of Mitsuba's scenes")) +
      ("lines" -> Unseen("of Mitsuba's scenes")) +
      ("vertexcolor" -> Unseen("of glTF models"))

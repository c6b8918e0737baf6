package candela.gallery

import candela.build.{Category, Language}
import candela.build.recipe.Recipe
import candela.scenefile.Dialect

/** How a type is shown in the gallery. */
enum Example:
  /** By lines that declare it; they stand in the gap of the category's [[Template]]. */
  case Lines(text: String)

  /** Not at all, for a reason. */
  case Unseen(reason: String)

/** An example, or a reason for none, for every type of the categories that can be seen. */
object Examples:
  import Example.*

  /** In which categories each type has a picture. */
  val categories: Vector[Category] = Language.categories.filter(c => tables.contains(c.name))

  /** Of a type, if it has one. */
  def of(category: Category, recipe: Recipe[?]): Option[Example] =
    tables(category.name).get(key(recipe))

  /** Examples that are of no type. */
  def strays: Vector[String] =
    for
      category <- categories
      known = category.recipes.all.map(key).toSet
      name <- tables(category.name).keys.toVector.sorted if !known(name)
    yield s"${category.name} $name"

  /** The newest dialect that has it. */
  def dialect(recipe: Recipe[?]): Dialect = Dialect.values.filter(recipe.dialects).maxBy(_.ordinal)

  /** A name that two dialects use for different things has the newest dialect's behind it. */
  private def key(recipe: Recipe[?]): String =
    val isTwice = Ambiguous(recipe.name)
    if isTwice then s"${recipe.name}/${dialect(recipe).toString.toLowerCase}" else recipe.name

  private val Ambiguous = Set("measured", "realistic")

  private lazy val tables: Map[String, Map[String, Example]] = Map(
    "Shape" -> shown(ShapeExamples.all),
    "Material" -> (shown(SurfaceExamples.materials) ++ SurfaceExamples.unseen),
    "Texture (float)" -> textures("float", SurfaceExamples.floats),
    "Texture (spectrum)" -> textures("spectrum", SurfaceExamples.colors),
    "LightSource" -> shown(LightExamples.lights),
    "AreaLightSource" -> shown(LightExamples.areaLights),
    "Camera" -> (shown(LightExamples.cameras) ++ LightExamples.unseenCameras),
    "MakeNamedMedium" -> (shown(MediumExamples.media) ++ MediumExamples.unseen),
    "Volume" -> shown(MediumExamples.volumes)
  )

  private def shown(texts: Vector[(String, String)]): Map[String, Example] =
    texts.map((name, text) => name -> Lines(text)).toMap

  private def textures(kind: String, texts: Vector[(String, String)]): Map[String, Example] =
    shown(texts.map((name, rest) => name -> s"Texture \"shown\" \"$kind\" \"$name\" $rest")) +
      ("ptex" -> Unseen("its files come from other programs"))

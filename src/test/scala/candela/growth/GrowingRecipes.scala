package candela.growth

import candela.build.{Category, Language}
import candela.build.recipe.{Field, RangeScenes, Recipe}
import candela.scenefile.Dialect

/** Many statements of each type, each with another value. */
object GrowingRecipes:
  def rows: Vector[Growing] =
    for
      category <- Language.categories
      statement <- statements.get(category.name).toVector
      recipe <- category.recipes.all
      dialect <- Dialect.ofPbrt.filter(recipe.dialects).lastOption
      if !Unwritten(recipe.name)
    yield Growing(s"${category.name} ${recipe.name}", dialect, Sizes.getOrElse(recipe.name, 250)):
      (_, count) =>
        val lines =
          for i <- 0 until count yield
            val quoted = s"\"${recipe.name}\" ${parameters(category, recipe, dialect, i, count)}"
            statement(quoted, i, Growing.spot(i, count), dialect)
        val material =
          s"MakeNamedMaterial \"a\" \"string type\" \"${GrowingPbrt.diffuse(dialect)}\""
        GrowingPbrt.scene(dialect, material +: lines)

  /** They need large files, or are converted to large meshes or pictures. */
  private val Unwritten = Set(
    "ptex",
    "measured",
    "fourier",
    "cone",
    "paraboloid",
    "hyperboloid",
    "goniometric",
    "projection",
    "nanovdb"
  )

  /** Smaller numbers of what takes long for each. */
  private val Sizes = Map("nurbs" -> 20, "plymesh" -> 60)

  /** Parameters that are given together only. */
  private val Paired = Set("sigma_a", "sigma_s", "mfp")

  private def statements: Map[String, (String, Int, String, Dialect) => String] =
    def block(spot: String, lines: String*) =
      s"AttributeBegin\nTranslate $spot\n${lines.mkString("\n")}\nAttributeEnd"
    val sphere = "Shape \"sphere\" \"float radius\" .02"
    def textured(kind: String)(quoted: String, i: Int, spot: String, dialect: Dialect) =
      val parameter = (dialect, kind) match
        case (Dialect.V4, "float") => "displacement"
        case (_, "float") => "bumpmap"
        case (Dialect.V4, _) => "reflectance"
        case _ => "Kd"
      val material = s"Material \"${GrowingPbrt.diffuse(dialect)}\" \"texture $parameter\" \"t$i\""
      s"Texture \"t$i\" \"$kind\" $quoted\n${block(spot, material, sphere)}"
    Map(
      "Shape" -> ((quoted, _, spot, _) => block(spot, s"Shape $quoted")),
      "Material" -> ((quoted, _, spot, _) => block(spot, s"Material $quoted", sphere)),
      "Texture (float)" -> textured("float"),
      "Texture (spectrum)" -> textured("spectrum"),
      "LightSource" -> ((quoted, _, spot, _) => block(spot, s"LightSource $quoted")),
      "AreaLightSource" -> ((quoted, _, spot, _) =>
        block(spot, s"AreaLightSource $quoted", sphere)
      ),
      "MakeNamedMedium" -> ((quoted, i, spot, dialect) =>
        val invisible = if dialect == Dialect.V4 then "interface" else ""
        val lines = Seq(s"MediumInterface \"m$i\" \"\"", s"Material \"$invisible\"", sphere)
        s"MakeNamedMedium \"m$i\" \"string type\" $quoted\n${block(spot, lines*)}"
      ),
      "Volume" -> ((quoted, _, spot, _) => block(spot, s"Volume $quoted"))
    )

  private def parameters(
      category: Category,
      recipe: Recipe[?],
      dialect: Dialect,
      i: Int,
      count: Int
  ): String =
    val needed = RangeScenes.needed(category, recipe, dialect)
    val free =
      recipe.fields.filter(f => f.dialects(dialect) && !needed.exists(_._1 == f))
    def isColor(f: Field[?]) =
      Seq("spectrum", "rgb").exists(f.typeName.takeWhile(_ != ' ') == _) && !Paired(f.name)
    val share = Growing.share(i, count)
    def number(f: Field[?]) =
      f.defaultText(dialect).toDoubleOption.filter(x => x > 0 && f.typeName.startsWith("float"))
    val varied = free.find(isColor).map(_ -> s"[$share .3 .2]").orElse:
      free.find(number(_).nonEmpty).map(f => f -> s"${number(f).get * (1 - 1e-3 * share)}")
    val written = needed ++ varied
    written.map((f, value) => s"\"${RangeScenes.typeOf(f, dialect)} ${f.name}\" $value").mkString(
      " "
    )

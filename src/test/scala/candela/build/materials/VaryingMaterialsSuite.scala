package candela.build.materials

import org.scalatest.funsuite.AnyFunSuite

import candela.build.SceneBuilder
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

/** A material is as constant as the textures it names: a parameter that it forgot to name would
  * have the value of one point everywhere.
  */
class VaryingMaterialsSuite extends AnyFunSuite:

  /** Parameters that are read beside others only. */
  private def beside(material: String, parameter: String, dialect: Dialect): String =
    (material, parameter, dialect.base) match
      case ("mix" | "twosided", _, Dialect.V4) => "\"string materials\" [\"a\" \"b\"]"
      case ("nested" | "coating", _, _) => "\"string material\" \"a\""
      case ("mix", _, _) => "\"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\""
      case ("subsurface", "sigma_a", Dialect.V4) => "\"rgb sigma_s\" [1 1 1]"
      case ("subsurface", "sigma_s", Dialect.V4) => "\"rgb sigma_a\" [1 1 1]"
      case ("coateddiffuse", "g", _) => "\"rgb albedo\" [.5 .5 .5]"
      case ("subsurface", "mfp", Dialect.V4) => "\"rgb reflectance\" [.5 .5 .5]"
      case _ => ""

  private def describe(dialect: Dialect, material: String): String =
    val matte = if dialect.base == Dialect.V4 then "diffuse" else "matte"
    val text = "WorldBegin\nTexture \"varying\" \"float\" \"checkerboard\"\n" +
      "Texture \"varying\" \"spectrum\" \"checkerboard\"\n" +
      Seq("a", "b").map(n => s"MakeNamedMaterial \"$n\" \"string type\" \"$matte\"\n").mkString +
      s"$material\nShape \"sphere\"\n" + (if dialect.base == Dialect.V4 then "" else "WorldEnd\n")
    val scene = SceneTexts.parse(text, dialect.base).copy(dialect = dialect)
    SceneBuilder.build(scene, RenderSettings())._1.features.toMap.apply("materials")

  for
    recipe <- Materials.all.all
    if !Set("measured", "fourier")(recipe.name)
    dialect <- Dialect.values
    textures = recipe.fields.filter: field =>
      recipe.dialectsOf(field)(dialect) && field.typeName.endsWith("texture")
    if textures.nonEmpty
  do
    test(s"material \"${recipe.name}\" in $dialect varies with each of its textures"):
      for field <- textures do
        val others = beside(recipe.name, field.name, dialect)
        val material =
          s"Material \"${recipe.name}\" \"texture ${field.name}\" \"varying\" $others"
        val found = describe(dialect, material)
        assert(found == "1, 0 of them constant", material)

  test("what is rough in Mitsuba's scenes may be so along one axis only"):
    for name <- Seq("conductor", "dielectric", "roughplastic") do
      val recipe = Materials.all.all.find(_.name == name).get
      assert(recipe.fields.exists(_.name == "uroughness"), name)

  test("a material whose textures are all constant is constant"):
    assert(describe(Dialect.V4, "Material \"diffuse\"") == "1, 1 of them constant")
    assert(describe(Dialect.V3, "Material \"uber\"") == "1, 1 of them constant")

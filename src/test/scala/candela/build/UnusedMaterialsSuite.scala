package candela.build

import candela.diagnostics.Severity
import candela.scenefile.Dialect
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

/** What is wrong with materials that nothing has is told. */
final class UnusedMaterialsSuite extends AnyFunSuite:
  private def told(statement: String, dialect: Dialect) =
    val world = s"WorldBegin\nLightSource \"infinite\"\nMaterial \"matte\"\nShape \"sphere\"\n"
    val surface = if dialect == Dialect.V4 then world.replace("matte", "diffuse") else world
    SceneTexts.problems(s"$surface$statement\n", dialect)

  private def named(rest: String) = s"MakeNamedMaterial \"a\" \"string type\" $rest"

  test("in a scene of v4, it is an error where a rendered one has it"):
    for
      (statement, message) <- Vector(
        named("\"difuse\"") -> "unknown material \"difuse\"",
        named("\"diffuse\" \"texture reflectance\" \"t\"") -> "texture `t` is not defined",
        named("\"diffuse\" \"string reflectance\" \"t\"") -> "`reflectance`",
        named("\"mix\" \"string materials\" [\"x\" \"a\"]") -> "material `x` is not defined",
        "Material \"difuse\"" -> "unknown material \"difuse\"",
        "AttributeBegin Material \"difuse\" AttributeEnd" -> "unknown material \"difuse\"",
        "Material \"difuse\" Material \"diffuse\" Shape \"sphere\"" ->
          "unknown material \"difuse\"",
        "ObjectBegin \"o\" Material \"difuse\" Shape \"sphere\" ObjectEnd" ->
          "unknown material \"difuse\"",
        "Texture \"u\" \"spectrum\" \"scale\" \"texture tex\" \"t\"" ->
          "texture `t` is not defined"
      )
    do
      val all = told(statement, Dialect.V4).filter(_.severity == Severity.Error)
      assert(all.exists(_.message.contains(message)), s"$statement: $all")

  test("a parameter that such a material does not have is a warning"):
    for statement <- Vector("Material \"diffuse\"", named("\"diffuse\"")) do
      val all = told(s"$statement \"float rflectance\" 3", Dialect.V4)
      assert(all.map(_.severity) == Vector(Severity.Warning), all)
      assert(all.head.message.contains("`rflectance` is not a parameter of \"diffuse\""))

  test("in a scene of v3, it is a warning"):
    for
      (statement, message) <- Vector(
        named("\"mate\"") -> "unknown material \"mate\"",
        named("\"matte\" \"texture Kd\" \"t\"") -> "texture `t` is not defined",
        named("\"mix\" \"string namedmaterial1\" \"x\"") -> "material `x` is not defined",
        "Material \"mate\"" -> "unknown material \"mate\"",
        "Material \"matte\" \"float sgma\" 3" -> "`sgma` is not a parameter"
      )
    do
      val all = told(statement, Dialect.V3)
      assert(all.exists(_.message.contains(message)), s"$statement: $all")
      assert(all.forall(_.severity == Severity.Warning), s"$statement: $all")

  test("a name of nothing is a warning, but in a shape of an object an error in v4"):
    val undefined = "material `none` is not defined"
    for dialect <- Vector(Dialect.V3, Dialect.V4) do
      val surface = if dialect == Dialect.V4 then "diffuse" else "matte"
      for rest <- Vector("", s"Material \"$surface\" Shape \"sphere\"") do
        val all = told(s"NamedMaterial \"none\" $rest", dialect)
        assert(all.map(_.message) == Vector(undefined), all)
        assert(all.forall(p => p.severity == Severity.Warning && p.pos.exists(_.line == 5)))
      val inObject =
        told("ObjectBegin \"o\" NamedMaterial \"none\" Shape \"sphere\" ObjectEnd", dialect)
      val severity = if dialect == Dialect.V4 then Severity.Error else Severity.Warning
      assert(inObject.map(p => (p.message, p.severity)) == Vector((undefined, severity)), inObject)

  test("what is right is silent, and textures of materials that nothing has are known"):
    for
      statement <- Vector(
        "Material \"diffuse\"",
        named("\"diffuse\" \"rgb reflectance\" [.1 .2 .3]"),
        "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.1 .2 .3]\n" +
          "Material \"diffuse\" \"texture reflectance\" \"t\"",
        s"${named("\"diffuse\"")} MakeNamedMaterial \"b\" \"string type\" \"mix\" " +
          "\"string materials\" [\"a\" \"a\"]",
        s"${named("\"diffuse\"")} NamedMaterial \"a\"",
        s"NamedMaterial \"a\" ${named("\"diffuse\"")}"
      )
    do assert(told(statement, Dialect.V4).isEmpty, statement)

  test("the error of a texture that an unused material has is told once"):
    def texture(part: String) = s"Texture \"u\" \"spectrum\" \"scale\" \"texture $part\" \"t\"\n"
    for (dialect, material) <- Vector(Dialect.V4 -> "diffuse", Dialect.V3 -> "matte") do
      val (parameter, part) =
        if dialect == Dialect.V4 then ("reflectance", "tex") else ("Kd", "tex1")
      val all =
        told(s"${texture(part)}Material \"$material\" \"texture $parameter\" \"u\"", dialect)
          .filter(_.message.contains("`t` is not defined"))
      assert(all.size == 1, all)

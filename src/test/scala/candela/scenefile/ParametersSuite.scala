package candela.scenefile

import candela.diagnostics.{Problem, SceneError}
import org.scalatest.funsuite.AnyFunSuite

class ParametersSuite extends AnyFunSuite:

  private var warnings = Vector.empty[Problem]

  private def params(text: String, isV4: Boolean = true): Vector[Param] =
    warnings = Vector.empty
    val in = Tokenizer(Source.fromText("test", text), None)
    in.advance()
    def warn(problem: Problem) = warnings = warnings :+ problem
    val read = Parameters(DialectGuess(), warn, isV4 = () => isV4).list(in)
    assert(in.current == Token.End)
    if read.faults.nonEmpty then throw SceneError(read.faults)
    read.params

  private def one(text: String): Param =
    val all = params(text)
    assert(all.size == 1)
    all.head

  private def error(text: String): String =
    val problems = intercept[SceneError](params(text)).problems
    problems.map(p => s"${p.pos.get.column}: ${p.message}").mkString

  test("each spelling of each type is known"):
    val numbers = Map(
      "float" -> ParamType.Float,
      "point" -> ParamType.Point3,
      "point3" -> ParamType.Point3,
      "vector" -> ParamType.Vector3,
      "vector3" -> ParamType.Vector3,
      "normal" -> ParamType.Normal,
      "normal3" -> ParamType.Normal,
      "point2" -> ParamType.Point2,
      "vector2" -> ParamType.Vector2,
      "rgb" -> ParamType.Rgb,
      "color" -> ParamType.Rgb,
      "xyz" -> ParamType.Xyz,
      "blackbody" -> ParamType.Blackbody,
      "spectrum" -> ParamType.Spectrum
    )
    for (spelling, paramType) <- numbers do
      val p = one(s"\"$spelling P\" [1 2 3 4 5 6]")
      assert(p.paramType == paramType && p.floats.toVector == Vector(1f, 2f, 3f, 4f, 5f, 6f))

  test("one value needs no brackets"):
    assert(one("\"float fov\" 45").floats.toVector == Vector(45f))
    assert(one("\"integer n\" -3").ints.toVector == Vector(-3))
    assert(one("\"string f\" \"a b\"").strings == Vector("a b"))
    assert(one("\"texture Kd\" \"t\"").strings == Vector("t"))
    assert(one("\"spectrum eta\" \"metal-Cu-eta\"").strings == Vector("metal-Cu-eta"))

  test("true and false may stand in quotes or bare"):
    def values(text: String) = one("\"bool b\" " + text).bools
    assert(values("true") == Vector(true) && values("\"true\"") == Vector(true))
    assert(values("[false]") == Vector(false))
    assert(values("[\"false\" true]") == Vector(false, true))

  test("a spectrum is pairs of numbers, or names"):
    assert(one("\"spectrum L\" [400 1 700 2]").floats.length == 4)
    assert(one("\"spectrum L\" [\"a.spd\" \"b.spd\"]").strings == Vector("a.spd", "b.spd"))

  test("type and name may have more blanks around them"):
    assert(one("\" float\t tex2 \" [-.25]").name == "tex2")

  test("places are those of the quoted name and of the first value"):
    val p = one("  \"float a\"\n [ 1 2 ]")
    assert((p.pos.line, p.pos.column) == (1, 3))
    assert((p.valuesAt.line, p.valuesAt.column) == (2, 4))

  test("whole numbers may be written with a point; fractions are cut off with a warning"):
    assert(one("\"integer n\" [1.0 2e2]").ints.toVector == Vector(1, 200))
    assert(warnings.isEmpty)
    assert(one("\"integer n\" [1 2.7]").ints.toVector == Vector(1, 2))
    assert(
      warnings.map(_.message) == Vector("values of `n` must be integers; truncating fractions")
    )

  test("commas between numbers are blanks"):
    val plain = Vector(0f, 1.5f, -1f)
    assert(one("\"normal n\" [0, 1.5, -1]").floats.toVector == plain)
    assert(one("\"normal n\" [ 0,1.5 , -1, ]").floats.toVector == plain)

  test("an empty list is read, with a warning"):
    assert(one("\"float a\" []").floats.isEmpty)
    assert(warnings.map(_.message) == Vector("`a` is an empty list"))

  test("of two parameters with one name the last counts, and the first is warned of"):
    assert(one("\"float a\" 1 \"float a\" 2").floats.toVector == Vector(2f))
    assert(warnings.map(_.pos.get.column) == Vector(1))

  test("a value of the wrong kind is an error at the value"):
    assert(error("\"float fov\" \"45\"").startsWith("13: "))
    assert(error("\"float fov\" [1 2 \"3\"]").startsWith("18: "))
    assert(error("\"string f\" 3").startsWith("12: "))
    assert(error("\"bool b\" [yes]").startsWith("11: "))
    assert(error("\"integer n\" 3000000000").startsWith("13: "))
    assert(error("\"integer n\" [1 3000000000]").startsWith("16: "))
    assert(error("\"rgb L\" [1 2 nan]").startsWith("14: "))

  test("in v2 and v3 a texture is used instead of a constant, whichever comes first"):
    val (texture, color) = ("\"texture Kd\" \"grid\"", "\"color Kd\" [.4 .2 .1]")
    for text <- Seq(s"$texture $color", s"$color $texture") do
      assert(params(text, isV4 = false).map(_.strings) == Vector(Vector("grid")))
      assert(warnings.map(_.pos.get.column) == Vector(text.indexOf("\"color") + 1))
    assert(params(s"$texture $color").map(_.paramType) == Vector(ParamType.Rgb))

  test("excess values of pairs or triples are ignored in v2 and v3, with a warning"):
    val spectrum = params("\"spectrum Kd\" [.8 .7 .6]", isV4 = false).head
    assert(spectrum.floats.toSeq == Seq(.8f, .7f))
    val message = "values of `Kd` must come in pairs, found 3 numbers; the last is ignored"
    assert(warnings.map(_.message) == Vector(message))
    val points = params("\"point P\" [1 2 3 4 5]", isV4 = false).head
    assert(points.floats.toSeq == Seq(1f, 2f, 3f))
    assert(warnings.head.message.endsWith("found 5 numbers; the last 2 are ignored"))
    assert(params("\"rgb Kd\" [.5 .5]", isV4 = false).head.floats.isEmpty)
    assert(warnings.head.message.endsWith("found 2 numbers; they are ignored"))

  test("lists that are no whole number of pairs or triples, are errors"):
    assert(error("\"rgb L\" [1 2]").contains("must come in triples, found 2 numbers"))
    assert(error("\"point3 P\" [1 2 3 4]").contains("must come in triples"))
    assert(error("\"point2 P\" [1 2 3]").contains("must come in pairs"))
    assert(error("\"spectrum L\" 3").contains("must come in pairs, found 1 number"))
    assert(error("\"texture a\" [\"b\" \"c\"]").contains("must be one texture"))

  test("a parameter without type, with an unknown type, or without value is an error"):
    assert(error("\"fov\" 45").contains("must have a type"))
    assert(error("\"float\" 45").contains("a parameter type without a name"))
    assert(error("\"flot fov\" 45").contains("unknown parameter type `flot`"))
    assert(error("\"\" 45").contains("an empty string"))
    assert(error("\"float fov\"").contains("`fov` must have a value"))
    assert(error("\"float fov\" [ 1 2").contains("no closing `]`"))

  test("of any number of parameters, the last of a name is used, behind all others"):
    for count <- Vector(3, 17, 20_000) do
      val many = (1 to count).map(i => s"\"integer n$i\" $i").mkString(" ")
      val found = params(s"$many \"integer n2\" 7")
      val others = (1 to count).filter(_ != 2)
      assert(found.map(_.name) == (others :+ 2).map(i => s"n$i"), count)
      assert(found.last.ints.toVector == Vector(7) && warnings.size == 1)
      val old = params(s"\"texture n2\" \"t\" $many", isV4 = false)
      assert(
        old.size == count && old.exists(p => p.name == "n2" && p.strings == Vector("t")),
        count
      )

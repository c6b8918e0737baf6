package candela.convert

import java.nio.file.Path

import candela.render.ReferenceScenes
import candela.scenefile.*
import org.scalatest.funsuite.AnyFunSuite

class SceneTextSuite extends AnyFunSuite:

  private def assertRoundTrip(scene: SceneDescription, dialect: Option[Dialect] = None) =
    val text = Descriptions.text(scene)
    val again = Descriptions.read(text, ReferenceScenes.Scenes, dialect)
    val (before, after) = (Descriptions.facts(scene), Descriptions.facts(again))
    for (a, b) <- before.zipAll(after, "nothing", "nothing") do assert(a == b)
    assert(again.warnings.isEmpty)
    assert(Descriptions.text(again) == text)
    assert(text.linesIterator.forall(l => l.length <= 110 || l.contains("\"")), "long lines")

  for name <- ReferenceScenes.names(ReferenceScenes.Scenes, ".pbrt") do
    test(s"$name is written, and read again as the same"):
      assertRoundTrip(Parser.parse(ReferenceScenes.Scenes.resolve(s"$name.pbrt")))

  private def parse(text: String, dialect: Dialect) =
    Parser.parseText("test.pbrt", text, Path.of("scenes"), Some(dialect))

  test("instances, media, animations, reversed shapes and odd names survive"):
    for dialect <- Dialect.ofPbrt do
      val scene = parse(
        """TransformTimes 0.5 2 MediumInterface "" "fog" LookAt 0 0 5 0 0 0 0 1 0
          |Camera "perspective" Translate 1 2 3 WorldBegin
          |Translate .1 0 0 MakeNamedMedium "fog" "string type" "homogeneous" "float g" .3
          |ActiveTransform EndTime Rotate 30 0 1 0 ActiveTransform All
          |Texture "a \"b\" \\ c" "spectrum" "imagemap" "string filename" "x\\y.png"
          |MakeNamedMaterial "m" "string type" "matte" "texture Kd" "a \"b\" \\ c"
          |ObjectBegin "o" NamedMaterial "m" Shape "sphere" Scale 2 2 2 Shape "disk" ObjectEnd
          |ObjectInstance "o" Identity ObjectInstance "o"
          |AttributeBegin ReverseOrientation MediumInterface "fog" "" Shape "cone" AttributeEnd
          |AreaLightSource "diffuse" "rgb L" [1 1e-9 3e20] Shape "sphere" "bool b" "true"
          |LightSource "point" MediumInterface "" "" LightSource "point"
          |""".stripMargin + (if dialect == Dialect.V4 then "" else "WorldEnd"),
        dialect
      )
      assertRoundTrip(scene, Some(dialect))

  test("v4 defines the medium around the camera behind the camera and before the world"):
    for dialect <- Vector(Dialect.V3, Dialect.V4) do
      val scene = parse(
        """MediumInterface "" "fog" LookAt 0 0 5 0 0 0 0 1 0 Camera "perspective"
          |WorldBegin Translate 1 0 0 MakeNamedMedium "fog" "string type" "homogeneous"
          |MakeNamedMedium "smoke" "string type" "homogeneous"
          |""".stripMargin + (if dialect == Dialect.V4 then "" else "WorldEnd"),
        dialect
      )
      assertRoundTrip(scene, Some(dialect))
      val statements = Descriptions.text(scene).linesIterator.map(_.trim.takeWhile(_ != ' '))
      assert(statements.filter(s => s.startsWith("Make") || s == "WorldBegin").toVector ==
        Vector("MakeNamedMedium", "WorldBegin", "MakeNamedMedium")
          .sortBy(s => dialect == Dialect.V3 && s.startsWith("Make")))

  test("what only v4 knows survives: options, attributes, color spaces"):
    assertRoundTrip(
      parse(
        """Option "disable-pixel-jitter" true Option "string rendercoordsys" "world"
          |Camera "perspective" WorldBegin Attribute "shape" "float alpha" .5
          |Attribute "material" "float roughness" .25 Attribute "light" "float scale" 2
          |Material "coateddiffuse" AreaLightSource "diffuse" Shape "sphere"
          |ColorSpace "rec2020" Attribute "material" "rgb reflectance" [.1 .2 .3]
          |AttributeBegin ColorSpace "dci-p3" Attribute "shape" "float radius" 3 Material "diffuse"
          |Shape "disk" "float alpha" 1 AttributeEnd LightSource "infinite" """.stripMargin,
        Dialect.V4
      ),
      Some(Dialect.V4)
    )

  test("shapes that share all but their place share a block"):
    val text = Descriptions.text(
      parse(
        """WorldBegin AttributeBegin Material "matte" Translate 1 0 0 Shape "sphere"
          |Translate 1 0 0 Shape "sphere" Shape "disk" AttributeEnd Shape "cone"
          |WorldEnd""".stripMargin,
        Dialect.V3
      )
    )
    assert(text.linesIterator.filter(_.nonEmpty).toVector == Vector(
      "WorldBegin",
      "AttributeBegin",
      "  Material \"matte\"",
      "  Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1 ]",
      "  Shape \"sphere\"",
      "  Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 2 0 0 1 ]",
      "  Shape \"sphere\"",
      "  Shape \"disk\"",
      "AttributeEnd",
      "Shape \"cone\"",
      "WorldEnd"
    ))

  test("instances are where statements say, to 14 digits, without digits of rounding"):
    val text = Descriptions.text(parse(
      """WorldBegin ObjectBegin "o" Shape "sphere" ObjectEnd
        |Translate .3 -1.2 2 Rotate 70 0 0 1 Scale .6 .6 .5 ObjectInstance "o"
        |Translate 30000 .1 1e-7 ObjectInstance "o"""".stripMargin,
      Dialect.V4
    ))
    val numbers = text.replaceAll("\\s+", " ")
    assert(numbers.contains("[ 0.2052120859954 0.56381557247155 0 0 -0.56381557247155 "), text)
    assert(numbers.contains(" 0 0 0.5 0 0.3 -1.2 2 1 ]"), text)

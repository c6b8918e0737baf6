package candela.build

import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.testing.SceneTexts

class ObjectUsesSuite extends AnyFunSuite:

  private val ball = """Shape "sphere""""

  private def scene(objectBody: String, instances: String): String =
    s"""WorldBegin
       |LightSource "distant"
       |ObjectBegin "thing"
       |$objectBody
       |ObjectEnd
       |$instances
       |WorldEnd
       |""".stripMargin

  private def features(text: String): Map[String, String] =
    SceneTexts.plan(text, Dialect.V3).features.toMap

  private val twice = "ObjectInstance \"thing\"\nTranslate 3 0 0\nObjectInstance \"thing\"\n"

  test("an object that stands once is part of the world"):
    val found = features(scene(ball, "Translate 1 0 0 ObjectInstance \"thing\""))
    assert(found("instances") == "none" && found("other shapes") == "1")

  test("an object that stands twice is instanced"):
    val found = features(scene(ball, twice))
    assert(found("instances") == "2 of 1 objects with 0 triangles and 1 other shapes")
    assert(found("other shapes") == "0")

  test("an object that stands nowhere, or is empty, is nothing"):
    assert(features(scene(ball, ""))("instances") == "none")
    assert(features(scene("", twice))("instances") == "none")

  test("what no instance can do, a perspective map, makes copies"):
    val view = "ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 .1  0 0 0 1]\n"
    val mesh = """Shape "trianglemesh" "point P" [0 0 0 1 0 0 0 1 1] "integer indices" [0 1 2]"""
    val found = features(scene(mesh, view + twice))
    assert(found("instances") == "none" && found("triangles") == "2")

  test("an emitting shape in an object is dark, with a warning at its light"):
    val text = scene("AreaLightSource \"diffuse\"\n" + ball, twice)
    val found = SceneTexts.problems(text, Dialect.V3)
    assert(found.count(_.message.contains("emission is ignored")) == 1)
    assert(found.head.at.map(_.line).contains(4))
    assert(features(text)("lights").startsWith("one light"))

  test("an instance of nothing is an error, and says what was meant"):
    val found = SceneTexts.problems(scene(ball, "ObjectInstance \"thingy\""), Dialect.V3)
    assert(found.exists(p => p.message.contains("`thingy`") && p.help.exists(_.contains("thing"))))

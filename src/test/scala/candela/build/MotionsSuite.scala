package candela.build

import org.scalatest.funsuite.AnyFunSuite

import candela.cameras.{MovingCamera, PerspectiveCamera, Shutter}
import candela.render.RenderPlan
import candela.scenefile.Dialect
import candela.testing.SceneTexts

class MotionsSuite extends AnyFunSuite:

  private val ball = "Shape \"sphere\"\n"
  private val moved = "ActiveTransform EndTime\nTranslate 1 0 0\nActiveTransform All\n"
  private def group(statements: String) = s"AttributeBegin\n${statements}AttributeEnd\n"

  private def text(world: String, beforeCamera: String = ""): String =
    s"""${beforeCamera}Camera "perspective" "float shutteropen" .25 "float shutterclose" .5
       |WorldBegin
       |LightSource "infinite"
       |$world
       |""".stripMargin

  private def plan(world: String, beforeCamera: String = "", dialect: Dialect = Dialect.V3) =
    SceneTexts.plan(text(world, beforeCamera), dialect)

  private def feature(plan: RenderPlan, name: String): String = plan.features.toMap.apply(name)

  test("where nothing moves, no time is drawn"):
    val still = plan(group(ball))
    assert(still.shutter.isEmpty && feature(still, "motion") == "none")
    assert(still.camera.isInstanceOf[PerspectiveCamera])

  test("a moving shape is one instance, and the shutter is the camera's"):
    for dialect <- Dialect.ofPbrt do
      val moving = plan(group(moved + ball) + group(ball), dialect = dialect)
      assert(moving.shutter.contains(Shutter(0.25f, 0.5f)))
      assert(feature(moving, "motion") == "shapes, from 0.25 to 0.5")
      assert(feature(moving, "other shapes") == "1")
      val what = "1 of 1 objects with 0 triangles and 1 other shapes, 1 of them moving"
      assert(feature(moving, "instances") == what)

  test("a moving camera is one, and lets shapes stand"):
    val moving = plan(group(ball), beforeCamera = moved)
    assert(moving.camera.isInstanceOf[MovingCamera] && moving.shutter.isDefined)
    assert(feature(moving, "instances") == "none")
    assert(feature(moving, "motion") == "camera, from 0.25 to 0.5")

  test("an object that moves is an instance even if it is alone"):
    val world = s"ObjectBegin \"it\"\n${ball}ObjectEnd\n${moved}ObjectInstance \"it\"\n"
    assert(feature(plan(world), "instances").startsWith("1 of 1 objects"))

  test("a shape that moves within an object has an instance for each of the object's"):
    val world = s"ObjectBegin \"it\"\n$ball${group(moved + ball)}ObjectEnd\n" +
      "ObjectInstance \"it\"\nTranslate 5 0 0\nObjectInstance \"it\"\n"
    val found = feature(plan(world), "instances")
    assert(found == "4 of 2 objects with 0 triangles and 2 other shapes, 2 of them moving")

  test("what can't move says so: area lights, lights, textures, and what perspective maps show"):
    def warned(world: String, words: String) =
      val found = SceneTexts.problems(text(world), Dialect.V3)
      assert(found.exists(_.message.contains(words)), s"$words in $found")
    warned(
      group(s"AreaLightSource \"diffuse\"\n$moved$ball"),
      "animated shapes can't be area lights"
    )
    warned(group(s"${moved}LightSource \"point\"\n"), "a light can't be animated")
    warned(group(s"${moved}Texture \"t\" \"float\" \"constant\"\n"), "a texture can't be animated")
    val view = "ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 .1  0 0 0 1]\n"
    warned(group(view + moved + ball), "perspective transform")

  test("a shutter that closes before it opens is turned around, with a warning"):
    val swapped = text(group(moved + ball)).replace(".25", ".75")
    assert(SceneTexts.plan(swapped, Dialect.V3).shutter.contains(Shutter(0.5f, 0.75f)))
    assert(SceneTexts.problems(swapped, Dialect.V3).exists(_.message.contains("swapping")))

package candela.build

import candela.scenefile.Dialect
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

class ColorPlanSuite extends AnyFunSuite:
  private val fog = """Material "interface"
    MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [.1 .2 .3]
    "rgb sigma_s" [.4 .3 .2]
    MediumInterface "fog" """""
  private val paint = "Material \"diffuse\" \"rgb reflectance\" [.7 .1 .1]"

  private def color(light: String, world: String): String =
    val text = s"""Integrator "volpath" Camera "perspective" WorldBegin
      LightSource $light
      $world Shape "sphere""""
    SceneTexts.plan(text, Dialect.V4).features.toMap.apply("color")

  for
    (name, emission) <- Seq("distant" -> "L", "infinite" -> "L", "point" -> "I", "spot" -> "I")
    world <- Seq(fog, paint)
  do
    test(s"the error of three numbers counts the light of a \"$name\" without a colour: $world"):
      val white = color(s"\"$name\" \"rgb $emission\" [1 1 1]", world)
      assert(white.startsWith("spectral"))
      assert(color(s"\"$name\"", world) == white)

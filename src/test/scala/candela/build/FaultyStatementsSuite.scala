package candela.build

import candela.diagnostics.{SceneError, Severity}
import candela.job.Render
import candela.settings.{BuildControl, ReadSettings, RenderSettings}

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

/** A faulty value hides neither the type of its statement nor another value. */
class FaultyStatementsSuite extends AnyFunSuite:

  private def errors(name: String, text: String): Vector[String] =
    val control = BuildControl()
    val problems =
      try
        val description = Render.readText(Path.of(name), text, ReadSettings(), control)
        Render.build(description, RenderSettings(), control).close()
        Vector.empty
      catch case e: SceneError => e.problems
    problems.filter(_.severity == Severity.Error).map(_.message)

  private def pbrt(head: String = "", world: String = ""): Vector[String] =
    errors("a.pbrt", s"$head\nWorldBegin\n$world\nShape \"sphere\"\n")

  private def check(found: Vector[String], parts: String*): Unit =
    assert(found.size == parts.size, found)
    for part <- parts do assert(found.exists(_.contains(part)), found)

  test("each statement before the world reports its type and its value"):
    for (statement, parameter) <- Seq(
        "Camera" -> "float fov",
        "Film" -> "integer xresolution",
        "Sampler" -> "integer pixelsamples",
        "Integrator" -> "integer maxdepth",
        "PixelFilter" -> "float xradius",
        "Accelerator" -> "integer maxnodeprims"
      )
    do
      val found = pbrt(head = s"$statement \"misspelt\" \"$parameter\" \"x\"")
      check(found, "\"misspelt\"", s"values of `${parameter.split(' ')(1)}`")

  test("each statement of the world does, too"):
    for (statement, name) <- Seq(
        "LightSource \"misspelt\" \"rgb I\" [ 1 2 ]" -> "I",
        "Material \"misspelt\" \"rgb reflectance\" [ 1 x 2 ]" -> "reflectance",
        "Shape \"misspelt\" \"float radius\" \"abc\"" -> "radius",
        "AreaLightSource \"misspelt\" \"rgb L\" true" -> "L",
        "Texture \"t\" \"float\" \"misspelt\" \"float scale\" \"x\"" -> "scale",
        "Texture \"t\" \"misspelt\" \"constant\" \"float value\" \"x\"" -> "value",
        "MakeNamedMaterial \"m\" \"string type\" \"misspelt\" \"float roughness\" \"x\"" ->
          "roughness",
        "MakeNamedMedium \"m\" \"string type\" \"misspelt\" \"float scale\" \"x\"" -> "scale"
      )
    do check(pbrt(world = statement), "misspelt", s"values of `$name`")

  test("all faulty values of a statement are told, and nothing that follows from them"):
    check(
      pbrt(world = "Shape \"trianglemesh\" \"point3 P\" [ a ] \"integer indices\" \"x\""),
      "values of `P`",
      "values of `indices`"
    )
    check(
      pbrt(world =
        "Texture \"t\" \"float\" \"constant\" \"float value\" \"x\"\n" +
          "Material \"diffuse\" \"texture reflectance\" \"t\""
      ),
      "values of `value`"
    )
    check(pbrt(world = "MakeNamedMaterial \"m\" \"string type\" 5"), "values of `type`")
    check(pbrt(world = "Shape \"sphere\" \"flot radius\" 1 \"float zmin\" \"x\""), "flot", "zmin")

  test("Mitsuba's elements do, too"):
    for (element, value) <- Seq(
        "integrator" -> "integer name=\"max_depth\"",
        "emitter" -> "rgb name=\"radiance\"",
        "shape" -> "float name=\"radius\"",
        "bsdf" -> "rgb name=\"reflectance\""
      )
    do
      val text = s"""<scene version="3.0.0"><sensor type="perspective"/><emitter type="constant"/>
                    |<shape type="sphere"/>
                    |<$element type="misspelt"><$value value="abc"/></$element></scene>"""
      check(errors("a.xml", text.stripMargin), "\"misspelt\"", "found `abc`")

package candela.build

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.{Dialect, Parser, SceneDescription}

final class DialectChoiceSuite extends AnyFunSuite:
  private def chosen(text: String, asked: Option[Dialect] = None): SceneDescription =
    DialectChoice.of(Parser.parseText("test.pbrt", text, Path.of(""), asked), asked)

  private val world =
    """Film "image"
      |Camera "perspective"
      |WorldBegin
      |LightSource "infinite" "color L" [1 1 1]
      |""".stripMargin

  test("parameters that only v3 has outweigh the spelling of v2"):
    val ketchup = "Material \"subsurface\" \"string name\" \"Ketchup\" \"float uroughness\" .05 "
    for rest <- Seq("\"float vroughness\" .05 \"bool remaproughness\" \"false\"", "") do
      val scene = chosen(s"$world$ketchup$rest\nShape \"sphere\"\nWorldEnd\n")
      assert(scene.dialect == Dialect.V3)
      assert(scene.dialectReason.contains("\"float uroughness\" of \"subsurface\" (line 5)"))
      assert(scene.warnings.isEmpty)

  test("parameters that only v2 has outweigh the spelling of v3"):
    val text = world.replace("color", "rgb") +
      "Texture \"t\" \"color\" \"imagemap\" \"float gamma\" 2.2 \"string filename\" \"x\"\n" +
      "Material \"glass\" \"float index\" 1.5\nWorldEnd\n"
    assert(chosen(text).dialect == Dialect.V2)

  test("a scene that contradicts itself is told once, with the places"):
    val text = "SurfaceIntegrator \"path\"\n" + world +
      "Material \"disney\"\nShape \"plymesh\" \"string filename\" \"x\"\nWorldEnd\n"
    val scene = chosen(text)
    assert(scene.dialect == Dialect.V2 && scene.warnings.size == 1)
    val told = scene.warnings.head
    assert(told.message.contains("is read as v2"), told)
    assert(told.message.contains("Material \"disney\" (line 6) is of v3"), told)
    assert(told.help.exists(_.contains("--dialect v3")) && told.pos.map(_.line).contains(6))

  test("of two dialects that fit as well, the newer one is suggested"):
    val mixed = "Film \"image\"\nWorldBegin\nMaterial \"diffuse\"\nMaterial \"matte\"\n" +
      "LightSource \"infinite\"\nShape \"sphere\"\n"
    val told = chosen(mixed).warnings
    assert(told.exists(_.help.exists(_.startsWith("`--dialect v3` reads it"))), told)

  test("a dialect that is asked for is taken without weighing"):
    val scene = chosen(world + "WorldEnd\n", Some(Dialect.V3))
    assert(scene.dialect == Dialect.V3 && scene.dialectReason == "as requested")

  test("all scenes here are read as what their names say, without contradiction"):
    val files = Using.resource(Files.list(Path.of("scenes"))): found =>
      found.iterator.asScala.filter(_.toString.matches(".*/v[234]-[^/]*\\.pbrt")).toVector.sorted
    assert(files.nonEmpty)
    for file <- files do
      val scene = DialectChoice.of(Parser.readable(file, None, keepGoing = true), None)
      val name = file.getFileName.toString
      assert(scene.dialect.toString.toLowerCase == name.take(2), s"$name: ${scene.dialectReason}")
      assert(!scene.warnings.exists(_.message.contains("is read as")), name)

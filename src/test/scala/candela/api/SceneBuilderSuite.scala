package candela.api

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

import scala.jdk.CollectionConverters.*
import scala.util.Using

class SceneBuilderSuite extends AnyFunSuite:
  private def image(scene: Scene, settings: RenderSettings = RenderSettings()): Vector[Float] =
    Using.resource(scene.prepare(settings, 2))(_.render(2).image.values.toVector)

  private def texts(problems: java.util.List[Problem]): Vector[String] =
    problems.asScala.map(_.message).toVector

  test("a scene made in code is that of the same file, byte for byte"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("scene.pbrt"), LibraryScenes.text())
      val scenes = Vector(
        Candela.read(file),
        Candela.parse(LibraryScenes.text(), file, ReadSettings()),
        LibraryScenes.built().called(file.toString).scene()
      )
      val files = scenes.zipWithIndex.map: (scene, i) =>
        assert(scene.problems.isEmpty && scene.dialect == "v4", scene.problems)
        val image = folder.resolve(s"$i.exr")
        Using.resource(scene.prepare(RenderSettings(), 2))(_.render(2).image.save(image))
        Files.readAllBytes(image).toVector
      assert(files(1) == files(0) && files(2) == files(0))

  test("what is wrong in code has the message that it has in a file, and the line of the call"):
    val text = LibraryScenes.text()
    val mistakes = Vector[(String, String, SceneBuilder => SceneBuilder)](
      ("Shape \"sphere\" \"float radius\" 1", "Shape \"spher\"", _.shape("spher", Parameters())),
      (
        "",
        "Shape \"sphere\" \"float radiu\" 1",
        _.shape("sphere", Parameters().number("radiu", 1))
      ),
      (
        "",
        "Shape \"sphere\" \"integer radius\" 1",
        _.shape("sphere", Parameters().integer("radius", 1))
      ),
      (
        "",
        "Material \"matt\" Shape \"sphere\"",
        _.material("matt", Parameters()).shape("sphere", Parameters())
      ),
      (
        "",
        "NamedMaterial \"coa\" Shape \"sphere\"",
        _.useMaterial("coa").shape("sphere", Parameters())
      ),
      (
        "",
        "LightSource \"infinite\" \"rgb L\" [1 2]",
        _.light("infinite", Parameters().rgbs("L", Array[Float](1, 2)))
      ),
      ("", "ObjectInstance \"ston\"", _.instance("ston")),
      ("", "Film \"rgb\"", _.film("rgb", Parameters())),
      ("", "Rotate 10 0 0 0", _.rotate(10, 0, 0, 0)),
      ("", "ColorSpace \"rec202\"", _.colorSpace("rec202")),
      ("", "Attribute \"shap\"", _.defaults("shap", Parameters())),
      (
        "",
        "Texture \"checks\" \"spectrum\" \"constant\"",
        _.texture("checks", TextureValues.Spectrum, "constant", Parameters())
      )
    )
    def plain(message: String) = message.replaceAll(raw"[\w./]+:\d+:\d+", "PLACE")
    for (_, written, call) <- mistakes do
      val inFile = Candela.parse(s"$text$written\n").check(RenderSettings()).asScala.toVector
      val inCode = call(LibraryScenes.built()).scene().check(RenderSettings()).asScala.toVector
      def shown(p: Problem) = (p.severity, plain(p.message), p.help.toString)
      assert(inFile.nonEmpty, written)
      assert(inCode.map(shown) == inFile.map(shown), written)
      assert(inCode.forall(_.file.get == "SceneBuilderSuite.scala"), written)
      assert(inCode.forall(_.line > 20) && inFile.forall(_.line == text.linesIterator.size + 1))

  test("numbers that a file can't contain are problems"):
    val found = LibraryScenes.built().translate(Double.NaN, 0, 0)
      .shape("sphere", Parameters().number("radius", Double.PositiveInfinity)).scene()
    assert(found.hasErrors)
    assert(texts(found.problems) == Vector(
      "Translate expects 3 numbers; number 1 is NaN",
      "values of `radius` must be numbers, found Infinity"
    ))
    val twice = LibraryScenes.built()
      .shape("sphere", Parameters().number("radius", 1).number("radius", 2)).scene()
    assert(!twice.hasErrors && texts(twice.problems).head.startsWith("`radius` is repeated"))

  test("a scene without a world, and one that can't be prepared, say so"):
    val none = Candela.build().film("rgb", Parameters()).scene()
    assert(texts(none.problems).exists(_.contains("no WorldBegin")))
    val thrown = intercept[SceneException](none.prepare(RenderSettings(samples = 1)))
    assert(texts(thrown.problems) == texts(none.problems))

  test("a changed scene is that of the changed file"):
    for version <- Vector("v4", "v3") do
      val start = if version == "v4" then LibraryScenes.text() else SceneBuilderSuite.old
      val read = Candela.parse(start)
      assert(read.dialect == version)
      val changed = read.edit()
        .change(SceneSetting.Film, Parameters().integer("xresolution", 12))
        .changeTexture("checks", Parameters().rgb("tex1", 0.1, 0.9, 0.1))
        .attributes:
          _.translate(0, -1, 0).material("diffuse", Parameters().rgb("reflectance", 0.9, 0.9, 0.9))
            .shape("sphere", Parameters().number("radius", 0.5))
        .scene()
      val white =
        if version == "v4" then "\"diffuse\" \"rgb reflectance\"" else "\"matte\" \"rgb Kd\""
      val world = s"AttributeBegin Translate 0 -1 0 Material $white [.9 .9 .9]\n" +
        "Shape \"sphere\" \"float radius\" .5 AttributeEnd\n"
      val end = if version == "v4" then "" else "WorldEnd\n"
      val edited = start.replace("\"integer xresolution\" 24", "\"integer xresolution\" 12")
        .replace(
          "\"rgb tex1\" [.8 .2 .1]",
          "\"rgb tex1\" [.1 .9 .1]"
        ).stripSuffix(end) + world + end
      assert(changed.problems.isEmpty, changed.problems)
      assert(image(changed) == image(Candela.parse(edited)), version)
      assert(image(read) == image(Candela.parse(start)), version)

  test("changes of what is not there are problems, with what may be meant"):
    val scene = Candela.parse(LibraryScenes.text()).edit()
      .changeMaterial("coa", Parameters().number("roughness", 1))
      .changeTexture("check", Parameters().number("scale", 1)).scene()
    val all = scene.problems.asScala.toVector
    assert(all.map(_.message) == Vector("unknown material `coa`", "unknown texture `check`"))
    assert(all.forall(p => p.help.isPresent && p.line > 0))

  test("a camera is placed anew, lights and shapes are removed"):
    val start = Candela.parse(LibraryScenes.text())
    val there = start.edit()
      .attributes(_.identity().lookAt(0, 2, -7, 0, 0, 0, 0, 1, 0).placeCamera()).scene()
    val moved = LibraryScenes.text().replace("LookAt 0 1 -6", "LookAt 0 2 -7")
    assert(image(there) == image(Candela.parse(moved)))
    val empty = start.edit().removeLights().removeShapes().scene()
    assert(image(empty).forall(_ == 0f))

object SceneBuilderSuite:
  private val old =
    """Film "image" "integer xresolution" 24 "integer yresolution" 16
      |LookAt 0 1 -6  0 0 0  0 1 0
      |Camera "perspective" "float fov" 40
      |Sampler "halton" "integer pixelsamples" 4
      |Integrator "path" "integer maxdepth" 3
      |WorldBegin
      |LightSource "infinite" "rgb L" [.3 .4 .6]
      |Texture "checks" "color" "checkerboard" "rgb tex1" [.8 .2 .1] "rgb tex2" [.1 .2 .8]
      |Material "matte" "texture Kd" "checks"
      |Shape "sphere" "float radius" 1.1
      |WorldEnd
      |""".stripMargin

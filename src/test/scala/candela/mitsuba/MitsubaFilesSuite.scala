package candela.mitsuba

import candela.diagnostics.SceneError
import candela.scenefile.SceneDescription

import java.nio.file.{Files, Path}
import java.util.Comparator

import org.scalatest.funsuite.AnyFunSuite

/** Names, numbers and files of XML, as Mitsuba 3.9.1 reads them. */
class MitsubaFilesSuite extends AnyFunSuite:

  private def read(main: String, others: (String, String)*): SceneDescription =
    val folder = Files.createTempDirectory("candela-files")
    def write(name: String, text: String): Path =
      val file = folder.resolve(name)
      val _ = Files.createDirectories(file.getParent)
      Files.writeString(file, text)
    try
      for (name, body) <- others do
        val isScene = name.endsWith(".xml")
        val _ = write(name, if isScene then s"<scene version=\"3.0.0\">$body</scene>" else body)
      val text = if main.startsWith("<scene") then main
      else s"<scene version=\"3.0.0\"><sensor type=\"perspective\"/>$main</scene>"
      MitsubaScene.readable(write("scene.xml", text), Map.empty, keepGoing = false)
    finally
      val all = Files.walk(folder)
      try all.sorted(Comparator.reverseOrder).forEach(Files.delete(_))
      finally all.close()

  private def ball(radius: String) =
    s"<shape type=\"sphere\"><float name=\"radius\" value=\"$radius\"/></shape>"

  private def radii(scene: SceneDescription) =
    scene.shapes.flatMap(_.shape.param("radius")).map(_.floats.head)

  test("an include is relative to its own file, then to the folders of the scene"):
    val scene = read(
      "<include filename=\"sub/a.xml\"/>",
      "sub/a.xml" -> "<include filename=\"deep/b.xml\"/><include filename=\"c.xml\"/>",
      "sub/deep/b.xml" -> (ball("2") + "<include filename=\"sub/d.xml\"/>"),
      "c.xml" -> ball("3"),
      "sub/d.xml" -> ball("4")
    )
    assert(radii(scene) == Vector(2f, 4f, 3f))

  test("a path is relative to its own file, and counts before earlier ones"):
    val scene = read(
      "<path value=\"p\"/><path value=\"q\"/><include filename=\"x.xml\"/>" +
        "<include filename=\"sub/a.xml\"/>",
      "p/x.xml" -> ball("1"),
      "q/x.xml" -> ball("2"),
      "x.xml" -> ball("3"),
      "sub/a.xml" -> "<path value=\"inner\"/><include filename=\"y.xml\"/>",
      "sub/inner/y.xml" -> ball("4")
    )
    assert(radii(scene) == Vector(2f, 4f))

  private def errors(body: String): Vector[String] =
    try read(body).errors.map(_.message)
    catch case e: SceneError => e.problems.map(_.message)

  test("files are looked for in a hundred folders at most"):
    def paths(count: Int) = "<path value=\"p\"/>" * count + ball("1")
    assert(read(paths(100), "p/a" -> "").errors.isEmpty)
    val problem = intercept[SceneError](read(paths(101), "p/a" -> "")).problems.head
    assert(problem.message == "more than 100 folders are named")

  test("numbers are decimal, and integers have neither point nor sign"):
    for text <- Seq("1e3f", "0.0f", "1d", "0x1p3") do
      assert(errors(ball(text)) == Vector(s"expected a number, found `$text`"))
      val pairs = s"<spectrum name=\"reflectance\" value=\"400:$text, 700:1\"/>"
      assert(errors(s"<bsdf type=\"diffuse\">$pairs</bsdf>") ==
        Vector(s"expected a number, found `$text`"))
    assert(errors(ball("1e-1") + ball("+.5") + ball("2.")).isEmpty)
    def depth(text: String) = errors("<integrator type=\"path\">" +
      s"<integer name=\"max_depth\" value=\"$text\"/></integrator>")
    for text <- Seq("1.0", "+1", "1e1", "x") do
      assert(depth(text) == Vector(s"expected an integer, found `$text`"))
    assert(depth(" 5 ").isEmpty && depth("-1").isEmpty)

  test("messages have the names of a file whose version has others"):
    val scene = read(
      """<scene version="0.6.0"><sensor type="perspective"/><shape type="sphere">
        <float name="maxSmoothAngle" value="3"/><string name="toWorld" value="x"/></shape>
        <integrator type="path"><integer name="rrDepth" value="0"/></integrator></scene>"""
    )
    val messages = (scene.errors ++ scene.warnings).map(_.message)
    assert(messages.exists(_.startsWith("`maxSmoothAngle` is not a parameter")), messages)
    assert(messages.exists(_.startsWith("`toWorld` of shape \"sphere\" must be")), messages)
    assert(messages.exists(_.startsWith("`rrDepth` must be at least 1")), messages)

  test("attributes that an element has not are told of, and rotations without an axis"):
    def problems(step: String, version: String = "3.0.0") =
      val scene = read(
        s"""<scene version="$version"><sensor type="perspective"><transform name="to_world">$step
          </transform></sensor><integrator type="path"/></scene>"""
      )
      (scene.errors ++ scene.warnings).map(p => p.message + p.help.fold("")(": " + _))
    def isTold(step: String, message: String) =
      assert(problems(step).exists(_.startsWith(message)), problems(step))
    isTold(
      "<translate vaule=\"1 2 3\"/>",
      "`vaule` is not an attribute of <translate>; it is ignored: did you mean `value`?"
    )
    isTold(
      "<scale value=\"2\" x=\"3\"/>",
      "`x` is not an attribute of <scale>; it has no effect beside `value`"
    )
    isTold("<rotate angle=\"60\"/>", "a rotation needs an axis")
    assert(problems("<translate x=\"1\"/><rotate value=\"0 1 0\" angle=\"3\"/>").isEmpty)
    assert(!problems("<translate vaule=\"1\"/>", "0.6.0").exists(_.contains("vaule")))

  test("indices of refraction are above 0"):
    for name <- Vector("int_ior", "ext_ior"); value <- Vector("0", "-1.5") do
      val scene = read(
        s"""<scene version="3.0.0"><sensor type="perspective"/><shape type="sphere">
          <bsdf type="dielectric"><float name="$name" value="$value"/></bsdf></shape></scene>"""
      )
      val message = s"`$name` must be above 0, found ${value.toDouble}"
      assert(scene.errors.map(_.message).contains(message), scene.errors)

  test("a file without a version is of 0.6 if a transform has its name"):
    for name <- Vector("toWorld", "to_world") do
      val scene = read(
        s"""<scene><sensor type="perspective"><transform name="$name"/></sensor>
          <integrator type="path"><integer name="maxDepth" value="5"/></integrator></scene>"""
      )
      assert(scene.warnings.exists(_.message.contains("maxDepth")) == (name == "to_world"))

  test("colours of bytes are used as they are, with a warning"):
    def warnings(color: String, scale: String) =
      val ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" +
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n" +
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
        s"0 0 0 $color\n1 0 0 $color\n0 1 0 $color\n3 0 1 2\n"
      val texture = "<texture type=\"mesh_attribute\" name=\"reflectance\">" +
        s"<string name=\"name\" value=\"vertex_color\"/>$scale</texture>"
      val scene = read(
        "<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/>" +
          s"<bsdf type=\"diffuse\">$texture</bsdf></shape>",
        "m.ply" -> ply
      )
      assert(scene.errors.isEmpty, scene.errors)
      val values = scene.textures.head.texture.param("values").get.floats
      (values.max, scene.warnings.map(_.message))
    val (largest, bytes) = warnings("131 242 37", "")
    assert(largest == 242f)
    assert(bytes ==
      Vector("`vertex_color` has integers above 1, which are used as they are, as in Mitsuba"))
    assert(warnings("0 1 1", "")._2.isEmpty)
    assert(warnings("131 242 37", "<float name=\"scale\" value=\".004\"/>")._2.isEmpty)

  test("a file that is missing makes no other parameter useless"):
    val scene = read("<emitter type=\"envmap\"><string name=\"filename\" value=\"a.exr\"/>" +
      "<transform name=\"to_world\"><rotate y=\"1\" angle=\"9\"/></transform></emitter>" +
      "<shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/>" +
      "<boolean name=\"face_normals\" value=\"true\"/></shape>")
    assert(scene.warnings.isEmpty, scene.warnings)
    val files = Vector("a.exr", "a.ply")
    assert(scene.errors.map(_.message).sorted == files.map(f => s"no such file: `$f`"))

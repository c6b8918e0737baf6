package candela.job

import candela.diagnostics.SceneError
import candela.render.Renderer
import candela.scenefile.SceneDescription
import candela.settings.{BuildControl, ModelSettings, ReadSettings, RenderSettings}
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

class CameraFileSuite extends AnyFunSuite:
  private val Views = "LookAt 1 2 -6  0 .5 0  0 1 0\nCamera \"perspective\" \"float fov\" 30\n"

  /** A scene of each dialect, after its camera. */
  private def world(dialect: String): String =
    val (sampler, light) = dialect match
      case "v2" => ("\"random\" \"integer pixelsamples\" 2", "\"color L\" [1 .5 .2]")
      case "v3" => ("\"random\" \"integer pixelsamples\" 2", "\"rgb L\" [1 .5 .2]")
      case _ => ("\"independent\" \"integer pixelsamples\" 2", "\"rgb L\" [1 .5 .2]")
    val film = if dialect == "v4" then "rgb" else "image"
    val end = if dialect == "v4" then "" else "WorldEnd"
    s"""Sampler $sampler
       |Film "$film" "integer xresolution" 12 "integer yresolution" 8
       |WorldBegin
       |LightSource "infinite" $light
       |Shape "sphere" "float radius" 1
       |Translate 1 2 0
       |Shape "sphere" "float radius" .5
       |$end
       |""".stripMargin

  private val Mitsuba = """<scene version="3.0.0"><integrator type="path"/>
    SENSOR
    <emitter type="constant"/><shape type="sphere"/>
    <shape type="cube"><transform name="to_world"><translate x="2"/></transform></shape></scene>"""

  private def sensor(transform: String, fov: Double, film: String): String =
    s"""<sensor type="perspective"><float name="fov" value="$fov"/>
       |<transform name="to_world">$transform</transform>$film</sensor>""".stripMargin

  private val Film = """<film type="hdrfilm"><integer name="width" value="8"/>
    <integer name="height" value="12"/></film>"""

  private def written(folder: Path, name: String, text: String): Path =
    Files.writeString(folder.resolve(name), text)

  private def read(
      scene: Path,
      camera: Option[Path] = None,
      defines: Map[String, String] = Map.empty
  ): SceneDescription =
    val reading = ReadSettings(camera = camera.map(_.toString), defines = defines)
    Render.read(scene, reading, BuildControl())

  private def pixels(description: SceneDescription): Seq[Float] =
    val settings = RenderSettings(samples = Some(2))
    val prepared = Render.build(description, settings, BuildControl())
    try Renderer.render(prepared.plan, 1).image(prepared.plan.development).data.toSeq
    finally prepared.close()

  for dialect <- Vector("v2", "v3", "v4") do
    test(s"with a camera file, a scene of $dialect is the one that has its statements"):
      TempFolder.use: folder =>
        val own = "Scale -1 1 1\nLookAt 0 0 -9 0 0 0 0 1 0\nCamera \"perspective\"\n"
        val other = written(folder, "other.pbrt", Views + world(dialect))
        val scene = written(folder, "scene.pbrt", own + world(dialect))
        val camera = written(folder, "camera.pbrt", s"# of another\n$Views")
        val (wanted, found) = (read(other), read(scene, Some(camera)))
        assert(found.dialect.toString.toLowerCase == dialect)
        assert(pixels(found) == pixels(wanted) && pixels(found) != pixels(read(scene)))
        assert(found.sources == Vector(scene, camera))

  test("transforms alone move the scene's camera, and `Camera` alone changes it where it is"):
    TempFolder.use: folder =>
      val own = "MediumInterface \"\" \"fog\"\nLookAt 0 1 -9 0 0 0 0 1 0\n" +
        "Camera \"perspective\" \"float fov\" 20\n"
      val fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
      val scene = written(folder, "scene.pbrt", fog + own + world("v4"))
      def by(text: String) = read(scene, Some(written(folder, "camera.pbrt", text)))
      val moved = by("LookAt 1 2 -6  0 .5 0  0 1 0")
      assert(moved.camera.get.param("fov").get.floats.toSeq == Seq(20f))
      assert(moved.worldToCamera == read(written(folder, "o.pbrt", Views + world("v4")))
        .worldToCamera)
      val wider = by("Camera \"perspective\" \"float fov\" 70")
      assert(wider.worldToCamera == read(scene).worldToCamera)
      assert(wider.camera.get.param("fov").get.floats.toSeq == Seq(70f))
      assert(Vector(moved, wider).forall(_.cameraMedium == "fog"))
      assert(by(s"MediumInterface \"\" \"\"\n$Views").cameraMedium == "")

  test("Mitsuba's scenes take a <sensor>, whose film has the scene's size, and statements alike"):
    TempFolder.use: folder =>
      val near = sensor("""<lookat origin="1,2,6" target="0,0.5,0" up="0,1,0"/>""", 30, "")
      val far = sensor("""<lookat origin="0,0,9" target="0,0,0" up="0,1,0"/>""", 50, Film)
      val scene = written(folder, "scene.xml", Mitsuba.replace("SENSOR", far))
      val wanted = near.replace("</sensor>", s"$Film</sensor>")
      val other = written(folder, "other.xml", Mitsuba.replace("SENSOR", wanted))
      val xml = written(folder, "camera.xml", s"<?xml version=\"1.0\"?>\n<!-- near -->$near")
      assert(pixels(read(scene, Some(xml))) == pixels(read(other)))
      assert(pixels(read(scene)) != pixels(read(other)))
      // Along x, 30 degrees; the image is upright, so that is the shorter side
      val statements = written(
        folder,
        "camera.pbrt",
        "Scale -1 1 1 LookAt 1 2 6 0 .5 0 0 1 0 Camera \"perspective\" \"float fov\" 30"
      )
      val (found, same) = (read(scene, Some(statements)), read(other))
      assert(found.camera.get.param("fov").get.floats.toSeq ==
        same.camera.get.param("fov").get.floats.toSeq)
      val (a, b) = (found.worldToCamera.start.m, same.worldToCamera.start.m)
      for i <- 0 until 16 do assert(Math.abs(a(i) - b(i)) < 1e-14)

  test("of a Mitsuba scene the first sensor is taken, and a warning names what is ignored"):
    TempFolder.use: folder =>
      val near = sensor("""<lookat origin="1,2,6" target="0,0.5,0" up="0,1,0"/>""", 30, "")
      val far = sensor("""<lookat origin="0,0,9" target="0,0,0" up="0,1,0"/>""", 50, Film)
      val scene = written(folder, "scene.xml", Mitsuba.replace("SENSOR", far))
      def viewed(text: String) = read(scene, Some(written(folder, "camera.xml", text)))
      val wanted = viewed(near)
      val named = near.replace("</sensor>", "<ref id=\"f\"/></sensor>")
      val all = viewed(s"""<?xml version="1.0"?>
        |<scene version="3.0.0">$Film
        |<shape type="ply"><string name="filename" value="none.ply"/></shape>$named$far
        |</scene>""".stripMargin.replace("<film ", "<film id=\"f\" "))
      assert(all.worldToCamera == wanted.worldToCamera)
      assert(all.camera.get.param("fov").get.floats.toSeq == Seq(30f))
      val added = all.warnings.diff(wanted.warnings)
      assert(added.map(_.message) ==
        Vector("of this file only the first <sensor> is taken; ignored: <sensor>, <shape>"))
      assert(added.head.pos.get.line == 4 && wanted.warnings == read(scene).warnings)

  test("the user's values are those of the camera, too, and either file may have them"):
    TempFolder.use: folder =>
      val world = this.world("v4")
      val size = Map("a" -> "20", "s" -> "3")
      val own = written(folder, "scene.pbrt", s"$Views$world Scale $$s $$s $$s\n")
      val shared = written(folder, "shared.pbrt", s"$Views$world Scale $$a $$s $$s\n")
      val plain = written(folder, "plain.pbrt", Views + world)
      def text(angle: String) = s"Rotate $angle 0 1 0\nCamera \"perspective\""
      val camera = Some(written(folder, "camera.pbrt", text("$a")))
      val wanted = read(plain, Some(written(folder, "rotated.pbrt", text("20")))).worldToCamera
      for scene <- Vector(own, shared) do
        assert(read(scene, camera, size).worldToCamera == wanted)
      assert(read(plain, camera, size - "s").worldToCamera == wanted)
      def told(scene: Path) = intercept[SceneError](read(scene, camera, size)).problems.head.message
      assert(told(plain) == "the scene has no parameter `$s`")

      val spheres = Mitsuba.replace("SENSOR", sensor("", 50, Film))
      val xml = written(folder, "scene.xml", spheres)
      val obj = written(folder, "model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
      for scene <- Vector(xml, obj) do
        assert(read(scene, camera, size - "s").worldToCamera == wanted)
        assert(told(scene) == "the scene has no parameter `$s`")
      val turned = sensor("""<rotate y="1" angle="$a"/>""", 50, "")
      val sensors = Some(written(folder, "camera.xml", turned))
      val scaled = spheres.replace("x=\"2\"", "x=\"$s\"")
      for scene <- Vector(xml, written(folder, "scaled.xml", scaled)) do
        val values = if scene == xml then size - "s" else size
        assert(read(scene, sensors, values).worldToCamera ==
          read(scene, Some(written(folder, "by.xml", turned.replace("$a", "20"))), values - "a")
            .worldToCamera)

  test("models take statements"):
    TempFolder.use: folder =>
      val model = written(
        folder,
        "model.gltf",
        """{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[
          |{"camera":0,"translation":[0,0,9]},
          |{"translation":[0,0,-5],"extensions":{"KHR_lights_punctual":{"light":0}}}],
          |"extensionsUsed":["KHR_lights_punctual"],
          |"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},
          |"cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}]}""".stripMargin
      )
      val found = read(model, Some(written(folder, "camera.pbrt", Views)))
      val scene = read(written(folder, "other.pbrt", Views + world("v4")))
      assert(found.worldToCamera == scene.worldToCamera)
      assert(found.camera.get.param("fov").get.floats.toSeq == Seq(30f))

  test("a model whose camera is in a file lacks light alone"):
    TempFolder.use: folder =>
      val model = written(folder, "model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
      val additions = read(model, Some(written(folder, "camera.pbrt", Views))).additions
      assert(additions.exists(_.startsWith("shown by a studio with light, which it lacks")))

  test("a camera of the other handedness than the scene's own is a warning"):
    TempFolder.use: folder =>
      val own = sensor("""<lookat origin="0,0,9" target="0,0,0" up="0,1,0"/>""", 50, Film)
      val xml = written(folder, "scene.xml", Mitsuba.replace("SENSOR", own))
      val pbrt = written(folder, "scene.pbrt", s"Scale -1 1 1 $Views${world("v4")}")
      val plain = written(folder, "plain.pbrt", s"$Views${world("v4")}")
      def warned(scene: Path, text: String) =
        read(scene, Some(written(folder, "camera.pbrt", text))).warnings.map(_.message)
      for scene <- Vector(xml, pbrt) do
        assert(warned(scene, Views).exists(_.contains("mirrored")))
        assert(warned(scene, s"Scale -1 1 1 $Views").isEmpty)
      assert(warned(plain, Views).isEmpty)

  private def problem(text: String, scene: String = Views + world("v4")): String =
    TempFolder.use: folder =>
      val name = if scene.startsWith("<") then "scene.xml" else "scene.pbrt"
      val file = written(folder, "camera.pbrt", text)
      val scenes = written(folder, name, scene)
      val e = intercept[SceneError](read(scenes, Some(file)))
      val p = e.problems.head
      val place = p.pos.fold("")(at => s"${Path.of(at.file).getFileName}:${at.line}:${at.column}: ")
      s"$place${p.message}${p.help.fold("")(h => s" ($h)")}".replace(s"$folder/", "")

  test("what is wrong with a camera file is said at its place"):
    assert(problem("LookAt 0 0 1  0 0 0  0 1 0\nFilm \"rgb\"").startsWith(
      "camera.pbrt:2:1: Film is no statement of a camera file (it may have ActiveTransform, "
    ))
    assert(problem("# nothing") == "camera.pbrt:1:1: expected `LookAt` or another transform, " +
      "`Camera`, or both; found neither")
    assert(problem("LookAt 0 0") ==
      "camera.pbrt:1:11: LookAt expects 9 numbers; number 3 is missing: the file ends here " +
      "(usage: LookAt eye.x eye.y eye.z  look.x look.y look.z  up.x up.y up.z)")
    assert(problem("Lookat 0 0 1 0 0 0 0 1 0") ==
      "camera.pbrt:1:1: unknown directive `Lookat` (did you mean `LookAt`?)")
    val pbrts = "camera.pbrt:1:1: a <sensor> is a camera of Mitsuba's scenes, and this scene " +
      "is of another format (write `LookAt` and `Camera`)"
    assert(problem("<sensor type=\"perspective\"/>") == pbrts)
    val mitsubas = Mitsuba.replace("SENSOR", sensor("", 50, Film))
    assert(problem("<bsdf type=\"diffuse\"/>", mitsubas) ==
      "camera.pbrt:1:1: expected <sensor> or <scene>, found <bsdf>")
    assert(problem("<scene version=\"3.0.0\"><integrator type=\"path\"/></scene>", mitsubas) ==
      "camera.pbrt:1:1: the scene has no sensor (add <sensor type=\"perspective\">)")
    assert(problem(
      "\n<sensor type=\"perspective\">\n<flaot name=\"fov\" value=\"3\"/></sensor>",
      mitsubas
    ).startsWith("camera.pbrt:3:1: unknown element <flaot>"))

  test("a transform after `Camera` is reported, as it has no effect"):
    TempFolder.use: folder =>
      val scene = written(folder, "scene.pbrt", Views + world("v3"))
      val text = "Camera \"perspective\"\nLookAt 1 1 1 0 0 0 0 1 0"
      val camera = written(folder, "camera.pbrt", text)
      val warning = read(scene, Some(camera)).warnings.last
      assert(warning.message == "LookAt after `Camera` has no effect")
      assert(warning.pos.exists(at => at.line == 2 && at.column == 1))

  test("a missing camera file is an error with the nearest name"):
    TempFolder.use: folder =>
      val scene = written(folder, "scene.pbrt", Views + world("v3"))
      val _ = written(folder, "camera.pbrt", Views)
      def told(name: String) =
        intercept[SceneError](read(scene, Some(folder.resolve(name)))).problems.head
      assert(told("camrea.pbrt").message.endsWith("camrea.pbrt`: no such file"))
      assert(told("camrea.pbrt").help.contains("did you mean `camera.pbrt`?"))
      assert(told("").message.endsWith("it is a folder"))

  test("a turntable, which moves the camera itself, refuses another one"):
    TempFolder.use: folder =>
      val reading = ReadSettings(model = ModelSettings(turntable = Some(2)), camera = Some("a"))
      val e = intercept[SceneError]:
        Render.read(written(folder, "a.gltf", "{}"), reading, BuildControl())
      assert(e.problems.head.message == "a turntable moves the camera itself")

package candela.moving

import candela.job.{CameraFile, Render}
import candela.scenefile.SceneDescription
import candela.settings.{BuildControl, ReadSettings}
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** What is written of a camera is read as the same, by the reader of each format. */
class CameraTextSuite extends AnyFunSuite:

  private def read(folder: Path, name: String, text: String): SceneDescription =
    Render.read(Files.writeString(folder.resolve(name), text), ReadSettings(), BuildControl())

  private def text(scene: SceneDescription): CameraText =
    def size(name: String) = scene.film.get.param(name).get.ints.head
    val pose = CameraPose.of(scene.worldToCamera.start, 5)
    CameraText(
      scene.dialect,
      scene.camera.get,
      pose,
      size("xresolution"),
      size("yresolution")
    )

  private def assertAlike(a: SceneDescription, b: SceneDescription): Unit =
    val (s, t) = (a.worldToCamera.start, b.worldToCamera.start)
    for i <- 0 until 16 do assert(Math.abs(s.m(i) - t.m(i)) < 2e-5, s"$s, $t")
    val (c, d) = (a.camera.get, b.camera.get)
    assert(c.name == d.name)
    val names = Vector("fov", "lensradius", "focaldistance", "nearclip", "farclip", "screenwindow")
    for name <- names do
      val (p, q) = (c.param(name).map(_.floats.toSeq), d.param(name).map(_.floats.toSeq))
      if p != q then
        for (x, y) <- p.get.zip(q.get) do assert(Math.abs(x - y) <= 1e-5f * Math.abs(x), name)

  private val view = "Scale -1 1 1\nLookAt 1 2 -6  0 .5 0  0 1 0\n"

  test("statements are of the scene's dialect, and read as the same camera"):
    val ends = Map("v2" -> "WorldEnd", "v3" -> "WorldEnd", "v4" -> "")
    for (dialect, end) <- ends do
      TempFolder.use: folder =>
        val film = if dialect == "v4" then "rgb" else "image"
        val camera = "Camera \"perspective\" \"float fov\" 31.5 \"float lensradius\" .1\n"
        val scene = read(
          folder,
          "a.pbrt",
          s"""$view$camera Film "$film" "integer xresolution" 8 "integer yresolution" 4
             |WorldBegin Shape "sphere" $end""".stripMargin
        )
        val statements = text(scene).statements
        assert(statements.startsWith("Scale -1 1 1\nLookAt 1 2 -6  "))
        assertAlike(CameraFile.ofText(scene, "camera", statements), scene)

  test("other files keep their place when the camera is written elsewhere"):
    TempFolder.use: folder =>
      val lens = Files.writeString(folder.resolve("a.dat"), "0 1 0 1")
      val scene = read(
        folder,
        "a.pbrt",
        s"""$view Camera "realistic" "string lensfile" "a.dat"
           |Film "image" "integer xresolution" 8 "integer yresolution" 4
           |WorldBegin Shape "sphere" WorldEnd""".stripMargin
      )
      val there = Files.createDirectory(folder.resolve("b"))
      assert(text(scene).statements.contains("\"string lensfile\" \"a.dat\""))
      assert(text(scene).statementsIn(there).contains("\"../a.dat\"") &&
        there.resolve("../a.dat").normalize == lens)

  private def mitsuba(sensor: String) = s"""<scene version="3.0.0"><integrator type="path"/>$sensor
    <emitter type="constant"/><shape type="sphere"/></scene>"""

  private val size = """<film type="hdrfilm"><integer name="width" value="8"/>
    <integer name="height" value="12"/></film>"""
  private val lookat = """<lookat origin="1,2,6" target="0,0.5,0" up="0,1,0"/>"""

  test("a Mitsuba scene's <sensor> is read as the same camera"):
    val flat = """<scale x="2.5" y="2.5"/>"""
    val sensors = Vector(
      s"""<sensor type="perspective"><float name="fov" value="31"/><transform name="to_world">
         |$lookat</transform>$size</sensor>""",
      s"""<sensor type="perspective"><float name="fov" value="31"/>
         |<float name="principal_point_offset_x" value="0.1"/><float name="near_clip" value="0.5"/>
         |<float name="principal_point_offset_y" value="-0.2"/>
         |<transform name="to_world"><scale x="-1"/>$lookat</transform>$size</sensor>""",
      s"""<sensor type="thinlens"><float name="fov" value="31"/>
         |<float name="aperture_radius" value="0.2"/><float name="focus_distance" value="5"/>
         |<transform name="to_world">$lookat</transform>$size</sensor>""",
      s"""<sensor type="orthographic"><transform name="to_world">$flat$lookat</transform>
         |$size</sensor>""",
      s"""<sensor type="spherical"><transform name="to_world">$lookat</transform>$size</sensor>"""
    ).map(_.stripMargin)
    for sensor <- sensors do
      TempFolder.use: folder =>
        val scene = read(folder, "a.xml", mitsuba(sensor))
        val native = text(scene).native.get
        assert(native.title == "Mitsuba's <sensor>")
        assertAlike(read(folder, "b.xml", mitsuba(native.text)), scene)
        assertAlike(CameraFile.ofText(scene, "camera", text(scene).statements), scene)

  test("an upright camera of Mitsuba has its <lookat>"):
    TempFolder.use: folder =>
      val sensor = s"""<sensor type="perspective"><float name="fov" value="31"/>
        <transform name="to_world">$lookat</transform>$size</sensor>"""
      val native = text(read(folder, "a.xml", mitsuba(sensor))).native.get.text
      assert(native.contains("<lookat origin=\"1, 2, 6\" target=\"") &&
        native.contains("up=\"0, 1, 0\"/>"))

  private def gltf(camera: String, node: String) =
    s"""{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[$node,
       |{"translation":[0,0,-5],"extensions":{"KHR_lights_punctual":{"light":0}}}],
       |"extensionsUsed":["KHR_lights_punctual"],
       |"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},
       |"cameras":[$camera]}""".stripMargin

  test("a model's camera and node are read as the same camera"):
    val node = """{"camera":0,"translation":[1,2,9],"rotation":[0,0.6,0,0.8]}"""
    val cameras = Vector(
      """{"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":0.5,"znear":0.1}}""",
      """{"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":2,"znear":0.1,"zfar":9}}""",
      """{"type":"orthographic","orthographic":{"xmag":2,"ymag":1,"znear":0.1,"zfar":50}}"""
    )
    for camera <- cameras do
      TempFolder.use: folder =>
        val scene = read(folder, "a.gltf", gltf(camera, node))
        val native = text(scene).native.get
        val made = ujson.read(native.text)
        val (written, place) = (made("cameras")(0).render(), made("nodes")(0).render())
        assert(native.title == "glTF's camera and node")
        assertAlike(read(folder, "b.gltf", gltf(written, place)), scene)

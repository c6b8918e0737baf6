package candela.models

import candela.color.Rgb
import candela.diagnostics.{Code, Refusal, SceneError}
import candela.image.{Image, ImageFiles}
import candela.io.SceneFolder
import candela.math.Vec3
import candela.scenefile.{Param, Resolution, SceneDescription, ShapeDescription}
import candela.build.SceneBuilder
import candela.settings.{
  BuildControl, ModelGround, ModelLight, ModelSettings, ReadSettings, RenderSettings, Sensors
}
import candela.testing.TempFolder

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class GltfFormatSuite extends AnyFunSuite, GltfModels:
  private def param(s: ShapeDescription, name: String): Param = s.shape.param(name).get
  private def indices(json: String): Vector[Int] = param(shape(json), "indices").ints.toVector

  test("another aspect ratio keeps the vertical field of view, and all of a model in a studio"):
    def camera(json: String, resolution: Resolution, name: String) =
      val scene = read(json, reading = ReadSettings(resolution = Some(resolution)))
      scene.camera.get.param(name).get.floats.toVector
    def seen(view: String) = model(
      nodes = """{"mesh":0},{"camera":0}""",
      roots = "0,1",
      others = s""","cameras":[$view]"""
    )
    val perspective =
      seen("""{"type":"perspective","perspective":{"yfov":1,"aspectRatio":1.5,"znear":0.1}}""")
    // pbrt's angle is that of the shorter side
    val wide = camera(perspective, Resolution.Size(300, 100), "fov").head
    assert(Math.abs(wide - Math.toDegrees(1)) < 1e-4)
    val tall = camera(perspective, Resolution.Size(100, 200), "fov").head
    assert(Math.abs(tall - Math.toDegrees(2 * Math.atan(Math.tan(0.5) / 2))) < 1e-4)
    val flat = """{"type":"orthographic","orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":9}}"""
    assert(camera(
      seen(flat),
      Resolution.Size(100, 200),
      "screenwindow"
    ) == Vector(-1f, 1f, -2f, 2f))
    assert(camera(seen(flat), Resolution.Percent(10), "screenwindow") == Vector(-3f, 3f, -2f, 2f))
    val studio = camera(model(), Resolution.Size(90, 180), "fov").head
    assert(Math.abs(studio - Math.toDegrees(2 * Math.atan(9.0 / 35))) < 1e-4)

  test("a model is a scene with a camera and light"):
    val scene = read(model(primitive = ""","mode":5"""))
    assert(scene.errors.isEmpty && scene.camera.isDefined && scene.lights.nonEmpty)
    assert(scene.shapes.count(_.areaLight.isDefined) == 3)
    assert(scene.additions.exists(a => a.contains("a camera") && a.contains("light")))

  private def shown(settings: ReadSettings, json: String, world: Int = 0): SceneDescription =
    TempFolder.use: folder =>
      val file = folder.resolve("model.gltf")
      Files.writeString(file, json): Unit
      val scene = format.read(file, SceneFolder.of(file, false), settings, Some(world), None)
      assert(scene.errors.isEmpty, scene.errors.map(_.message))
      scene

  private def lit(light: ModelLight, background: Option[ModelGround] = None) =
    shown(
      ReadSettings(model = ModelSettings(Some(light), background)),
      model(primitive = ""","mode":5""")
    )

  /** Of a file that is there only meanwhile. */
  private def inMap(background: Option[ModelGround] = None) = TempFolder.use: folder =>
    val file = folder.resolve("a.exr")
    ImageFiles.write(file, Image.rgb(8, 4))
    lit(ModelLight.Surroundings(s"$file"), background)

  test("the light that is asked for replaces a model's own, and the ground is of a colour"):
    val names = Vector(lit(ModelLight.Studio), lit(ModelLight.Sky), inMap())
      .map(_.lights.map(_.light.name))
    assert(names == Vector(Vector("infinite"), Vector("sunsky"), Vector("infinite")))
    val red = Rgb(0.5f, 0f, 0f)
    val ground = lit(ModelLight.Sky, Some(ModelGround.Colored(red))).shapes.last.material
    assert(ground.declared(Map.empty).get.param("reflectance").get.floats.toVector ==
      Vector(0.5f, 0f, 0f))
    assert(lit(ModelLight.Sky, Some(ModelGround.Empty)).shapes.size == 1)
    val misspelt = intercept[SceneError](lit(ModelLight.Surroundings("studoi"))).problems.head
    assert(misspelt.help.contains("did you mean `studio`?"))
    val absent = intercept[SceneError](lit(ModelLight.Surroundings("sun"))).problems.head
    assert(absent.help.exists(_.contains("studio, sky or an image file")))
    val missing = intercept[SceneError](lit(ModelLight.Surroundings("a.exr"))).problems.head
    assert(missing.message == "no such file: `a.exr`" && missing.code == Code.NoSuchFile)
    val lone = intercept[SceneError](inMap(Some(ModelGround.Colored(red))))
    assert(lone.problems.head.code == Code.OptionMisfit)

  test("an environment map that is not twice as wide as high is a warning"):
    TempFolder.use: folder =>
      def problems(width: Int, height: Int) =
        val file = folder.resolve(s"$width.exr")
        ImageFiles.write(file, Image.rgb(width, height))
        lit(ModelLight.Surroundings(s"$file")).warnings.map(_.message)
      assert(problems(8, 4).isEmpty)
      assert(problems(6, 6).exists(_.contains("has 6×6 pixels, and is stretched")))

  test("a map is seen from within, not mirrored, with its middle ahead"):
    val map = inMap().lights.head
    val toWorld = map.lightToWorld.start
    // pbrt-v3 has the middle at -x, what is right of it towards -y, and the top at z
    assert(toWorld.vector(Vec3(-1, 0, 0)) == Vec3(0, 0, -1))
    assert(toWorld.vector(Vec3(0, -1, 0)) == Vec3(1, 0, 0))
    assert(toWorld.vector(Vec3(0, 0, 1)) == Vec3(0, 1, 0))

  test("on a turntable, the camera goes around the model and keeps its distance"):
    val settings = ReadSettings(model = ModelSettings(turntable = Some(4)))
    val images = Vector.tabulate(4)(shown(settings, model(primitive = ""","mode":5"""), _))
    assert(images.map(_.isFollowed) == Vector(true, true, true, false))
    val names = images.map(_.film.get.param("filename").get.strings.head)
    assert(names == Vector.tabulate(4)(i => s"model-$i.exr"))
    val ofAll = settings.copy(sensors = Some(Sensors.All))
    assert(intercept[SceneError](shown(
      ofAll,
      model(primitive = ""","mode":5""")
    )).problems.nonEmpty)
    val eyes = images.map(_.worldToCamera.start.inverse.point(Vec3.Zero))
    val center = Vec3(0.5f, 0.5f, 0f)
    for (a, b) <- eyes.zip(eyes.tail) do
      val (u, v) = (a - center, b - center)
      assert(Math.abs(u.length - v.length) < 1e-4 && Math.abs(u.y - v.y) < 1e-4)
      assert(Math.abs(u.x * v.x + u.z * v.z) < 1e-4)

  test("a model's cameras are its sensors"):
    val camera =
      """{"type":"perspective","perspective":{"yfov":0.5,"znear":1}},
        |{"type":"perspective","perspective":{"yfov":1,"znear":1}}""".stripMargin
    val json = model(
      primitive = ""","mode":5""",
      nodes = """{"mesh":0},{"camera":0},{"camera":1}""",
      roots = "0,1,2",
      others = s""","cameras":[$camera]"""
    )
    def angle(sensors: Option[Sensors], world: Int = 0) =
      val scene = shown(ReadSettings(sensors = sensors), json, world)
      (Math.toRadians(scene.camera.get.param("fov").get.floats.head), scene.isFollowed)
    assert(Math.abs(angle(None)._1 - 0.5) < 1e-5)
    assert(Math.abs(angle(Some(Sensors.One(1)))._1 - 1) < 1e-5)
    assert(angle(Some(Sensors.All))._2 && !angle(Some(Sensors.All), 1)._2)
    val absent = intercept[SceneError](angle(Some(Sensors.One(2))))
    assert(absent.problems.head.message.contains("0 to 1"))

  test("numbers of instances are in a buffer"):
    val zeros = """{"componentType":5126,"count":22000000,"type":"VEC3"}"""
    val several = """{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":
      {"attributes":{"TRANSLATION":1}}}}"""
    assert(error(model(accessors = Seq(zeros), nodes = several)).endsWith("in a buffer view"))

  test("strips and fans become triangles of the same side"):
    assert(indices(model(primitive = ""","mode":5""")) == Vector(0, 1, 2, 1, 3, 2))
    assert(indices(model(primitive = ""","mode":6""")) == Vector(1, 2, 0, 2, 3, 0))
    // Those that are not whole are left out
    assert(indices(model()) == Vector(0, 1, 2))

  test("matrices are by columns; translation, rotation and scale in this order"):
    def at(node: String) = shape(model(nodes = s"""{"mesh":0,$node}""")).objectToWorld.start
      .point(Vec3(1f, 2f, 3f))
    val moved = at(""""matrix":[2,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1]""")
    assert(moved == Vec3(7f, 8f, 10f))
    val half = Math.sqrt(0.5)
    val turned = at(s""""translation":[1,0,0],"rotation":[0,0,$half,$half],"scale":[2,1,1]""")
    assert((turned - Vec3(-1f, 2f, 3f)).length < 1e-5f)

  test("normalised, strided and sparse numbers are read"):
    val colors = Array[Byte](-1, 0, 0, 127, 0, -1, 0, 0, 0, 0, -1, 0, -128, 0, 0, 0)
    val normalized = model(
      primitive = ""","mode":5""".replace(",\"mode\"", ",\"mode\""),
      accessors = Seq(
        """{"bufferView":1,"componentType":5121,"normalized":true,"count":4,"type":"VEC3"}"""
      ),
      views = Seq("""{"buffer":0,"byteOffset":48,"byteLength":16,"byteStride":4}"""),
      data = colors
    ).replace("\"POSITION\":0", "\"POSITION\":0,\"COLOR_0\":1")
    val values = param(shape(normalized), "colors").floats
    assert(values.take(8).toVector == Vector(1f, 0f, 0f, 1f, 0f, 1f, 0f, 1f))
    assert(Math.abs(values(12) - 128 / 255f) < 1e-6f)

    val sparse = """"sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},
      "values":{"bufferView":2}}"""
    val changed = model(
      primitive = ""","mode":5""",
      views = Seq(
        """{"buffer":0,"byteOffset":48,"byteLength":1}""",
        """{"buffer":0,"byteOffset":52,"byteLength":12}"""
      ),
      data = Array[Byte](2, 0, 0, 0) ++ floats(9, 8, 7)
    ).replace(Position, s"${Position.dropRight(1)},$sparse}")
    val p = param(shape(changed), "P").floats.toVector
    assert(p.slice(3, 9) == Vector(1f, 0f, 0f, 9f, 8f, 7f))

  test("a mesh of several nodes is instanced, but not one that emits light"):
    val nodes = """{"mesh":0},{"mesh":0,"translation":[2,0,0]}"""
    val strip = ""","mode":5,"material":0"""
    val plain = read(model(strip, nodes = nodes, roots = "0,1", others = ""","materials":[{}]"""))
    assert(plain.instances.size == 2 && plain.objects.size == 1)
    val glowing = ""","materials":[{"emissiveFactor":[1,1,1]}]"""
    val lit = read(model(strip, nodes = nodes, roots = "0,1", others = glowing))
    assert(lit.instances.isEmpty && lit.shapes.size == 2)

  test("cameras look along -z, and keep their angle in tall images"):
    val cameras = """,
      "cameras":[{"type":"perspective","perspective":{"yfov":1,"aspectRatio":0.5,"znear":0.1}}]"""
    val nodes = """{"mesh":0},{"camera":0,"translation":[0,0,5]}"""
    val scene = read(model(""","mode":5""", nodes = nodes, roots = "0,1", others = cameras))
    val p = scene.worldToCamera.start.point(Vec3(1f, 0f, 0f))
    assert(p == Vec3(1f, 0f, 5f))
    val fov = Math.toRadians(scene.camera.get.param("fov").get.floats.head)
    assert(Math.abs(Math.tan(fov / 2) - Math.tan(0.5) * 0.5) < 1e-6)

  test("a camera's axes are those of its node, also mirrored and sheared, without scale"):
    val cameras = """,
      "cameras":[{"type":"perspective","perspective":{"yfov":1,"aspectRatio":1,"znear":0.1}}]"""
    def seen(matrix: String) =
      val nodes = s"""{"mesh":0},{"camera":0,"matrix":$matrix}"""
      val scene = read(model(""","mode":5""", nodes = nodes, roots = "0,1", others = cameras))
      scene.worldToCamera.start.point(Vec3(1f, 2f, 3f))
    assert(seen("[2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1]") == Vec3(1f, 2f, -3f))
    assert(seen("[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]") == Vec3(-1f, 2f, -3f))
    assert(seen("[1,0,0,0,0,-1,0,0,0,0,1,0,0,0,0,1]") == Vec3(1f, -2f, -3f))
    assert(seen("[1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,1]") == Vec3(1f, 2f, 3f))
    // The unit of y leads to (0.6, 0.8, 0)
    assert((seen("[1,0,0,0,3,4,0,0,0,0,1,0,0,0,0,1]") - Vec3(-0.5f, 2.5f, -3f)).length < 1e-6)

  test("a model that is wrong is an error with a JSON pointer"):
    def replaced(from: String, to: String) = error(model(""","mode":5""").replace(from, to))
    assert(error("{").contains("not valid JSON"))
    assert(error("[]").startsWith(": expected an object"))
    assert(error("""{"asset":{"version":"1.0"}}""").startsWith("/asset/version: "))
    assert(replaced("\"count\":4", "\"count\":5").startsWith("/accessors/0: 5 elements end at"))
    assert(replaced("\"count\":4", "\"count\":2000000000").startsWith("/accessors/0: "))
    assert(replaced("\"count\":4", "\"count\":-1").startsWith("/accessors/0/count: "))
    assert(replaced("\"byteLength\":48}", "\"byteLength\":49}").startsWith("/bufferViews/0: "))
    assert(replaced("5126", "5127").startsWith("/accessors/0/componentType: "))
    assert(replaced("\"mesh\":0", "\"mesh\":1").startsWith("/nodes/0/mesh: "))
    assert(replaced("VEC3", "VEC9").startsWith("/accessors/0/type: "))
    assert(replaced("\"mode\":5", "\"mode\":7").startsWith("/meshes/0/primitives/0/mode: "))
    assert(replaced("base64,", "base64,*").startsWith("/buffers/0/uri: "))
    val circle = model(nodes = """{"children":[1]},{"children":[0]}""")
    assert(error(circle).startsWith("/nodes/1/children/0: node 0 is reached twice"))
    val far = """,{"componentType":5126,"count":900000000,"type":"VEC3"}"""
    val huge = model().replace(Position, Position + far).replace("\"POSITION\":0", "\"POSITION\":1")
    assert(error(huge).startsWith("/accessors/1: "))

  test("deep nesting and damaged binaries are errors, too"):
    assert(error("[" * 200_000).nonEmpty)
    val folder = Files.createTempDirectory("candela-models")
    def binary(bytes: Array[Byte]) =
      val file = Files.write(folder.resolve("model.glb"), bytes)
      try
        val e =
          intercept[SceneError](format.read(file, SceneFolder.of(file), ReadSettings(), None))
        e.problems.head.message
      finally Files.delete(file)
    val start = "glTF".getBytes(UTF_8) ++ Array[Byte](2, 0, 0, 0, 40, 0, 0, 0)
    try
      assert(binary(start).contains("no JSON"))
      assert(binary(start.take(8)).contains("ends early"))
      assert(binary("abcdef".getBytes(UTF_8)).endsWith("it begins with `abcd`, not `glTF`"))
      assert(binary(start ++ Array[Byte](-1, -1, -1, 127, 74, 83, 79, 78)).contains("ends early"))
      assert(binary(start.updated(4, 1.toByte)).contains("version 1"))
    finally Files.delete(folder)

  test("a model in a sandbox reads no files beside its folder, and no devices"):
    def refused(uri: String) =
      val json = model().replaceAll("\"uri\":\"[^\"]*\"", s"\"uri\":\"$uri\"")
      intercept[Refusal](read(json, isConfined = true)).problem
    assert(refused("../../secret.bin").code == Code.Sandboxed)
    assert(refused("/dev/zero").code == Code.Sandboxed)
    assert(refused("%2e%2e/secret.bin").code == Code.Sandboxed)
    val remote = model().replaceAll("\"uri\":\"[^\"]*\"", "\"uri\":\"https://example.com/a.bin\"")
    assert(error(remote).startsWith("/buffers/0/uri: addresses of other schemes"))

  test("an extension that is required must be known, unless rendering goes on"):
    val json = model(
      primitive = ""","mode":5""",
      others = ""","extensionsRequired":["KHR_texture_transform","KHR_draco_mesh_compression"]"""
    )
    val problem = read(json).errors.head
    assert(problem.pos.exists(_.file.endsWith("#/extensionsRequired/1")))
    assert(problem.message.contains("KHR_draco_mesh_compression"))
    assert(read(json, reading = ReadSettings(keepGoing = true)).errors.isEmpty)

  test("what is not supported is a warning with its pointer"):
    val materials = ""","materials":[{"extensions":{"KHR_materials_volume_scatter":{}}}]"""
    val animations = ""","animations":[{"channels":[],"samplers":[]}]"""
    val scene = read(model(""","mode":5,"material":0""", others = materials + animations))
    val at = scene.warnings.flatMap(_.pos).map(_.toString)
    assert(at.exists(_.endsWith("#/materials/0/extensions/KHR_materials_volume_scatter")), at)
    assert(at.exists(_.endsWith("#/animations/0")), at)

  /** Warnings of a model whose material has these members, with their places. */
  private def warned(material: String): Vector[String] =
    val scene =
      read(model(""","mode":5,"material":0""", others = s""","materials":[{$material}]"""))
    assert(scene.errors.isEmpty)
    scene.warnings.map(w => s"${w.pos.fold("")(_.file.dropWhile(_ != '#').drop(1))}: ${w.message}")

  test("misspelt members and factors outside 0 to 1 are warnings with their pointers"):
    val pbr =
      """"pbrMetallicRoughness":{"metalicFactor":0,"roughnessfactor":1,"metallicFactor":3}"""
    assert(warned(pbr).toSet == Set(
      "/materials/0/pbrMetallicRoughness/metalicFactor: unknown member `metalicFactor`; " +
        "did you mean `metallicFactor`?",
      "/materials/0/pbrMetallicRoughness/roughnessfactor: unknown member `roughnessfactor`; " +
        "did you mean `roughnessFactor`?",
      "/materials/0/pbrMetallicRoughness/metallicFactor: `metallicFactor` must be from 0 to 1, " +
        "found 3; using 1"
    ))
    assert(warned(""""pbrMetalicRoughness":{},"doublesided":true,"extras":{"a":1}""").size == 2)
    assert(warned(""""emissiveTexture":{"index":0},"name":"a","alphaCutoff":0.5""").isEmpty)

  test("a missing image is named, with its place, and magenta if rendering goes on"):
    val textured = model(
      ""","mode":5,"material":0""",
      others = ""","materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
        "textures":[{"source":0}],"images":[{"uri":"none.png"}]"""
    )
    val control = BuildControl(threads = 1)
    def built(keepGoing: Boolean) =
      val settings = RenderSettings(reading = ReadSettings(keepGoing = keepGoing))
      SceneBuilder.build(read(textured, reading = settings.reading), settings, control)
    val missing = intercept[SceneError](built(false)).problems.head
    assert(missing.message.contains("none.png") && missing.standIn.contains("using magenta"))
    assert(missing.pos.exists(_.file.endsWith("baseColorTexture")), missing.pos)
    assert(built(true)._2.exists(_.message.contains("using magenta")))

  test("values for parameters, of which models have none, are an error"):
    val reading = ReadSettings(defines = Map("width" -> "3"))
    val problem = intercept[SceneError](read(model(), reading = reading)).problems.head
    assert(problem.code == Code.SceneParameter)

  test("transforms of textures are those of the extension, about the upper left corner"):
    val transform =
      """"extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":1.5707963267948966,
        |"scale":[0.5,0.5]}}""".stripMargin
    val png =
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU" +
        "5ErkJggg=="
    val materials = s""",
      |"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,$transform}}}],
      |"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,$png"}]""".stripMargin
    val scene = read(model(""","mode":5,"material":0""", others = materials))
    val t = scene.textures.head.texture
    def number(name: String, default: Float) = t.param(name).fold(default)(_.floats.head)
    // The lower left quadrant of the image, turned
    def st(u: Float, v: Float) =
      (
        number("uscale", 1) * u + number("uskew", 0) * v + number("udelta", 0),
        number("vskew", 0) * u + number("vscale", 1) * v + number("vdelta", 0)
      )
    assert(st(0, 1) == (0f, 0f) && st(1, 1) == (0f, 0.5f) && st(0, 0) == (0.5f, 0f))
    assert(t.folder.locate(t.param("filename").get.strings.head, None).exists(_.size > 0))

package candela.models

import candela.aov.Layer
import candela.build.SceneBuilder
import candela.image.Image
import candela.job.CameraFile
import candela.render.Renderer
import candela.scenefile.{Resolution, SceneDescription}
import candela.settings.{ReadSettings, RenderSettings}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files
import java.nio.{ByteBuffer, ByteOrder}

/** Which medium is where in a model. */
class InteriorsSuite extends AnyFunSuite, GltfModels:
  private val Absorption = 0.5

  /** Unit cubes whose faces point outwards; the last one lacks a face. */
  private val corners = floats(unit*)
  private val innerCorners = floats(unit.map(0.25 + 0.5 * _)*)
  private def unit =
    for
      x <-
        0 to 1;
      y <-
        0 to 1;
      z <-
        0 to 1;
      c <- Vector(x, y, z)
    yield c.toDouble
  private val faces = Vector(0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6,
    0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3)

  private def shorts(values: Vector[Int]): Array[Byte] =
    val bytes = ByteBuffer.allocate(2 * values.size).order(ByteOrder.LITTLE_ENDIAN)
    values.foreach(x => bytes.putShort(x.toShort))
    bytes.array

  private val Camera = """{"camera":0,"translation":[0.5,0.5,6]}"""
  private val Perspective = """"perspective","perspective":{"yfov":0.02,"znear":0.1}"""
  private val Inside = s""""absorption":[$Absorption,$Absorption,$Absorption]"""
  private val Passed = s"""$Inside,"surface":false"""

  private def fog(members: String = "", box: String = "0,0,0,1,1,1") =
    s"""{"extras":{"candela":{"medium":{"uri":"fog.nvdb","box":[$box],"absorption":[1,1,1]}}}
       |$members}""".stripMargin

  /** The first node is the camera's. */
  private def cubes(
      nodes: Seq[String],
      medium: String = Passed,
      material: String = "",
      camera: String = Perspective,
      indices: Vector[Int] = faces
  ): String =
    // The second mesh is within the first, the third has both
    def primitive(position: Int) =
      s"""{"attributes":{"POSITION":$position},"indices":1,"material":0}"""
    val bytes = corners ++ shorts(indices) ++ innerCorners
    s"""{"asset":{"version":"2.0"},"nodes":[${nodes.mkString(",")}],"cameras":[{"type":$camera}],
       |"scenes":[{"nodes":[${nodes.indices.mkString(",")}],
       |"extras":{"candela":{"environment":{"radiance":[1,1,1]}}}}],
       |"materials":[{"extras":{"candela":{"medium":{$medium}}}$material}],
       |"meshes":[{"primitives":[${primitive(0)}]},{"primitives":[${primitive(2)}]},
       |{"primitives":[${primitive(0)},${primitive(2)}]}],
       |"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],
       |"max":[1,1,1]},{"bufferView":1,"componentType":5123,"count":${indices.size},
       |"type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":8,"type":"VEC3",
       |"min":[0.25,0.25,0.25],"max":[0.75,0.75,0.75]}],"bufferViews":[{"buffer":0,"byteLength":96},
       |{"buffer":0,"byteOffset":96,"byteLength":${2 * indices.size}},
       |{"buffer":0,"byteOffset":${96 + 2 * indices.size},"byteLength":96}],
       |"buffers":[{"byteLength":${bytes.length},"uri":"${uri(bytes)}"}]}""".stripMargin

  private val Cube = """{"mesh":0}"""

  private def image(json: String, settings: RenderSettings = RenderSettings()): Image =
    val small = ReadSettings(resolution = Some(Resolution.Size(4, 4)))
    val (plan, _) = SceneBuilder.build(
      read(json, reading = small),
      settings.copy(samples = Some(4), reading = small)
    )
    Renderer.render(plan, threads = 1).image(plan.development)

  private def assertRadiance(json: String, expected: Double): Unit =
    for x <- image(json).toRgb.data do assert(Math.abs(x - expected) < 1e-3, s"$expected")

  private def warnings(s: SceneDescription): Vector[String] =
    s.warnings.map(w => s"${w.pos.get.file.dropWhile(_ != '#').drop(1)}: ${w.message}")

  test("the camera is in the innermost medium in which its rays begin"):
    def around(z: Double, near: Double = 0.1, more: String = fog(box = "-9,-9,2,9,9,4")) =
      val camera = s"""{"camera":0,"translation":[0.5,0.5,$z]}"""
      val s = read(cubes(
        Seq(camera, Cube, more),
        camera = s""""perspective","perspective":{"yfov":0.02,"znear":$near}"""
      ))
      s.media.find(_.name == s.cameraMedium).map(_.medium.name)
    assert(around(z = 0.6).contains("homogeneous") && around(z = 3).contains("nanovdb"))
    assert(around(z = 1.6).isEmpty && around(z = 0.05).isEmpty)
    assert(around(z = 6, near = 5.5).contains("homogeneous") && around(z = 3, near = 1.5).isEmpty)
    assert(around(z = 0.6, more = fog(box = "-9,-9,-9,9,9,9")).contains("homogeneous"))

  test("a camera that is added is outside of boxes at the origin"):
    assert(read(cubes(Seq(Cube, fog(box = "-1,-1,-1,1,1,1")))).cameraMedium.isEmpty)

  test("rays that begin in several media are a warning"):
    val wide = """"orthographic","orthographic":{"xmag":3,"ymag":3,"znear":0.1,"zfar":9}"""
    val s = read(cubes(Seq("""{"camera":0,"translation":[0.5,0.5,0.6]}""", Cube), camera = wide))
    assert(warnings(s).exists(_.startsWith("/cameras/0: rays of this camera begin in several")))
    assert(s.cameraMedium.nonEmpty)

  test("light is absorbed from the ray's start"):
    val within = """{"camera":0,"translation":[0.5,0.5,0.7]}"""
    assertRadiance(cubes(Seq(within, Cube)), Math.exp(-0.6 * Absorption))
    assertRadiance(cubes(Seq(Camera, Cube)), Math.exp(-Absorption))

  test("alpha lets paths and light through the surface into the medium"):
    for material <- Vector(""""alphaMode":"MASK"""", """"alphaMode":"BLEND"""") do
      val clear = s""",$material,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0]}"""
      assertRadiance(cubes(Seq(Camera, Cube), Inside, clear), Math.exp(-Absorption))
      // Light from the side
      val lamp = """{"extras":{"candela":{"light":{"size":[1,1]}}},"translation":[3,0.5,0.5],
                   |"rotation":[0,0.7071,0,0.7071]}""".stripMargin
      val nodes = Seq(Camera, Cube, lamp)
      val scattering = s"""$Inside,"scattering":[1,1,1]"""
      val passed = image(cubes(nodes, s"""$scattering,"surface":false"""))
      assert(image(cubes(nodes, scattering, clear)).data.toSeq == passed.data.toSeq)

  test("media cover what is behind them"):
    val alpha = RenderSettings(layers = Vector(Layer.Alpha))
    val covered = image(cubes(Seq(Camera, Cube)), alpha)
    val c = covered.channelNames.indexOf("A")
    for i <- 0 until 16 do
      val a = covered.data(i * covered.channels + c)
      assert(Math.abs(a - (1 - Math.exp(-Absorption))) < 1e-3)

  test("a mesh within a box borders on the box's medium, one across its faces is a warning"):
    def meeting(scale: Double) =
      val small = s"""{"mesh":0,"scale":[$scale,$scale,$scale],"translation":[0.1,0.1,0.1]}"""
      read(cubes(Seq(Camera, small, fog())))
    val within = meeting(0.5)
    val Vector(mesh) = within.shapes.filter(_.outsideMedium.nonEmpty): @unchecked
    val names = within.media.map(m => m.medium.name -> m.name).toMap
    assert(mesh.insideMedium == names("homogeneous") && mesh.outsideMedium == names("nanovdb"))
    assert(warnings(within).isEmpty)
    val across = meeting(1.5)
    assert(across.shapes.forall(_.outsideMedium.isEmpty))
    assert(warnings(across) == Vector("/meshes/0/primitives/0: this mesh meets another " +
      "medium, which may not be seen behind it"))

  test("what zfar clips covers nothing"):
    val camera = """"orthographic","orthographic":{"xmag":0.1,"ymag":0.1,"znear":0.1,"zfar":3}"""
    val clipped = image(
      cubes(Seq(Camera, Cube), Inside, camera = camera),
      RenderSettings(layers = Vector(Layer.Alpha, Layer.Depth))
    )
    for name <- Vector("A", "Z") do
      val c = clipped.channelNames.indexOf(name)
      assert(c >= 0 && (0 until 16).forall(i => clipped.data(i * clipped.channels + c) == 0f), name)

  private val Inner = """{"mesh":1}"""

  test("a mesh within others borders on the innermost, also in each instance"):
    for nodes <- Seq(Seq(Cube, Inner), Seq(Inner, Cube), Seq("""{"mesh":2}""")) do
      assertRadiance(cubes(Camera +: nodes), Math.exp(-Absorption))
    val beside = """{"mesh":2,"translation":[3,0,0]}"""
    assertRadiance(cubes(Seq(Camera, """{"mesh":2}""", beside)), Math.exp(-Absorption))
    // Of other absorption
    val box = fog(box = "-1,-1,-1,2,2,2")
    val s = read(cubes(Seq(Camera, Cube, Inner, box)))
    val media = s.shapes.map(m => m.shape.pos.file.dropWhile(_ != '#') -> m.outsideMedium).toMap
    val names = s.media.map(m => m.medium.name -> m.name).toMap
    assert(media("#/meshes/0/primitives/0") == names("nanovdb"))
    assert(media("#/meshes/1/primitives/0") == names("homogeneous"))
    assert(warnings(s).isEmpty)

  test("meshes that cross or touch are a warning, and such as only their boxes meet are none"):
    val message = "/meshes/1/primitives/0: this mesh meets another medium, which may not be seen " +
      "behind it"
    def beside(transform: String) =
      warnings(read(cubes(Seq(Camera, Cube, s"""{"mesh":1,$transform}"""))))
    // A bar through the cube, none of whose vertices is within it
    val across = Vector(
      """"scale":[0.5,0.5,3],"translation":[0,0,-1]""",
      """"scale":[3,0.1,0.1],"translation":[-1,0.3,0.3]""",
      """"translation":[0.5,0,0]""",
      """"translation":[0.25,0,0]""",
      """"translation":[0.75,0.2,0.1]"""
    )
    for transform <- across do assert(beside(transform) == Vector(message), transform)
    // A corner beside an edge
    val turned = """"rotation":[0,0,0.38268,0.92388],"translation":[1.2,0.6,0]"""
    for transform <- Vector(turned, """"translation":[0.76,0,0]""") do
      assert(beside(transform).isEmpty, transform)

  test("a mesh whose faces are wound inwards is a warning"):
    val inwards = faces.grouped(3).flatMap(_.reverse).toVector
    assert(warnings(read(cubes(Seq(Camera, Cube), indices = inwards))) ==
      Vector("/meshes/0/primitives/0: the faces of this mesh are wound inwards, so that its " +
        "medium is outside"))

  test("the medium is that around the camera of a file"):
    val file = Files.createTempFile("camera", ".pbrt")
    def around(text: String, node: String = Camera) =
      Files.writeString(file, text): Unit
      val reading = ReadSettings(camera = Some(file.toString))
      read(cubes(Seq(node, Cube)), reading = reading).cameraMedium
    val within = """{"camera":0,"translation":[0.5,0.5,0.5]}"""
    try
      assert(around("LookAt 0.5 0.5 0.6 0.5 0.5 0 0 1 0").nonEmpty)
      assert(around("LookAt 0.5 0.5 6 0.5 0.5 0 0 1 0\nCamera \"perspective\"", within).isEmpty)
      assert(around("MediumInterface \"\" \"\"\nCamera \"perspective\"", within).isEmpty)
    finally Files.delete(file)
    val moved = CameraFile.ofText(read(cubes(Seq(within, Cube))), "camera", "Translate 0 0 9")
    assert(moved.cameraMedium.isEmpty)

  test("boxes that overlap or touch are a warning"):
    def boxes(x: Double) =
      warnings(read(cubes(Seq(Camera, fog(), fog(s""","translation":[$x,0.5,0]""")))))
    assert(boxes(1.01).isEmpty)
    for x <- Vector(0.9, 1.0) do
      assert(boxes(x) == Vector("/nodes/2/extras/candela/medium: the boxes of two media overlap " +
        "or touch; there, only one of them is seen"))

  test("a mesh with a medium that is not closed is a warning"):
    val open = read(cubes(Seq(Camera, Cube), indices = faces.drop(6)))
    assert(warnings(open) == Vector("/meshes/0/primitives/0: this mesh is not closed: rays may " +
      "enter its medium and never leave it"))
    assert(warnings(read(cubes(Seq(Camera, Cube)))).isEmpty)

  test("a material without a surface that should emit is a warning"):
    val s = read(cubes(Seq(Camera, Cube), material = ""","emissiveFactor":[1,1,1]"""))
    assert(warnings(s) ==
      Vector("/materials/0/emissiveFactor: a material without a surface emits nothing"))

  test("each instance of a node has its medium"):
    val instancing =
      ""","extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}"""
    val s = read(cubes(Seq(Camera, fog(instancing, box = "0,0,0,0.1,0.1,0.1"))))
    assert(s.errors.isEmpty && s.media.size == 8, s.errors)
    val places = s.shapes.map(_.objectToWorld).toSet
    assert(places.size == 8 && places == s.media.map(_.mediumToWorld).toSet)

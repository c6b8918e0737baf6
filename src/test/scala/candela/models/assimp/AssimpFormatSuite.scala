package candela.models.assimp

import candela.diagnostics.Refusal
import candela.image.Natives
import candela.math.Vec3
import candela.models.MeshFormats
import candela.scenefile.SceneDescription
import candela.settings.{ModelSettings, ModelState, ModelTimes, ReadSettings, UpAxis}

import org.scalatest.Outcome
import org.scalatest.funsuite.AnyFunSuite

class AssimpFormatSuite extends AnyFunSuite:
  import AssimpFiles.*
  import MeshFormats.{bytes, floats, material, number, told}

  override def withFixture(test: NoArgTest): Outcome =
    try Natives.require("assimp", "assimp")
    catch case e: LinkageError => cancel(s"skipped: ${e.getMessage}")
    super.withFixture(test)

  private def read(
      name: String,
      text: String,
      reading: ReadSettings = ReadSettings()
  ): SceneDescription = MeshFormats.read(Seq(name -> bytes(text)), reading)

  private def warnings(scene: SceneDescription) = scene.warnings.map(told)

  /** World positions of the first shape that is the model's. */
  private def positions(scene: SceneDescription): Vector[Vector[Int]] =
    val shape = scene.shapes.head
    floats(shape.shape, "P").grouped(3).toVector.map: p =>
      val q = shape.objectToWorld.start.point(Vec3(p(0), p(1), p(2)))
      Vector(q.x, q.y, q.z).map(x => Math.round(1000 * x))

  test("FBX is turned from its axes, and its centimetres become metres"):
    val scene = read("a.fbx", fbx(color("DiffuseColor", 0.5, 0.25, 0.125)))
    assert(positions(scene).toSet == Set(
      Vector(0, 2000, 0),
      Vector(1000, 2000, 0),
      Vector(0, 3000, 0)
    ))

  test("weights of FBX's morph targets, which Assimp does not read, are 0, with a warning"):
    val scene = read("a.fbx", fbx("", lights = morphed))
    assert(positions(scene) == positions(read("a.fbx", fbx(""))))
    assert(warnings(scene).exists(_.contains("the weights of its morph targets are not read")))

  test("materials of FBX become what Blender makes of them"):
    val properties = color("DiffuseColor", 0.5, 0.25, 0.125) + numeric("ShininessExponent", 25) +
      numeric("SpecularFactor", 0.125) + numeric("ReflectionFactor", 0.75) + numeric("Opacity", 0.5)
    val scene = read("a.fbx", fbx(properties))
    val d = material(scene, 0)
    assert(floats(d, "color") == Vector(0.5f, 0.25f, 0.125f))
    assert(number(d, "roughness").contains(0.5f) && number(d, "metallic").contains(0.75f))
    assert(floats(d, "specularcolor") == Vector(0.5f, 0.5f, 0.5f))
    assert(number(scene.shapes.head.shape, "alpha").contains(0.5f))
    val plain = material(read("a.fbx", fbx("")), 0)
    assert(Math.abs(number(plain, "roughness").get - 0.5528f) < 1e-4f)
    assert(plain.param("specularcolor").isEmpty)

  test("images of another computer are looked for beside the model"):
    val png = java.util.Base64.getDecoder.decode(
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAA" +
        "AABJRU5ErkJggg=="
    )
    val model = bytes(fbx("", texture = """C:\\work\\red.png""".replace("\\\\", "\\")))
    val scene = MeshFormats.read(Seq("a.fbx" -> model, "red.png" -> png))
    assert(scene.errors.isEmpty, scene.errors)
    assert(scene.textures.exists(_.texture.param("filename").exists(_.strings.contains("red.png"))))
    val expected = "a.fbx#material Cloth:0:0: no such file: `C:/work/red.png`; using `red.png`"
    assert(warnings(scene).contains(expected), warnings(scene))

  test("a mesh of several nodes is an object; lights are where their nodes are"):
    val attenuation = "<quadratic_attenuation>0.5</quadratic_attenuation>"
    val scene = read("a.dae", collada(attenuation))
    assert(scene.objects.size == 1 && scene.instances.size == 2)
    val light = scene.lights.head
    assert(floats(light.light, "I") == Vector(2f, 4f, 8f))
    assert(light.lightToWorld.start.point(Vec3.Zero) == Vec3(0, 3, 0))
    // Assimp loses it
    val expected = "a.dae#camera eye:0:0: its field of view is not read; left out"
    assert(warnings(scene) == Vector(expected))

  test("light that nothing attenuates is reported"):
    val expected = "a.dae#light lamp:0:0: here its light falls off with the square of the distance"
    assert(warnings(read("a.dae", collada(""))).contains(expected))

  test("joints and skins are animated"):
    def at(time: Double) =
      ReadSettings(model = ModelSettings(state = ModelState(Some(ModelTimes.at(time)))))
    assert(positions(read("a.dae", skinned)).map(_(1)).max == 1000)
    assert(positions(read("a.dae", skinned, at(1.5))).map(_(1)).max == 4000)

  test("which axis points up is said where files leave it open"):
    val scene = read("a.off", off)
    assert(scene.additions.exists(_.contains("z points up, turned to y: --up y changes that")))
    assert(!read("a.fbx", fbx("")).additions.exists(_.contains("points up")))
    assert(positions(scene).exists(_ == Vector(0, 1000, 0)))
    val turned = read("a.off", off, MeshFormats.up(UpAxis.Y))
    assert(positions(turned).exists(_ == Vector(0, 0, 1000)))

  test("AC3D and X3D have their triangles and colours"):
    val plane = read("a.ac", ac)
    assert(MeshFormats.ints(plane.shapes.head.shape, "indices").size == 6)
    assert(floats(material(plane, 0), "color") == Vector(0.9f, 0.1f, 0.1f))
    assert(floats(material(read("a.x3d", x3d), 0), "color") == Vector(0.2f, 0.4f, 0.6f))

  test("what Assimp can't read is an error with its words"):
    val message = MeshFormats.error(read("a.fbx", "Kaydara FBX Binary  "))
    assert(message.startsWith("a.fbx:0:0: Assimp can't read the model: "), message)

  test("a sandbox refuses it, as native code can't be confined"):
    val e = intercept[Refusal]:
      MeshFormats.read(Seq("a.fbx" -> bytes(fbx(""))), isConfined = true)
    assert(e.problem.message.contains("is read by Assimp, which no sandbox confines"))

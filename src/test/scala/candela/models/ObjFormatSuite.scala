package candela.models

import candela.diagnostics.{Code, Refusal, SceneError}
import candela.math.Vec3
import candela.models.MeshFormats.*
import candela.scenefile.SceneDescription
import candela.settings.{ModelSettings, ReadSettings, Sensors, UpAxis}

import org.scalatest.funsuite.AnyFunSuite

class ObjFormatSuite extends AnyFunSuite:
  private val Square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

  private def model(obj: String, mtl: String = "", settings: ReadSettings = ReadSettings()) =
    read(Seq("m.obj" -> bytes(obj), "m.mtl" -> bytes(mtl)), settings)

  private def normals(obj: String): Vector[Vector[Float]] =
    floats(model(obj).shapes.head.shape, "N").grouped(3).toVector

  test("a mesh is a scene with a camera and light, and what was taken as up is said"):
    val scene = model(Square + "f 1 2 3 4\n")
    assert(scene.errors.isEmpty && scene.camera.isDefined && scene.lights.nonEmpty)
    assert(ints(scene.shapes.head.shape, "indices") == Vector(0, 1, 2, 0, 2, 3))
    assert(floats(scene.shapes.head.shape, "N").isEmpty)
    assert(scene.additions.get.endsWith("; y points up: --up z changes that"))
    assert(scene.warnings.isEmpty)

  test("with --up z, z points up and -y to the front"):
    val scene = model(Square + "f 1 2 3 4\n", settings = up(UpAxis.Z))
    val turn = scene.shapes.head.objectToWorld.start
    assert((turn.vector(Vec3(0, 0, 1)) - Vec3(0, 1, 0)).length < 1e-6f)
    assert((turn.vector(Vec3(0, -1, 0)) - Vec3(0, 0, 1)).length < 1e-6f)
    assert(!scene.additions.get.contains("points up"))

  test("options that do not fit are refused"):
    def refused(settings: ReadSettings) =
      val e = intercept[SceneError](model(Square + "f 1 2 3\n", settings = settings))
      assert(e.problems.head.code == Code.OptionMisfit)
    refused(ReadSettings(sensors = Some(Sensors.One(0))))
    val known = intercept[SceneError](read(Seq("m.gltf" -> bytes("{}")), up(UpAxis.Z)))
    assert(known.problems.head.code == Code.OptionMisfit)

  test("a turntable has a scene for each image"):
    val settings = ReadSettings(model = ModelSettings(turntable = Some(3)))
    val scenes = Vector(0, 2).map: n =>
      read(Seq("m.obj" -> bytes(Square + "f 1 2 3\n")), settings, world = Some(n))
    assert(scenes.map(_.isFollowed) == Vector(true, false))

  test("faces of a smoothing group have common normals, others are flat"):
    val roof = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    val apart = normals(roof + "s 1\nf 1 2 3\ns 2\nf 1 4 2\n")
    assert(apart.size == 6)
    val smooth = normals(roof + "s 1\nf 1 2 3\nf 1 4 2\n")
    assert(smooth.size == 4)
    val edge = smooth(0)
    assert(edge(0) == 0f && edge(1) > 0f && Math.abs(edge(1) - edge(2)) < 1e-6f)
    val mixed = normals(roof + "f 1 2 3\ns 1\nf 1 4 2\n")
    assert(mixed.size == 6 && mixed.take(3).forall(_ == Vector(0f, 0f, 1f)))

  test("normals of the file come before smoothing groups"):
    assert(normals(Square + "vn 1 0 0\ns 1\nf 1//1 2//1 3//1\n").forall(_ == Vector(1f, 0f, 0f)))

  test("a face without normals is flat beside those that have them"):
    val all = normals(Square + "vn 1 0 0\nf 1//1 2//1 3//1\nf 1 3 4\n")
    assert(all == Vector.fill(3)(Vector(1f, 0f, 0f)) ++ Vector.fill(3)(Vector(0f, 0f, 1f)))

  test("a concave polygon is not filled"):
    val scene = model("v 0 0 0\nv 4 4 0\nv 0 1 0\nv -4 4 0\nf 1 2 3 4\n")
    assert(ints(scene.shapes.head.shape, "indices").grouped(3).forall(t =>
      Set(0, 2).subsetOf(t.toSet)
    ))

  test("colours of vertices are sRGB, and scale the material"):
    val colored = "v 0 0 0 1 0.5 0\nv 1 0 0 1 0.5 0\nv 1 1 0 1 0.5 0\nf 1 2 3\n"
    val scene = model(colored)
    val first = floats(scene.shapes.head.shape, "colors").take(4)
    assert(first(0) == 1f && Math.abs(first(1) - 0.2140f) < 1e-4f && first(3) == 1f)
    assert(scene.textures.map(_.texture.name) == Vector("vertexcolor"))
    val red = model("mtllib m.mtl\nusemtl a\n" + colored, "newmtl a\nKd 1 0 0\n")
    assert(red.textures.map(_.texture.name) == Vector("vertexcolor", "scale"))

  test("materials come from all libraries, and what is missing is a warning with the nearest name"):
    val two = read(Seq(
      "m.obj" -> bytes("mtllib my a.mtl\nmtllib b.mtl c.mtl\n" + Square +
        "usemtl red\nf 1 2 3\nusemtl blu\nf 1 3 4\nusemtl blue\nf 2 3 4\nusemtl red\nf 1 2 4\n"),
      "my a.mtl" -> bytes("newmtl red\nKd 1 0 0\n"),
      "b.mtl" -> bytes("newmtl green\nKd 0 1 0\n"),
      "c.mtl" -> bytes("newmtl blue\nKd 0 0 1\n")
    ))
    assert(two.namedMaterials.map(_._1) == Vector("red", "blue") && two.shapes.size == 3 + 4)
    assert(two.warnings.map(told) == Vector("m.obj:9:8: no material `blu`; its faces have none"))
    assert(two.warnings.head.help.contains("did you mean `blue`?"))
    val none = model("mtllib n.mtl\n" + Square + "usemtl a\nf 1 2 3\n")
    assert(none.errors.isEmpty)
    assert(none.warnings.map(told) ==
      Vector("m.obj:1:8: no such file: `n.mtl`; faces have the material of none"))

  test("statements that are left out are warnings, once for each kind"):
    val scene = model(Square + "f 1 2 3\nl 1 2\nl 2 3\ncurv 0 1 1 2\nlod 1\nusemtll a\nf 1 2\n")
    assert(scene.warnings.map(told) == Vector(
      "m.obj:6:1: `l`: lines are not supported; left out",
      "m.obj:8:1: `curv`: free-form curves and surfaces are not supported; left out",
      "m.obj:10:1: unknown statement `usemtll`; left out",
      "m.obj:11:1: faces of fewer than three corners are left out"
    ))
    assert(scene.warnings(2).help.contains("did you mean `usemtl`?"))

  test("faults have the place in the model or its library"):
    assert(error(model(Square + "f 1 2 5\n")) ==
      "m.obj:5:7: an index of the corner `5` is out of range: vertices are 1 to 4")
    assert(error(model("mtllib m.mtl\n" + Square + "f 1 2 3\n", "newmtl a\nKd 1 x 0\n")) ==
      "m.mtl:2:6: expected a number, found `x`")
    assert(error(model("v 0 0 0\n")) == "m.obj:0:0: it has no faces")

  test("a text is read as the file"):
    val scene = candela.job.SceneFormat.named(java.nio.file.Path.of("m.obj")).get.read(
      java.nio.file.Path.of("m.obj"),
      candela.io.SceneFolder.of(java.nio.file.Path.of("m.obj")),
      ReadSettings(),
      None,
      Some(Square + "f 1 2 3\n")
    )
    assert(scene.errors.isEmpty && ints(scene.shapes.head.shape, "indices") == Vector(0, 1, 2))

  test("in the sandbox, a library or an image of elsewhere is refused"):
    def refused(obj: String, mtl: String): Unit =
      val files = Seq("m.obj" -> bytes(obj), "m.mtl" -> bytes(mtl))
      val refusal = intercept[Refusal](read(files, isConfined = true))
      assert(refusal.problem.code == Code.Sandboxed): Unit
    refused("mtllib ../other.mtl\n" + Square + "f 1 2 3\n", "")
    for name <- Vector("../x.png", "/etc/passwd") do
      refused("mtllib m.mtl\n" + Square + "usemtl a\nf 1 2 3\n", s"newmtl a\nmap_Kd $name\n")

  private def scene(mtl: String): SceneDescription =
    model("mtllib m.mtl\n" + Square + "usemtl a\nf 1 2 3\n", mtl)
  test("a material that nothing uses makes no difference"):
    assert(scene("newmtl a\nnewmtl b\nKd 1 0 0\n").namedMaterials.size == 1)

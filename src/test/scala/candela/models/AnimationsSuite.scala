package candela.models

import candela.diagnostics.{Code, SceneError, Severity}
import candela.io.SceneFolder
import candela.math.Vec3
import candela.scenefile.SceneDescription
import candela.settings.{ModelSettings, ModelState, ModelTimes, ReadSettings, Sensors}

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class AnimationsSuite extends AnyFunSuite, GltfModels:
  private def at(time: Double, animation: Option[String] = None) =
    reading(ModelState(Some(ModelTimes.at(time)), animation))

  private def reading(state: ModelState) = ReadSettings(model = ModelSettings(state = state))

  /** An animation of a property of node 0, by accessors 1 and 2. */
  private def animation(path: String, interpolation: String, name: String = "Walk") =
    s"""{"name":"$name","samplers":[{"input":1,"output":2,"interpolation":"$interpolation"}],
       |"channels":[{"sampler":0,"target":{"node":0,"path":"$path"}}]}""".stripMargin

  private def animated(
      path: String,
      interpolation: String,
      times: Array[Byte],
      values: Array[Byte],
      kind: String = "VEC3",
      primitive: String = "",
      more: Seq[(String, Array[Byte])] = Nil,
      node: String = """{"mesh":0}""",
      others: String = ""
  ): String =
    val (accessors, views, data) = arrays(Seq("SCALAR" -> times, kind -> values) ++ more*)
    model(
      ""","mode":5""" + primitive,
      accessors,
      views,
      data,
      node,
      others = s""","animations":[${animation(path, interpolation)}$others]"""
    )

  private def sound(scene: SceneDescription): SceneDescription =
    assert(scene.errors.isEmpty, scene.errors.map(_.message))
    scene

  /** Where a point of the mesh is at a time. */
  private def moved(json: String, time: Double, p: Vec3 = Vec3.Zero): Vec3 =
    sound(read(json, reading = at(time))).shapes.head.objectToWorld.start.point(p)

  private def near(a: Vec3, b: Vec3): Boolean = (a - b).length < 1e-5f * (1 + b.length)

  private val times = floats(1, 2, 4)

  test("linear and stepped translations are between keys, and those of the ends beyond"):
    val values = floats(0, 0, 0, 2, 0, 0, 2, 4, 0)
    val linear = animated("translation", "LINEAR", times, values)
    assert(moved(linear, 1.25) == Vec3(0.5f, 0, 0) && moved(linear, 3) == Vec3(2, 2, 0))
    assert(moved(linear, 0) == Vec3.Zero && moved(linear, 4) == Vec3(2, 4, 0))
    val stepped = animated("translation", "STEP", times, values)
    assert(moved(stepped, 1.9) == Vec3.Zero && moved(stepped, 2) == Vec3(2, 0, 0))
    assert(moved(linear, 9) == Vec3(2, 4, 0))
    val warnings = read(linear, reading = at(9)).warnings.map(_.message)
    assert(warnings.exists(_.contains("ends at 4.0s")), warnings)
    assert(read(linear, reading = at(0)).warnings.exists(_.message.contains("begins at 1.0s")))

  test("cubic splines have their tangents, which are of seconds"):
    // From 0 with a slope of 3 to 2 with a slope of -1, within 2 seconds
    val values = floats(0, 0, 0, 0, 0, 0, 3, 0, 0, -1, 0, 0, 2, 0, 0, 0, 0, 0)
    val spline = animated("translation", "CUBICSPLINE", floats(1, 3), values)
    def hermite(t: Double) =
      val (t2, t3) = (t * t, t * t * t)
      2 * (t3 - 2 * t2 + t) * 3 + (3 * t2 - 2 * t3) * 2 + 2 * (t3 - t2) * -1
    for t <- Seq(0.0, 0.25, 0.5, 0.9) do
      assert(near(moved(spline, 1 + 2 * t), Vec3(hermite(t).toFloat, 0, 0)), t)

  test("rotations turn evenly along the shorter arc, and splines of them are unit quaternions"):
    val half = Math.sqrt(0.5)
    // To the negated quaternion of a quarter turn about z
    val quarter = animated(
      "rotation",
      "LINEAR",
      floats(0, 3),
      floats(0, 0, 0, 1, 0, 0, -half, -half),
      "VEC4"
    )
    for third <- 0 to 3 do
      val angle = Math.toRadians(30.0 * third)
      val expected = Vec3(Math.cos(angle).toFloat, Math.sin(angle).toFloat, 0)
      assert(near(moved(quarter, third, Vec3(1, 0, 0)), expected), third)
    val flat = floats(0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, half, half, 0, 0, 0, 0)
    val spline = animated("rotation", "CUBICSPLINE", floats(0, 1), flat, "VEC4")
    val middle = moved(spline, 0.5, Vec3(1, 0, 0))
    assert(near(middle, Vec3(half.toFloat, half.toFloat, 0)))

  test("an animated scale keeps the rest of the node's transform"):
    val node = """{"mesh":0,"translation":[5,0,0]}"""
    val scaled = animated("scale", "LINEAR", floats(0, 1), floats(1, 1, 1, 3, 1, 1), node = node)
    assert(moved(scaled, 0.5, Vec3(1, 0, 0)) == Vec3(7, 0, 0))
    val matrix = """{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}"""
    val both = animated("scale", "LINEAR", floats(0, 1), floats(1, 1, 1, 3, 1, 1), node = matrix)
    assert(problem(both, at(0)).startsWith("/nodes/0: an animated node"))

  private def problem(json: String, how: ReadSettings): String =
    val all =
      try read(json, reading = how).errors
      catch case e: SceneError => e.problems
    val p = all.find(_.severity == Severity.Error).get
    s"${p.pos.fold("")(_.file.dropWhile(_ != '#').drop(1))}: ${p.message}${p.help.mkString(" ")}"

  test("animated weights blend morph targets, also of a mesh of several nodes"):
    val up = floats(Seq.tabulate(12)(i => if i % 3 == 2 then 1.0 else 0.0)*)
    val right = floats(Seq.tabulate(12)(i => if i % 3 == 0 then 1.0 else 0.0)*)
    def morphed(interpolation: String, kind: String, values: Double*) = animated(
      "weights",
      interpolation,
      floats(0, 1),
      floats(values*),
      kind,
      ""","targets":[{"POSITION":3},{"POSITION":4}]""",
      Seq("VEC3" -> up, "VEC3" -> right),
      """{"mesh":0},{"mesh":0}"""
    ).replace("\"nodes\":[0]", "\"nodes\":[0,1]")
    def first(json: String, time: Double) =
      val scene = sound(read(json, reading = at(time)))
      scene.objects.values.map(_.head.shape.param("P").get.floats.take(3).toVector).toSet ++
        scene.shapes.filter(_.areaLight.isEmpty).map(_.shape.param("P").get.floats.toVector.take(3))
    val linear = morphed("LINEAR", "SCALAR", 0, 0, 1, 0.5)
    assert(first(linear, 0.5).contains(Vector(0.25f, 0f, 0.5f)))
    // The other node is at rest
    assert(first(linear, 0.5).contains(Vector(0f, 0f, 0f)))
    val spline = morphed("CUBICSPLINE", "SCALAR", 0, 0, 0, 0, 4, 0, 0, 0, 1, 0.5, 0, 0)
    val Vector(x, _, z) = first(spline, 0.5).find(_.last > 0).get: @unchecked
    assert(Math.abs(x - 0.25f) < 1e-6 && Math.abs(z - (0.5f + 0.125f * 4)) < 1e-6)
    val uneven = morphed("LINEAR", "SCALAR", 0, 0, 1)
    assert(problem(uneven, at(0)).startsWith("/animations/0/samplers/0/output: expected 4 numbers"))

  test("skins follow animated joints"):
    val joints = Array.fill[Byte](16)(0)
    val json = animated(
      "translation",
      "LINEAR",
      floats(0, 2),
      floats(0, 0, 0, 0, 6, 0),
      more = Seq("VEC4" -> floats(Seq.fill(4)(Seq(1.0, 0.0, 0.0, 0.0)).flatten*), "VEC4" -> joints),
      node = """{"name":"joint"},{"mesh":0,"skin":0}""",
      others = ""
    ).replace("\"nodes\":[0]", "\"nodes\":[0,1]")
      .replace("\"POSITION\":0", "\"POSITION\":0,\"JOINTS_0\":4,\"WEIGHTS_0\":3")
      .replace("\"animations\"", "\"skins\":[{\"joints\":[0]}],\"animations\"")
    // Joints are bytes: four vertices of four
    val bytes = json.replace(
      """"bufferView":4,"componentType":5126,"count":1,""",
      """"bufferView":4,"componentType":5121,"count":4,"""
    )
    val p = sound(read(bytes, reading = at(1))).shapes.head.shape.param("P").get.floats
    assert(p.take(6).toVector == Vector(0f, 3f, 0f, 1f, 3f, 0f))

  private val walk =
    animated(
      "translation",
      "LINEAR",
      floats(0, 1),
      floats(0, 0, 0, 1, 0, 0),
      others =
        "," + animation("translation", "STEP", "Run")
    )

  test("the animation is the first, or chosen by name or index, and all are named"):
    assert(moved(walk, 0.5).x == 0.5f)
    def chosen(name: String) =
      read(walk, reading = at(0.5, Some(name))).shapes.head.objectToWorld.start.point(Vec3.Zero).x
    assert(chosen("Run") == 0f && chosen("1") == 0f && chosen("Walk") == 0.5f)
    assert(problem(walk, at(0, Some("Rum"))).endsWith("did you mean `Run`?"))
    assert(problem(walk, at(0, Some("2"))).contains("no animation `2`"))
    def said(how: ReadSettings) = read(walk, reading = how).warnings.map(_.message)
    for how <- Seq(ReadSettings(), at(0)) do
      assert(said(how).exists(_.contains("`Walk`, `Run`")), said(how))
    assert(problem(model(), at(0)).contains("no animations"))
    assert(problem(walk, reading(ModelState(animation = Some("Run")))).contains("--at"))

  test("several times are an image each, with the view of the first"):
    val steps = reading(ModelState(Some(ModelTimes(0, 0.5, 3))))
    val file = Path.of("models", "model.gltf")
    val images = Vector.tabulate(3)(i =>
      format.read(file, SceneFolder.of(file), steps, Some(i), Some(walk))
    )
    assert(images.map(_.isFollowed) == Vector(true, true, false))
    assert(images.map(_.shapes.head.objectToWorld.start.point(Vec3.Zero).x) == Vector(0f, 0.5f, 1f))
    assert(images.map(_.worldToCamera.start.point(Vec3.Zero)).distinct.size == 1)
    val names = images.map(_.film.get.param("filename").get.strings.head)
    assert(names == Vector.tabulate(3)(i => s"model-$i.exr"))
    // Where a scene is one image, it is the first
    assert(read(walk, reading = steps).warnings.exists(_.message.contains("several images")))
    for
      several <- Seq(
        steps.copy(sensors = Some(Sensors.All)),
        steps.copy(model = steps.model.copy(turntable = Some(3)))
      )
    do
      val refused = intercept[SceneError](read(walk, reading = several)).problems.head
      assert(refused.code == Code.OptionMisfit)

  test("damaged animations are errors with their place; pointers are named"):
    def broken(from: String, to: String) = problem(walk.replace(from, to), at(0))
    val sampler = "/animations/0/samplers/0"
    assert(broken("LINEAR", "LINAER").startsWith(s"$sampler/interpolation: expected STEP, LINEAR"))
    assert(broken("\"input\":1", "\"input\":9").startsWith(s"$sampler/input: there are no"))
    assert(broken("\"node\":0", "\"node\":7").startsWith("/animations/0/channels/0/target/node: "))
    assert(broken("\"path\":\"translation\"", "\"path\":\"colour\"")
      .startsWith("/animations/0/channels/0/target/path: expected translation"))
    val back = animated("translation", "LINEAR", floats(1, 1), floats(0, 0, 0, 1, 0, 0))
    assert(problem(back, at(0)).startsWith(s"$sampler/input: times must increase"))
    val pointer = walk.replace(
      "\"node\":0,\"path\":\"translation\"",
      "\"path\":\"pointer\",\"extensions\":{\"KHR_animation_pointer\":{\"pointer\":\"/a\"}}"
    )
    val warnings = sound(read(pointer, reading = at(0))).warnings.map(_.message)
    assert(warnings.exists(_.contains("KHR_animation_pointer")))

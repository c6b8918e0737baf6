package candela.models

import candela.diagnostics.{Code, SceneError}
import candela.io.SceneFolder
import candela.job.SceneFormat
import candela.math.{Transform, Vec3}
import candela.scenefile.{Declaration, MaterialRef, SceneDescription, ShapeDescription}
import candela.settings.ReadSettings

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

/** What models may say in `extras.candela`. */
class ExtrasSuite extends AnyFunSuite:
  private val format = SceneFormat.named(Path.of("model.gltf")).get

  /** A triangle before a camera, and a light.
    *
    * @param light  members of the light's node
    * @param camera members of the camera's node
    * @param scene  members of the scene
    * @param view   the camera itself
    */
  private def read(
      light: String = "",
      camera: String = "",
      scene: String = "",
      view: String =
        """"type":"perspective","perspective":{"yfov":1,"aspectRatio":2,"znear":0.1}""",
      others: String = ""
  ): SceneDescription =
    val file = Path.of("models", "model.gltf")
    val triangle = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
    val json =
      s"""{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]$scene}],
         |"nodes":[{"mesh":0},{"camera":0$camera},{"name":"lamp"$light}],
         |"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
         |"cameras":[{$view}],
         |"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
         |"bufferViews":[{"buffer":0,"byteLength":36}],
         |"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,$triangle"}]
         |$others}""".stripMargin
    format.read(file, SceneFolder.of(file, false), ReadSettings(), None, Some(json))

  private def extras(members: String) = s""","extras":{"candela":{$members}}"""

  /** A scene lit by a punctual light and what its node says of it. */
  private def punctual(light: String, fields: String): SceneDescription =
    read(
      light = s""","extensions":{"KHR_lights_punctual":{"light":0}}${extras(
          s""""light":{$fields}"""
        )}""",
      others = s""","extensions":{"KHR_lights_punctual":{"lights":[{$light}]}}"""
    )

  private def numbers(params: Declaration, name: String): Vector[Float] =
    params.param(name).get.floats.toVector

  private def emitter(scene: SceneDescription): ShapeDescription =
    assert(scene.errors.isEmpty, scene.errors.map(_.message))
    scene.shapes.filter(_.areaLight.isDefined) match
      case Vector(one) => one
      case several => fail(s"${several.size} emitters")

  private def warned(scene: SceneDescription): Vector[String] =
    scene.warnings.map(w => s"${w.pos.fold("")(_.file.dropWhile(_ != '#').drop(1))}: ${w.message}")

  private val Watts = 683.0

  test("a point light with a radius is a sphere of the same intensity that casts no shadow"):
    val scene = punctual(s""""type":"point","intensity":${2 * Watts}""", """"radius":0.5""")
    val s = emitter(scene)
    assert(scene.lights.isEmpty && s.shape.name == "sphere")
    assert(numbers(s.shape, "radius") == Vector(0.5f))
    val radiance = numbers(s.areaLight.get, "L").head
    assert(Math.abs(radiance - 2 / (Math.PI * 0.25)) < 1e-5)
    assert(s.material match
      case MaterialRef.Inline(m) => m.name == "interface"
      case _ => false)
    assert(s.areaLight.get.param("inview").get.bools.toVector == Vector(true))
    val hidden = punctual(""""type":"point"""", """"radius":0.5,"inView":false""")
    assert(emitter(hidden).areaLight.get.param("inview").get.bools.toVector == Vector(false))

  test("a light without a radius stays a point"):
    val scene = punctual(""""type":"point"""", """"radius":0""")
    assert(scene.lights.map(_.light.name) == Vector("point"))

  test("a sun of some angle has the irradiance of the light"):
    val scene = punctual(s""""type":"directional","intensity":$Watts""", """"angle":1""")
    val sun = scene.lights.head.light
    assert(sun.name == "sunsky" && numbers(sun, "skyscale") == Vector(0f))
    assert(Math.abs(numbers(sun, "sunaperture").head - Math.toDegrees(1)) < 1e-4)
    // The runtime's irradiance is that of the same radiance without the cosine
    val solidAngle = 2 * Math.PI * (1 - Math.cos(0.5))
    val radiance = numbers(sun, "sunirradiance").head / solidAngle
    val irradiance = radiance * Math.PI * Math.sin(0.5) * Math.sin(0.5)
    assert(Math.abs(irradiance - 1) < 1e-5)

  test("a blend is a part of 1 - cos of the spotlight's edge"):
    val cone = """"type":"spot","spot":{"outerConeAngle":1}"""
    val spot = punctual(cone, """"blend":0.25""").lights.head.light
    assert(spot.param("falloff").get.strings == Vector("smoothstep"))
    val edge = Math.toRadians(numbers(spot, "coneangle").head)
    val full = edge - Math.toRadians(numbers(spot, "conedeltaangle").head)
    assert(Math.abs((1 - Math.cos(full)) / (1 - Math.cos(edge)) - 0.75) < 1e-6)
    val wide = emitter(punctual(cone, """"blend":0.25,"radius":0.1""")).areaLight.get
    assert(numbers(wide, "axis") == Vector(0f, 0f, -1f))
    assert(Math.abs(numbers(wide, "coneangle").head - Math.toDegrees(1)) < 1e-4)

  private def area(fields: String): SceneDescription =
    read(light = s""","translation":[1,2,3]${extras(s""""light":{$fields}""")}""")

  test("area lights face along -z, with their size and radiance"):
    val plane = emitter(area(""""size":[4,2],"radiance":[1,2,3],"spread":1"""))
    assert(numbers(plane.areaLight.get, "L") == Vector(1f, 2f, 3f))
    assert(Math.abs(numbers(plane.areaLight.get, "spread").head - Math.toDegrees(1)) < 1e-4)
    val p = numbers(plane.shape, "P").grouped(3).map(c => Vec3(c(0), c(1), c(2))).toVector
    assert(p.map(_.x.abs).toSet == Set(2f) && p.map(_.y.abs).toSet == Set(1f))
    val i = plane.shape.param("indices").get.ints
    assert(((p(i(1)) - p(i(0))) cross (p(i(2)) - p(i(0)))).normalized == -Vec3.Z)
    assert(plane.objectToWorld.start.point(Vec3.Zero) == Vec3(1, 2, 3))
    val round = emitter(area(""""shape":"ellipse","size":[4,2]"""))
    assert(round.shape.name == "disk" && numbers(round.shape, "radius") == Vector(2f))
    val place = round.objectToWorld.start
    assert(place.swapsHandedness == Transform.Identity.swapsHandedness)
    assert((place.vector(Vec3.Z) + Vec3.Z).length < 1e-6f)
    assert((place.vector(Vec3.Y) + Vec3.Y * 0.5f).length < 1e-6f)

  test("a shift moves the window by parts of it; an aperture has a radius and a focus"):
    val fields = """"camera":{"shift":[0.25,-0.5],"apertureRadius":0.1,"focusDistance":3}"""
    val scene = read(camera = extras(fields))
    val camera = scene.camera.get
    assert(numbers(camera, "screenwindow") == Vector(-1f, 3f, -2f, 0f))
    assert(numbers(camera, "lensradius") == Vector(0.1f))
    assert(numbers(camera, "focaldistance") == Vector(3f))
    val flat = """"type":"orthographic","orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":9}"""
    val moved = read(camera = extras(""""camera":{"shift":[0.5,0]}"""), view = flat)
    assert(numbers(moved.camera.get, "screenwindow") == Vector(0f, 6f, -2f, 2f))

  private def around(fields: String) = read(scene = extras(s""""environment":{$fields}"""))

  test("an environment replaces the studio, even a black one"):
    val black = around(""""radiance":[0,0,0]""")
    assert(black.lights.isEmpty && black.shapes.size == 1 && black.additions.isEmpty)
    val blue = around(""""radiance":[0,0,2]""").lights
    assert(blue.map(l => numbers(l.light, "L")) == Vector(Vector(0f, 0f, 2f)))
    assert(read().shapes.size > 1)

  test("an environment's image is turned by its rotation"):
    val half = Math.sqrt(0.5)
    val map = around(s""""uri":"sky.exr","rotation":[0,$half,0,$half]""").lights.head
    assert(map.light.param("mapname").get.strings == Vector("sky.exr"))
    // The middle of pbrt-v3's maps, at -x, is ahead, at -z, and then turned towards -x
    assert((map.lightToWorld.start.vector(Vec3(-1, 0, 0)) + Vec3.X).length < 1e-6f)

  test("unknown members are warnings with the nearest known one"):
    val path = "/nodes/2/extras/candela/light"
    val scene = punctual(""""type":"point"""", """"radios":1,"angle":1""")
    assert(warned(scene).toSet == Set(
      s"$path/radios: unknown member `radios`; did you mean `radius`?",
      s"$path/angle: unknown member `angle`; known: inView, radius"
    ))
    assert(scene.warnings.forall(_.code == Code.UnknownParameter))
    val misplaced = read(camera = extras(""""lens":{}"""), scene = extras(""""enviroment":{}"""))
    assert(warned(misplaced).toSet == Set(
      "/nodes/1/extras/candela/lens: unknown member `lens`; known: camera, light, medium",
      "/scenes/0/extras/candela/enviroment: unknown member `enviroment`; did you mean " +
        "`environment`?"
    ))

  test("extras of other programs are none of the reader's business"):
    assert(warned(read(
      camera = ""","extras":{"tool":{"camera":1}}""",
      light = ""","extras":7"""
    )).isEmpty)

  test("numbers out of range are warnings, and the nearer limit is used"):
    val scene = punctual(""""type":"spot","spot":{}""", """"blend":2,"radius":-1""")
    assert(warned(scene).toSet == Set(
      "/nodes/2/extras/candela/light/blend: `blend` must be from 0 to 1, found 2; using 1",
      "/nodes/2/extras/candela/light/radius: `radius` must be at least 0, found -1; using 0"
    ))
    assert(warned(around(""""radiance":[1,-1,0]""")).head.endsWith("found 1 -1 0; using 1 0 0"))

  test("values of another kind, and areas of no size, are errors with their pointers"):
    def error(scene: => SceneDescription) =
      val problems =
        try scene.errors
        catch case e: SceneError => e.problems
      val p = problems.head
      s"${p.pos.fold("")(_.file.dropWhile(_ != '#').drop(1))}: ${p.message}"
    val light = "/nodes/2/extras/candela/light"
    assert(
      error(area(""""size":[1,0]""")) == s"$light/size: expected lengths above 0, found 1 0"
    )
    assert(error(area("")) == s"$light: `size` is missing")
    assert(
      error(area(""""size":[1,1],"shape":"star"""")).endsWith("rectangle or ellipse, found `star`")
    )
    assert(error(around(""""radiance":7""")).startsWith(
      "/scenes/0/extras/candela/environment/radiance: expected an array"
    ))

package candela.models

import candela.build.SceneBuilder
import candela.diagnostics.{Refusal, SceneError}
import candela.io.SceneFolder
import candela.math.Vec3
import candela.scenefile.{Declaration, MaterialRef, SceneDescription}
import candela.settings.{ReadSettings, RenderSettings}
import candela.testing.{NanoVdb, TempFolder, VdbGrid}

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** Participating media of models. */
class MediaSuite extends AnyFunSuite, GltfModels:
  private val Grid =
    """"uri":"fog.nvdb","grid":"fog","box":[0,0,0,2,1,1],"scattering":[1,2,3]"""
  private val Camera =
    """{"camera":0,"translation":[0.5,0.5,6]}"""
  private val Cameras =
    """,
      |"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}]""".stripMargin

  private def node(medium: String, members: String = "") =
    s"""{"extras":{"candela":{"medium":{$medium}}}$members}"""

  private def scene(nodes: String*): String =
    val roots = (0 to nodes.size + 1).mkString(",")
    model(
      nodes = (s"""{"mesh":0},$Camera""" +: nodes).mkString(","),
      roots = roots,
      others = Cameras
    )

  private def material(members: String): SceneDescription =
    read(model(""","material":0""", others = s""","materials":[{$members}]"""))

  private def inside(medium: String, members: String = ""): SceneDescription =
    material(s""""extras":{"candela":{"medium":{$medium}}}$members""")

  private def numbers(d: Declaration, name: String): Vector[Float] =
    d.param(name).get.floats.toVector

  private def isInterface(m: MaterialRef) = m match
    case MaterialRef.Inline(d) => d.name == "interface"
    case _ => false

  test("a grid fills a box whose faces point outwards, and is placed as its node"):
    val s =
      read(scene(node(s"$Grid,\"anisotropy\":0.5", ""","translation":[1,2,3],"scale":[2,-1,1]""")))
    assert(s.errors.isEmpty && s.warnings.isEmpty, (s.errors ++ s.warnings).map(_.message))
    val Vector(medium) = s.media: @unchecked
    val d = medium.medium
    assert(d.name == "nanovdb" && d.param("filename").get.strings == Vector("fog.nvdb"))
    assert(d.param("gridname").get.strings == Vector("fog") && numbers(d, "g") == Vector(0.5f))
    assert(numbers(d, "sigma_s") == Vector(1f, 2f, 3f) && numbers(
      d,
      "sigma_a"
    ) == Vector(0f, 0f, 0f))
    val box = s.shapes.find(_.insideMedium == medium.name).get
    assert(isInterface(box.material) && box.outsideMedium.isEmpty)
    assert(box.objectToWorld.start == medium.mediumToWorld.start)
    assert(medium.mediumToWorld.start.point(Vec3(1, 1, 1)) == Vec3(3, 1, 4))
    val p = numbers(box.shape, "P").grouped(3).map(c => Vec3(c(0), c(1), c(2))).toVector
    val faces = box.shape.param("indices").get.ints.grouped(3).map(_.map(p(_))).toVector
    assert(faces.size == 12 && p.toSet.size == 8)
    for f <- faces do
      val normal = ((f(1) - f(0)) cross (f(2) - f(0))).normalized
      assert((normal dot (f(0) - Vec3(1, 0.5f, 0.5f))) > 0.4f)
    assert(s.integrator.get.name == "volpath" && s.cameraMedium.isEmpty)

  test("what is no box, no file or unknown is an error or a warning with its pointer"):
    val path = "/nodes/2/extras/candela/medium"
    def failed(medium: String) = error(scene(node(medium)))
    assert(failed(Grid.replace("fog.nvdb", "data:;base64,AA")) ==
      s"$path/uri: expected the name of a file, found data")
    assert(failed(""""box":[0,0,0,1,1,1]""") == s"$path: `uri` is missing")
    assert(failed(""""uri":"fog.nvdb"""") == s"$path: `box` is missing")
    assert(failed(Grid.replace("2,1,1", "2,0,1")).startsWith(s"$path/box: expected the lowest"))
    val odd = read(scene(node(s"$Grid,\"anisotropy\":1,\"absorbtion\":[1,1,1]")))
    assert(odd.warnings.map(_.message).toSet == Set(
      "`anisotropy` must be from -0.99 to 0.99, found 1; using 0.99",
      "unknown member `absorbtion`; did you mean `absorption`?"
    ))

  test("files and grids that are missing, and files elsewhere, are errors with their pointers"):
    TempFolder.use: folder =>
      val home = Files.createDirectory(folder.resolve("home"))
      val grid = VdbGrid("fog", Map((0, 0, 0) -> 1f))
      for name <- Vector("home/fog.nvdb", "away.nvdb") do
        Files.write(folder.resolve(name), NanoVdb.file(Seq(grid))): Unit
      def problems(medium: String, isConfined: Boolean = false): Vector[String] =
        val file = home.resolve("model.gltf")
        val all =
          try
            val s = format.read(
              file,
              SceneFolder.of(file, isConfined),
              ReadSettings(),
              None,
              Some(scene(node(medium)))
            )
            SceneBuilder.build(s, RenderSettings())._2 ++ s.errors
          catch
            case e: SceneError => e.problems
            case e: Refusal => Vector(e.problem)
        all.map(p => s"${p.pos.fold("")(_.file.dropWhile(_ != '#').drop(1))}: ${p.message}")
      val path = "/nodes/2/extras/candela/medium"
      assert(problems(Grid).isEmpty && problems(Grid, isConfined = true).isEmpty)
      assert(problems(Grid.replace(
        "fog.nvdb",
        "fox.nvdb"
      )) == Vector(s"$path/uri: no file `fox.nvdb`"))
      assert(problems(Grid.replace("\"fog\"", "\"fox\"")) ==
        Vector(s"$path/grid: can't read `fog.nvdb`: it has no grid `fox`, only `fog`"))
      val away = Grid.replace("fog.nvdb", "../away.nvdb")
      assert(problems(away).isEmpty)
      val Vector(confined) = problems(away, isConfined = true): @unchecked
      assert(confined.startsWith(s"$path/uri: expected a file in the scene's folder"))

  test("a material without a surface is an interface around its medium"):
    val s = inside(""""absorption":[1,2,4],"emission":[1,1,1],"anisotropy":-0.5,"surface":false""")
    val Vector(medium) = s.media: @unchecked
    val shape = s.shapes.find(_.insideMedium == medium.name).get
    assert(isInterface(shape.material) && shape.shape.param("cullbackfaces").isEmpty)
    assert(medium.medium.name == "homogeneous" && numbers(medium.medium, "g") == Vector(-0.5f))
    assert(numbers(medium.medium, "sigma_a") == Vector(1f, 2f, 4f))
    assert(numbers(medium.medium, "Le") == Vector(1f, 0.5f, 0.25f))

  test("glass around a medium is solid, and its medium replaces that of KHR_materials_volume"):
    val glass = ""","extensions":{"KHR_materials_transmission":{"transmissionFactor":1},
                  |"KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":1,
                  |"attenuationColor":[0.5,0.5,0.5]}}""".stripMargin
    val s = inside(""""scattering":[1,1,1]""", glass)
    assert(s.media.size == 1 && s.shapes.exists(_.insideMedium == s.media.head.name))
    assert(numbers(s.media.head.medium, "sigma_s") == Vector(1f, 1f, 1f))
    val thin = inside(""""scattering":[1,1,1]""", glass.takeWhile(_ != '\n').dropRight(1) + "}")
    val d = thin.namedMaterials.map(_._2).find(_.name == "gltf").get
    assert(!d.param("thin").get.bools.head)

  test("a medium that absorbs nothing emits nothing"):
    val s = inside(""""scattering":[1,1,1],"absorption":[1,0,1],"emission":[1,1,0]""")
    assert(
      s.warnings.exists(_.pos.get.file.endsWith("/materials/0/extras/candela/medium/emission"))
    )
    assert(numbers(s.media.head.medium, "Le") == Vector(1f, 0f, 0f))

package candela.build

import candela.concurrency.Parallel
import candela.diagnostics.{Code, SceneError}
import candela.build.recipe.{Findings, TextureStore}
import candela.image.{Image, ImageFiles}
import candela.math.Position
import candela.render.{CostKind, Renderer}
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.{BuildControl, RenderSettings, TextureControl}
import candela.testing.{SceneTexts, TempFolder}

import java.nio.file.{Files, Path}
import java.util.Random

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Estimates against the bytes of what is built. */
class SceneSizeSuite extends AnyFunSuite:

  private val Head = "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 24\n" +
    "Sampler \"independent\" \"integer pixelsamples\" 1\nLookAt 0 -5 3  0 0 0  0 0 1\n" +
    "Camera \"perspective\" \"float fov\" 40\nWorldBegin\n"

  private val Sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"

  /** Estimated and measured bytes of a kind, of objects of these classes. */
  private def sizes(
      scene: SceneDescription,
      kind: CostKind,
      names: String*
  )(without: String*): (Long, Long) =
    val plan = SceneBuilder.build(scene, RenderSettings())._1
    val sizes = ObjectSizes()
    def named(all: Seq[String])(o: AnyRef) = all.contains(o.getClass.getSimpleName)
    val root = Array[AnyRef](plan)
    if without.nonEmpty then sizes.add(sizes.find(root)(named(without))): Unit
    val measured = sizes.add(sizes.find(root)(named(names)))
    (plan.costs.all.find(_.kind == kind).fold(0L)(_.bytes), measured)

  private def parsed(text: String, folder: Path = Path.of("")) =
    SceneTexts.parse(Head + text, Dialect.V4, folder)

  private def assertNear(estimated: Long, measured: Long, tolerance: Double): Unit =
    val ratio = estimated.toDouble / measured
    val _ = assert(
      measured > 10_000 && ratio < 1 + tolerance && ratio > 1 / (1 + tolerance),
      s"estimated $estimated, measured $measured"
    )

  private val random = Random(1)
  private def somewhere = Vector.fill(3)(6 * random.nextFloat - 3).mkString(" ")

  private val Side = 60

  /** A grid of squares, with normals and coordinates. */
  private def sheet(z: Double, material: String = ""): String =
    val points = for y <- 0 until Side; x <- 0 until Side yield (x * 0.1, y * 0.1)
    val p = points.map((x, y) => s"$x $y ${z + 0.1 * Math.sin(7 * x + y)}").mkString(" ")
    val n = points.map(_ => "0 0 1").mkString(" ")
    val uv = points.map((x, y) => s"$x $y").mkString(" ")
    val quads = for y <- 0 until Side - 1; x <- 0 until Side - 1 yield y * Side + x
    val corners =
      quads.map(a => s"$a ${a + 1} ${a + Side + 1} $a ${a + Side + 1} ${a + Side}").mkString(" ")
    s"AttributeBegin\n${material}Shape \"trianglemesh\" \"point3 P\" [ $p ] \"normal N\" [ $n ] " +
      s"\"point2 uv\" [ $uv ] \"integer indices\" [ $corners ]\nAttributeEnd\n"

  private val Hierarchies = Seq("WideTree", "BinaryTree", "WideBvh", "Bvh")

  test("triangles and their hierarchies, within a quarter"):
    val scene = parsed(Sky + sheet(0) + sheet(1))
    val (triangles, soup) = sizes(scene, CostKind.Triangles, "TriangleSoup")()
    assertNear(triangles, soup, 0.25)
    val (hierarchies, trees) =
      sizes(scene, CostKind.Hierarchies, Hierarchies*)("TriangleSoup")
    assertNear(hierarchies, trees, 0.25)

  test("triangles of a PLY file, by its header and its size, within a quarter"):
    TempFolder.use: folder =>
      for corners <- Vector(3, 5) do
        val text = StringBuilder(s"ply\nformat ascii 1.0\nelement vertex ${Side * Side}\n")
        text ++= "property float x\nproperty float y\nproperty float z\nelement face 4000\n"
        text ++= "property list uchar int vertex_indices\nend_header\n"
        for i <- 0 until Side * Side do text ++= s"${i % Side} ${i / Side} ${random.nextFloat}\n"
        for i <- 0 until 4000 do text ++= s"3 ${i % 3000} ${(i + 1) % 3000} ${(i + 70) % 3000}\n"
        val binary = java.nio.ByteBuffer.allocate(1 << 20).order(java.nio.ByteOrder.LITTLE_ENDIAN)
        binary.put(text.toString.linesIterator.takeWhile(_ != "end_header").mkString(
          "",
          "\n",
          "\nend_header\n"
        ).replace("ascii", "binary_little_endian").getBytes("US-ASCII"))
        for i <- 0 until Side * Side do
          val (x, y) = (i % Side, i / Side)
          binary.putFloat(x.toFloat).putFloat(y.toFloat).putFloat(random.nextFloat)
        for i <- 0 until 4000 do
          binary.put(corners.toByte)
          for k <- 0 until corners do binary.putInt((i + 61 * k) % 3000)
        val bytes = binary.array.take(binary.position)
        if corners == 3 then Files.writeString(folder.resolve("a.ply"), text.toString): Unit
        Files.write(folder.resolve("b.ply"), bytes): Unit
        for name <- Vector("a", "b") do
          val scene = parsed(Sky + s"Shape \"plymesh\" \"string filename\" \"$name.ply\"\n", folder)
          val (estimated, soup) = sizes(scene, CostKind.Triangles, "TriangleSoup")()
          assertNear(estimated, soup, 0.25)

  test("spheres, curves and instances, within a half"):
    val spheres = parsed(Sky + Vector.fill(2000)(
      s"AttributeBegin Translate $somewhere Shape \"sphere\" \"float radius\" 0.1 AttributeEnd\n"
    ).mkString)
    val (shapes, solids) = sizes(spheres, CostKind.Shapes, "ShapeTable")()
    assertNear(shapes, solids, 0.5)
    val (nodes, trees) = sizes(spheres, CostKind.Hierarchies, Hierarchies*)("ShapeTable")
    assertNear(nodes, trees, 0.5)
    val curves = parsed(Sky + Vector.fill(500)(
      s"Shape \"curve\" \"point3 P\" [ 0 0 0 $somewhere 1 1 1 1 0 1 ] \"float width\" 0.01\n"
    ).mkString)
    val (hair, segments) = sizes(curves, CostKind.Shapes, "ShapeTable")()
    assertNear(hair, segments, 0.5)
    val instances =
      parsed(Sky + s"ObjectBegin \"o\"\nShape \"sphere\"\nObjectEnd\n" + Vector.fill(2000)(
        s"AttributeBegin Translate $somewhere ObjectInstance \"o\" AttributeEnd\n"
      ).mkString)
    val (placed, all) =
      sizes(instances, CostKind.Instances, "Instances")()
    assertNear(placed, all, 0.5)

  test("statements of instances and what is made of them, within a fifth"):
    def placed(inObject: String, first: String) =
      parsed(Sky + s"ObjectBegin \"o\"\n${inObject}Shape \"sphere\"\nObjectEnd\n$first" +
        Vector.fill(5000)(
          s"AttributeBegin Translate $somewhere ObjectInstance \"o\" AttributeEnd\n"
        ).mkString)
    val moving = "AttributeBegin ActiveTransform EndTime Translate 1 0 0 ActiveTransform All " +
      "ObjectInstance \"o\" AttributeEnd\n"
    // As they are; around another origin, which copies their matrices; and with one that moves
    val shared = placed("", "")
    val copied = placed("Translate 1e6 0 0\n", "")
    val mixed = placed("", moving)
    val measured =
      for scene <- Vector(shared, copied, mixed) yield
        val plan = SceneBuilder.build(scene, RenderSettings())._1
        val kinds = Seq(CostKind.Statements, CostKind.Instances)
        val estimated = plan.costs.all.filter(c => kinds.contains(c.kind)).map(_.bytes).sum
        val sizes = ObjectSizes()
        val instances = sizes.find(plan)(_.getClass.getSimpleName == "Instances")
        val found = sizes.add(scene.instances +: instances)
        assertNear(estimated, found, 0.2)
        found
    assert(measured(1) > 1.7 * measured(0) && measured(2) < 1.1 * measured(0), measured)

  test("emitters, within a half"):
    val emission = "AreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ]\n"
    val balls = parsed(Vector.fill(2000)(
      s"AttributeBegin\n${emission}Translate $somewhere Shape \"sphere\" \"float radius\" 0.1\n" +
        "AttributeEnd\n"
    ).mkString)
    val (emitters, lights) = sizes(balls, CostKind.Lights, "Scene")(
      ("ShapeTable" +: "TriangleSoup" +: "SceneMaterials" +: Hierarchies)*
    )
    assertNear(emitters, lights, 0.5)
    val shining = parsed(sheet(0, emission))
    val (mesh, triangles) = sizes(shining, CostKind.Lights, "Scene")(
      ("TriangleSoup" +: "SceneMaterials" +: Hierarchies)*
    )
    assertNear(mesh, triangles, 0.5)

  test("images of lights are counted as they are kept"):
    TempFolder.use: folder =>
      ImageFiles.write(folder.resolve("a.exr"), Image.rgb(256, 256))
      val control = TextureControl(memory = Some(1), folder = Some(folder.resolve("cache")))
      val pixels = 256L * 256
      def bytes(light: String, control: TextureControl): Long =
        val scene = parsed(s"LightSource $light \"string filename\" \"a.exr\"\n", folder)
        val uses = ObjectUses(scene, Position.Origin, Findings())
        val textures = TextureStore.of(scene, control, Parallel.Alone)
        val costs = SceneSize(scene, uses, textures).costs
        costs.find(_.kind == CostKind.Lights).get.bytes / pixels
      val portal = "\"infinite\" \"point3 portal\" [0 0 0  0 1 0  1 1 0  1 0 0]"
      for light <- Vector("\"infinite\"", "\"goniometric\"", "\"projection\"", portal) do
        assert(bytes(light, TextureControl()) == 20)
      assert(bytes("\"infinite\"", control) == 5 && bytes(portal, control) == 20)
      val both = "\"infinite\" \"string filename\" \"a.exr\"\nLightSource \"goniometric\""
      assert(bytes(both, control) == 25)

  test("films, with bands, within a fifth", Slow):
    def film(statement: String, samples: Int) =
      val text = Head.linesIterator.drop(1).mkString(statement, "\n", "\n") + Sky +
        "Shape \"sphere\"\n"
      val settings = RenderSettings(samples = Some(samples))
      SceneBuilder.build(SceneTexts.parse(text, Dialect.V4), settings)._1
    def size =
      " \"integer xresolution\" 320 \"integer yresolution\" 240 \"string filename\" \"a\"\n"
    for
      (statement, samples) <-
        Vector(("Film \"rgb\"", 1), ("Film \"rgb\"", 16), ("Film \"spectral\"", 16))
    do
      val plan = film(statement + size, samples)
      val made = Renderer.render(plan, threads = 1)
      val measured = ObjectSizes().add(Vector(made.film, made.image(plan.development)))
      assertNear(plan.costs.all.find(_.kind == CostKind.Film).get.bytes, measured, 0.2)

  test("a scene that does not fit is refused at once, with its greatest parts"):
    TempFolder.use: folder =>
      // Whatever is read of the mesh would be an error; the file could hold it
      val header = "ply\nformat ascii 1.0\nelement vertex 1000000\nproperty float x\n" +
        "property float y\nproperty float z\nelement face 2000000\n" +
        "property list uchar int vertex_indices\nend_header\nnone\n" + " " * 2_000_000
      Files.writeString(folder.resolve("a.ply"), header): Unit
      val scene = parsed(Sky + "Shape \"plymesh\" \"string filename\" \"a.ply\"\n", folder)
      def refused(heap: Long): SceneError =
        intercept[SceneError]:
          SceneBuilder.build(scene, RenderSettings(), heap = heap)
      val problem = refused(100_000_000).problems.head
      assert(problem.code == Code.OutOfMemory)
      assert(problem.message.contains("limited to 100 MB: hierarchies 112 MB"), problem.message)
      assert(problem.message.contains("triangles 26 MB"), problem.message)
      assert(problem.help.exists(_.contains("-Xmx1g")), problem.help)
      assert(refused(1_000_000_000).problems.head.code == Code.DamagedMesh)

  test("a film that does not fit is refused with the advice to render parts of it"):
    val text = Head.replace("32", "8000").replace("24", "8000") + Sky + "Shape \"sphere\"\n"
    val scene = SceneTexts.parse(text, Dialect.V4)
    for isRendered <- Seq(true, false) do
      def build(heap: Long) =
        val control = BuildControl(isRendered = isRendered)
        SceneBuilder.build(scene, RenderSettings(samples = Some(4)), control, heap = heap)
      val problem = intercept[SceneError](build(3_000_000_000L)).problems.head
      assert(problem.message.contains("film 4.9 GB"), problem.message)
      assert(problem.help.exists(_.contains("--cropwindow")), problem.help)
      build(6_000_000_000L): Unit

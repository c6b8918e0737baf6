package candela.cli

import candela.base.loop
import candela.io.CheckedFile
import java.nio.{ByteBuffer, ByteOrder}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.image.{Image, ImageFiles}
import candela.sampling.Distribution2D
import candela.testing.{Draws, TempFolder}

/** Renderings whose environment maps don't fit into the memory that images may take. */
class EnvironmentTilesSuite extends AnyFunSuite:

  private def picture(file: Path, width: Int, height: Int): Unit =
    val draws = Draws(width)
    val image = Image.rgb(width, height)
    // A few bright pixels, as of a sun
    loop(image.data.length): i =>
      image.data(i) = draws.unit() * (if i % 9973 < 3 then 90 else 1)
    ImageFiles.write(file, image)

  private def scene(folder: Path, name: String, light: String): Path =
    val film = if name.startsWith("v4") then "rgb" else "image"
    Files.writeString(
      folder.resolve(s"$name.pbrt"),
      s"""Film "$film" "integer xresolution" 12 "integer yresolution" 12
    Sampler "halton" "integer pixelsamples" 4
    LookAt 0 -3 2  0 0 0  0 0 1
    Camera "perspective" "float fov" 70
    WorldBegin
    Rotate 20 1 .3 0
    LightSource "infinite" $light
    Shape "sphere"
    """
    )

  private def scenes(folder: Path): Vector[Path] =
    picture(folder.resolve("square.exr"), 256, 256)
    picture(folder.resolve("wide.exr"), 500, 300)
    picture(folder.resolve("wide.png"), 400, 300)
    val portal = "\"point3 portal\" [-9 9 -9  9 9 -9  9 9 9  -9 9 9]"
    Vector(
      scene(folder, "v4", "\"string filename\" \"square.exr\""),
      scene(folder, "v4 lux", "\"string filename\" \"square.exr\" \"float illuminance\" 3"),
      scene(folder, "v4 window", s"\"string filename\" \"square.exr\" $portal"),
      scene(folder, "v3", "\"string mapname\" \"wide.exr\" \"rgb L\" [.3 2 1]"),
      scene(folder, "v3 bytes", "\"string mapname\" \"wide.png\"")
    )

  private def render(scene: Path, words: String*): (Vector[Byte], String) =
    val out = scene.resolveSibling("out.pfm")
    val dialect = Vector("--dialect", scene.getFileName.toString.take(2))
    val (code, captured) =
      Captured.run(Vector(s"$scene", "--outfile", s"$out") ++ dialect ++ words*)
    assert(code == 0, captured.err)
    (Files.readAllBytes(out).toVector, captured.err)

  private def tiles(cache: Path): Vector[String] =
    Vector("--texture-memory", "1M", "--texture-cache", s"$cache")

  private def files(cache: Path, suffix: String): Vector[Path] =
    TempFolder.names(cache).toVector.sorted.filter(_.endsWith(suffix)).map(cache.resolve(_))

  test("images are the same with environment maps in tiles and in memory, and once more", Slow):
    TempFolder.use: folder =>
      for scene <- scenes(folder); color <- Vector("rgb", "spectral") do
        val cache = folder.resolve(s"cache $color ${scene.getFileName}")
        val (whole, _) = render(scene, "--color", color)
        val (roomy, said) = render(scene, "--color", color, "--texture-memory", "1G", "--explain")
        assert(roomy == whole && said.contains("1 image in memory"), said)
        val (first, told) = render(scene, tiles(cache) ++ Vector("--color", color, "--explain")*)
        assert(first == whole, scene)
        assert(told.contains("in tiles: at most 1.0 MB in memory"), told)
        assert(files(cache, ".tiles").size == 1)
        val before = files(cache, ".part").map(Files.readAllBytes(_).toVector)
        val (second, _) =
          render(scene, tiles(cache) ++ Vector("--color", color, "--nthreads", "3")*)
        assert(second == whole, scene)
        assert(files(cache, ".part").map(Files.readAllBytes(_).toVector) == before)

  /** A scene, its cache, its image, and the file of the sampling table that it left there. */
  private def withTable(body: (Path, Path, Vector[Byte], Path) => Assertion): Assertion =
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val cache = folder.resolve("cache")
      val (image, _) = render(scene, tiles(cache)*)
      body(scene, cache, image, files(cache, ".part").head)

  test("a sampling table has a file; one that is damaged is made again"):
    withTable: (scene, cache, image, table) =>
      val bytes = Files.readAllBytes(table)
      // Of its own content: another table makes another image
      assert(bytes.length > 256 * 257 * 4)
      val damaged = bytes.clone
      loop(1000)(i => damaged(bytes.length / 2 + i) = 1)
      Files.write(table, damaged): Unit
      assert(render(scene, tiles(cache)*)._1 == image)
      assert(Files.readAllBytes(table).sameElements(bytes))

  /** What a file of a table begins with, which tells what the table is of. */
  private def mark(table: Path): String =
    val bytes = Files.readAllBytes(table)
    val length = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).getInt
    String(bytes, 4, length, UTF_8)

  test("the table in a file is that by which the map is sampled"):
    withTable: (scene, cache, image, table) =>
      val sizes = Seq(256, 256)
      val other = Distribution2D(Array.tabulate(sizes.product)(i => (i % 7 + 1).toFloat), 256, 256)
      CheckedFile.write(table, mark(table))(Distribution2D.Form.write(other, _))
      assert(render(scene, tiles(cache)*)._1 != image)
      assert(files(cache, ".part") == Vector(table))

  test("maps of other scales have tables of their own"):
    TempFolder.use: folder =>
      scenes(folder): Unit
      val cache = folder.resolve("cache")
      for (l, i) <- Vector("[.3 2 1]", "[2 .3 1]").zipWithIndex do
        val light = s"\"string mapname\" \"wide.exr\" \"rgb L\" $l"
        val other = scene(folder, s"v3 $i", light)
        assert(render(other, tiles(cache)*)._1 == render(other)._1)
        assert(files(cache, ".part").size == i + 1)

  test("a map in tiles has one table, with the scene cache, too"):
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val (cache, parts) = (folder.resolve("cache"), folder.resolve("parts"))
      val words = Vector("--scene-cache", s"$parts")
      val (whole, _) = render(scene, words*)
      val before = files(parts, ".part")
      assert(before.size == 1)
      for table <- before do Files.delete(table)
      assert(render(scene, tiles(cache) ++ words*)._1 == whole)
      assert(files(cache, ".part").size == 1)
      assert(!Files.exists(parts) || files(parts, ".part").isEmpty)

  test("where a table can't be written, a warning says so, and the image is the same"):
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val cache = folder.resolve("cache")
      val (image, _) = render(scene, tiles(cache)*)
      val table = files(cache, ".part").head
      Files.delete(table)
      Files.createDirectories(table.resolve("full")): Unit
      val (again, said) = render(scene, tiles(cache)*)
      assert(again == image)
      assert(said.contains("tables of environment maps are made again"), said)

  test("an environment map that has changed has another table"):
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val cache = folder.resolve("cache")
      val (before, _) = render(scene, tiles(cache)*)
      val image = Image.rgb(256, 256)
      loop(image.data.length)(i => image.data(i) = (i % 7).toFloat)
      ImageFiles.write(folder.resolve("square.exr"), image)
      val (after, _) = render(scene, tiles(cache)*)
      assert(after != before && after == render(scene)._1)
      assert(files(cache, ".part").size == 2)

  test("what is wrong with an environment map is said, in tiles and in memory"):
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val image = Image.rgb(256, 256)
      image.data(70_000) = Float.NaN
      ImageFiles.write(folder.resolve("square.exr"), image)
      for words <- Vector(Vector.empty, tiles(folder.resolve("cache"))) do
        val (code, captured) = Captured.run(s"$scene" +: words*)
        assert(code == 1 && captured.err.contains("pixels that are NaN"), captured.err)
        assert(captured.err.contains("square.exr: "), captured.err)
        assert(captured.err.contains("the first, at (37, 91), is NaN"), captured.err)
      ImageFiles.write(folder.resolve("square.exr"), Image.rgb(256, 256))
      for words <- Vector(Vector.empty, tiles(folder.resolve("cache"))) do
        assert(render(scene, words*)._2.contains("this light emits nothing"))

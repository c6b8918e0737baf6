package candela.cli

import candela.base.loop
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.image.{Image, ImageFiles}
import candela.testing.{Draws, TempFolder, TiledExr}

/** Renderings whose image textures don't fit into the memory that they may take. */
class TextureMemorySuite extends AnyFunSuite:

  private def picture(file: Path, width: Int, height: Int, seed: Int): Unit =
    val draws = Draws(seed)
    val image = Image.rgb(width, height)
    loop(image.data.length)(i => image.data(i) = draws.unit())
    ImageFiles.write(file, image)

  private val square = """Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
    "point3 P" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] """

  private val head = s"""Film "image" "integer xresolution" 12 "integer yresolution" 12
    Sampler "halton" "integer pixelsamples" 2
    LookAt 0 -3 2  0 0 0  0 0 1
    Camera "perspective" "float fov" 50
    WorldBegin
    LightSource "point" "point3 from" [0 -1 3] "rgb I" [9 9 9]
    """

  /** Colours of all filters, alpha, bumps and normals. */
  private val v4 = head.replace("\"image\"", "\"rgb\"") + """
    Texture "c" "spectrum" "imagemap" "string filename" "a.png" "string filter" "ewa"
    Texture "d" "spectrum" "imagemap" "string filename" "b.exr" "string filter" "trilinear"
    Texture "e" "spectrum" "imagemap" "string filename" "a.png" "string filter" "bilinear"
      "string encoding" "gamma 1.7" "string wrap" "clamp"
    Texture "h" "float" "imagemap" "string filename" "b.exr" "float scale" .1
    Texture "o" "float" "imagemap" "string filename" "c.png" "string filter" "point"
    Material "diffuse" "texture reflectance" "c" "texture displacement" "h"
    """ + square + """ "texture alpha" "o" "point2 uv" [0 0 3 0 3 3 0 3]
    Translate 0 0 -.4
    Material "diffuse" "texture reflectance" "d" "string normalmap" "a.png"
    """ + square + """ "point2 uv" [0 0 1 0 1 1 0 1]
    Translate 0 .8 0 Rotate 60 1 0 0
    Material "diffuse" "texture reflectance" "e"
    """ + square + """ "point2 uv" [-1 -1 2 -1 2 2 -1 2]
    """

  private val v3 = head + """
    Texture "c" "color" "imagemap" "string filename" "c.png"
    Texture "b" "float" "imagemap" "string filename" "a.png" "bool trilinear" "true"
    Material "matte" "texture Kd" "c" "texture bumpmap" "b"
    """ + square + """ "float st" [0 0 2 0 2 2 0 2]
    """

  private def scenes(folder: Path): Vector[Path] =
    picture(folder.resolve("a.png"), 512, 256, 1)
    picture(folder.resolve("b.exr"), 300, 200, 2)
    picture(folder.resolve("c.png"), 500, 300, 3)
    Vector("v4" -> v4, "v3" -> v3).map: (name, text) =>
      Files.writeString(folder.resolve(s"$name.pbrt"), text)

  private def render(scene: Path, words: String*): (Vector[Byte], String) =
    val out = scene.resolveSibling("out.pfm")
    val dialect = Vector("--dialect", scene.getFileName.toString.take(2))
    val all = Vector(s"$scene", "--outfile", s"$out") ++ dialect ++ words
    val (code, captured) = Captured.run(all*)
    assert(code == 0, captured.err)
    (Files.readAllBytes(out).toVector, captured.err)

  test("images are the same in tiles and in memory, by one thread and three, and once more"):
    TempFolder.use: folder =>
      for scene <- scenes(folder) do
        val cache = folder.resolve(s"cache ${scene.getFileName}")
        val tiles = Vector("--texture-memory", "1M", "--texture-cache", s"$cache", "--nthreads")
        val (whole, _) = render(scene, "--texture-memory", "1G", "--nthreads", "2")
        assert(!Files.exists(cache))
        val (first, _) = render(scene, tiles :+ "1"*)
        assert(TempFolder.names(cache).nonEmpty)
        val (second, said) = render(scene, tiles ++ Vector("3", "--explain")*)
        assert(first == whole && second == whole, scene)
        assert(said.contains("in tiles: at most 1.0 MB in memory"), said)

  /** A square whose texture is `a.exr`. */
  private def ownLevels(folder: Path, made: TiledExr, use: String = ""): Path =
    made.write(folder.resolve("a.exr")): Unit
    val text = head.replace("\"image\"", "\"rgb\"") + """
      Texture "c" "spectrum" "imagemap" "string filename" "a.exr" "string filter" "trilinear" """ +
      use + """
      Material "diffuse" "texture reflectance" "c"
      """ + square + """ "point2 uv" [0 0 4 0 4 4 0 4]
      """
    Files.writeString(folder.resolve("v4.pbrt"), text)

  test(
    "levels in a tiled EXR file are used as they are, in tiles and in memory, without a copy",
    Slow
  ):
    TempFolder.use: folder =>
      val draws = Draws(1)
      // Smaller levels are darker than they would be made
      val scene = ownLevels(
        folder,
        TiledExr(512, 512, 64, 64)((level, _, _, _) => draws.unit() / (1 + level))
      )
      val cache = folder.resolve("cache")
      val tiles = Vector("--texture-memory", "1M", "--texture-cache", s"$cache", "--nthreads")
      val (whole, said) = render(scene, "--texture-memory", "1G")
      assert(!said.contains("warning"), said)
      for threads <- Seq("1", "3") do
        val (image, told) = render(scene, tiles ++ Vector(threads, "--explain")*)
        assert(image == whole && told.contains("in memory, in their own files"), told)
      assert(!Files.exists(cache))
      val other = ownLevels(folder, TiledExr(512, 512, 64, 64, mode = 0)((_, _, _, _) => 0.5f))
      assert(render(other, "--texture-memory", "1G")._1 != whole)

  test("why levels in a file are not used is said, and they are made"):
    TempFolder.use: folder =>
      val cases = Seq(
        (300, 200, "", "300×200 texels are no powers of two"),
        (64, 64, "\"string encoding\" \"sRGB\"", "")
      )
      for (w, h, use, why) <- cases do
        val scene = ownLevels(folder, TiledExr(w, h, 32, 32)((_, x, y, _) => x / (1f + y)), use)
        val cache = folder.resolve(s"cache $w")
        val small = Vector("--texture-memory", "1M", "--texture-cache", s"$cache")
        val (image, said) = render(scene, small*)
        if why.isEmpty then assert(!said.contains("warning"), said)
        else assert(said.contains(s"the levels in the file are not used: $why"), said)
        assert(image == render(scene, "--texture-memory", "1G")._1)

  test("each use of a file whose levels can't be used is warned of"):
    TempFolder.use: folder =>
      val scene = ownLevels(folder, TiledExr(300, 200, 32, 32)((_, x, y, _) => x / (1f + y)))
      val text = Files.readString(scene)
      val other = text.substring(text.indexOf("Texture \"c\"")).replace("\"c\"", "\"d\"")
        .replace("\"trilinear\"", "\"ewa\"")
      Files.writeString(scene, text + other): Unit
      val (_, said) = render(scene, "--texture-memory", "1G")
      assert(said.contains("are not used: 300×200 texels"), said)
      assert(said.contains("and at 1 more position"), said)

  test("a file that has no colours is told of once"):
    TempFolder.use: folder =>
      val names = Vector("P", "Q")
      val scene = ownLevels(folder, TiledExr(64, 64, 32, 32, names)((_, x, y, _) => x / (1f + y)))
      val (_, said) = render(scene, "--keep-going")
      assert(said.contains("E0703") && said.split("warning").length == 2, said)

  test("where a statement can't be read, pixels are not decoded, but files checked"):
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val whole = Files.readAllBytes(folder.resolve("a.png"))
      def broken(bytes: Array[Byte]) =
        Files.write(folder.resolve("a.png"), bytes): Unit
      broken(whole.take(whole.length / 2))
      Files.writeString(scene, Files.readString(scene) + "\nShape \"sphere\" \"float\" 1"): Unit
      for memory <- Seq("1M", "1G") do
        val cache = folder.resolve("cache")
        val words =
          Vector(s"$scene", "--texture-memory", memory, "--texture-cache", s"$cache")
        val (code, captured) = Captured.run(words*)
        assert(code == 1 && !captured.err.contains("a.png"), captured.err)
        assert(!Files.exists(cache))
        broken(Array[Byte](1, 2, 3))
        val (_, told) = Captured.run(words*)
        assert(told.err.contains("a.png: not a valid .png file"), told.err)
        broken(whole.take(whole.length / 2))

  test("an image with texels that are no numbers is named, in tiles and in memory, and once more"):
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val image = Image.rgb(300, 200)
      image.data(50_000) = Float.NaN
      ImageFiles.write(folder.resolve("b.exr"), image)
      val tiles = Vector("--texture-memory", "1M", "--texture-cache", s"${folder.resolve("cache")}")
      for words <- Vector(Vector.empty, tiles, tiles) do
        val (_, said) = render(scene, words*)
        assert(said.contains("b.exr: texels are NaN or infinite"), said)
        assert(!said.contains("a.png"), said)
      val draws = Draws(1)
      val own = ownLevels(folder, TiledExr(64, 64, 32, 32)((_, _, _, _) => 1 / 0f * draws.unit()))
      for words <- Vector(Vector.empty, tiles) do
        assert(render(own, words*)._2.contains("a.exr: texels are NaN or infinite"))

  test("texels are numbers or not as they are read, in tiles and in memory"):
    TempFolder.use: folder =>
      val tiles = Vector("--texture-memory", "1M", "--texture-cache", s"${folder.resolve("cache")}")
      def said(name: String, text: String) =
        val scene = folder.resolve(s"$name.pbrt")
        Files.writeString(scene, text): Unit
        val found =
          for words <- Vector(Vector.empty, tiles, tiles)
          yield render(scene, words*)._2.linesIterator.filter(_.contains("texels are NaN")).toVector
        assert(found.distinct.size == 1, found)
        found.head
      val image = Image(600, 200, Image.RgbNames :+ "A", Array.fill(480_000)(0.5f))
      ImageFiles.write(folder.resolve("b.exr"), image)
      def use(name: String, kind: String, words: String = "") =
        s"Texture \"$name\" \"$kind\" \"imagemap\" \"string filename\" \"b.exr\" $words\n"
      val v4 = head.replace("\"image\"", "\"rgb\"")
      assert(said("v4", v4 + use("a", "float")).isEmpty && Files.exists(folder.resolve("cache")))
      // Alpha, which numbers are made of, not colours
      image.data(4 * 610 + 3) = Float.PositiveInfinity
      ImageFiles.write(folder.resolve("b.exr"), image)
      assert(said("v4", v4 + use("a", "spectrum")).isEmpty)
      assert(said("v4", v4 + use("a", "spectrum") + use("b", "float"))
        .exists(_.contains("the first, at (10, 1), is Infinity")))
      // Zero, of which one texture alone makes what is no number
      image.data(4 * 610 + 3) = 1f
      for c <- 0 until 3 do image.data(4 * 1205 + c) = 0f
      ImageFiles.write(folder.resolve("b.exr"), image)
      val v2 = head.replace("point3", "point")
      assert(said("v2", v2 + use("a", "color")).isEmpty)
      assert(said("v2", v2 + use("a", "color") + use("b", "color", "\"float gamma\" -1"))
        .exists(_.contains("the first, at (5, 2), is Infinity")))

  test("levels in a file keep to the limit of pixels"):
    TempFolder.use: folder =>
      val scene = ownLevels(folder, TiledExr(512, 512, 64, 64)((_, _, _, _) => 0.5f))
      for memory <- Seq("1M", "1G") do
        val words =
          Vector(
            s"$scene",
            "--dialect",
            "v4",
            "--texture-memory",
            memory,
            "--limit",
            "pixels=20000"
          )
        val (code, captured) = Captured.run(words*)
        assert(code == 1 && captured.err.contains("`a.exr` has 512×512 pixels"), captured.err)

  test("a damaged tile of such a file ends the rendering with an error that names it"):
    TempFolder.use: folder =>
      val draws = Draws(7)
      val made = TiledExr(256, 256, 64, 64)((_, _, _, _) => draws.unit())
      // Ten texels across
      val scene = ownLevels(folder, made, "\"float uscale\" .01 \"float vscale\" .01")
      val file = folder.resolve("a.exr")
      val bytes = Files.readAllBytes(file)
      // All but the levels of 64 × 64 texels and less, of 66 kB before compression
      for i <- made.firstChunk until bytes.length - 100_000 do bytes(i) = 7
      Files.write(file, bytes): Unit
      val cache = folder.resolve("cache")
      val words = Vector(s"$scene", "--texture-memory", "1M", "--texture-cache", s"$cache")
      val (code, captured) = Captured.run(words*)
      assert(code == 1 && captured.err.contains("a.exr: tile "), captured.err)
      assert(!captured.err.contains("bug"), captured.err)

  test("an image that has changed is seen as it is now"):
    TempFolder.use: folder =>
      val scene = scenes(folder).last
      val tiles =
        Vector("--texture-memory", "1M", "--texture-cache", s"${folder.resolve("cache")}")
      val (before, _) = render(scene, tiles*)
      picture(folder.resolve("c.png"), 500, 300, 4)
      val (after, _) = render(scene, tiles*)
      assert(after != before)
      assert(after == render(scene, "--texture-memory", "1G")._1)

  test("where the cache can't be written, one warning says so, and the image is the same"):
    TempFolder.use: folder =>
      val scene = scenes(folder).head
      val file = folder.resolve("b.exr")
      val (image, said) = render(scene, "--texture-memory", "1M", "--texture-cache", s"$file")
      assert(said.split("warning").length == 2, said)
      assert(said.contains("texture cache are kept in memory"), said)
      assert(image == render(scene)._1)

  test("in a sandbox nothing is written to the user's cache"):
    TempFolder.use: folder =>
      val scene = scenes(folder).last
      val (_, said) = render(scene, "--texture-memory", "1M", "--sandbox", "--explain")
      assert(said.contains("there is no folder for tiles"), said)

  test("a wrong memory or folder is refused, with what was expected"):
    for
      (words, expected) <- Seq(
        Vector("--texture-memory", "much") -> "must be a size, e.g. 500MB, 2G or 1Gi",
        Vector("--texture-memory", "10") -> "--texture-memory must be at least 1M, found 10 bytes",
        Vector("--texture-cache-size", "-3") -> "must be a size",
        Vector("--texture-cache", "") -> "must be a folder"
      )
    do
      val (code, captured) = Captured.run("x.pbrt" +: words*)
      assert(code != 0 && captured.err.contains(expected), captured.err)

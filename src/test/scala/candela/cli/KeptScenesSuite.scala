package candela.cli

import candela.base.loop
import java.nio.file.{Files, Path}

import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.api.{Candela, ReadSettings, RenderSettings}
import candela.image.{Image, ImageFiles}
import candela.testing.{Draws, TempFolder}

/** Scenes that are rendered one after another in one process: each image is that of its scene
  * alone.
  */
class KeptScenesSuite extends AnyFunSuite:

  /** A wavy sheet of 2 · 60² triangles. */
  private def sheet(file: Path, height: Double): Unit =
    val side = 61
    val vertices =
      for j <- 0 until side; i <- 0 until side yield
        val (x, y) = (4.0 * i / (side - 1) - 2, 4.0 * j / (side - 1) - 2)
        s"$x $y ${height * Math.sin(3 * x) * Math.cos(4 * y)} ${i / 60.0} ${j / 60.0}\n"
    val faces =
      for j <- 0 until side - 1; i <- 0 until side - 1; half <- 0 to 1 yield
        val a = j * side + i
        if half == 0 then s"3 $a ${a + 1} ${a + side + 1}\n"
        else s"3 $a ${a + side + 1} ${a + side}\n"
    val head = s"ply\nformat ascii 1.0\nelement vertex ${vertices.size}\n" +
      Seq("x", "y", "z", "u", "v").map(p => s"property float $p\n").mkString +
      s"element face ${faces.size}\nproperty list uchar int vertex_indices\nend_header\n"
    Files.writeString(file, head + vertices.mkString + faces.mkString): Unit

  private def picture(file: Path, seed: Int): Unit =
    val draws = Draws(seed)
    val image = Image.rgb(33, 20)
    loop(image.data.length)(i => image.data(i) = draws.unit())
    ImageFiles.write(file, image)

  /** @param eye      of the camera
    * @param at       of the object that moves
    * @param mesh     of the ground
    * @param material of the object
    * @param ground   where a second mesh of a file is
    */
  private def scene(
      eye: String = "0 -4 3",
      at: String = "0 0 1",
      mesh: String = "sheet.ply",
      material: String = "\"conductor\" \"float roughness\" .2",
      ground: String = "0 0 -1"
  ): String =
    s"""Film "rgb" "integer xresolution" 16 "integer yresolution" 12
       |Sampler "zsobol" "integer pixelsamples" 4
       |LookAt $eye  0 0 0  0 0 1
       |Camera "perspective" "float fov" 50
       |WorldBegin
       |LightSource "infinite" "rgb L" [.6 .7 .9]
       |Texture "c" "spectrum" "imagemap" "string filename" "c.png" "string filter" "trilinear"
       |Texture "h" "float" "imagemap" "string filename" "c.png" "string filter" "bilinear"
       |Material "diffuse" "texture reflectance" "c"
       |Shape "plymesh" "string filename" "$mesh" "texture alpha" "h"
       |AttributeBegin
       |Translate $ground
       |Shape "plymesh" "string filename" "sheet.ply"
       |AttributeEnd
       |Translate 0 0 -1
       |AttributeBegin
       |Material $material
       |Translate $at
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [3 2 1]
       |Shape "sphere" "float radius" .15
       |AttributeEnd
       |Scale .3 .3 .3
       |Shape "loopsubdiv" "integer levels" 2 "integer indices" [0 1 2 0 3 1 1 3 2 2 3 0]
       |  "point3 P" [1 1 1 -1 -1 1 -1 1 -1 1 -1 -1]
       |AttributeEnd
       |ObjectBegin "o"
       |Shape "plymesh" "string filename" "$mesh"
       |ObjectEnd
       |AttributeBegin
       |Translate $at
       |Scale .1 .1 .1
       |ObjectInstance "o"
       |Translate 9 0 0
       |ObjectInstance "o"
       |AttributeEnd
       |""".stripMargin

  private def run(words: String*): Unit =
    val (code, captured) = Captured.run(words*)
    assert(code == 0, captured.err): Unit

  /** Renders the scenes at once, and each alone, and compares their images. */
  private def assertSame(scenes: String*): Unit = TempFolder.use: folder =>
    sheet(folder.resolve("sheet.ply"), 0.2)
    sheet(folder.resolve("other.ply"), 0.3)
    picture(folder.resolve("c.png"), 1)
    for (text, i) <- scenes.zipWithIndex do
      Files.writeString(folder.resolve(s"s$i.pbrt"), text): Unit
    def image(name: String) = Files.readAllBytes(folder.resolve(name)).toVector
    val alone = scenes.indices.map: i =>
      run(s"$folder/s$i.pbrt", "--outfile", s"$folder/alone.pfm", "--nthreads", "1", "--quiet")
      image("alone.pfm")
    assert(alone.distinct.size == scenes.distinct.size)
    for threads <- Seq("1", "2") do
      val to = s"$folder/t$threads-%d.pfm"
      val frames = s"0-${scenes.size - 1}"
      run(
        s"$folder/s%d.pbrt",
        "--frames",
        frames,
        "--outfile",
        to,
        "--nthreads",
        threads,
        "--quiet"
      )
      for i <- scenes.indices do assert(image(s"t$threads-$i.pfm") == alone(i), s"$threads, $i")

  test("many views of one scene are as each alone", Slow):
    assertSame((0 to 2).map(i => scene(eye = s"$i -4 3"))*)

  test("frames in which an object moves are as each alone", Slow):
    assertSame((0 to 3).map(i => scene(at = s"${0.2 * i} 0 1"))*)

  test("frames in which a mesh of a file moves are as each alone", Slow):
    assertSame((0 to 2).map(i => scene(ground = s"0 ${0.3 * i} -0.5"))*)

  test("frames that differ in meshes and materials are as each alone, and in any order", Slow):
    val (glass, dull) = ("\"dielectric\"", "\"coateddiffuse\"")
    assertSame(
      scene(), scene(mesh = "other.ply"), scene(material = glass), scene(material = dull), scene()
    )

  test("files that change between two renderings are read again", Slow):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("s.pbrt"), scene())
      def rendered(how: ReadSettings) =
        Using.resource(Candela.read(file, how).prepare(RenderSettings())): job =>
          val to = folder.resolve("x.pfm")
          job.render(1).image.save(to)
          Files.readAllBytes(to).toVector
      val shared = ReadSettings()
      val images =
        for (height, seed) <- Vector((0.2, 1), (0.25, 1), (0.25, 2), (0.2, 1)) yield
          sheet(folder.resolve("sheet.ply"), height)
          picture(folder.resolve("c.png"), seed)
          val image = rendered(shared)
          assert(image == rendered(ReadSettings()), s"$height, $seed")
          image
      assert(images.distinct.size == 3 && images.head == images.last)

  private def prepared[A](body: Path => A): A = TempFolder.use: folder =>
    sheet(folder.resolve("sheet.ply"), 0.2)
    sheet(folder.resolve("other.ply"), 0.3)
    picture(folder.resolve("c.png"), 1)
    Files.writeString(folder.resolve("s.pbrt"), scene(mesh = "other.ply")): Unit
    body(folder)

  /** The image and the warnings of a rendering. */
  private def rendered(folder: Path, words: String*): (Vector[Byte], String) =
    val to = folder.resolve("x.pfm")
    val (code, captured) =
      Captured.run(Seq(s"$folder/s.pbrt", "--outfile", s"$to") ++ words*)
    assert(code == 0, captured.err)
    val warnings = captured.err.linesIterator.filter(_.contains("warning")).mkString
    (Files.readAllBytes(to).toVector, warnings)

  test(
    "images are the same with a scene cache, cold, warm and damaged, for any number of threads",
    Slow
  ):
    prepared: folder =>
      val (alone, _) = rendered(folder, "--nthreads", "1")
      val cache = folder.resolve("cache")
      def cached(threads: Int) =
        rendered(folder, "--nthreads", s"$threads", "--scene-cache", s"$cache")
      assert(cached(1) == (alone, ""))
      val names = TempFolder.names(cache).filter(_.endsWith(".part"))
      // Two meshes, the hierarchy of the world, and that of the object
      assert(names.size == 4, names)
      val files = names.toVector.map(cache.resolve(_)).map(f => f -> Files.readAllBytes(f))
      assert(cached(2) == (alone, ""))
      val damages = Seq[Array[Byte] => Array[Byte]](
        all => all.updated(all.length / 2, (all(all.length / 2) ^ 1).toByte),
        _.dropRight(5),
        _ => Array.emptyByteArray
      )
      for damage <- damages; threads <- 1 to 2 do
        for (file, bytes) <- files do Files.write(file, damage(bytes)): Unit
        assert(cached(threads) == (alone, ""))
        for (file, bytes) <- files do assert(Files.readAllBytes(file).sameElements(bytes))

  test("a mesh that changes has other files in the scene cache"):
    prepared: folder =>
      def cached() = rendered(folder, "--scene-cache", s"$folder/cache")
      val (first, _) = cached()
      sheet(folder.resolve("other.ply"), 0.25)
      assert(cached() == rendered(folder))
      sheet(folder.resolve("other.ply"), 0.3)
      assert(cached() == (first, ""))

  test("the scene cache is in the folder of the texture cache, unless it has its own"):
    prepared: folder =>
      val cache = folder.resolve("cache")
      val _ = rendered(folder, "--scene-cache", "--texture-cache", s"$cache")
      assert(TempFolder.names(cache).count(_.endsWith(".part")) == 4)
      run(
        "--scene-cache",
        s"$folder/s.pbrt",
        "--texture-cache",
        s"$folder/d",
        "--outfile",
        s"$folder/y.pfm"
      )
      assert(TempFolder.names(folder.resolve("d")).count(_.endsWith(".part")) == 4)

  test("a scene cache that can't be written is told of once, and nothing is lost"):
    prepared: folder =>
      val (alone, _) = rendered(folder)
      val file = Files.write(folder.resolve("file"), Array.emptyByteArray)
      val under = file.resolve("cache")
      val (image, said) = rendered(folder, s"--scene-cache=$under")
      assert(image == alone)
      assert(said.linesIterator.count(_.contains("the scene cache gets no more files")) == 1, said)

  test("untrusted scenes have no scene cache"):
    prepared: folder =>
      val cache = folder.resolve("cache")
      val _ = rendered(folder, "--sandbox", "--scene-cache", s"$cache")
      assert(!Files.exists(cache))

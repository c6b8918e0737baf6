package candela.job

import candela.io.Sha256
import candela.scenefile.{SceneFiles, TokenDigest}
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.{NanoVdb, TempFolder, TiledExr, VdbGrid}

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** What a film says of its scene's files is what was rendered. */
class ReadFilesSuite extends AnyFunSuite:
  private val ply =
    """ply
      |format ascii 1.0
      |element vertex 3
      |property float x
      |property float y
      |property float z
      |element face 1
      |property list uchar int vertex_indices
      |end_header
      |0 0 0
      |1 0 0
      |0 1 0
      |3 0 1 2
      |""".stripMargin

  private val scene =
    """Camera "perspective"
      |WorldBegin
      |Include "part.pbrt"
      |Shape "plymesh" "string filename" "mesh.ply"
      |LightSource "infinite" "spectrum L" "light.spd"
      |Texture "t" "spectrum" "imagemap" "string filename" "image.pgm"
      |Material "diffuse" "texture reflectance" "t"
      |Shape "sphere"
      |Texture "l" "spectrum" "imagemap" "string filename" "levels.exr"
      |Material "diffuse" "texture reflectance" "l"
      |Shape "sphere"
      |MakeNamedMedium "smoke" "string type" "nanovdb" "string filename" "smoke.nvdb"
      |""".stripMargin

  private val grid = VdbGrid("density", Map((0, 0, 0) -> 1f, (1, 1, 1) -> 2f))

  private val texts = Map(
    "s.pbrt" -> scene,
    "part.pbrt" -> "Shape \"disk\"\n",
    "mesh.ply" -> ply,
    "light.spd" -> "400 1\n700 2\n",
    "image.pgm" -> "P2 1 1 255 7\n"
  )

  private def load(scene: Path): Prepared =
    SceneLoader.FromFile.load(scene.toString, RenderSettings(), BuildControl())

  private def digests(prepared: Prepared, film: Path): Map[String, String] =
    FilmHeaders.of(RenderSettings(), "s.pbrt", prepared, film).files.toMap

  test("digests of a film are of files as they were read, though they change before it is made"):
    TempFolder.use: folder =>
      for (name, text) <- texts do Files.writeString(folder.resolve(name), text): Unit
      Files.write(folder.resolve("smoke.nvdb"), NanoVdb.file(Vector(grid))): Unit
      TiledExr(64, 64, 16, 16)((_, _, _, _) => 0.5f).write(folder.resolve("levels.exr"))
      val film = folder.resolve("a.film")
      val names = texts.keySet ++ Set("smoke.nvdb", "levels.exr")
      val before = names.map: name =>
        val file = folder.resolve(name)
        val isScene = name.endsWith(".pbrt")
        name -> (if isScene then TokenDigest.of(texts(name))
                 else Sha256.ofAll(Files.newInputStream(file)))
      Using.resource(load(folder.resolve("s.pbrt"))): prepared =>
        for name <- names do Files.writeString(folder.resolve(name), "another"): Unit
        assert(digests(prepared, film) == before.toMap)

  test("every file that a scene names is digested while it is read", Slow):
    val files = Using.resource(Files.walk(Path.of("scenes")))(_.iterator.asScala.toVector)
      .filter(f => SceneFormat.all.exists(_.suffixes.exists(s => f.toString.endsWith(s".$s"))))
    val loaded =
      for file <- files; prepared <- Try(load(file)).toOption yield Using.resource(prepared): p =>
        val scene = p.description
        for read <- SceneFiles.of(scene) do
          assert(scene.folder.reads.digest(read).isDefined, s"$file: $read")
    // Those that others include are no scenes
    assert(loaded.size > 0.8 * files.size)

  test("a file that is read twice with two contents has the digest of neither"):
    TempFolder.use: folder =>
      val reads = candela.io.ReadFiles()
      val file = folder.resolve("a")
      reads.note(file, "1")
      reads.note(file, "1")
      assert(reads.digest(file).contains("1"))
      reads.note(file, "2")
      assert(!reads.digest(file).exists(Set("1", "2")))

package candela.cli

import candela.testing.TempFolder

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** Films of pbrt-v2's adaptive sampler. */
class AdaptiveFilmsSuite extends AnyFunSuite:
  private val text =
    """LookAt 0 0 -4  0 0 0  0 1 0
      |Camera "perspective" "float fov" 40
      |Film "image" "integer xresolution" 24 "integer yresolution" 16
      |Sampler "adaptive"
      |SurfaceIntegrator "directlighting"
      |WorldBegin
      |LightSource "point" "point from" [ 3 4 -5 ] "rgb I" [ 40 40 40 ]
      |Shape "sphere" "float radius" 1
      |WorldEnd
      |""".stripMargin

  test("they are merged and resumed, but get no more samples"):
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val f = FilmFilesSuite.Folder(folder, scene)
      val said = f.render("--outfile", f("one.exr"))
      assert(" 24x16, [0-9.]+ of 32 spp,".r.findFirstIn(said).isDefined, said)
      f.render("--outfile", f("one.film"))
      for i <- 0 until 2 do f.render("--shard", s"$i/2", "--outfile", f(s"$i.film"))
      val outfiles = s"${f("all.exr")},${f("all.film")}"
      f.run(Vector("merge", "--outfile", outfiles, f("0.film"), f("1.film")))
      assert(f.bytes("all.exr") == f.bytes("one.exr"))
      assert(f.bytes("all.film") == f.bytes("one.film"))
      f.run(Vector("resume", f("one.film")))
      assert(f.bytes("all.film") == f.bytes("one.film"))
      for option <- Vector("--spp=64", "--time=1s", "--error=1%") do
        assert(f.fail(Vector("resume", f("one.film"), option)).contains("decides on their number"))
      val other = f.fail(Vector(f.scene, "--spp", "32", "--outfile", f("one.film")))
      assert(other.contains("`adaptive sampling` differs"))

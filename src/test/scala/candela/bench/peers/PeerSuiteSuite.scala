package candela.bench.peers

import candela.bench.suite.{Installed, SuiteFolder, SuiteResults, Work}
import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}
import java.nio.file.attribute.PosixFilePermissions

import org.scalatest.funsuite.AnyFunSuite

/** Programs of the shell stand for renderers. */
class PeerSuiteSuite extends AnyFunSuite:

  private def script(file: Path, text: String): Path =
    Files.writeString(file, s"#!/bin/sh\n$text\n"): Unit
    Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rwxr-xr-x"))

  /** Copies a picture to the word after `--outfile` or `-o`. */
  private def copying(picture: Path): String =
    s"""while [ $$# -gt 1 ]; do
       |  case "$$1" in --outfile|-o) cp $picture "$$2";; esac
       |  shift
       |done""".stripMargin

  private def flat(file: Path, value: Float): Path =
    val image = Image.rgb(8, 8)
    java.util.Arrays.fill(image.data, value)
    ImageFiles.write(file, image)
    file

  private def found(folder: Path, environment: (String, String)*) =
    PeerPrograms(Map("PATH" -> "") ++ environment, folder).detect

  test("programs that are absent are named with where to get them"):
    TempFolder.use: folder =>
      val (programs, absent) = found(folder, Installed.Python -> "/no/such/python")
      assert(programs.map(_.name) == Vector("candela"))
      val where = absent.map(a => a.title -> a.obtain).toMap
      assert(where("pbrt-v4").contains("PBRT_V4") && where("Mitsuba 3").contains("pip install"))
      assert(where("Cycles").contains("`pip install bpy numpy`"))
      assert(where("LuxCore").contains("pyluxcore") && absent.size == 6)

  test("a program on the path is told by what its help says, a Python by its packages"):
    TempFolder.use: folder =>
      script(folder.resolve("pbrt"), "echo usage: pbrt --nthreads --debugstart"): Unit
      val python = script(folder.resolve("python3"), "echo \"['numpy', 'pyluxcore']\"")
      val (programs, absent) =
        found(folder, "PATH" -> folder.toString, "MITSUBA" -> "/opt/mitsuba")
      assert(programs.map(_.name) ==
        Vector("candela", "candela-rgb", "pbrt-v4", "mitsuba", "luxcore"))
      assert(absent.map(_.title) == Vector("pbrt-v3", "pbrt-v2", "Cycles"))
      assert(programs.last.command.take(2) ==
        Vector(python.toString, folder.resolve("render_luxcore.py").toString))
      assert(Files.exists(folder.resolve("exchange.py")) && Files.exists(python))

  test("a program whose mean differs is not compared, and the reason is told"):
    TempFolder.use: folder =>
      val right = flat(folder.resolve("right.exr"), 0.5f)
      val self = script(folder.resolve("self"), copying(right))
      val mitsuba = script(folder.resolve("mitsuba"), copying(right))
      val wrong = copying(flat(folder.resolve("wrong.exr"), 0.55f))
      val python = script(
        folder.resolve("python"),
        s"if [ \"$$1\" = -c ]; then echo \"['numpy', 'bpy']\"; exit; fi\n$wrong"
      )
      val scene = folder.resolve("ball.pbrt")
      Files.writeString(
        scene,
        """Camera "perspective"
          |Film "rgb" "integer xresolution" 8 "integer yresolution" 8
          |Integrator "path"
          |WorldBegin
          |LightSource "infinite"
          |Shape "sphere"
          |""".stripMargin
      ): Unit
      val suite = SuiteFolder.ofScene(scene).copy(work = Work.Samples(Vector(1, 2)))
      val environment =
        Map("MITSUBA" -> mitsuba.toString, Installed.Python -> python.toString, "PATH" -> "")
      val peers = PeerSuite.of(suite, environment, folder)
      val report = SuiteResults.of(
        // The variables are not set for this process
        peers.suite.copy(programs = peers.suite.programs.map(_.copy(needs = Vector.empty))),
        Vector(self.toString),
        folder,
        "1",
        _ => (),
        leftOut = peers.leftOut
      )
      val why = report.leftOut.toMap
      val compared = report.scenes.head.programs.map(_.name)
      assert(compared == Vector("candela", "candela-rgb", "mitsuba"), why)
      assert(why("Cycles on ball").contains("by +10 % in red"), why)
      assert(why("LuxCore").contains("pip install"))

  test("the suite of some minutes can be written for every program that reads its scenes"):
    TempFolder.use: folder =>
      for scene <- PeerSuite.short(folder).scenes do
        val made = PeerScenes.of(scene.files("v4"), folder.resolve(scene.name))
        assert(Seq("v3", "v4", PeerScenes.Exchange).forall(made.files.contains), made.failures)
        assert(made.isSame)

package candela.suite

import candela.image.{Image, ImageFiles}
import candela.measure.Metric
import candela.report.SuiteReport

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

/** Programs that copy a picture stand for renderers: what comes out is known. */
class SuiteRunnerSuite extends AnyFunSuite:

  private def flat(path: Path, value: Float): Path =
    val image = Image.rgb(4, 3)
    java.util.Arrays.fill(image.data, value)
    ImageFiles.write(path, image)
    path

  private def program(name: String, command: String, edits: Edit*): Program =
    Program(
      name,
      name,
      command.split(' ').toVector,
      Vector("picture"),
      2,
      edits.toVector,
      isSeeded = true,
      0,
      isThin = false
    )

  private def run(folder: Path, programs: Program*): (SuiteReport, Vector[String]) =
    val scene = SuiteScene(
      "flat",
      "Flat",
      "",
      Map("picture" -> flat(folder.resolve("scene.exr"), 0.75f)),
      flat(folder.resolve("reference.exr"), 0.5f),
      None,
      None,
      None,
      Vector.empty
    )
    val away = scene.copy(name = "away", title = "Away", needs = Vector("NO_SUCH_VARIABLE"))
    val suite =
      Suite("T", programs.toVector, Vector(scene, away), Work.Samples(Vector(1, 2)), 2, 30)
    val said = Vector.newBuilder[String]
    val report = SuiteResults.of(suite, Vector("self"), folder, "1", s => said += s)
    (report, said.result())

  private def inFolder[A](body: Path => A): A =
    val folder = Files.createTempDirectory("candela-suite")
    try body(folder)
    finally
      Using.resource(Files.walk(folder)): files =>
        files.iterator.asScala.toVector.reverse.foreach(Files.delete)

  test("every program makes every image, in turn, after one that doesn't count"):
    inFolder: folder =>
      val copy = "cp {scene} {out}"
      val (report, said) = run(folder, program("one", copy), program("two", copy))
      val scene = report.scenes.head
      assert(scene.programs.map(_.name) == Vector("one", "two"))
      for p <- scene.programs do
        assert(p.curve.points.map(_.samples) == Vector(1, 2))
        assert(p.curve.points.forall(_.runs.map(_.seed) == Vector(1, 2)))
        assert(p.curve.points.head(Metric.Mse).get.estimate == 0.0625)
        assert(p.curve.points.forall(_.seconds > 0) && p.picture(0, 0, 0) == 0.75f)
      val runs = said.filter(_.startsWith("Flat"))
      assert(runs.size == 2 + 8 && runs.count(_.contains("warm-up")) == 2)
      // Neighbours are of different programs, and another one begins each time.
      val order = runs.drop(2).map(_.split(", ")(1))
      assert(order == Vector("two", "one", "one", "two", "one", "two", "two", "one"))

  test("what is not installed, fails or lacks its scene is left out with the reason"):
    inFolder: folder =>
      val (report, said) = run(
        folder,
        program("copy", "cp {scene} {out}"),
        program("none", "no-such-renderer-of-candela {scene}"),
        program("bad", "cp {scene}"),
        program("silent", "true"),
        program("unset", "cp").copy(needs = Vector("NO_SUCH_PROGRAM")),
        program("edited", "cp {scene} {out}", Edit("no such words".r, ""))
      )
      assert(report.scenes.map(_.name) == Vector("flat"))
      assert(report.scenes.head.programs.map(_.name) == Vector("copy"))
      val reasons = report.leftOut.toMap
      assert(reasons("none") == "`no-such-renderer-of-candela` is not installed")
      assert(reasons("unset") == "the variable NO_SUCH_PROGRAM is not set")
      assert(reasons("Away") == "the variable NO_SUCH_VARIABLE is not set")
      assert(reasons("Flat, bad, 1 spp").startsWith("ended with 1: "))
      assert(reasons("Flat, silent, 1 spp") == "wrote no image: it said nothing")
      assert(reasons("edited on Flat") == "nothing to edit: `no such words`")
      for (what, why) <- reasons do assert(said.contains(s"left out: $what: $why"))

  test("a run that takes too long is ended"):
    inFolder: folder =>
      val outcome = Commands(Vector.empty, folder).run(
        Vector("sleep", "30"),
        folder.resolve("out.exr"),
        timeout = 0.2
      )
      assert(outcome == Outcome.Failed("took longer than 0.2 s"))

  test("words are filled in, and {candela} is this program"):
    inFolder: folder =>
      val commands = Commands(Vector("java", "Main"), folder)
      val p = program("p", "{candela} -j {threads} {out}")
      val words = commands.words(p, Map("threads" -> "2"))
      assert(words == Vector("java", "Main", "-j", "2", "{out}"))

  test("an edited scene lies among links to its neighbours, and the original stays"):
    inFolder: folder =>
      val home = Files.createDirectory(folder.resolve("home"))
      val scene = Files.writeString(home.resolve("a.pbrt"), "Sampler \"x\" \"integer spp\" 8")
      Files.writeString(home.resolve("mesh.ply"), "ply")
      val edits = Vector(Edit("spp\" \\d+".r, "spp\" {spp}"))
      val copy = SceneCopy(folder).of(scene, edits, Commands.filled(_, Map("spp" -> "32")))
      assert(Files.readString(copy) == "Sampler \"x\" \"integer spp\" 32")
      assert(Files.readString(copy.resolveSibling("mesh.ply")) == "ply")
      assert(Files.readString(scene).endsWith(" 8"))
      assert(SceneCopy(folder).of(scene, Vector.empty, identity) == scene)

  test("the target is what half of the programs reach, rounded up to two digits"):
    assert(Math.abs(SuiteResults.reachable(Vector(0.0123, 0.5, 0.001)) - 0.013) < 1e-12)
    assert(Math.abs(SuiteResults.reachable(Vector(0.02)) - 0.02) < 1e-12)

  test("a time is filled with as many samples as fit into it, and one at least"):
    // Half a second to start, a tenth for each sample
    assert(SuiteRunner.samplesFor(2.65, one = 0.6, many = 1.3) == 21)
    assert(SuiteRunner.samplesFor(0.1, one = 0.6, many = 1.3) == 1)

package candela.bench.suite

import candela.bench.report.{SuitePage, SuiteReport}
import candela.image.{Image, ImageFiles}
import candela.measure.Metric

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

  private def sceneIn(folder: Path): SuiteScene =
    SuiteScene(
      "flat",
      "Flat",
      "",
      Map("picture" -> flat(folder.resolve("scene.exr"), 0.75f)),
      Some(flat(folder.resolve("reference.exr"), 0.5f)),
      None,
      None,
      None,
      Vector.empty
    )

  private def run(folder: Path, programs: Program*): (SuiteReport, Vector[String]) =
    val scene = sceneIn(folder)
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

  test("a program's layer is compared in place of its colours"):
    inFolder: folder =>
      val names = Vector("R", "G", "B", "Denoised.R", "Denoised.G", "Denoised.B")
      val data = Array.tabulate(12 * names.size)(i => if i % 6 < 3 then 0.75f else 0.5f)
      ImageFiles.write(folder.resolve("both.exr"), Image(4, 3, names, data))
      val copy = s"cp ${folder.resolve("both.exr")} {out}"
      val denoised = program("denoised", copy).copy(layer = Some("Denoised"))
      val wrong = program("wrong", copy).copy(layer = Some("Clean"))
      val (report, _) = run(folder, program("noisy", copy), denoised, wrong)
      val errors =
        report.scenes.head.programs.map(p => p.curve.points.last(Metric.Mse).get.estimate)
      assert(errors == Vector(0.0625, 0.0))
      assert(report.leftOut.exists((what, why) =>
        what.startsWith("Flat, wrong") &&
          why == "the image has no layer `Clean`"
      ))

  test("programs that can denoise are run with and without it"):
    inFolder: folder =>
      val self = program("own", "{candela} {scene} --outfile {out}").copy(title = "Own")
      val scene = sceneIn(folder).copy(programs = Some(Vector("own", "other")))
      val suite = Suite(
        "T",
        Vector(self, program("other", "cp")),
        Vector(scene),
        Work.Samples(Vector(1)),
        1,
        1
      )
        .withDenoised
      assert(suite.programs.map(_.name) == Vector("own", "own-denoised", "other"))
      val twin = suite.programs(1)
      assert(twin.title == "Own, denoised" && twin.layer.contains("Denoised") && twin.isThin)
      assert(twin.command == self.command :+ "--denoise")
      assert(suite.scenes.head.programs.contains(Vector("own", "other", "own-denoised")))

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

  test("the first image has one sample, and runs of its own only where no count is one"):
    inFolder: folder =>
      def first(counts: Int*): (Option[Double], Vector[Int], Int) =
        val said = Vector.newBuilder[String]
        val work = Work.Samples(counts.toVector)
        val suite =
          Suite("T", Vector(program("a", "cp {scene} {out}")), Vector(sceneIn(folder)), work, 2, 30)
        val report = SuiteResults.of(suite, Vector("self"), folder, "1", s => said += s)
        val p = report.scenes.head.programs.head
        (p.firstImage, p.curve.points.map(_.samples), said.result().count(_.contains("1 spp")))
      val (own, points, runs) = first(2, 4)
      assert(own.exists(_ > 0) && points == Vector(2, 4) && runs == 2)
      val (shared, all, ones) = first(1, 4)
      // With the warm-up run
      assert(shared.exists(_ > 0) && all == Vector(1, 4) && ones == 3)

  private def unjudged(folder: Path, seeds: Int, programs: Program*): SuiteReport =
    for seed <- 1 to 3; (name, scale) <- Seq("one" -> 1f, "two" -> 2f) do
      flat(folder.resolve(s"$name-$seed.exr"), scale * seed / 10f): Unit
    val scene = sceneIn(folder).copy(reference = None)
    val suite =
      Suite("T", programs.toVector, Vector(scene), Work.Samples(Vector(1, 2)), seeds, 30)
    SuiteResults.of(suite, Vector("self"), folder, "1", _ => ())

  test("without a reference, errors are the variance between the seeds"):
    inFolder: folder =>
      def seeded(name: String) = program(name, s"cp $folder/$name-{seed}.exr {out}")
      val still = program("still", "cp {scene} {out}").copy(isSeeded = false)
      val two = seeded("two").copy(ownFamily = Some("another"))
      val report = unjudged(folder, 3, seeded("one"), two, still)
      val scene = report.scenes.head
      assert(scene.referenceName.isEmpty && Math.abs(scene.reference(0, 0, 0) - 0.3f) < 1e-6)
      assert(scene.programs.map(_.name) == Vector("one", "two"))
      assert(scene.biases.map(_.test.fullImage.size) == Vector(3))
      for (p, variance, ratio) <- scene.programs.zip(Seq(0.01, 0.04)).zip(Seq(2 / 3.0, 4 / 3.0))
          .map((a, b) => (a._1, a._2, b))
      do
        assert(p.curve.points.map(_.samples) == Vector(1, 2) && p.firstImage.isDefined)
        for point <- p.curve.points do
          assert(Math.abs(point(Metric.Mse).get.estimate - variance) < 1e-6)
          assert(point(Metric.Flip).isEmpty)
        assert(Math.abs(p.curve.meanRatio.head - ratio) < 1e-6)
      val why = "it has no seeds: without a reference, its noise is unknown"
      assert(report.leftOut == Vector("still on Flat" -> why))
      val page = SuitePage.html(report)
      for words <- Seq("variance between the seeds", "renderings of one and two") do
        assert(page.contains(words))

  test("repeated images of a program without seeds count once"):
    inFolder: folder =>
      val copy = program("copy", "cp {scene} {out}")
      val still = program("still", "cp {scene} {out}").copy(isSeeded = false)
      val (report, _) = run(folder, copy, still)
      val runs = report.scenes.head.programs.map(_.curve.points.map(_.runs.size))
      assert(runs == Vector(Vector(2, 2), Vector(1, 1)))

  test("a scene whose images have no finite pixel is left out"):
    inFolder: folder =>
      val dark = flat(folder.resolve("nothing.exr"), Float.NaN)
      val report = unjudged(folder, 3, program("one", s"cp $dark {out}"))
      assert(report.scenes.isEmpty)
      assert(report.leftOut == Vector("Flat" -> "no pixel is finite in all images"))

  test("without a reference, two seeds are too few"):
    inFolder: folder =>
      val report = unjudged(folder, 2, program("one", s"cp $folder/one-{seed}.exr {out}"))
      assert(report.scenes.isEmpty && report.leftOut.head._2.contains("at least 3 seeds"))

  test("peak memory is that of the largest process, where the system tells it"):
    val own = PeakMemory.of(ProcessHandle.current)
    val sleeping = ProcessBuilder("sh", "-c", "sleep 30; true").start()
    try
      if Files.isDirectory(java.nio.file.Path.of("/proc/self")) then
        val used = Runtime.getRuntime.totalMemory - Runtime.getRuntime.freeMemory
        assert(own.exists(_ >= used / 2))
        assert(PeakMemory.of(sleeping.toHandle).exists(m => m > 10000 && m < 50000000))
      else assert(own.isEmpty)
    finally sleeping.destroyForcibly().waitFor(): Unit
    assert(PeakMemory.of(sleeping.toHandle).isEmpty)

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
      assert(reasons("unset") == "environment variable NO_SUCH_PROGRAM is not set")
      assert(reasons("Away") == "environment variable NO_SUCH_VARIABLE is not set")
      assert(reasons("Flat, bad, 1 spp").startsWith("exit code 1: "))
      assert(reasons("Flat, silent, 1 spp") == "wrote no image: no output")
      assert(reasons("edited on Flat") == "edit matches nothing: `no such words`")
      for (what, why) <- reasons do assert(said.contains(s"skipped: $what: $why"))

  test("the reason for a failure is the line that names the error, else the last one"):
    inFolder: folder =>
      def said(lines: String*): String =
        val script = folder.resolve("fails.sh")
        val text = lines.map(l => s"printf '%b\\n' '$l'").mkString("", "\n", "\nexit 3\n")
        val _ = Files.writeString(script, text)
        Commands(Vector.empty, folder).run(
          Vector("sh", script.toString),
          folder.resolve("none.exr"),
          30
        ) match
          case Outcome.Failed(why) => why
          case other => fail(other.toString)
      assert(said("reading", "error[E0001]: no lamp", " --> a.pbrt:1:1", "bye") ==
        "exit code 3: error[E0001]: no lamp")
      assert(said("Traceback:", "  raise ValueError(x)", "ValueError: 3", "bye") ==
        "exit code 3: ValueError: 3")
      assert(said(
        "\\033[31mError\\033[0m: a.pbrt: what",
        "bye"
      ) == "exit code 3: Error: a.pbrt: what")
      assert(said("[ x.cpp:3 ] FATAL no file", "bye") == "exit code 3: [ x.cpp:3 ] FATAL no file")
      assert(said("estimated error 0.1", "bye") == "exit code 3: bye")

  /** Renders for 0.01 s per sample, from 100 samples on for four times as long each. */
  private final class Slowing(folder: Path) extends Commands(Vector.empty, folder):
    override def run(words: Vector[String], out: Path, timeout: Double): Outcome =
      val samples = words.last.toInt
      flat(out, if samples < 100 then 0.5f else 0.75f)
      Outcome.Done(0.01 * (samples + 3 * Math.max(0, samples - 100)), None)

  test("a rendering that took much longer than its budget is repeated with fewer samples, once"):
    inFolder: folder =>
      val said = Vector.newBuilder[String]
      val scene = sceneIn(folder).copy(work = Some(Work.Seconds(Vector(0.5, 2))))
      val suite =
        Suite(
          "T",
          Vector(program("slow", "cp {spp}")),
          Vector(scene),
          Work.Samples(Vector(1)),
          3,
          30
        )
      val names = PublicNames(Map.empty, Vector.empty)
      val runner = SuiteRunner(suite, Slowing(folder), folder, names, said += _, () => false)
      val points = runner.run(_ => ()).filter(_.job.isPoint)
      val (short, long) = points.partition(_.job.step == 0)
      assert(short.map(_.measurement.samples) == Vector(50, 50, 50))
      // 200 take 5 s; between 100, which take 1 s, and these, the time is linear
      assert(long.map(_.measurement.samples).distinct.size == 1)
      assert(long.map(_.measurement.seed) == Vector(1, 2, 3))
      assert(long.forall(r => Math.abs(r.measurement.seconds / 2 - 1) < 0.2))
      assert(runner.picture(long.head.job.entry)(0, 0, 0) == 0.75f)
      val repeated = said.result().filter(_.contains("again with"))
      assert(repeated.size == 1 && repeated.head.startsWith("Flat, slow: 5.00 s instead of 2.00 s"))
      // Nothing is forgotten, and nothing counted twice
      assert(said.result().last.endsWith("[13 of 13]"))

  private def twoScenes(folder: Path, command: String): Suite =
    val first = sceneIn(folder)
    val scenes = Vector(first, first.copy(name = "second", title = "Second"))
    Suite("T", Vector(program("copy", command)), scenes, Work.Samples(Vector(1, 2)), 2, 30)

  test("what there is is told after each scene, and what is missing yet"):
    inFolder: folder =>
      val told = Vector.newBuilder[SuiteReport]
      val report = SuiteResults.of(
        twoScenes(folder, "cp {scene} {out}"),
        Vector("self"),
        folder,
        "1",
        _ => (),
        publish = r => told += r
      )
      assert(told.result().map(_.scenes.map(_.name)) ==
        Vector(Vector("flat"), Vector("flat", "second")))
      assert(told.result().head.leftOut == Vector(
        "Second" -> "not rendered when this report was written"
      ))
      assert(report.leftOut.isEmpty && report.scenes.size == 2)

  test("what is cancelled keeps what was measured, and says what was not"):
    inFolder: folder =>
      @volatile var isCancelled = false
      val report = SuiteResults.of(
        twoScenes(folder, "cp {scene} {out}"),
        Vector("self"),
        folder,
        "1",
        line => if line.startsWith("Flat") && line.contains("seed 2") then isCancelled = true,
        () => isCancelled
      )
      // Both counts with the first seed, the smaller one with the second
      val points = report.scenes.head.programs.head.curve.points
      assert(points.map(_.runs.size) == Vector(2, 1))
      assert(report.leftOut == Vector(
        "Flat" -> "partly rendered when this report was written",
        "Second" -> "not rendered when this report was written"
      ))

  test("a program that is cancelled ends soon, and is no failure"):
    inFolder: folder =>
      var asked = 0
      def isCancelled =
        asked += 1
        asked > 3
      val commands = Commands(Vector.empty, folder, () => isCancelled)
      // What it does later is not done, however long later is
      val words = Vector("sh", "-c", "sleep 30; touch late")
      val outcome = commands.run(words, folder.resolve("out.exr"), timeout = 600)
      assert(outcome == Outcome.Cancelled && !Files.exists(folder.resolve("late")))

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

  test("variants of a program vote once about the target"):
    inFolder: folder =>
      for (name, value) <- Seq("good" -> 0.6f, "better" -> 0.55f, "poor" -> 0.75f) do
        flat(folder.resolve(s"$name.exr"), value): Unit
      def made(name: String, family: String) =
        program(name, s"cp $folder/$name.exr {out}").copy(ownFamily = Some(family))
      val all = Vector(made("good", "one"), made("better", "one"), made("poor", "two"))
      val (report, _) = run(folder, all*)
      // Half of two families is one more than the best; of three programs it was the second best
      val worst = report.scenes.head.programs.last.curve.lowestError
      assert(report.scenes.head.target >= worst)

  test("what others take of the processors is told"):
    val machine = "cpu  100 0 50 800 10 5 5 30 0 0\ncpu0 1 2 3"
    val process = "7 (a (b) c) S 1 1 1 0 -1 4 5 6 7 8 20 10 3 2 20 0"
    val before = ProcessorTimes.of(machine, process)
    assert(before == ProcessorTimes(1000, 190, 35))
    // Of 100 ticks, 60 were busy: 50 of our programs
    assert(before.othersUntil(ProcessorTimes(1100, 250, 85)).contains(0.1))
    assert(before.othersUntil(before).isEmpty)
    // Children are counted when they end: less than nothing is nothing
    assert(before.othersUntil(ProcessorTimes(1100, 200, 100)).contains(0.0))

  test("the target is what half of the programs reach, rounded up to two digits"):
    assert(Math.abs(SuiteResults.reachable(Vector(0.0123, 0.5, 0.001)) - 0.013) < 1e-12)
    assert(Math.abs(SuiteResults.reachable(Vector(0.02)) - 0.02) < 1e-12)

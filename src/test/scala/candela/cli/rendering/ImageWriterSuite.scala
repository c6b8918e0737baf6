package candela.cli.rendering

import candela.cli.{Captured, Main}
import candela.cli.terminal.Interrupts
import candela.color.Rgb
import candela.image.ImageFiles
import candela.job.{Prepared, SceneLoader}
import candela.render.{Cancellation, TinyPlan}
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** What `--skip-done` takes for done. */
class ImageWriterSuite extends AnyFunSuite:

  /** Scenes of 5 samples per pixel, unless others are asked for.
    *
    * @param fifth called with a scene's name and the cancellation of its rendering, when a fifth
    *              sample is taken
    */
  private final class Scenes(fifth: (String, Cancellation) => Unit) extends SceneLoader:
    private var current = Cancellation()

    object CtrlC extends Interrupts:
      def during[A](cancellation: Cancellation)(body: => A): A =
        current = cancellation
        body

    def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
      val plan = TinyPlan(spp = settings.samples.getOrElse(5)): (where, _) =>
        if where.sample == 4 then fifth(scene, current)
        Rgb.White
      Prepared(SceneDescription(Dialect.V4), plan, Vector.empty, 0.5, 0.25)

  /** Exit code and output of a run that renders what is not done. */
  private def run(words: String*)(fifth: (String, Cancellation) => Unit): (Int, String) =
    val scenes = Scenes(fifth)
    val captured = Captured(interrupts = scenes.CtrlC)
    val all = words ++ Seq("--skip-done", "--nthreads", "1")
    (Main.run(all, captured.terminal, scenes), captured.out)

  private def run(words: String*): (Int, String) = run(words*)((_, _) => ())

  private def samples(image: Path): String = ImageFiles.facts(image).toMap.apply("samplesPerPixel")

  test("an image that was interrupted is not done, one that was completed is"):
    TempFolder.use: folder =>
      val image = folder.resolve("a.exr")
      val words = Seq("s.pbrt", "--outfile", image.toString)
      val (interrupted, _) = run(words*)((_, cancellation) => cancellation.request())
      assert(interrupted == 130 && samples(image) == "4")
      val (code, out) = run(words*)
      assert(code == 0 && out.startsWith("wrote ") && samples(image) == "5", out)
      assert(run(words*) == (0, "1 scene: 1 skipped (done already)\n"))

  test("an image that is written before the end is not done"):
    TempFolder.use: folder =>
      val (image, early) = (folder.resolve("a.exr"), folder.resolve("early.exr"))
      val words = Seq("s.pbrt", "--outfile", image.toString, "--write-partial-images")
      // What a run leaves that is killed by then
      val _ = run(words*): (_, _) =>
        if !Files.exists(early) then Files.copy(image, early): Unit
      assert(samples(image) == "5" && samples(early) == "4")
      Files.write(image, Files.readAllBytes(early))
      assert(run(words*)._2.startsWith("wrote ") && samples(image) == "5")
      assert(run(words*)._2.contains("1 skipped"))

  test("a frame that was interrupted is rendered again, those before it are not"):
    TempFolder.use: folder =>
      val words = Seq("s%d.pbrt", "--frames", "1-3", "--outfile", s"$folder/a%d.exr")
      val (interrupted, _) = run(words*): (scene, cancellation) =>
        if scene == "s2.pbrt" then cancellation.request()
      assert(interrupted == 130 && TempFolder.names(folder) == Set("a1.exr", "a2.exr"))
      val (code, out) = run(words*)
      assert(code == 0 && out.contains("3 scenes: 2 rendered, 1 skipped (done already)"), out)
      for n <- 1 to 3 do assert(samples(folder.resolve(s"a$n.exr")) == "5")

  test("an image of fewer samples than are asked for is not done, nor is one of more"):
    TempFolder.use: folder =>
      val image = folder.resolve("a.exr")
      for spp <- Vector("2", "4", "3") do
        val words = Seq("s.pbrt", "--spp", spp, "--outfile", image.toString)
        assert(run(words*)._2.startsWith("wrote "), spp)
        assert(samples(image) == spp && run(words*)._2.contains("1 skipped"))

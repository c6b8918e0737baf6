package candela.fuzz

import java.nio.file.{Files, Path}
import scala.util.Random

import candela.image.ImageFiles
import candela.testing.{RandomLaws, TempFolder, TrialPlan}

import org.scalatest.tagobjects.Slow

/** The short version of [[FuzzScenes]]. */
class FuzzSuite extends RandomLaws:

  for kind <- Kind.all do
    val name = s"attempts end in an answer or a clean refusal: ${kind.name}"
    // A single attempt of some kinds starts processes, and takes seconds
    if kind.short > 1 then law(name)(attempt(kind, _))
    else test(name, Slow)(attempt(kind, TrialPlan.Full))

  private def attempt(kind: Kind, plan: TrialPlan): Unit =
    TempFolder.use: folder =>
      kind.start(Place(Path.of("scenes"), folder, Random(plan.seed(7)))) match
        case Left(why) => cancel(why)
        case Right(attempts) =>
          try
            for i <- 0 until plan.count(kind.short) do
              val attempt = attempts.next()
              val wrong = attempt.judge()
              def texts = attempt.files.filter(Files.isRegularFile(_)).map: file =>
                String(Files.readAllBytes(file), "ISO-8859-1").take(20000)
              assert(wrong.isEmpty, s"$i: ${attempt.what}\n${texts.mkString("\n")}")
          finally attempts.close()

  test("the pictures that are to be broken can be read before"):
    TempFolder.use: folder =>
      for (bytes, i) <- Trials.pictures(folder).zipWithIndex do
        val file = Files.write(folder.resolve("whole.tga"), bytes)
        assert(ImageFiles.read(file).width >= 8, s"picture $i")

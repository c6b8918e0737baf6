package candela.fuzz

import java.nio.file.{Files, Path}
import scala.util.Random

import candela.image.ImageFiles

import org.scalatest.BeforeAndAfterAll
import org.scalatest.funsuite.AnyFunSuite

/** The short version of [[FuzzScenes]]. */
class FuzzSuite extends AnyFunSuite with BeforeAndAfterAll:
  private lazy val folder = Files.createTempDirectory("candela-fuzz")

  override def afterAll(): Unit =
    val all = Files.walk(folder)
    try all.sorted(java.util.Comparator.reverseOrder()).forEach(Files.delete(_))
    finally all.close()

  for (kind, count) <- Vector(
      Kind.Scenes -> 2000,
      Kind.Builds -> 150,
      Kind.Meshes -> 1500,
      Kind.Pictures -> 500,
      Kind.Volumes -> 200,
      Kind.Mitsuba -> 400
    )
  do
    test(s"$count broken files end in an answer or a clean refusal: ${kind.name}"):
      val trials = Trials(Path.of("scenes"), folder, Random(7))
      for i <- 0 until count do
        val file = trials.next(kind)
        val wrong = trials.judge(kind, file)
        def text = String(Files.readAllBytes(file), "ISO-8859-1")
        assert(wrong.isEmpty, s"${kind.name} $i:\n$text")

  test("the pictures that are to be broken can be read before"):
    for (bytes, i) <- Trials.pictures(folder).zipWithIndex do
      val file = Files.write(folder.resolve("whole.tga"), bytes)
      assert(ImageFiles.read(file).width >= 8, s"picture $i")

package candela.stability

import java.nio.file.Path

import scala.collection.mutable

import candela.image.{Image, ImageFiles}

/** One scene, rendered by all. */
private final class SideBySideRow(val scene: HardScene, programs: Seq[Renders], folder: Path):
  private type Outcome = Either[String, (Image, Image)]
  private val likes = mutable.Map.empty[(Renders, String), Option[Image]]

  private def outcome(p: Renders): Outcome =
    p.render(scene.name, folder).flatMap: image =>
      def other(name: String) =
        likes.getOrElseUpdate((p, name), p.render(name, folder).toOption)
      scene.right(image, other).map(image -> _).toRight("nothing to compare with")

  private val outcomes: Seq[Outcome] = programs.map(outcome)

  private val cells: Seq[(String, Boolean)] = outcomes.map:
    case Left(why) => (why, why.startsWith("**"))
    case Right((image, right)) =>
      val verdict = Verdict.of(scene, image, right)
      (s"${verdict.words} (${verdict.figures})", !verdict.isRight)

  private val expected = scene.expected match
    case Expected.Value(x) => Verdict.digits(x, 5)
    case Expected.Like(_) => "as on a small plane"

  val line: String = (s"`${scene.name}`" +: expected +: cells.map(_._1)).mkString("| ", " | ", " |")

  /** The line of a table, anew if it is this scene's. */
  def inPlaceOf(old: String): String = if old.startsWith(s"| `${scene.name}` |") then line else old

  /** Is anything wrong with one of them? */
  val hasPicture: Boolean = cells.exists(_._2)

  def writePicture(): Unit =
    if hasPicture then
      val strip = Strip(outcomes.map(_.toOption), scene)
      ImageFiles.write(HardScenes.Folder.resolve(s"${scene.name}.png"), strip.image)

package candela.render

import java.nio.file.Files

import scala.sys.process.*

/** Renews `reference-images/digests.csv`:
  * {{{
  * ./sbt "Test/runMain candela.render.RenewDigests"
  * }}}
  * A scene whose digest has changed gets the new one once its images agree with the reference, as
  * [[Agreement]] says. Scenes that disagree keep their row, and the command fails. The rows that
  * are written name the commit that is checked out, with a `+` where files differ from it.
  */
object RenewDigests:
  def main(args: Array[String]): Unit =
    val old = ImageDigests.rows.map(row => row.scene -> row).toMap
    val (rows, wrong) =
      ReferenceScenes.compared.map(renewed(_, old)).partitionMap:
        case (row, isRight) => if isRight then Left(row) else Right(row)
    val lines = (rows ++ wrong).flatten.sortBy(_.scene).map(_.line)
    val _ = Files.writeString(
      ImageDigests.File,
      (ImageDigests.Row.Header +: lines).mkString("", "\n", "\n")
    )
    println(s"${ImageDigests.File}: ${rows.size} scenes agree, ${wrong.size} do not")
    if wrong.nonEmpty then throw IllegalStateException("some scenes disagree with their references")

  /** The row to write, if there is one, and whether the scene is right. */
  private def renewed(
      scene: ReferenceScene,
      old: Map[String, ImageDigests.Row]
  ): (Option[ImageDigests.Row], Boolean) =
    val digest = ImageDigests.of(scene)
    val row = old.get(scene.title)
    if row.exists(_.digest == digest) then (row, true)
    else
      val agreement = ReferenceComparison(scene, scene.text)
      val disagreements = agreement.disagreements(ReferenceComparison.Significance)
      println(s"${scene.title}: ${disagreements.headOption.fold("agrees")(_.what)}")
      if disagreements.isEmpty then (Some(ImageDigests.Row(scene.title, digest, commit)), true)
      else (row, false)

  private lazy val commit: String =
    val head = Seq("git", "rev-parse", "--short=12", "HEAD").!!.trim
    val changes = Seq("git", "status", "--porcelain", "--untracked-files=no").!!.trim
    if changes.isEmpty then head else s"$head+"

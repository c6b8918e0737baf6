package candela.robustness

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path

import candela.base.WholeFile
import candela.build.{RenderSettings, SceneBuilder}
import candela.convert.{Converter, SceneText}
import candela.image.{Image, ImageError, ImageFiles}
import candela.render.{Cancellation, Renderer}
import candela.report.RobustProgram
import candela.scenefile.{Dialect, Parser, SceneDescription}
import candela.suite.{Commands, Outcome}

/** What a program renders: a scene of [[PeerScene]], or one in pbrt-v3's words alone. */
final case class PeerInput(v3: String, mitsuba: Option[(String, Map[String, String])])

object PeerInput:
  def of(s: PeerScene): PeerInput = PeerInput(PeerText.v3(s), Some(PeerXml.of(s)))

/** A program that renders the scenes. */
trait Painter:
  def program: RobustProgram

  /** Left: why there is no picture; a failure if it should have rendered it. */
  def paint(scene: PeerInput): Either[Painter.Refusal, Image]

object Painter:
  final case class Refusal(why: String, isFailure: Boolean)

  /** Seconds that a program has for a scene of this command. */
  private[robustness] final val Timeout = 120.0

  private[robustness] def parsed(scene: PeerInput): SceneDescription =
    Parser.parseText("scene.pbrt", scene.v3, Path.of(""), Some(Dialect.V3))

/** Candela itself. */
final class OwnPainter(threads: Int, cancellation: Cancellation) extends Painter:
  val program: RobustProgram = RobustProgram("candela", "Candela", isOurs = true)

  def paint(scene: PeerInput): Either[Painter.Refusal, Image] =
    val (plan, _) = SceneBuilder.build(Painter.parsed(scene), RenderSettings())
    Right(Renderer.render(plan, threads, cancellation).image(plan.development).toRgb)

/** Another program.
  *
  * @param folder   for scenes and images
  * @param language that it reads
  * @param words    its command line, from scene and image
  */
final class OtherPainter(
    val program: RobustProgram,
    folder: Path,
    commands: Commands,
    language: OtherPainter.Language,
    words: (Path, Path) => Vector[String]
) extends Painter:
  import OtherPainter.Language

  def paint(scene: PeerInput): Either[Painter.Refusal, Image] =
    written(scene) match
      case None => Left(Painter.Refusal("has no such scene", isFailure = false))
      case Some(file) =>
        val out = folder.resolve(s"${program.key}.exr")
        def failed(why: String) = Left(Painter.Refusal(why, isFailure = true))
        commands.run(words(file, out), out, Painter.Timeout) match
          case Outcome.Done(_, _) =>
            try Right(ImageFiles.read(out).toRgb)
            catch case e: ImageError => failed(e.getMessage)
          case Outcome.Failed(why) => failed(why.takeWhile(_ != ':'))
          case Outcome.Cancelled => Left(Painter.Refusal("cancelled", isFailure = false))

  private def written(scene: PeerInput): Option[Path] = language match
    case Language.V3 => Some(write("scene-v3.pbrt", scene.v3))
    case Language.V4 =>
      val text = java.io.StringWriter()
      SceneText.write(Converter.convert(Painter.parsed(scene), Dialect.V4, folder).scene, text)
      Some(write("scene-v4.pbrt", text.toString))
    case Language.Mitsuba =>
      scene.mitsuba.map: (text, files) =>
        for (name, content) <- files do write(name, content): Unit
        write("scene.xml", text)

  private def write(name: String, text: String): Path =
    val file = folder.resolve(name)
    WholeFile.write(file, text.getBytes(UTF_8))
    file

object OtherPainter:
  enum Language:
    case V3, V4, Mitsuba

  /** Those whose commands the environment has, by the names that suites use; and those that it has
    * not, with the reason.
    */
  def found(
      folder: Path,
      commands: Commands,
      threads: Int,
      env: Map[String, String]
  ): (Vector[Painter], Vector[(String, String)]) =
    val all = Vector[(String, String, Language, (Vector[String], Path, Path) => Vector[String])](
      (
        "pbrt-v3",
        "PBRT_V3",
        Language.V3,
        (c, s, o) =>
          c ++ Vector("--quiet", s"--nthreads=$threads", s"--outfile=$o", s"$s")
      ),
      (
        "pbrt-v4",
        "PBRT_V4",
        Language.V4,
        (c, s, o) =>
          c ++ Vector("--quiet", "--nthreads", s"$threads", "--outfile", s"$o", s"$s")
      ),
      // With one thread more than processors: with as many or fewer, 3.9.1 hangs when it writes
      (
        "Mitsuba 3",
        "MITSUBA",
        Language.Mitsuba,
        (c, s, o) =>
          c ++ Vector("-m", "scalar_rgb", "-t", s"${threads + 1}", "-o", s"$o", s"$s")
      )
    )
    val sorted = all.map: (title, variable, language, words) =>
      env.get(variable).map(_.trim.split("\\s+").toVector).filter(_.head.nonEmpty) match
        case None => Left(title -> Commands.notSet(Vector(variable)))
        case Some(command) if !Commands.isExecutable(command.head) =>
          Left(title -> s"`${command.head}` ($variable) is not installed")
        case Some(command) =>
          val key = title.toLowerCase.replace(' ', '-')
          val program = RobustProgram(key, title, isOurs = false)
          Right(OtherPainter(program, folder, commands, language, words(command, _, _)))
    (sorted.collect { case Right(p) => p }, sorted.collect { case Left(why) => why })

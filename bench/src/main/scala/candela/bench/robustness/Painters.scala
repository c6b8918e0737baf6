package candela.bench.robustness

import candela.io.WholeFile
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path
import java.util.Locale

import candela.bench.report.RobustProgram
import candela.bench.suite.{Absent, Commands, Installed, Outcome, Present}
import candela.build.SceneBuilder
import candela.convert.{Converter, SceneText}
import candela.image.{Image, ImageError, ImageFiles}
import candela.render.{RenderControl, Cancellation, Renderer}
import candela.scenefile.{Dialect, Parser, SceneDescription}
import candela.settings.RenderSettings

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
    Right(Renderer.render(plan, RenderControl(threads, cancellation)).image(plan.development).toRgb)

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

  /** Those that are installed, and those that are not, with the reason. */
  def detect(
      folder: Path,
      commands: Commands,
      threads: Int,
      installed: Installed
  ): (Vector[Painter], Vector[(String, String)]) =
    def painter(title: String, language: Language, program: Either[Absent, Present])(
        options: (Path, Path) => Vector[String]
    ): Either[(String, String), Painter] = program match
      case Left(absent) => Left(title -> absent.obtain)
      case Right(present) if !Commands.isExecutable(present.words.head) =>
        val named = present.variable.fold("")(v => s" ($v)")
        Left(title -> s"`${present.words.head}`$named is not installed")
      case Right(present) =>
        val key = title.toLowerCase(Locale.ROOT).replace(' ', '-')
        val words = (scene: Path, out: Path) => present.words ++ options(scene, out)
        val robustProgram = RobustProgram(key, title, isOurs = false)
        Right(OtherPainter(robustProgram, folder, commands, language, words))
    val all = Vector(
      painter("pbrt-v3", Language.V3, installed.pbrt(3)): (scene, out) =>
        Vector("--quiet", s"--nthreads=$threads", s"--outfile=$out", s"$scene"),
      painter("pbrt-v4", Language.V4, installed.pbrt(4)): (scene, out) =>
        Vector("--quiet", "--nthreads", s"$threads", "--outfile", s"$out", s"$scene"),
      painter("Mitsuba 3", Language.Mitsuba, installed.mitsuba): (scene, out) =>
        val count = s"${Installed.mitsubaThreads(threads)}"
        Vector("-m", "scalar_rgb", "-t", count, "-o", s"$out", s"$scene")
    )
    (all.collect { case Right(p) => p }, all.collect { case Left(why) => why })

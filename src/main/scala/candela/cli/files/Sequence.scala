package candela.cli.files

import candela.base.Figures
import candela.diagnostics.{Code, Problem, SceneError}
import candela.cli.options.{FilmOptions, FrameNames, Options}
import candela.cli.terminal.ExitCode
import candela.image.{ImageFiles, OutputFormat}
import candela.job.SceneFormat
import candela.settings.{ReadSettings, Sensors}

import java.nio.file.Path

/** A scene of a sequence, the output files asked for, and its options. */
private[cli] final case class Frame(
    scene: String,
    outfiles: Vector[String],
    options: Options,
    number: Option[Int] = None
):
  /** Its scene, and its number if that is not in the name of the scene. */
  def label: String = number.fold(scene)(n => s"$scene frame $n")

/** The scenes of a command line, and what became of them. */
private[cli] final class Sequence(options: Options):
  private var worst = ExitCode.Done
  private var skipped, succeeded = 0
  private var failed = Vector.empty[String]

  val frames: Vector[Frame] = options.film.frames match
    case None => options.files.map(Frame(_, options.outfiles, options))
    case Some(numbers) =>
      numbers.toVector.map: n =>
        Frame(
          FrameNames.numbered(options.files.head, n),
          options.outfiles.map(FrameNames.numbered(_, n)),
          options.defining(_.view.mapValues(FrameNames.numbered(_, n)).toMap),
          Option.unless(FrameNames.hasNumber(options.files.head))(n)
        )

  def code: ExitCode = worst

  /** Notes that a scene, which ends next, is done already. */
  def skip(): Unit = skipped += 1

  /** @param label of the frame */
  def ended(label: String)(render: => ExitCode): Unit =
    val code = render
    worst = worst.worseOf(code)
    if code != ExitCode.Done then failed :+= label else succeeded += 1

  /** `4 scenes: 2 rendered, 1 skipped (done already), 1 failed: b.pbrt`; of several scenes only. */
  def summary: Option[String] =
    Option.when(frames.size > 1 || skipped > 0):
      def counted(count: Int, what: String) = Option.when(count > 0)(s"$count $what")
      val unnamed = failed.size - Sequence.MaxNamedScenes
      val names =
        failed.take(Sequence.MaxNamedScenes) ++ Option.when(unnamed > 0)(s"… and $unnamed more")
      val missing = frames.size - failed.size - succeeded
      val counts =
        counted(succeeded - skipped, "rendered") ++ counted(skipped, "skipped (done already)") ++
          counted(failed.size, names.mkString("failed (", ", ", ")")) ++
          counted(missing, "not begun")
      s"${Figures.count(frames.size, "scene")}: ${counts.mkString(", ")}"

private[cli] object Sequence:
  /** Failed scenes in the summary. */
  private val MaxNamedScenes = 20

  /** Name of the metadata that identify a complete rendering. */
  val Digest = "rendering"

  /** The output files of a world, or a sensor, of a scene; its number is in their names if there
    * are several, and in the place of `%d` if an option chooses among several.
    *
    * @param n          index of the world
    * @param isFollowed whether another follows
    * @throws SceneError if the worlds would have the same files
    */
  def ofWorld(
      scene: String,
      outfiles: Vector[String],
      reading: ReadSettings,
      n: Int,
      isFollowed: Boolean
  ): Vector[String] =
    val chosen = first(reading)
    if n == 0 && !isFollowed then
      chosen.fold(outfiles)(number => outfiles.map(FrameNames.numbered(_, number)))
    else
      val format = SceneFormat.of(OutputFiles.path(scene))
      val several = s"`$scene` has several ${format.worlds}"
      for name <- outfiles
      yield
        if FilmOptions.isFilm(name) then
          throw SceneError(Problem.general(
            Code.FrameNames,
            s"$several; a .film file holds one"
          ))
        else if !FrameNames.hasNumber(name) then
          val clause = if format.worlds == "images" then "" else ", each an image"
          val message = s"$several$clause; `$name` names one"
          throw SceneError(Problem.general(
            Code.FrameNames,
            message,
            Some("write %d, or %04d, for the number")
          ))
        else FrameNames.numbered(name, n + chosen.getOrElse(format.firstWorld))

  /** The number of the first image that options ask for, if they choose among several. */
  private def first(reading: ReadSettings): Option[Int] = reading.sensors match
    case Some(Sensors.One(index)) if !reading.model.hasSeveralImages => Some(index)
    case sensors =>
      Option.when(
        sensors.nonEmpty || reading.model.turntable.nonEmpty || reading.model.state.times.nonEmpty
      )(0)

  /** Whether all images are whole, and of the rendering with this digest. Those that can't hold it
    * are written before those that can.
    */
  def isDone(images: Vector[Path], digest: String): Boolean =
    images.exists(keepsDigest) && images.forall(ImageFiles.isWhole(_, digest))

  def keepsDigest(image: Path): Boolean = OutputFormat.of(image).exists(_.keepsTexts)

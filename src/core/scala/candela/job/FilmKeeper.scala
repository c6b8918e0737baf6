package candela.job

import candela.base.Version
import candela.diagnostics.{Code, Problem, SceneError, Severity}
import candela.io.{SceneFolder, WholeFile}
import candela.render.RenderPlan
import candela.measure.Interval
import candela.render.storage.{Checkpoints, FilmError, FilmFile, FilmHeader, FilmLock, FilmWriter}

import java.io.IOException
import java.nio.file.{Files, Path}

/** The film file of one rendering, which no other rendering can write until it is closed.
  *
  * @param header of the rendering; its number of samples done is not used
  * @param start  the saved rendering to continue, if any
  * @param how    it is written
  */
final class FilmKeeper private (
    val path: Path,
    header: FilmHeader,
    val start: Option[FilmFile],
    lock: Option[FilmLock],
    how: FilmKeeper.How
) extends AutoCloseable:
  def close(): Unit = lock.foreach(_.close())

  /** Whether all planned samples are taken. */
  def isDone: Boolean = start.exists(f => f.header.isComplete && f.header.samples == header.samples)

  /** Samples that every pixel has already. */
  def samplesDone: Int = start.fold(0)(_.header.done)

  /** @param error relative MSE of the image with so many samples per pixel, if it is known */
  def checkpointer(error: Int => Option[Interval] = _ => None): Checkpoints =
    def of(done: Int) =
      val noise = error(done).orElse(savedError(done))
      header.copy(
        done = done,
        // A film without images may be one of several parts: their sum has no error
        error = noise.filter(_ => header.outfiles.nonEmpty || how.savesError)
          .map(i => FilmError(i.estimate, i.low, i.high))
      )
    // A damaged file must not replace its previous copy.
    val writer = FilmWriter(path, isGood = start.forall(_.damage.isEmpty))
    Checkpoints(writer, of, start, how.every, why => how.warn(FilmKeeper.unwritable(path, why)))

  /** The relative MSE of the saved image, if it has so many samples per pixel. */
  def savedError(samples: Int): Option[Interval] =
    start.map(_.header).filter(_.done == samples).flatMap(_.error)
      .map(e => Interval(e.estimate, e.low, e.high))

object FilmKeeper:

  /** @param every seconds between two copies; none: as often as is worth it
    * @param warn  receives what can't be read or written
    * @param savesError whether the error of a film without images is saved, too
    */
  final case class How(every: Option[Double], warn: Problem => Unit, savesError: Boolean = false)

  /** A new film file, or the saved rendering of an existing one.
    *
    * @param lock takes the file, for this rendering alone
    * @throws SceneError if the file is of another rendering
    */
  def of(path: Path, now: FilmHeader, how: How)(lock: => FilmLock): FilmKeeper =
    val heldLock = lock
    try
      val start = existing(path, now, how.warn)
      FilmKeeper(path, now, start, Some(heldLock), how)
    catch
      case e: Throwable =>
        heldLock.close()
        throw e

  /** The film of a saved rendering that goes on, and whose file is locked already.
    *
    * @throws SceneError if it can't
    */
  def resumed(film: FilmFile, now: FilmHeader, plan: RenderPlan, how: How): FilmKeeper =
    val next = continued(film, now, plan.samplesPerPixel, film.header.obstacle(plan))
    FilmKeeper(film.path, next, Some(film), None, how)

  /** @throws SceneError if another rendering writes this film file, or none can */
  def locked(path: Path): FilmLock =
    def refuse(reason: String) =
      fail(Code.Unwritable, s"can't write `$path`: $reason", "choose another file")
    if Files.isDirectory(path) then refuse("it is a folder")
    if WholeFile.isPipe(path) then refuse("it is a pipe")
    val lock =
      try FilmLock.acquire(path)
      catch case e: IOException => refuse(WholeFile.reason(e))
    lock.getOrElse:
      fail(
        Code.FilmInUse,
        s"`$path` is being written by another rendering",
        "wait for it, or stop it"
      )

  /** Opens a film file; warns if its previous copy has to be used.
    *
    * @throws SceneError if it can't be read, or is another version's
    */
  def open(path: Path, warn: Problem => Unit): FilmFile =
    val film =
      try FilmFile.open(path)
      catch
        case e: IOException =>
          if Files.exists(path) then fail(Code.DamagedFilm, e.getMessage)
          fail(Code.NoSuchFile, e.getMessage, SceneFolder.suggestionFor(path).getOrElse(""))
    for damage <- film.damage do
      val message = s"can't read `$path`: $damage; using its previous copy, " +
        s"`${FilmFile.previous(film.path).getFileName}`"
      warn(Problem.general(Code.DamagedFilm, message).copy(severity = Severity.Warning))
    val version = film.header.version
    if version != Version.build then
      fail(
        Code.OtherRendering,
        s"`$path` was written by Candela $version; this is ${Version.build}"
      )
    film

  /** @throws SceneError if the scene is no longer what was rendered */
  def verify(film: FilmFile, now: FilmHeader): Unit =
    // The samples per pixel may change.
    for difference <- film.header.difference(now.copy(samples = film.header.samples)) do
      val message = s"the scene of `${film.path}` has changed: $difference"
      fail(Code.OtherRendering, message, "render it again; or restore what has changed")

  def fail(code: Code, message: String, help: String = ""): Nothing =
    throw SceneError(Problem.general(code, message, Option.when(help.nonEmpty)(help)))

  def unwritable(path: Path, why: String): Problem =
    Problem(Code.Unwritable, Severity.Warning, None, s"can't write the film file `$path`: $why")

  /** The rendering that continues a saved one. */
  private def continued(
      film: FilmFile,
      now: FilmHeader,
      samples: Int,
      obstacle: Option[String]
  ): FilmHeader =
    verify(film, now.copy(count = film.header.count))
    val header = film.header
    if now.samples != header.samples then
      for why <- obstacle do
        fail(
          Code.NothingToAdd,
          s"can't change the ${header.samples} samples per pixel of `${film.path}`: $why",
          "resume with --error or --time, or render with --spp N --checkpoint, " +
            "N being the most you may want"
        )
    if samples < header.done then
      fail(Code.NothingToAdd, s"`${film.path}` has ${header.done} samples per pixel already")
    header.copy(samples = now.samples)

  /** The saved rendering at `path`, if there is one. */
  private def existing(path: Path, now: FilmHeader, warn: Problem => Unit): Option[FilmFile] =
    Option.when(Files.isRegularFile(path) || Files.exists(FilmFile.previous(path))):
      val film =
        try open(path, warn)
        catch case e: SceneError => fail(Code.OtherRendering, e.problems.head.message, Remove)
      for difference <- now.difference(film.header) do
        val isLonger = now.copy(samples = film.header.samples).difference(film.header).isEmpty &&
          now.samples > film.header.samples
        val resuming = s"`candela resume $path --spp ${now.samples}` adds samples, " +
          "unless its sampler's points depend on their number; or "
        val hasOtherOptions =
          now.copy(words = film.header.words).difference(film.header).isEmpty
        val help =
          if FilmHeaders.isMadeInCode(film.header) then s"its own settings continue it; or $Remove"
          else if isLonger then resuming + Remove
          else if hasOtherOptions then
            s"its own options continue it, as `candela resume $path` does, also to a goal; or " +
              Remove
          else Remove
        fail(Code.OtherRendering, s"`$path` belongs to another rendering: $difference", help)
      if film.header.shards != now.shards then
        fail(Code.OtherRendering, s"`$path` belongs to another shard: ${film.header.label}", Remove)
      film

  private val Remove = "remove it, or name another file"

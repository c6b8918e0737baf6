package candela.job

import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.Sha256
import candela.image.{ImageError, ImageFiles}
import candela.measure.ReferenceMean
import candela.render.Rendering
import candela.settings.{PointChoice, RenderGoal, RenderSettings}

import java.nio.file.{Files, Path}
import java.util.Locale

/** The file of a reference: the mean of independent runs, with what tells which runs they are.
  *
  * @param of       settings of the command
  * @param perRun   samples per pixel of each
  */
final class ReferenceFile(path: Path, of: RenderSettings, scene: String, perRun: Int):
  import ReferenceFile.*

  /** Settings of a run: independent of renderings that users make, whose seeds are small. It ends
    * by its samples, and learns nothing.
    */
  def settings(run: Int): RenderSettings =
    of.copy(
      seed = FirstSeed + of.seed * SeedStep + run,
      goal = RenderGoal(),
      points = of.points.orElse(Some(PointChoice.Progressive))
    )

  /** The reference so far, if the file is there.
    *
    * @throws SceneError if it holds something else
    */
  def start(prepared: Prepared): Option[ReferenceMean] =
    Option.when(Files.exists(path)):
      def mismatch(what: String) =
        val help = "name another file with --outfile, or remove it"
        SceneError(Problem.general(Code.OtherRendering, s"`$path` $what", Some(help)))
      val (stored, facts) =
        try (ImageFiles.read(path), ImageFiles.facts(path).toMap)
        catch case e: ImageError => throw SceneError(Problem.general(e.code, e.getMessage))
      val runs = facts.get(Runs).flatMap(_.toIntOption)
      val mean = runs.flatMap(ReferenceMean.of(stored, _))
      val existing =
        mean.getOrElse(throw mismatch("is an image, not a reference that can be continued"))
      if !facts.get(Identity).contains(identity(prepared)) then
        throw mismatch("is a reference of another scene, other options or another version")
      existing

  /** Writes the file, whole or not at all.
    *
    * @param last the last run
    */
  def write(mean: ReferenceMean, prepared: Prepared, last: Rendering): Unit =
    val errorFact =
      mean.relativeError.map("relativeError" -> "%.6g".formatLocal(Locale.ROOT, _))
    val seeds = s"${settings(0).seed} to ${settings(mean.runs - 1).seed}"
    val about = Vector(
      Runs -> mean.runs.toString,
      "samplesPerRun" -> perRun.toString,
      "seeds" -> seeds,
      Correlation -> correlation(prepared).toString,
      Identity -> identity(prepared)
    ) ++ errorFact
    val combined = last.copy(samplesDone = mean.runs * perRun)
    ImageFile(settings(0), scene, prepared).writeReference(path, mean.stored, combined, about)

  /** Pixels that share samples are alike. */
  private def correlation(prepared: Prepared): Double =
    if prepared.plan.sharesSamples then prepared.plan.filter.correlation else 1.0

  private def identity(prepared: Prepared): String =
    val header = FilmHeaders.of(settings(0), scene, prepared, path)
    Sha256.of(s"${FilmHeaders.digest(header, RenderGoal())}, $perRun")

object ReferenceFile:
  /** Samples per pixel of a run, unless the user says otherwise. */
  val UsualSamples = 64

  /** Fewer runs tell little about their variance. */
  val MinRuns = 8

  // Names of what the file says of itself
  val Runs = "runs"
  val Correlation = "pixelCorrelation"
  private val Identity = "reference"

  private val FirstSeed = 1_000_000_000
  private val SeedStep = 1_000_003

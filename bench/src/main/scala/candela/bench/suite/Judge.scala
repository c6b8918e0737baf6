package candela.bench.suite

import candela.bench.statistics.{ErrorParts, Measurement, SeedNoise}
import candela.image.{Image, ImageFiles}
import candela.measure.{Errors, ImagePair}

import java.nio.file.Path

/** Finds the errors of a scene's images. */
private[suite] abstract class Judge:

  /** Takes an image; returns its error in words, if it is known already. An image of the same
    * program, step and seed is replaced.
    *
    * @throws candela.image.ImageError if it cannot be compared
    */
  def take(job: Job, seconds: Double, memory: Option[Long], image: Image): String

  /** Forgets all images of these programs. */
  def drop(entries: Set[Entry]): Unit

  /** All that was measured so far, in the order of rendering. */
  def results: Vector[Result]

  /** What the images are compared with; there are results. */
  def reference: Image

  /** The programs of whose images the reference is the mean; none if it was given. */
  def voters: Vector[Program] = Vector.empty

  protected final def result(
      job: Job,
      seconds: Double,
      memory: Option[Long],
      errors: Errors,
      parts: Option[ErrorParts]
  ): Result =
    Result(job, Measurement(job.samples, job.seed, seconds, errors, memory, parts))

  /** Errors of scenes that grow are not shown, and the spectra of large films take minutes. */
  protected final def hasParts(job: Job): Boolean = job.entry.scene.growth.isEmpty

/** Compares with a reference. */
private[suite] final class ReferenceJudge(truth: Image) extends Judge:
  val reference: Image = truth.toRgb
  private var all = Vector.empty[Result]

  def take(job: Job, seconds: Double, memory: Option[Long], image: Image): String =
    val errors = Errors.against(truth)(image)
    if job.step != Job.WarmUp then
      // They would include the reference's own error
      val parts = Option.when(hasParts(job) && errors.own.isEmpty):
        ErrorParts.against(ImagePair(image, reference))
      all = all.filterNot(_.job.isInPlaceOf(job)) :+ result(job, seconds, memory, errors, parts)
    f"relative MSE ${errors.relativeMse}%.3g"

  def drop(entries: Set[Entry]): Unit = all = all.filterNot(r => entries(r.job.entry))

  def results: Vector[Result] = all

/** Compares the images of several seeds with each other. Each waits in a file for the last seed.
  *
  * @param suite decides which programs make the reference
  */
private[suite] final class SeedJudge(suite: Suite, scratch: Path) extends Judge:
  private final case class Kept(job: Job, seconds: Double, memory: Option[Long], file: Path):
    def image: Image = ImageFiles.read(file).toRgb

  private var storedImages = Vector.empty[Kept]
  private var files = 0

  /** All images must have its size. */
  private var first: Option[Image] = None
  private var pooled: Option[Image] = None

  def take(job: Job, seconds: Double, memory: Option[Long], image: Image): String =
    first = Some(ImagePair(image, first.getOrElse(image)).reference)
    if job.step != Job.WarmUp then
      val file = scratch.resolve(s"${job.entry.scene.name}-$files.exr")
      files += 1
      ImageFiles.write(file, image)
      storedImages =
        storedImages.filterNot(_.job.isInPlaceOf(job)) :+ Kept(job, seconds, memory, file)
      pooled = None
    "error known after all seeds"

  def drop(entries: Set[Entry]): Unit =
    storedImages = storedImages.filterNot(k => entries(k.job.entry))
    pooled = None

  /** Of the sample counts that have been rendered with enough seeds. */
  private def sets: Vector[Vector[Kept]] =
    val all = storedImages.groupBy(k => (k.job.entry, k.job.step)).values
    all.filter(_.sizeIs >= SeedNoise.Fewest).toVector

  def results: Vector[Result] =
    // Without a point of a curve, the mean is unknown
    if !sets.exists(_.head.job.isPoint) then Vector.empty
    else
      val scale = reference
      val errors = sets.flatMap: set =>
        val images = set.map(_.image)
        val parts =
          if hasParts(set.head.job) then SeedNoise.parts(images, scale).map(Some(_))
          else images.map(_ => None)
        set.map(_.job).zip(SeedNoise.of(images, scale).zip(parts))
      val byJob = errors.toMap
      storedImages.flatMap: k =>
        byJob.get(k.job).map((e, parts) => result(k.job, k.seconds, k.memory, e, parts))

  /** The mean of the longest renderings of one program of each family, all alike: more variants of
    * a program must not make it more right.
    */
  def reference: Image = pooled.getOrElse:
    val image = pool
    pooled = Some(image)
    image

  override def voters: Vector[Program] = suite.voters(longest.contains)

  private def longest: Map[Program, Vector[Kept]] =
    val points = sets.filter(_.head.job.isPoint)
    points.groupBy(_.head.job.entry.program).map: (program, all) =>
      program -> all.maxBy(_.head.job.samples)

  private def pool: Image =
    val all = longest
    SeedNoise.mean(voters.map(program => SeedNoise.mean(all(program).map(_.image))))

package candela.render.storage

import candela.io.{CheckedInput, CheckedOutput}
import candela.render.{RenderPlan, RenderState}

/** Identifies a saved rendering.
  *
  * @param version  of the program
  * @param scene    the scene file, as it was named
  * @param folder   the folder that file names are relative to: itself relative to the film file
  * @param words    settings that shape the image, without the samples per pixel: what
  *                 `settings.SettingsCodec` makes of them
  * @param outfiles image files to write; none if it is a part of an image
  * @param files    SHA-256 of each file of the scene, by name
  * @param size     of the image, and which part of it
  * @param samples  planned samples per pixel
  * @param done     samples that every pixel has, of those of the shards
  * @param footprint size of a sample's footprint, in pixels; 0: not used
  * @param shards   numbers of the parts, of `count`
  * @param error    of the image so far, if it is known
  * @param text     of the scene, if it is no file
  */
final case class FilmHeader(
    version: String,
    scene: String,
    folder: String,
    words: Vector[String],
    outfiles: Vector[String],
    files: Vector[(String, String)],
    size: String,
    samples: Int,
    done: Int,
    footprint: Float,
    shards: Set[Int],
    count: Int,
    error: Option[FilmError] = None,
    text: Option[String] = None
):
  def isWhole: Boolean = shards.size == count
  def isComplete: Boolean = done >= samples

  /** That of the merger of films of this rendering: it is as far as the least of them. */
  def merging(parts: Seq[FilmHeader]): FilmHeader =
    copy(
      shards = parts.flatMap(_.shards).toSet,
      count = parts.headOption.fold(count)(_.count),
      done = parts.map(_.done).minOption.getOrElse(0),
      error = None
    )

  /** A merger of all shards is a film of the whole if each is complete: then `resume` may go on.
    * Otherwise it stays a merger, whose state does not tell how far each shard is.
    */
  def joined: FilmHeader =
    if isWhole && isComplete then copy(shards = Set(0), count = 1) else this

  /** That of a part of it. */
  def of(shards: Set[Int], count: Int, state: RenderState): FilmHeader =
    copy(shards = shards, count = count, done = state.samplesDone)

  /** `shard 3/16`, or all of several. */
  def label: String = FilmHeader.named(FilmHeader.runs(shards.toVector.sorted), count)

  /** The first difference between this rendering and another, in words; the part and the number of
    * samples done may differ.
    */
  def difference(other: FilmHeader): Option[String] =
    def quoted(words: Vector[String]) =
      if words.isEmpty then "none" else words.mkString("`", " ", "`")
    def differ(what: String, mine: Any, others: Any) =
      Option.when(mine != others)(s"$what $others instead of $mine")
    val changed = files.toMap.keySet ++ other.files.toMap.keySet
    val file = changed.toVector.sorted.find(f => files.toMap.get(f) != other.files.toMap.get(f))
    differ("version", version, other.version)
      .orElse(file.map(f => s"`$f` differs"))
      .orElse(differ("options", quoted(words), quoted(other.words)))
      .orElse(differ("size", size, other.size))
      .orElse(differ("samples per pixel", samples, other.samples))
      .orElse(differ("number of shards", count, other.count))

  /** Why no samples can be added, beyond the planned ones: the image would not be that of so many
    * samples at once.
    *
    * @param plan with more samples
    */
  def obstacle(plan: RenderPlan): Option[String] =
    if !plan.method.takesCameraSamples then
      Some("Metropolis light transport distributes its mutations in advance")
    else if plan.method.guide.isDefined && !plan.method.canKeepOn then
      Some("what its paths learn depends on their number; with --guiding auto --sampler " +
        "progressive it doesn't")
    else if !plan.sampler.isProgressive then
      Some("its sampler's points depend on their number (those of --sampler progressive don't)")
    else if plan.differentialScale != footprint then
      Some("its textures, or its layers of gradients, depend on the number of samples")
    else None

  private[storage] def save(to: CheckedOutput): Unit =
    Vector(version, scene, folder, size).foreach(to.text)
    for list <- Vector(words, outfiles, files.flatMap((f, digest) => Vector(f, digest))) do
      to.int(list.size)
      list.foreach(to.text)
    to.int(samples)
    to.int(done)
    to.float(footprint)
    to.int(count)
    to.int(shards.size)
    shards.toVector.sorted.foreach(to.int)
    to.text(error.fold("")(_.words))
    to.text(text.getOrElse(""))

/** The estimated relative MSE of an image, with its 95 % interval; limits that are NaN are unknown.
  */
final case class FilmError(estimate: Double, low: Double, high: Double):
  private[storage] def words: String = s"$estimate $low $high"

object FilmError:
  private[storage] def of(words: String): FilmError =
    val numbers = words.split(' ').flatMap(_.toDoubleOption)
    require(numbers.length == 3, s"its error is `$words`")
    FilmError(numbers(0), numbers(1), numbers(2))

object FilmHeader:
  /** Samples per pixel of films of one rendering, averaged over all shards: missing ones have none.
    */
  def averageDone(parts: Seq[FilmHeader]): Int =
    val total = parts.map(p => p.done.toLong * p.shards.size).sum
    parts.headOption.fold(0)(p => (total / p.count).toInt)

  /** Runs of numbers that follow each other: the first and last of each. */
  private def runs(sorted: Vector[Int]): Vector[(Int, Int)] =
    sorted.foldLeft(Vector.empty[(Int, Int)]):
      case (done :+ ((first, last)), n) if n == last + 1 => done :+ (first, n)
      case (done, n) => done :+ (n, n)

  /** The runs of numbers below `count` that are not in `shards`. */
  def missing(shards: Set[Int], count: Int): Vector[(Int, Int)] =
    val ends = -1 +: shards.toVector.sorted :+ count
    ends.zip(ends.tail).collect { case (a, b) if b > a + 1 => (a + 1, b - 1) }

  /** `3/16, 5/16 to 9/16`; of many runs the first ones. */
  def named(runs: Vector[(Int, Int)], count: Int): String =
    val listed = runs.take(MaxNamedRuns).map: (first, last) =>
      if first == last then s"$first/$count"
      else if last == first + 1 then s"$first/$count, $last/$count"
      else s"$first/$count to $last/$count"
    val omitted = runs.drop(MaxNamedRuns).map((first, last) => last.toLong - first + 1).sum
    listed.mkString(", ") + (if omitted > 0 then s" and $omitted more" else "")

  private val MaxNamedRuns = 10

  private[storage] def load(from: CheckedInput): FilmHeader =
    def texts() = Vector.fill(from.count(bytes = 4))(from.text())
    val Vector(version, scene, folder, size) = Vector.fill(4)(from.text()): @unchecked
    val (words, outfiles, files) = (texts(), texts(), texts())
    val (samples, done, footprint, count) = (from.int(), from.int(), from.float(), from.int())
    val shards = Vector.fill(from.count(bytes = 4))(from.int()).toSet
    val error = Some(from.text()).filter(_.nonEmpty).map(FilmError.of)
    val text = Some(from.text()).filter(_.nonEmpty)
    val digests = files.grouped(2).map(pair => (pair(0), pair(1))).toVector
    require(samples > 0 && done >= 0, s"it has $done of $samples samples per pixel")
    require(
      count > 0 && shards.nonEmpty && shards.forall(i => i >= 0 && i < count),
      s"it has ${shards.size} shards of $count"
    )
    FilmHeader(
      version, scene, folder, words, outfiles, digests, size, samples, done, footprint, shards,
      count, error, text
    )

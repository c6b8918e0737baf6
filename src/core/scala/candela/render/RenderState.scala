package candela.render

import candela.io.{CheckedInput, CheckedOutput}
import java.io.IOException

import scala.jdk.CollectionConverters.*

/** All that a rendering has computed: which samples, and their sums. A rendering that continues
  * from a saved state ends with the same image, bit for bit, as one that was not interrupted.
  */
final class RenderState private[render] (job: Job, queue: TaskQueue, workers: Vector[Worker]):
  private var earlier = Vector.empty[DiscardedSamples]

  /** Samples that every pixel has at least, of those of its shard. */
  def samplesDone: Int = job.schedule.samplesDone(queue.progress).min

  /** Samples that some pixel has. */
  private[render] def maxSamplesDone: Int = job.schedule.samplesDone(queue.progress).max

  /** Whether some pixel can have so many samples. */
  private[render] def hasReached(samples: Int): Boolean = (0 until job.schedule.pieces).exists(i =>
    job.schedule.hasReached(i, queue.progress.get(i), samples)
  )

  private[render] def discarded: Option[DiscardedSamples] =
    DiscardedSamples.of(earlier ++ workers.flatMap(_.discarded))

  /** Completes the film of a rendering that ends and is not continued from here. */
  private[render] def settle(): Unit =
    for all <- job.chains do
      queue.begun.forEach((chain, begun) => all.settle(chain, begun.sums(0).toFloat))

  /** The image so far.
    *
    * @param samplesPerPixel planned
    */
  private[render] def rendering(samplesPerPixel: Int): Rendering =
    Rendering(
      job.film,
      samplesPerPixel,
      samplesDone,
      samplesTaken = 0,
      workers.map(_.raysTraced).sum,
      seconds = 0,
      discarded,
      job.layers,
      job.guide.map(_.outcome),
      job.guide.fold(0.0)(_.seconds)
    )

  /** The pieces at which workers are at the moment. */
  private[render] def pieces: Vector[Int] = workers.flatMap(_.piece)

  /** Writes the state, in a form that depends on the samples only. */
  def save(to: CheckedOutput): Unit =
    to.int(job.schedule.pieces)
    for i <- 0 until job.schedule.pieces do to.long(queue.progress.get(i))
    job.film.save(to)
    job.layers.foreach(_.save(to))
    job.chains.foreach(_.save(to))
    job.guide.foreach(_.save(to))
    val counts = discarded.toVector
    to.int(counts.size)
    for r <- counts do
      to.long(r.count)
      for number <- Vector(r.x, r.y, r.sample, r.material) do to.int(number)
    if !queue.begun.isEmpty then saveBegun(to)

  /** A tail, only of a rendering that was stopped in the midst of long samples. Earlier versions
    * ignore it: they take these samples again, so that some pixels have them twice, and chains lose
    * the weight of one path each.
    */
  private def saveBegun(to: CheckedOutput): Unit =
    val begun = queue.begun.asScala.toVector.sortBy((number, _) => number.intValue)
    to.int(begun.size)
    for (number, piece) <- begun do
      to.int(number)
      to.int(piece.done)
      to.int(piece.sums.length)
      piece.sums.foreach(to.double(_))

  /** Continues from a saved state; several that are shards of one rendering add up. */
  def load(from: CheckedInput): Unit =
    if from.int() != job.schedule.pieces then throw IOException("its state is of another image")
    val progress = new Array[Long](job.schedule.pieces)
    for i <- progress.indices do
      val done = from.long()
      require(done >= 0 && done <= job.schedule.maxProgress, s"piece $i has $done samples")
      progress(i) = done
      if done > queue.progress.get(i) then
        queue.progress.set(i, done)
        queue.begun.remove(i): Unit
    job.film.load(from)
    job.layers.foreach(_.load(from))
    job.chains.foreach(_.load(from))
    job.guide.foreach(_.load(from))
    for _ <- 0 until from.count(bytes = 24) do
      earlier :+= DiscardedSamples(from.long(), from.int(), from.int(), from.int(), from.int())
    if !from.isAtEnd then loadBegun(from, progress)

  private def loadBegun(from: CheckedInput, progress: Array[Long]): Unit =
    for _ <- 0 until from.count(bytes = 12) do
      val (number, done) = (from.int(), from.int())
      val piece = BegunPiece(done, Array.fill(from.count(bytes = 8))(from.double()))
      require(job.isBegun(number, piece), s"piece $number has $done parts of a sample")
      // Another shard may be farther
      if progress(number) == queue.progress.get(number) then
        queue.begun.put(number, piece): Unit

/** Keeps the state of a rendering. */
abstract class Checkpointer:

  /** Called before the first sample. */
  def restore(state: RenderState): Unit

  /** Asked about ten times a second. */
  def isDue: Boolean

  /** Called if due, and at the end; no sample is taken meanwhile. */
  def save(state: RenderState): Unit

  /** Called at the end instead of `save`, if some sample did not end in time: the last copy counts.
    */
  def discard(): Unit

  /** Called after each `save`, while sampling goes on: what may take longer. */
  def finish(): Unit

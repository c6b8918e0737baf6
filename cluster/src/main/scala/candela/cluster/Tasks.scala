package candela.cluster

import candela.job.{ClusterFailure, ShardRenderer}
import candela.render.storage.FilmHeader
import candela.render.{Cancellation, RenderControl, RenderListener, Shard}

import org.apache.spark.TaskContext
import org.apache.spark.broadcast.Broadcast
import org.apache.spark.util.LongAccumulator

import java.nio.file.Path

/** What every task of a rendering needs. Spark sends tasks, so this is small but for the bundle,
  * which reaches each executor once.
  *
  * @param threads of a task
  */
final class Assignment(
    val header: FilmHeader,
    val bundle: Broadcast[Bundle],
    val digest: String,
    val threads: Int
) extends Serializable:
  private val java = JavaRelease.current

  /** @throws ClusterFailure if this executor runs on another Java than the driver */
  def renderer: ShardRenderer =
    JavaRelease.check(driver = java)
    ExecutorScenes.renderer(this)

/** Releases of Java, whose mathematical functions may round differently. */
private[cluster] object JavaRelease:
  def current: Int = Runtime.version.feature

  /** @throws ClusterFailure if they differ */
  def check(driver: Int, executor: Int = current): Unit =
    if driver != executor then
      throw ClusterFailure(
        s"an executor runs on Java $executor, the program on Java $driver, which may not make the " +
          "same image: set JAVA_HOME to one JDK for Spark's workers (spark-class) and the program"
      )

/** Renders shards; their films are the result. A class, as Spark has to serialise it.
  *
  * @param samples counts camera samples while rendering
  */
final class RenderShards(work: Assignment, count: Int, samples: LongAccumulator)
    extends (Iterator[Int] => Iterator[FilmChunk]) with Serializable:

  def apply(shards: Iterator[Int]): Iterator[FilmChunk] =
    // A cancelled rendering asks once more for what is complete.
    val isCancelled = TaskContext.get.getLocalProperty(RenderShards.Cancelled) != null
    if isCancelled then Iterator.empty else shards.flatMap(render)

  private def render(index: Int): Iterator[FilmChunk] =
    val context = TaskContext.get
    val cancellation = Cancellation()
    var reported = 0L
    val file = ExecutorScenes.newFile()
    val listener = RenderListener.onProgress: progress =>
      samples.add(progress.done - reported)
      reported = progress.done
      if context.isInterrupted() then cancellation.request()
    val shard = Shard(index, count)
    val _ = work.renderer.render(
      file,
      RenderControl(cancellation = cancellation, listener = listener, shard = shard)
    )
    if cancellation.isRequested then throw InterruptedException(s"shard $index was cancelled")
    FilmChunks.read(index, file)

object RenderShards:
  /** Name of the property that says so. */
  val Cancelled = "candela.cancelled"

/** Adds up the films of a partition. What is damaged or missing is left out: the driver notices. */
final class MergeFilms(work: Assignment) extends (Iterator[FilmChunk] => Iterator[FilmChunk])
    with Serializable:

  def apply(chunks: Iterator[FilmChunk]): Iterator[FilmChunk] =
    val id = TaskContext.getPartitionId()
    val folder = ExecutorScenes.newFolder()
    FilmChunks.write(chunks, folder) match
      case Vector() => Iterator.empty
      case Vector(one) => FilmChunks.read(id, one)
      case several =>
        val sum = folder.resolve("sum.film")
        val shards = work.renderer.merge(several, sum)
        several.foreach(java.nio.file.Files.delete)
        if shards.isEmpty then Iterator.empty else FilmChunks.read(id, sum)

/** Sends the chunks of each partition to one of fewer. */
final class ByGroup(groups: Int)
    extends ((Int, Iterator[FilmChunk]) => Iterator[(Int, FilmChunk)]) with Serializable:
  def apply(partition: Int, chunks: Iterator[FilmChunk]): Iterator[(Int, FilmChunk)] =
    chunks.map(chunk => (partition % groups, chunk))

/** Drops the keys again. */
object Chunks extends (Iterator[(Int, FilmChunk)] => Iterator[FilmChunk]) with Serializable:
  def apply(pairs: Iterator[(Int, FilmChunk)]): Iterator[FilmChunk] = pairs.map(_._2)

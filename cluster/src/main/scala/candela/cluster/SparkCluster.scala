package candela.cluster

import candela.job.{Cluster, ClusterFailure, ClusterRun, ClusterWork, ShardRenderer}

import org.apache.spark.rdd.RDD
import org.apache.spark.{HashPartitioner, SparkContext}

import java.nio.file.Path
import java.util.concurrent.locks.LockSupport

import scala.util.{Failure, Success, Try}

/** A cluster of Apache Spark. Each rendering is a Spark job of a thread of its own; jobs share the
  * executors, the first submitted first.
  */
final class SparkCluster(context: SparkContext, note: String => Unit) extends Cluster:
  private val traffic = Traffic()
  private var jobs, bundles = 0L
  context.addSparkListener(traffic)

  def submit(work: ClusterWork): ClusterRun =
    if context.isStopped then throw ClusterFailure("Spark has ended the application")
    val bundle = Bundle.of(work.scene, work.files)
    jobs += 1
    bundles += bundle.size
    val run = SparkRun(context, note, traffic, work, bundle, s"candela-$jobs")
    run.start()
    run

  def summary: String =
    val executors = if context.isStopped then 0 else context.getExecutorMemoryStatus.size - 1
    s"Spark: $executors executors, ${traffic.tasks} tasks (${traffic.failures} failed), bundles " +
      s"$bundles bytes, films exchanged ${traffic.exchanged} bytes, to the driver " +
      s"${traffic.returned} bytes"

  def close(): Unit = context.stop()

/** One rendering on Spark. */
private final class SparkRun(
    context: SparkContext,
    note: String => Unit,
    traffic: Traffic,
    work: ClusterWork,
    bundle: Bundle,
    group: String
) extends ClusterRun:
  import SparkRun.*
  private val broadcast = context.broadcast(bundle)
  private val threads = context.getConf.getInt("spark.task.cpus", 1)
  private val assignment = Assignment(work.header, broadcast, bundle.digest, threads)
  private val counter = context.longAccumulator(group)
  @volatile private var isCancelled = false
  @volatile private var result: Option[Try[Vector[Vector[FilmChunk]]]] = None
  private lazy val count = work.shards.getOrElse(ShardsPerCore * cores() / threads)

  def start(): Unit =
    val job: Runnable = () =>
      result = Some(Try(rendered()))
      broadcast.destroy()
    val thread = Thread(job, group)
    thread.setDaemon(true)
    thread.start()

  def isDone: Boolean = result.isDefined
  def samples: Long = counter.sum + traffic.running(counter.id)

  def cancel(): Unit =
    isCancelled = true
    val jobs = context.statusTracker
    if jobs.getJobIdsForGroup(group).exists(jobs.getActiveJobIds().contains) then
      context.cancelJobGroup(group)

  def films(folder: Path): Vector[Path] =
    while !isDone do LockSupport.parkNanos(Tick)
    result match
      case Some(Success(films)) =>
        films.flatMap(chunks => FilmChunks.write(chunks.iterator, folder))
      case Some(Failure(e)) => throw failure(e)
      case None => Vector.empty

  private def failure(e: Throwable): Throwable =
    val causes = Iterator.iterate(e)(_.getCause).takeWhile(_ != null).toVector
    val text = causes.flatMap(c => Option(c.getMessage)).mkString("\n")
    ClusterFailure(s"Spark could not render `${work.scene}`: ${reason(text)}", e)

  /** Renders all shards; those that get lost again. */
  private def rendered(): Vector[Vector[FilmChunk]] =
    def round(missing: Set[Int], films: Vector[Vector[FilmChunk]], retries: Int)
        : Vector[Vector[FilmChunk]] =
      val (arrived, film) = collected(summed(missing))
      val damaged = missing -- arrived
      if damaged.isEmpty || isCancelled then films :+ film
      else
        val names = damaged.toVector.sorted.map(i => s"$i/$count").mkString(", ")
        if retries == 0 then throw ClusterFailure(s"shards $names arrived damaged repeatedly")
        note(s"shards $names arrived damaged; rendering them again")
        round(damaged, films :+ film, retries - 1)
    round((0 until count).toSet, Vector.empty, Rounds)

  /** A single partition: the film of these shards, summed along a tree. */
  private def summed(shards: Set[Int]): RDD[FilmChunk] =
    def reduced(films: RDD[FilmChunk]): RDD[FilmChunk] =
      val partitions = films.getNumPartitions
      if partitions == 1 then films
      else
        val groups = (partitions + FanIn - 1) / FanIn
        val grouped = films.mapPartitionsWithIndex(ByGroup(groups))
          .partitionBy(HashPartitioner(groups))
        reduced(grouped.mapPartitions(Chunks).mapPartitions(MergeFilms(assignment)))
    val partitioned = context.parallelize(shards.toVector.sorted, shards.size)
    reduced(partitioned.mapPartitions(RenderShards(assignment, count, counter)))

  /** The film, and the shards that arrived. */
  private def collected(sum: RDD[FilmChunk]): (Set[Int], Vector[FilmChunk]) =
    context.setJobGroup(group, s"Candela: ${work.scene}", interruptOnCancel = false)
    val chunks =
      try sum.collect().toVector
      catch
        case e: Throwable if isCancelled =>
          // What executors have completed is still there; the rest becomes empty.
          context.setLocalProperty(RenderShards.Cancelled, "true")
          context.setJobGroup(s"$group-rest", s"Candela: rest of ${work.scene}")
          Try(sum.collect().toVector).getOrElse(throw e)
    val folder = ExecutorScenes.newFolder()
    val shards = FilmChunks.write(chunks.iterator, folder).map(ShardRenderer.shards)
    (shards.flatten.toSet, chunks)

  /** Processors of all executors, once they have registered. */
  private def cores(): Int =
    def executors = context.getExecutorMemoryStatus.size
    var previous = 0
    var quiet = 0
    while !context.isLocal && (executors < 2 || quiet < Settled) && !isCancelled do
      quiet = if executors == previous then quiet + 1 else 0
      previous = executors
      LockSupport.parkNanos(Tick)
    context.defaultParallelism

private[cluster] object SparkRun:
  val ShardsPerCore = 4

  /** Films that are added up at once. */
  val FanIn = 8

  /** How often lost shards are rendered again. */
  val Rounds = 3

  /** In nanoseconds. */
  val Tick = 100_000_000L

  /** Ticks without a new executor. */
  val Settled = 10

  /** The program's own message in Spark's, if there is one. */
  def reason(text: String): String =
    val pattern = "(?:SceneError|ClusterFailure|IOException): ([^\n]*)".r
    pattern.findFirstMatchIn(text).fold(text.linesIterator.nextOption.getOrElse(""))(_.group(1))

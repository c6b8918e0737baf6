package candela.jmh

import scala.collection.mutable
import scala.util.Random

/** What the parts of a rendering on a cluster cost, measured on one core.
  *
  * @param shards    processor time of each shard, relative to their mean
  * @param filmBytes of one film
  * @param addition  seconds to read one film and add it to a sum
  * @param writing   seconds to write one film
  * @param bundle    bytes of the scene's files
  * @param building  seconds to read and build the scene
  */
final case class ClusterCosts(
    shards: Vector[Double],
    filmBytes: Double,
    addition: Double,
    writing: Double,
    bundle: Double,
    building: Double
)

/** A cluster that is assumed.
  *
  * @param start       seconds until executors are there
  * @param perMachine  cores of a machine, one executor
  * @param bandwidth   bytes per second into each machine
  * @param dispatch    seconds of the driver for each task
  * @param slow        share of tasks that take [[slowdown]] times as long
  */
final case class ClusterAssumptions(
    start: Double = 10,
    perMachine: Int = 16,
    bandwidth: Double = 1.25e9,
    dispatch: Double = 0.002,
    slow: Double = 0.001,
    slowdown: Double = 4
)

/** Simulates `render --spark`: start, broadcast, shards with speculation, tree of sums, and the way
  * to the driver.
  */
final class ClusterModel(costs: ClusterCosts, assumed: ClusterAssumptions):
  import ClusterModel.*

  /** Seconds until the image is written.
    *
    * @param work     seconds of one core for all samples
    * @param perCore  shards per core
    */
  def seconds(work: Double, cores: Int, perCore: Int): Double =
    val machines = (cores + assumed.perMachine - 1) / assumed.perMachine
    val shards = cores * perCore
    val broadcast = costs.bundle / assumed.bandwidth * (1 + log2(machines))
    val begin = assumed.start + broadcast + costs.building
    begin + rendering(work, cores, shards) + sums(shards, cores, machines) +
      costs.filmBytes / assumed.bandwidth + costs.addition

  /** The mean of several runs: slow tasks are random. */
  private def rendering(work: Double, cores: Int, shards: Int): Double =
    (1 to Runs).map(seed => rendering(work, cores, shards, Random(seed))).sum / Runs

  /** Tasks go to the first free core, in order. */
  private def rendering(work: Double, cores: Int, shards: Int, random: Random): Double =
    val free = mutable.PriorityQueue.fill(cores)(0.0)(using Ordering[Double].reverse)
    val usual = work / shards + costs.writing
    // Together they are the work
    val drawn = Vector.fill(shards)(costs.shards(random.nextInt(costs.shards.size)))
    val mean = drawn.sum / shards
    var end = 0.0
    for i <- 0 until shards do
      val normal = work / shards * drawn(i) / mean + costs.writing
      // Speculation starts a slow task again, elsewhere, after twice the median
      val slow = Math.min(normal * assumed.slowdown, 2 * usual + normal)
      val time = if random.nextDouble() < assumed.slow then slow else normal
      val done = Math.max(free.dequeue(), i * assumed.dispatch) + time
      free += done
      end = Math.max(end, done)
    end

  /** Each level waits for the one before. */
  private def sums(shards: Int, cores: Int, machines: Int): Double =
    Iterator.iterate(shards)(n => (n + FanIn - 1) / FanIn).takeWhile(_ > 1).map: films =>
      val tasks = (films + FanIn - 1) / FanIn
      val rounds = Math.ceil(tasks.toDouble / cores)
      val perMachine = Math.ceil(films.toDouble / Math.min(machines, tasks))
      val traffic = perMachine * costs.filmBytes / assumed.bandwidth
      val work = Math.min(FanIn, films) * costs.addition + costs.writing
      rounds * work + traffic + tasks * assumed.dispatch
    .sum

private object ClusterModel:
  val Runs = 20

  /** Films that are added at once. */
  val FanIn = 8

  def log2(n: Int): Double = Math.log(n) / Math.log(2)

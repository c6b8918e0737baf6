package candela.bench.robustness

import candela.concurrency.Parallel
import candela.bench.report.{Robust, RobustRow}
import candela.image.Image
import candela.report.Picture

/** What a measurement is made with.
  *
  * @param rays        trials of each row
  * @param isCancelled polled; what is cancelled has fewer trials
  */
final class Equipment(
    val rays: Long,
    pool: Parallel,
    val kernels: Vector[Kernel],
    val painters: Vector[Painter],
    val embree: Option[EmbreeRays],
    val isCancelled: () => Boolean
):
  /** Trials in parts, on all threads; the parts depend on the count alone. */
  def tally(count: Long)(of: Trials => Tally): Tally =
    val parts =
      Trials.divided(count, Math.max(Equipment.MinParts, count / Equipment.PartSize).toInt)
    val tallies = Array.fill(parts.size)(Tally.Empty)
    pool.forEach(parts.size)(k => if !isCancelled() then tallies(k) = of(parts(k)))
    tallies.reduce(_ and _)

  def counted(count: Long)(of: Trials => Tally): Robust =
    val t = tally(count)(of)
    Robust.Counted(t.faults, t.trials, t.first)

  /** The pictures of a scene by all programs, each judged. */
  def painted(what: String, scene: PeerInput, why: Option[String] = None)(
      judge: Image => Robust
  ): RobustRow =
    val all = painters.filterNot(_ => isCancelled()).map(p => p.program -> p.paint(scene))
    val cells = all.map: (program, result) =>
      program.key -> result.fold(
        r => if r.isFailure then Robust.Failed(r.why) else Robust.Absent(r.why),
        judge
      )
    val pictures = all.collect { case (program, Right(image)) => Picture(program.title, image) }
    val isShown = cells.exists(_._2.isFaulty)
    RobustRow(what, cells.toMap, why, if isShown then pictures else Vector.empty)

object Equipment:
  private final val MinParts = 8L
  private final val PartSize = 100_000L

/** A kind of fault: its rows are measured one by one.
  *
  * @param key   what `--only` calls it
  * @param per   number of trials to which counts are converted; 0 if they are shares, or nothing
  *   is counted
  * @param words what is counted, and how
  */
abstract class Measurement(
    val key: String,
    val title: String,
    val per: Double,
    val words: String
):

  /** Measured one by one, when they are asked for. */
  def rows(by: Equipment): Iterator[RobustRow]

/** Judges of pictures. */
object Pixels:
  private def green(image: Image): Array[Float] =
    val k = image.channelNames.indexOf("G")
    Array.tabulate(image.width * image.height)(i => image(i % image.width, i / image.width, k))

  /** Counts pixels. */
  def counted(image: Image)(isFault: Float => Boolean): Robust =
    val all = green(image)
    val faults = all.indices.filter(i => isFault(all(i)))
    val first = faults.headOption.map: i =>
      s"pixel ${i % image.width}, ${i / image.width}: ${all(i)}"
    Robust.Counted(faults.size.toLong, all.length.toLong, first)

  /** The mean of the picture, with the noise that neighbours in a row tell of. */
  def mean(image: Image, expected: Double, allowed: Double): Robust =
    val (mean, error) = meanAndError(image)
    Robust.Mean(mean, error, expected, allowed)

  def meanAndError(image: Image): (Double, Double) =
    val all = green(image).map(_.toDouble)
    val pairs = all.grouped(2).collect { case Array(a, b) => (a - b) * (a - b) / 2 }.toVector
    val variance = pairs.sum / pairs.size
    (all.sum / all.length, Math.sqrt(variance / all.length))

package candela.bench.suite

import candela.base.loop
import candela.image.Image

import scala.collection.mutable

/** The largest difference between the means of two programs' images.
  *
  * @param share of the mean, in which channel and where; not a number if the sizes differ
  * @param noise of that share, one standard deviation
  */
private[suite] final case class Difference(
    share: Double,
    noise: Double,
    channel: String,
    location: String
):
  def words(counterpart: String): String =
    if share.isNaN then s"not compared: its image has another size than that of $counterpart"
    else
      val size = f"${100 * share}%+.2g %% in $channel $location"
      s"not compared: its mean differs from that of $counterpart by $size; " +
        f"the noise is ${100 * noise}%.1g %%"

/** Tells whether programs render the same scene: the means of their images agree, as a whole and in
  * parts, but for noise and for what roundings and filters of textures may differ.
  */
private[suite] object Agreement:

  private val PartsPerSide = 4

  /** Differences of so many standard deviations count: there are 51 means. */
  private val Deviations = 5.0

  /** Relative differences that are no noise and yet allowed: of the image, and of its parts. */
  private val WholeTolerance = 0.005
  private val PartTolerance = 0.02

  /** Parts as dark as this share of the image's mean count as if they were this bright. */
  private val Dark = 0.1

  /** The difference, if there is one.
    *
    * @param images of several seeds, equally long renderings
    */
  def broken(images: Vector[Image], counterpart: Vector[Image]): Option[Difference] =
    val (width, height) = (counterpart.head.width, counterpart.head.height)
    if images.exists(i => i.width != width || i.height != height) then
      Some(Difference(Double.NaN, 0, "", ""))
    else
      val (ours, other) = (Tally(images), Tally(counterpart))
      val differences =
        for
          c <- 0 until 3
          middle = other.mean(Block(0, width, 0, height), c)
          (block, allowed) <- blocks(width, height)
          scale = Math.max(other.mean(block, c), Dark * middle)
          if scale > 0
        yield
          val share = (ours.mean(block, c) - other.mean(block, c)) / scale
          // The noise of a single image is taken for that of the other program
          val noise = Math.hypot(
            ours.noise(block, c).orElse(other.noise(block, c)).getOrElse(0.0),
            other.noise(block, c).getOrElse(0.0)
          ) / scale
          (Math.abs(share) - allowed - Deviations * noise) ->
            Difference(share, noise, Channels(c), block.describe(width, height))
      differences.filter(_._1 > 0).maxByOption(_._1).map(_._2)

  private val Channels = Vector("red", "green", "blue")

  private def blocks(width: Int, height: Int): Vector[(Block, Double)] =
    val parts =
      for
        j <- 0 until PartsPerSide
        i <- 0 until PartsPerSide
        block = Block(
          i * width / PartsPerSide,
          (i + 1) * width / PartsPerSide,
          j * height / PartsPerSide,
          (j + 1) * height / PartsPerSide
        )
        if block.x1 > block.x0 && block.y1 > block.y0
      yield block -> PartTolerance
    (Block(0, width, 0, height) -> WholeTolerance) +: parts.toVector

  private final case class Block(x0: Int, x1: Int, y0: Int, y1: Int):
    def pixels: Int = (x1 - x0) * (y1 - y0)
    def describe(width: Int, height: Int): String =
      if x1 - x0 == width && y1 - y0 == height then "over the image"
      else s"in pixels $x0 to ${x1 - 1}, $y0 to ${y1 - 1}"

  private final class Tally(images: Vector[Image]):
    private val sums = mutable.HashMap.empty[(Block, Int), (Double, Option[Double])]

    def mean(block: Block, c: Int): Double = of(block, c)._1

    /** Standard deviation of the mean; unknown of a single image. */
    def noise(block: Block, c: Int): Option[Double] = of(block, c)._2

    private def of(block: Block, c: Int) = sums.getOrElseUpdate((block, c), measured(block, c))

    private def measured(block: Block, c: Int): (Double, Option[Double]) =
      val n = images.size
      val means = new Array[Double](n)
      var variance = 0.0
      for y <- block.y0 until block.y1; x <- block.x0 until block.x1 do
        var (sum, squares) = (0.0, 0.0)
        loop(n): k =>
          val v = images(k)(x, y, c).toDouble
          sum += v
          squares += v * v
          means(k) += v / block.pixels
        if n > 1 then variance += Math.max(0.0, squares - sum * sum / n) / (n - 1)
      val mean = means.sum / n
      // Of pixels as if independent; and of the images' means, if their pixels are correlated
      val ofPixels = variance / n / block.pixels / block.pixels
      val ofMeans = means.map(m => (m - mean) * (m - mean)).sum / Math.max(n - 1, 1) / n
      (mean, Option.when(n > 1)(Math.sqrt(Math.max(ofPixels, ofMeans))))

/** The images of a scene by which programs are compared with their counterparts. */
private[suite] final class Witnesses(suite: Suite):
  private val longest = mutable.HashMap.empty[Entry, (Int, Map[Int, Image])]
  private val compared =
    suite.programs.filter(_.counterpart.isDefined).flatMap(p => p.counterpart.toSeq :+ p.name).toSet

  /** Keeps the images of each program's longest renderings. */
  def take(job: Job, image: Image): Unit =
    if job.isPoint && compared(job.entry.program.name) then
      val (step, images) = longest.getOrElse(job.entry, (job.step, Map.empty[Int, Image]))
      if job.step > step then longest(job.entry) = (job.step, Map(job.seed -> image))
      else if job.step == step then longest(job.entry) = (step, images.updated(job.seed, image))

  /** Programs that render another scene, and in words what differs; all images are forgotten. */
  def refused(): Vector[(Entry, String)] =
    val mismatches =
      for
        (entry, (_, images)) <- longest.toVector
        name <- entry.program.counterpart
        (other, (_, theirs)) <- longest.find(_._1.program.name == name)
        ours =
          if entry.program.isSeeded then images.values.toVector else images.values.take(1).toVector
        difference <- Agreement.broken(ours, theirs.values.toVector)
      yield entry -> difference.words(other.program.title)
    longest.clear()
    mismatches

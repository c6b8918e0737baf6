package candela.sampling

/** Sample points in [0, 1), indexed by pixel, sample number and dimension, so that an image depends
  * on neither threads nor pixel order.
  *
  * Not thread-safe: each worker has a `copy`.
  */
abstract class Sampler:

  /** Samples per pixel; some samplers round the request up, e.g. to a power of two. */
  def samplesPerPixel: Int

  /** Whether sample k is the same for any number of samples per pixel above k. */
  def isProgressive: Boolean = false

  /** Starts at dimension 0 of sample `sample` of the pixel. Any number may follow: those beyond
    * `samplesPerPixel` go on with the points, or begin another set of as many, independent of those
    * before.
    */
  def start(x: Int, y: Int, sample: Int): Unit

  /** Continues as after so many calls of `next1D` since `start`. What comes after a random walk
    * thus has the same dimensions in all samples, however long each walk was.
    *
    * Samplers without dimensions just go on.
    */
  def skipTo(requests: Int): Unit = ()

  /** Where it is in the sample's dimensions. */
  def position: Long = 0L

  /** Goes on from a [[position]] of the sample. */
  def goTo(position: Long): Unit = ()

  /** The next dimension, in [0, 1). */
  def next1D(): Float

  /** The next dimension. If its value does not matter, it is skipped without being computed: 0. */
  final def next1D(matters: Boolean): Float =
    if matters then next1D()
    else
      leaveOut()
      0f

  /** Advances to the dimension behind that of `next1D`. */
  protected def leaveOut(): Unit = next1D(): Unit

  /** Advances to the next two dimensions, jointly well distributed; read them from `x` and `y`. */
  def next2D(): Unit

  /** As `next2D`. If the values do not matter, `x` and `y` are left as they are. */
  final def next2D(matters: Boolean): Unit = if matters then next2D() else leaveOut2D()

  /** Advances to the dimension behind those of `next2D`. */
  protected def leaveOut2D(): Unit = next2D()

  /** The last point of `next2D`, each in [0, 1). */
  final var x, y: Float = 0f

  def copy(): Sampler

/** A sampler whose requests are numbered: each takes the bits of its number ([[SampleHash]]). */
abstract class HashedSampler extends Sampler:
  private var counter, first = 0L

  /** Numbers the requests from here: the same for all samples that form one set of points. */
  protected final def startAt(at: Long): Unit =
    first = at
    counter = at

  override def skipTo(requests: Int): Unit = counter = first + requests * SampleHash.Step
  override def position: Long = counter - first
  override def goTo(position: Long): Unit = counter = first + position

  override protected def leaveOut(): Unit = counter += SampleHash.Step
  override protected def leaveOut2D(): Unit = leaveOut()

  /** Of the next request. */
  protected final def nextBits(): Long =
    counter += SampleHash.Step
    SampleHash.mix64(counter)

/** Independent random numbers: the baseline for the other samplers.
  *
  * In pbrt: `independent` (v4), `random` (v2, v3).
  */
final class IndependentSampler(val samplesPerPixel: Int, seed: Int) extends HashedSampler:
  override def isProgressive: Boolean = true

  def start(x: Int, y: Int, sample: Int): Unit =
    startAt(SampleHash.mix64(SampleHash.pixel(x, y, seed) + sample))

  def next1D(): Float =
    SampleHash.toUnit((nextBits() >>> 32).toInt)

  def next2D(): Unit =
    val bits = nextBits()
    x = SampleHash.toUnit((bits >>> 32).toInt)
    y = SampleHash.toUnit(bits.toInt)

  def copy(): IndependentSampler = IndependentSampler(samplesPerPixel, seed)

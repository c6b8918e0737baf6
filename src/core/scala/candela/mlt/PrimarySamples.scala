package candela.mlt

import candela.io.{CheckedInput, CheckedOutput}
import candela.sampling.{SampleHash, Sampler}

/** A point of primary sample space: the random numbers of a path, with as many dimensions as the
  * path requests, mutated by small and large steps. Mutable, one per chain.
  *
  * Numbers come in three streams, so that an additional dimension of the light subpath doesn't
  * shift those of the camera subpath. Dimensions are mutated lazily: one not requested recently
  * catches up on missed steps.
  *
  * Sources: Kelemen, Szirmay-Kalos, Antal, Csonka, "A Simple and Robust Mutation Strategy for the
  * Metropolis Light Transport Algorithm", Eurographics 2002; PBRT 3rd ed., §16.4.4, for the normal
  * distribution of small steps.
  *
  * @param largeStep probability of a large step
  * @param sigma     standard deviation of small steps
  */
private[candela] final class PrimarySamples(largeStep: Float, sigma: Float):
  import PrimarySamples.*

  private var counter = 0L
  private var time = 0
  private var lastLarge = 0
  private var spare = Float.NaN

  /** Whether the proposal is a large step. */
  var isLarge = true

  val camera: Numbers = Numbers(this)
  val light: Numbers = Numbers(this)
  val joins: Numbers = Numbers(this)

  /** Resets to a point that depends on `seed` only. */
  def start(seed: Long): Unit =
    branch(seed)
    time = 0
    lastLarge = 0
    isLarge = true
    camera.clear()
    light.clear()
    joins.clear()

  /** Reseeds the random numbers of further steps, as chains may start at the same point. */
  def branch(seed: Long): Unit =
    counter = SampleHash.mix64(seed)
    spare = Float.NaN

  /** Proposes a mutation, to be accepted or rejected. */
  def propose(): Unit =
    time += 1
    isLarge = uniform() < largeStep
    camera.rewind()
    light.rewind()
    joins.rewind()

  def accept(): Unit = if isLarge then lastLarge = time

  def reject(): Unit =
    camera.restore()
    light.restore()
    joins.restore()
    time -= 1

  /** Uniform in [0, 1), independent of the point. */
  def uniform(): Float =
    counter += SampleHash.Step
    SampleHash.toUnit((SampleHash.mix64(counter) >>> 32).toInt)

  /** Writes the state between two steps. */
  def save(to: CheckedOutput): Unit =
    to.long(counter)
    to.int(time)
    to.int(lastLarge)
    to.float(spare)
    for stream <- Vector(camera, light, joins) do stream.save(to)

  def load(from: CheckedInput): Unit =
    counter = from.long()
    time = from.int()
    lastLarge = from.int()
    spare = from.float()
    require(lastLarge >= 0 && lastLarge <= time, s"a chain has step $lastLarge of $time")
    for stream <- Vector(camera, light, joins) do stream.load(from)

  /** Standard deviation of `steps` small steps combined. */
  private def deviation(steps: Int): Float = sigma * Math.sqrt(steps.toDouble).toFloat

  /** Box and Muller, "A Note on the Generation of Random Normal Deviates", 1958: two at a time. */
  private def normal(): Float =
    if spare == spare then
      val result = spare
      spare = Float.NaN
      result
    else
      val radius = Math.sqrt(-2 * Math.log(1.0 - uniform()))
      val angle = 2 * Math.PI * uniform()
      spare = (radius * Math.sin(angle)).toFloat
      (radius * Math.cos(angle)).toFloat

private[candela] object PrimarySamples:

  /** One stream of dimensions, in order of request. */
  final class Numbers(owner: PrimarySamples) extends Sampler:
    private var values = new Array[Float](InitialSize)
    private var changed = new Array[Int](InitialSize)
    private var oldValues = new Array[Float](InitialSize)
    private var oldChanged = new Array[Int](InitialSize)
    private var filled = 0
    private var next = 0

    def samplesPerPixel: Int = 1
    def start(x: Int, y: Int, sample: Int): Unit = rewind()
    def copy(): Numbers = Numbers(owner)

    def save(to: CheckedOutput): Unit =
      to.int(filled)
      for i <- 0 until filled do
        to.float(values(i))
        to.int(changed(i))

    def load(from: CheckedInput): Unit =
      filled = from.count(bytes = 8)
      next = 0
      val size = Math.max(InitialSize, filled)
      values = new Array[Float](size)
      changed = new Array[Int](size)
      oldValues = new Array[Float](size)
      oldChanged = new Array[Int](size)
      for i <- 0 until filled do
        values(i) = from.float()
        changed(i) = from.int()
        require(values(i) >= 0f && values(i) < 1f, s"a random number is ${values(i)}")
        require(changed(i) >= NeverChanged && changed(i) <= owner.time, s"a step is ${changed(i)}")

    def clear(): Unit =
      filled = 0
      next = 0

    def rewind(): Unit = next = 0

    def restore(): Unit =
      System.arraycopy(oldValues, 0, values, 0, next)
      System.arraycopy(oldChanged, 0, changed, 0, next)

    def next1D(): Float =
      val i = next
      next += 1
      if i == filled then grow()
      if changed(i) < owner.lastLarge then
        values(i) = owner.uniform()
        changed(i) = owner.lastLarge
      oldValues(i) = values(i)
      oldChanged(i) = changed(i)
      val steps = owner.time - changed(i)
      if steps > 0 then
        values(i) =
          if owner.isLarge then owner.uniform()
          else wrapped(values(i) + owner.normal() * owner.deviation(steps))
        changed(i) = owner.time
      values(i)

    def next2D(): Unit =
      x = next1D()
      y = next1D()

    private def grow(): Unit =
      if filled == values.length then
        values = java.util.Arrays.copyOf(values, 2 * filled)
        changed = java.util.Arrays.copyOf(changed, 2 * filled)
        oldValues = java.util.Arrays.copyOf(oldValues, 2 * filled)
        oldChanged = java.util.Arrays.copyOf(oldChanged, 2 * filled)
      changed(filled) = NeverChanged
      filled += 1

  /** Wraps around to [0, 1): the space is a torus. */
  private def wrapped(value: Float): Float =
    val inside = value - Math.floor(value.toDouble).toFloat
    if inside < 1f then inside else 0f

  private inline val NeverChanged = -1

  /** Initial capacity in dimensions. */
  private inline val InitialSize = 32

package candela.bidirectional

import candela.sampling.{SampleHash, Sampler}

/** The random numbers of which a chain makes its paths: a point of a cube of as many dimensions as
  * a path asks for, changed a little or thrown anew from path to path. Mutable, one per chain.
  *
  * The numbers come in three streams, so that one more of what a path from a light takes does not
  * shift those of the path from the camera. A dimension that lately was not asked for makes up for
  * the steps that it has missed when it is.
  *
  * Sources: Kelemen, Szirmay-Kalos, Antal, Csonka, "A Simple and Robust Mutation Strategy for the
  * Metropolis Light Transport Algorithm", Eurographics 2002; PBRT 3rd ed., §16.4.4, for the normal
  * distribution of small steps.
  *
  * @param largeStep probability that all numbers are thrown anew
  * @param sigma     standard deviation of the other steps
  */
private[bidirectional] final class PrimarySamples(largeStep: Float, sigma: Float):
  import PrimarySamples.*

  private var counter = 0L
  private var time = 0
  private var lastLarge = 0
  private var spare = Float.NaN

  /** Is the point that is tried thrown anew? */
  var isLarge = true

  val camera: Numbers = Numbers(this)
  val light: Numbers = Numbers(this)
  val joins: Numbers = Numbers(this)

  /** Starts anew with a point that depends on `seed` alone. */
  def start(seed: Long): Unit =
    branch(seed)
    time = 0
    lastLarge = 0
    isLarge = true
    camera.clear()
    light.clear()
    joins.clear()

  /** Draws on from here what depends on `seed`: chains may start at the same point. */
  def branch(seed: Long): Unit =
    counter = SampleHash.mix64(seed)
    spare = Float.NaN

  /** Steps to another point, which is then to be accepted or rejected. */
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

  /** In [0, 1), independent of the point. */
  def uniform(): Float =
    counter += SampleHash.Step
    SampleHash.toUnit((SampleHash.mix64(counter) >>> 32).toInt)

  /** Of so many small steps together. */
  private def deviation(steps: Int): Float = sigma * Math.sqrt(steps.toDouble).toFloat

  /** Box and Muller, "A Note on the Generation of Random Normal Deviates", 1958: two at a time. */
  private def normal(): Float =
    if spare == spare then
      val given_ = spare
      spare = Float.NaN
      given_
    else
      val radius = Math.sqrt(-2 * Math.log(1.0 - uniform()))
      val angle = 2 * Math.PI * uniform()
      spare = (radius * Math.sin(angle)).toFloat
      (radius * Math.cos(angle)).toFloat

private[bidirectional] object PrimarySamples:

  /** Some of the dimensions, in the order in which they are asked for. */
  final class Numbers(owner: PrimarySamples) extends Sampler:
    private var values = new Array[Float](InitialSize)
    private var changed = new Array[Int](InitialSize)
    private var oldValues = new Array[Float](InitialSize)
    private var oldChanged = new Array[Int](InitialSize)
    private var known = 0
    private var next = 0

    def samplesPerPixel: Int = 1
    def start(x: Int, y: Int, sample: Int): Unit = rewind()
    def copy(): Numbers = Numbers(owner)

    def clear(): Unit =
      known = 0
      next = 0

    def rewind(): Unit = next = 0

    def restore(): Unit =
      System.arraycopy(oldValues, 0, values, 0, next)
      System.arraycopy(oldChanged, 0, changed, 0, next)

    def next1D(): Float =
      val i = next
      next += 1
      if i == known then grow()
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
      if known == values.length then
        values = java.util.Arrays.copyOf(values, 2 * known)
        changed = java.util.Arrays.copyOf(changed, 2 * known)
        oldValues = java.util.Arrays.copyOf(oldValues, 2 * known)
        oldChanged = java.util.Arrays.copyOf(oldChanged, 2 * known)
      changed(known) = Never
      known += 1

  /** In [0, 1) again: the cube has no border. */
  private def wrapped(value: Float): Float =
    val inside = value - Math.floor(value.toDouble).toFloat
    if inside < 1f then inside else 0f

  private inline val Never = -1

  /** Dimensions to begin with. */
  private inline val InitialSize = 32

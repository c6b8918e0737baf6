package candela.accel.tracing

import candela.concurrency.Parallel
import java.lang.management.ManagementFactory
import java.util.SplittableRandom
import java.util.concurrent.atomic.AtomicBoolean

import candela.accel.{Primitives, WideTree}
import candela.accel.building.WideBuilder
import candela.geometry.{Hit, Ray}
import candela.math.{Transform, TwoPi, Vec3}
import candela.shapes.{Shape, Sphere, TriangleSoup}

/** Has the JVM compile a query of the SIMD kernel, which is a hundred times slower than scalar code
  * until then.
  *
  * A thread of its own traces the same rays by both kernels while the scene is built, and while
  * renders begin with scalar code. It ends when the SIMD kernel is faster.
  *
  * @param clock time in nanoseconds
  */
private[tracing] final class WarmUp(
    query: WarmUp.Query,
    clock: () => Long = () => System.nanoTime
):
  import WarmUp.*

  /** Whether the kernel has been faster. Never reverts. */
  @volatile var isOver = false

  /** Traces a batch of rays by both kernels; the SIMD kernel must be faster for most of them.
    * Returns the time of all.
    */
  def attempt(tree: WideTree, fast: WideKernel, rays: TestRays): Long =
    val start = clock()
    var wins = 0
    var i = 0
    while i < Batch do
      rays.advance()
      val scalarStart = clock()
      query(ScalarKernel, tree, rays.ray, rays.hit): Unit
      val vectorStart = clock()
      rays.again()
      query(fast, tree, rays.ray, rays.hit): Unit
      if clock() - vectorStart < vectorStart - scalarStart then wins += 1
      i += 1
    val nanos = clock() - start
    if wins >= MinWins then isOver = true
    nanos

private[tracing] object WarmUp:
  final val Batch = 16

  /** The SIMD kernel must be faster for this many rays of a batch. */
  private final val MinWins = 12

  /** Batches after which the launcher's JVM compiles the kernel (see `lib/options`; others do after
    * 5,000 calls).
    */
  final val BatchesToCompile = 20

  /** The pause after each later batch, relative to its time. */
  final val RestRatio = 3L

  /** Longest pause, in milliseconds: a batch takes long if it waits for the compiler. */
  final val MaxRestMillis = 20L

  /** The warm-up gives up a kernel that is not faster after this many seconds of its thread's
    * processor time: a busy machine only takes longer.
    */
  final val TimeoutSeconds = 15L

  private final val Triangles = 500

  /** Corners are at multiples of 1/Steps. */
  private final val Steps = 16
  private final val Spheres = 20
  private final val Radius = 0.05f

  /** Either query of a kernel. */
  trait Query:
    def apply(kernel: WideKernel, tree: WideTree, ray: Ray, hit: Hit): Boolean

  /** Small random triangles with corners at multiples of 1/[[Steps]], and a few spheres, in the
    * unit cube. Rays miss whole nodes, pass through edges and corners, hit two triangles at once
    * and triangles without area: branches that the JVM has seen here do not cost it a compilation
    * when a scene takes them.
    */
  def testTree(random: SplittableRandom, width: Int, lanes: Int): WideTree =
    val positions = Array.newBuilder[Float]
    for _ <- 0 until Triangles do
      val center = Vector.fill(3)(random.nextInt(Steps + 1))
      for _ <- 0 until 3; x <- center do
        positions += (x + random.nextInt(3) - 1).toFloat / Steps
    val indices = Array.tabulate(3 * Triangles)(i => i)
    val soup = TriangleSoup(positions.result, indices, Array.empty, false)
    val spheres = Array.fill[Shape](Spheres):
      def coordinate() = random.nextDouble()
      Sphere(
        Transform.translate(coordinate(), coordinate(), coordinate()),
        Radius,
        -Radius,
        Radius,
        TwoPi,
        false
      )
    WideBuilder.of(Primitives(soup, spheres), width, lanes, 4, Parallel.Alone)

  /** Rays between random points of the unit cube; every other one is a segment. */
  final class TestRays(random: SplittableRandom):
    val ray: Ray = Ray()
    val hit: Hit = Hit()
    private var end = 0f

    def advance(): Unit =
      val origin = point()
      end = if random.nextBoolean() then 0.999f else Float.PositiveInfinity
      ray.set(origin, point() - origin, end)
      hit.primitive = -1

    /** The same ray, untraced. */
    def again(): Unit =
      ray.tMax = end
      hit.primitive = -1

    /** Every other point is one of those where corners are. */
    private def point(): Vec3 =
      val isCorner = random.nextBoolean()
      def coordinate() =
        if isCorner then random.nextInt(Steps + 1).toFloat / Steps else random.nextDouble().toFloat
      Vec3(coordinate(), coordinate(), coordinate())

/** The warm-ups of both queries, of one job: it ends with the job's threads. What the JVM has
  * compiled for another job is known at once, after a batch.
  */
final class WarmUps:
  import WarmUp.*

  private[tracing] val closest = WarmUp(_.closest(_, _, _))
  private[tracing] val occluded = WarmUp(_.isOccluded(_, _, _))
  private val hasBegun = AtomicBoolean()

  private[tracing] def areOver: Boolean = closest.isOver && occluded.isOver

  /** Begins, unless it did before. The thread asks whether there are vectors: that takes time. */
  private[tracing] def start(parallel: Parallel, hasVectors: => Boolean): Unit =
    if parallel.worksAside && hasBegun.compareAndSet(false, true) then
      parallel.aside("warm-up")(if hasVectors then run(VectorKernel))

  private def run(fast: VectorKernel.type): Unit =
    val random = SplittableRandom(1)
    val tree = testTree(random, fast.width, fast.lanes)
    val rays = TestRays(random)
    val processor = ManagementFactory.getThreadMXBean
    val end = processor.getCurrentThreadCpuTime + TimeoutSeconds * 1000000000L
    var batches = 0
    while !areOver && processor.getCurrentThreadCpuTime < end && !Thread.currentThread.isInterrupted
    do
      var nanos = 0L
      if !closest.isOver then nanos += closest.attempt(tree, fast, rays)
      if !occluded.isOver then nanos += occluded.attempt(tree, fast, rays)
      batches += 1
      if batches > BatchesToCompile then
        Thread.sleep(Math.min(nanos * RestRatio / 1000000L, MaxRestMillis))

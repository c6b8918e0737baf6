package candela.accel.tracing

import candela.concurrency.Parallel
import candela.io.Keep
import candela.accel.{Accelerator, Primitives}
import candela.accel.building.{KeptTrees, WideBuilder}

/** Selects the BVH for a set of primitives and this JVM. */
object Hierarchies:

  /** Prepares for hierarchies of a scene with this many camera samples, while it is built; where
    * the number of primitives decides, that waits until it is known.
    */
  def expect(samples: Long, parallel: Parallel, warmUps: WarmUps): Unit =
    if samples >= MinSamples then warmUps.start(parallel, hasVectors)

  /** @param samples upper bound of the number of camera samples
    * @param warmUps those of the job
    * @param keep    has the hierarchies of other scenes
    */
  def of(
      primitives: Primitives,
      parallel: Parallel = Parallel.Alone,
      samples: Long = Long.MaxValue,
      warmUps: WarmUps = WarmUps(),
      keep: Keep = Keep.Nothing
  ): Accelerator =
    val unsplit = if isBrief(primitives.count, samples) then Unsplit else 1
    if primitives.count > MaxPrimitives then Bvh(primitives, parallel = parallel)
    else if isWorthIt(primitives.count, samples) && hasVectors then
      vector(primitives, parallel = parallel, warmUps = warmUps, keep = keep, unsplit = unsplit)
    else scalar(primitives, parallel = parallel, keep = keep, unsplit = unsplit)

  /** Whether so many primitives take longer to sort to the last than so few samples to trace. */
  private[tracing] def isBrief(primitives: Int, samples: Long): Boolean =
    samples < primitives / BriefPrimitives

  /** Whether SIMD code repays its loading and compilation, of about a second of processor time. */
  private[tracing] def isWorthIt(primitives: Int, samples: Long): Boolean =
    val minSamples = if primitives >= Mesh then MinMeshSamples else MinSamples
    primitives >= MinPrimitives && samples >= minSamples

  /** Wide BVH traversed by scalar code only. */
  def scalar(
      primitives: Primitives,
      width: Int = 4,
      parallel: Parallel = Parallel.Alone,
      keep: Keep = Keep.Nothing,
      unsplit: Int = 1
  ): Accelerator =
    val tree = KeptTrees(keep, width, 4, MaxLeaf, parallel, unsplit).of(primitives)
    WideBvh(tree, ScalarKernel, atOnce = true)

  /** Wide BVH traversed by SIMD code, at once or as soon as another thread has had it compiled;
    * requires [[hasVectors]].
    */
  def vector(
      primitives: Primitives,
      atOnce: Boolean = false,
      parallel: Parallel = Parallel.Alone,
      warmUps: WarmUps = WarmUps(),
      keep: Keep = Keep.Nothing,
      unsplit: Int = 1
  ): Accelerator =
    if !atOnce then warmUps.start(parallel, true)
    val (width, lanes) = (VectorKernel.width, VectorKernel.lanes)
    val tree = KeptTrees(keep, width, lanes, MaxLeaf, parallel, unsplit).of(primitives)
    WideBvh(tree, VectorKernel, atOnce, warmUps)

  private[tracing] def careful(primitives: Primitives): Accelerator =
    WideBvh(WideBuilder.of(primitives, 8, 8, MaxLeaf, Parallel.Alone), CarefulKernel, atOnce = true)

  /** Whether the JVM's incubating Vector API is available, and this machine's SIMD worth using. */
  lazy val hasVectors: Boolean = VectorModule.isLoaded && VectorKernel.isWorthIt

  private inline val MaxLeaf = 4

  /** Other primitives than triangles in leaves of hierarchies for few samples, at most. */
  private[tracing] inline val Unsplit = 8

  /** Primitives for each sample from which on samples are few. */
  private inline val BriefPrimitives = 20

  /** Lanes of the SIMD kernel's vectors; requires [[hasVectors]]. */
  def lanes: Int = VectorKernel.lanes

  /** Primitive count below which a tree has too few nodes for SIMD. */
  private inline val MinPrimitives = 16

  /** Camera samples below which SIMD does not pay, whatever the scene: in a room of 36 triangles,
    * it costs half a second and saves a tenth of the processor time.
    */
  private inline val MinSamples = 1500000L

  /** The same for scenes of at least [[Mesh]] primitives, where rays take most of the time. */
  private inline val MinMeshSamples = 500000L
  private inline val Mesh = 1000

  /** Primitive count above which blocks would not fit into one array. */
  private inline val MaxPrimitives = 60000000

package candela.accel.tracing

import candela.accel.{Accelerator, Primitives}
import candela.accel.building.WideBuilder
import candela.base.Parallel

/** Selects the BVH for a set of primitives and this JVM. */
object Hierarchies:

  /** @param samples upper bound of the number of camera samples */
  def of(
      primitives: Primitives,
      parallel: Parallel = Parallel.Alone,
      samples: Long = Long.MaxValue
  ): Accelerator =
    if primitives.count > Most then Bvh(primitives, parallel = parallel)
    else if samples >= Many && primitives.count >= Few && hasVectors then
      vector(primitives, parallel = parallel)
    else scalar(primitives, parallel = parallel)

  /** Wide BVH traversed by scalar code only. */
  def scalar(
      primitives: Primitives,
      width: Int = 4,
      parallel: Parallel = Parallel.Alone
  ): Accelerator =
    WideBvh(WideBuilder.of(primitives, width, 4, MaxLeaf, parallel), ScalarKernel, Int.MaxValue)

  /** Wide BVH traversed by SIMD code from the given ray on; requires [[hasVectors]]. */
  def vector(
      primitives: Primitives,
      patience: Int = Patience,
      parallel: Parallel = Parallel.Alone
  ): Accelerator =
    val tree = WideBuilder.of(primitives, VectorKernel.width, VectorKernel.lanes, MaxLeaf, parallel)
    WideBvh(tree, VectorKernel, patience)

  private[tracing] def careful(primitives: Primitives): Accelerator =
    WideBvh(WideBuilder.of(primitives, 8, 8, MaxLeaf, Parallel.Alone), CarefulKernel, 0)

  /** Whether the JVM's incubating Vector API is available, and this machine's SIMD worth using. */
  lazy val hasVectors: Boolean = VectorModule.isLoaded && VectorKernel.isWorthIt

  private inline val MaxLeaf = 4

  /** Rays after which the SIMD kernel is tried. Compiling it costs about half a second of compiler
    * time and of the thread that tries it; a ray then takes half as long as by scalar code. That
    * breaks even after about this many rays of each thread and kind
    * (docs/decisions/0010-ray-kernels.md).
    */
  private inline val Patience = 100000

  /** Primitive count below which a tree has too few nodes for SIMD to repay its compilation. A room
    * of 36 triangles gains a tenth of the processor time of 21 million samples.
    */
  private inline val Few = 16

  /** Camera samples below which loading and compiling SIMD code costs more than it saves. */
  private inline val Many = 4000000L

  /** Primitive count above which blocks would not fit into one array. */
  private inline val Most = 60000000

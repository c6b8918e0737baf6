package candela.accel.tracing

import candela.accel.{Accelerator, Primitives}
import candela.accel.building.WideBuilder
import candela.base.Parallel

/** Which hierarchy suits a set of primitives and this JVM. */
object Hierarchies:
  def of(primitives: Primitives, parallel: Parallel = Parallel.Alone): Accelerator =
    if primitives.count > Most then Bvh(primitives, parallel = parallel)
    else if hasVectors && primitives.count >= Few then vector(primitives, parallel = parallel)
    else scalar(primitives, parallel = parallel)

  /** Walked in plain Scala alone. */
  def scalar(
      primitives: Primitives,
      width: Int = 4,
      parallel: Parallel = Parallel.Alone
  ): Accelerator =
    WideBvh(WideBuilder.of(primitives, width, 4, MaxLeaf, parallel), ScalarKernel, Int.MaxValue)

  /** Walked by vectors from the given ray on; only if [[hasVectors]]. */
  def vector(
      primitives: Primitives,
      patience: Int = Patience,
      parallel: Parallel = Parallel.Alone
  ): Accelerator =
    val tree = WideBuilder.of(primitives, VectorKernel.width, VectorKernel.lanes, MaxLeaf, parallel)
    WideBvh(tree, VectorKernel, patience)

  private[tracing] def careful(primitives: Primitives): Accelerator =
    WideBvh(WideBuilder.of(primitives, 8, 8, MaxLeaf, Parallel.Alone), CarefulKernel, 0)

  /** Is the JVM's incubating Vector API there (`--add-modules jdk.incubator.vector`), and are this
    * machine's vectors worth it?
    */
  lazy val hasVectors: Boolean =
    ModuleLayer.boot.findModule("jdk.incubator.vector").isPresent && VectorKernel.isWorthIt

  private inline val MaxLeaf = 4

  /** Until vectors are compiled they cost about half a second of a thread that tries them and of
    * the compiler, and then half as much a ray as scalars: about the time that scalars take for
    * this many rays of each thread and kind (docs/decisions/0010-ray-kernels.md).
    */
  private inline val Patience = 100000

  /** A tree of fewer has too few nodes for vectors to make up for being compiled: a room of 36
    * triangles took 2.4 s more of processor time for 4 million samples.
    */
  private inline val Few = 1000

  /** Blocks of more would not fit into one array. */
  private inline val Most = 60000000

package candela.bench.robustness

import candela.accel.{Accelerator, Primitives}
import candela.accel.tracing.Hierarchies
import candela.bench.report.RobustProgram

/** A way to trace rays in Candela.
  *
  * @param create the accelerator of primitives
  */
final case class Kernel(key: String, title: String)(val create: Primitives => Accelerator):
  def program: RobustProgram = RobustProgram(key, title, isOurs = true)

object Kernel:
  /** Those of this JVM. */
  def all: Vector[Kernel] =
    val scalar = Kernel("candela-scalar", "Candela, scalar")(Hierarchies.scalar(_))
    if !Hierarchies.hasVectors then Vector(scalar)
    else
      val lanes = Hierarchies.lanes
      Vector(
        scalar,
        Kernel(s"candela-$lanes", s"Candela, $lanes lanes")(Hierarchies.vector(_, atOnce = true))
      )

  /** Why there are not more. */
  def missing: Vector[(String, String)] =
    val vectors =
      if Hierarchies.hasVectors then Vector.empty
      else Vector("Candela's SIMD kernel" -> "this JVM, or this processor, has no vectors for it")
    vectors :+ ("Candela, 16 lanes" ->
      "no such kernel: a node's 16 children are tested by two vectors of 8, which is faster")

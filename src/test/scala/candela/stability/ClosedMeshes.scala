package candela.stability

import candela.accel.{Accelerator, Primitives}
import candela.accel.tracing.{Bvh, Grid, Hierarchies}
import candela.bench.robustness.{ClosedMesh, LeakingRays}

/** No ray leaves a closed mesh. */
private object ClosedMeshes:

  val cases: Seq[Case] =
    for mesh <- ClosedMesh.all; (by, long, make) <- accelerators yield
      val words = s"no ray leaks from a closed mesh ${mesh.name} ($by)"
      Case.sliced(words, if mesh.isSlow then 1500 else 10000, long, words): trials =>
        Checks.holds(LeakingRays.tally(mesh.accelerator(make), mesh, trials))

  /** The hierarchy that renderings use, of enough triangles to be walked by vectors (where those
    * are) from the 250,000th ray on; the grid; and the hierarchy of two children a node, which is
    * for more triangles than fit into the other one.
    */
  private def accelerators: Seq[(String, Long, Primitives => Accelerator)] = Seq(
    ("bvh", 100_000_000L, Hierarchies.of(_)),
    ("grid", 100_000_000L, Grid(_)),
    ("binary bvh", 10_000_000L, Bvh(_))
  )

package candela.bidirectional

import candela.base.{Parallel, loop}
import candela.film.View
import candela.guiding.{FieldPhotons, GuideField, PhotonField, PhotonFieldBuilder}
import candela.math.*
import candela.sampling.IndependentSampler
import candela.scene.{CasterLearning, Scene}

/** Traces photons that guide the camera's paths: those that arrive where the camera looks by way of
  * specular surfaces, so that light paths can't be connected to it. Depends on the scene and its
  * camera alone.
  */
private final class AimingPhotons(scene: Scene, view: View, light: CausticLight, pool: Parallel):
  import AimingPhotons.*
  private val places = SeenPlaces(scene, view, light, pool, CameraPaths, onlyBehind = true)

  private val aimed: Option[CausticLight] =
    val learning = if places.isEmpty then CasterLearning() else places.learn()
    Option.unless(learning.isEmpty):
      light.copy(casters = light.casters.aimed(learning.aim), findsAll = false)

  /** The field, if there are such photons; it is the same for any pool.
    *
    * @param paths light paths
    */
  def trace(paths: Int): Option[PhotonField] = aimed.flatMap: by =>
    val aside = Math.sqrt(light.casters.area / paths).toFloat
    val parts = pool.map(Tasks)(i => Tracer(by, aside).part(i * paths / Tasks, paths / Tasks))
    val all = FieldPhotons()
    for part <- parts do all.append(part)
    Option.when(all.count > 0)(PhotonFieldBuilder(all, pool).result())

  /** @param aside distance by which neighbours of paths are moved */
  private final class Tracer(light: CausticLight, aside: Float):
    private val paths = light.photonPaths(scene, within = null)
    private val sampler = IndependentSampler(1, Seed)
    private val p1, w1, p2, w2 = MutableVec3()

    def part(first: Int, count: Int): FieldPhotons =
      val photons = FieldPhotons()
      loop(count)(i => add(first + i, photons))
      photons

    private def add(k: Int, to: FieldPhotons): Unit =
      trace(k, 0f, 0f)
      if paths.count > 0 then
        val vertex = paths(0)
        val power = vertex.throughput.average
        if power > 0f && power < Float.PositiveInfinity && places.contains(vertex.at.p) then
          val edges = vertex.edges
          to.add(vertex.at.p, vertex.from, sideOf(vertex), power)
          val isFound = arrives(k, edges, aside, 0f, p1, w1) && arrives(k, edges, 0f, aside, p2, w2)
          if isFound then to.bend(p1, w1, p2, w2)

    private def trace(k: Int, aside: Float, across: Float): Unit =
      sampler.start(k, 0, 0)
      val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
      paths.trace(time, sampler, aside, across)

    /** Where its neighbour arrives, if it goes the same way. */
    private def arrives(
        k: Int,
        edges: Int,
        aside: Float,
        across: Float,
        p: MutableVec3,
        w: MutableVec3
    ): Boolean =
      trace(k, aside, across)
      paths.count > 0 && {
        val vertex = paths(0)
        p.set(vertex.at.p)
        w.set((vertex.from - vertex.at.p).normalized)
        vertex.edges == edges
      }

    private def sideOf(vertex: PathVertex): Int =
      if vertex.isInMedium then GuideField.Medium
      else
        val n = vertex.at.frame.n
        GuideField.side(if vertex.localWo.z < 0f then -n else n)

private object AimingPhotons:
  inline val CameraPaths = 1 << 14

  /** Number of parallel tasks that trace the light paths; results do not depend on threads. */
  inline val Tasks = 64
  inline val Seed = 0xa1d

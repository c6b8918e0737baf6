package candela.build.lights

import candela.build.recipe.*
import candela.build.shapes.EmitterHoles
import candela.lights.Light
import candela.shapes.{TriangleSampler, TriangleSoup}

/** The lights of an emitting mesh, to be.
  *
  * @param first of its triangles
  * @param light number of the first triangle's light
  */
private[build] final case class MeshLights(
    plan: AreaLightPlan,
    holes: EmitterHoles,
    first: Int,
    count: Int,
    light: Int,
    site: Site
):
  /** The lights with their numbers. */
  def of(triangles: TriangleSoup): Seq[(Light, Int)] =
    val samplers = Vector.tabulate(count)(k => TriangleSampler(triangles, first + k))
    val flat = samplers.count(s => !(s.area > 0f))
    if flat > 0 then
      site.warn(s"$flat of $count triangles of this light have no area: they emit nothing")
    samplers.zipWithIndex.map((s, k) => (holes.light(plan.ofTriangle(s), s), light + k))

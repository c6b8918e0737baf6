package candela.scene

import candela.accel.Instances
import candela.geometry.{Hit, Ray, ShadingPoint}

/** The instances of a scene, with what their objects look like.
  *
  * @param objects surfaces of each object, as `instances` numbers them
  */
final class Instanced(val objects: Array[Surfaces], val instances: Instances):

  /** Works out the geometry of a hit on instance `i`, in world space. */
  def fill(i: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    objects(instances.objectOf(i)).fill(hit.inner, instances.enter(i, ray), hit, at)
    instances.locate(i, ray, at)

  /** For the plan. */
  def describe: String =
    if instances.count == 0 then "none"
    else
      val triangles = objects.map(_.soup.count.toLong).sum
      val others = objects.map(_.solids.length).sum
      val solids = if others == 0 then "" else s" and $others other shapes"
      val moving = if instances.moving == 0 then "" else s", ${instances.moving} of them moving"
      s"${instances.count} of ${objects.length} objects with $triangles triangles$solids$moving"

object Instanced:
  val None: Instanced = Instanced(Array.empty, Instances.None)

package candela.scene

import candela.accel.{Instances, Masks, Primitives}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.shapes.TriangleSoup

/** Geometry and appearance of one accelerator's primitives: those of the world, or of an instanced
  * object.
  *
  * @param masks alpha cutouts, where rays of all kinds miss the surface
  * @param veils masks with openings that paths pass and light samples do not, as Mitsuba's; rays
  *              hit them
  */
final class Surfaces(
    val soup: TriangleSoup,
    val solids: ShapeTable,
    val masks: Masks = Masks.Empty,
    val veils: Masks = Masks.Empty
):
  def count: Int = soup.count + solids.count

  /** Index of the primitive's mesh or, behind the meshes, of its shape. */
  def partOf(primitive: Int): Int =
    if primitive < soup.count then soup.meshOf(primitive)
    else soup.meshes.length + primitive - soup.count

  /** Does the ray meet an opening of a veil at this point of `primitive`? Requires veils. */
  def isOpen(primitive: Int, ray: Ray, at: ShadingPoint): Boolean =
    val veil =
      if primitive < soup.count then veils.ofMesh(soup.meshOf(primitive))
      else veils.ofShape(primitive - soup.count)
    veil.isHole(at, ray, primitive, shadow = false)

  def partCount: Int = soup.meshes.length + solids.count

  /** The primitives to build an accelerator from: these surfaces, and `instances` of others. */
  def primitives(instances: Instances = Instances.Empty): Primitives =
    Primitives(soup, solids.groups, instances, masks)

  /** Computes the geometry of the hit on `primitive`, in the space of these surfaces. */
  def fill(primitive: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    if primitive < soup.count then soup.surface(primitive, hit, at)
    else
      val i = primitive - soup.count
      solids.groups(i).surface(i, ray, hit, at)
      at.material = solids.material(i)
      at.areaLight = solids.light(i)
      if solids.isInverted(i) then at.invert()

/** The instances of a scene, with the surfaces of their objects.
  *
  * @param objects surfaces of each object, in the numbering of `instances`
  */
final class Instanced(val objects: Array[Surfaces], val instances: Instances):

  /** Computes the geometry of a hit on instance `i`, in world space. */
  def fill(i: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    objects(instances.objectOf(i)).fill(hit.inner, instances.enter(i, ray), hit, at)
    instances.locate(i, ray, at)

  val hasVeils: Boolean = objects.exists(!_.veils.isEmpty)

  /** Does the ray, which just hit instance `i`, meet an opening of a veil? */
  def isOpen(i: Int, ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    val surfaces = objects(instances.objectOf(i))
    !surfaces.veils.isEmpty && surfaces.isOpen(hit.inner, ray, at)

  /** Computes the geometry of a hit at the ray's time, as it is at `time`, in world space. */
  def fillAt(i: Int, ray: Ray, hit: Hit, time: Float, at: ShadingPoint): Unit =
    objects(instances.objectOf(i)).fill(hit.inner, instances.enter(i, ray), hit, at)
    val oldTime = ray.time
    ray.time = time
    val _ = instances.enter(i, ray)
    instances.locate(i, ray, at)
    ray.time = oldTime

  /** Summary for the render plan. */
  def describe: String =
    if instances.count == 0 then "none"
    else
      val triangles = objects.map(_.soup.count.toLong).sum
      val solidCount = objects.map(_.solids.count).sum
      val solids = if solidCount == 0 then "" else s" and $solidCount other shapes"
      val moving = if instances.moving == 0 then "" else s", ${instances.moving} of them moving"
      s"${instances.count} of ${objects.length} objects with $triangles triangles$solids$moving"

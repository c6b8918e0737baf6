package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.guiding.Guide
import candela.layers.LightParts
import candela.sampling.Sampler
import candela.scene.Scene

/** Guides the paths that the guide takes, and leaves the others to the integrator that would follow
  * them without it, at its speed.
  *
  * @param guided,plain make the two integrators of a worker, which divide light in the same place
  */
final class PartlyGuided(
    scene: Scene,
    guide: Guide,
    guided: (Scene, LightParts | Null) => Integrator,
    plain: (Scene, LightParts | Null) => Integrator
) extends SceneIntegrator(scene):
  private val parts = scene.lightGroups.map(LightParts(_)).orNull
  private val itsGuided = guided(scene, parts)
  private val itsPlain = plain(scene, parts)
  private var last = itsPlain

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    last = if guide.pass.includes(ray.origin, ray.direction) then itsGuided else itsPlain
    last.radiance(ray, sampler)

  def raysTraced: Long = itsGuided.raysTraced + itsPlain.raysTraced
  override def lastMaterial: Int = last.lastMaterial
  override def lightParts: LightParts | Null = parts
  protected def over(scene: Scene): PartlyGuided = PartlyGuided(scene, guide, guided, plain)

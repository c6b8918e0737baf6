package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.geometry.Ray
import candela.guiding.Guide
import candela.sampling.Sampler
import candela.scene.Scene

/** Guides the paths that the guide takes, and leaves the others to the integrator that would follow
  * them without it, at its speed.
  *
  * @param guided,plain make the two integrators, which divide light in the same place
  */
final class PartlyGuided(
    scene: Scene,
    guide: Guide,
    guided: (LightParts | Null) => Integrator,
    plain: (LightParts | Null) => Integrator
) extends Integrator:
  private val dividedLight = scene.lightGroups.map(LightParts(_)).orNull
  private val itsGuided = guided(dividedLight)
  private val itsPlain = plain(dividedLight)
  private var last = itsPlain

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    last = if guide.pass.includes(ray.origin, ray.direction) then itsGuided else itsPlain
    last.radiance(ray, sampler)

  def raysTraced: Long = itsGuided.raysTraced + itsPlain.raysTraced
  override def lastMaterial: Int = last.lastMaterial
  override def lightParts: LightParts | Null = dividedLight

package candela.aov

import candela.bsdf.{Bsdf, DirectionalAlbedo}
import candela.color.Rgb
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.scene.Scene

/** The first surface that is not perfectly specular, seen through mirrors and glass. A fixed
  * sequence chooses between reflection and transmission, so that the layers made of it have little
  * noise. Mutable, one per worker.
  *
  * Source of what to take: "Open Image Denoise", documentation, §"Albedos" and §"Normals".
  */
private[aov] final class SpecularView(scene: Scene):
  private val ray = Ray()
  private val hit = Hit()
  private var hasSurface = false
  private var color = Rgb.Black
  private val normal = MutableVec3()

  val point: ShadingPoint = scene.newPoint()

  /** False if the path escaped from the scene, or ended in specular surfaces. */
  def isHit: Boolean = hasSurface

  /** Albedo of that surface, times the weight of the path. */
  def albedo: Rgb = color

  /** Its shading normal, towards the path. */
  def n: MutableVec3 = normal

  /** Follows the specular path from its first surface. */
  def follow(from: Ray, start: ShadingPoint, startWo: Vec3, first: Bsdf, sample: Int): Unit =
    ray.time = from.time
    ray.differential.isKnown = false
    hasSurface = false
    color = Rgb.White
    var (place, wo, bsdf) = (start, startWo, first)
    var depth = 0
    var goesOn = true
    while goesOn do
      val step = bsdf.sampleSpecular(place.frame.toLocal(wo), SpecularView.choice(sample, depth))
      color = color * step.weight
      val wi = place.frame.toWorld(step.wi)
      depth += 1
      if color.isBlack || depth > SpecularView.MaxDepth then goesOn = false
      else
        ray.set(place.offsetOrigin(wi), wi, Float.PositiveInfinity)
        goesOn = scene.closestBehindInterfaces(ray, hit, point)
        if goesOn then
          place = point
          wo = -wi
          bsdf = scene.bsdf(point)
          if !bsdf.isSpecular then
            goesOn = false
            hasSurface = true
            color = color * DirectionalAlbedo(bsdf, point.frame.toLocal(wo))
            normal.set(point.frame.n.facing(wo))

private object SpecularView:
  private val MaxDepth = 8

  /** Of the bounce `depth` of sample `i`. Source: Roberts, "The Unreasonable Effectiveness of
    * Quasirandom Sequences", 2018: the golden ratio.
    */
  private def choice(i: Int, depth: Int): Float =
    val x = 0.5 + (i + 1.0) * Math.pow(0.6180339887498949, depth + 1.0)
    belowOne((x - Math.floor(x)).toFloat)

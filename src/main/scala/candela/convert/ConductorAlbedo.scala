package candela.convert

import candela.base.loop
import candela.bsdf.Fresnel
import candela.color.Rgb
import candela.math.sqrt

/** Reflectance of a smooth conductor in light from all sides. */
private[convert] object ConductorAlbedo:

  /** Of an index of refraction. */
  def ofIndex(eta: Rgb, k: Rgb): Rgb =
    Rgb(mean(eta.r, k.r), mean(eta.g, k.g), mean(eta.b, k.b))

  /** The reflectance at normal incidence for which pbrt-v4's conductor has this albedo: it takes an
    * index of 1 and the absorption that follows.
    *
    * @param albedo in [0, 1]; less than the least possible gives 0
    */
  def normal(albedo: Float): Float =
    var (low, high) = (0f, 1f)
    loop(Halvings): _ =>
      val r = (low + high) / 2
      if mean(1f, 2 * sqrt(r) / sqrt(1 - r)) < albedo then low = r else high = r
    (low + high) / 2

  def mean(eta: Float, k: Float): Float =
    var sum = 0.0
    loop(Steps): i =>
      val cos = (i + 0.5f) / Steps
      sum += cos * Fresnel.conductor(cos, eta, k)
    (2 * sum / Steps).toFloat

  private val Halvings = 20
  private val Steps = 100

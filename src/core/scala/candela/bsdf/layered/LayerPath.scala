package candela.bsdf.layered

import candela.bsdf.{Fresnel, Hemisphere}
import candela.bsdf.microfacet.{RoughDielectric, TrowbridgeReitz}
import candela.color.Rgb
import candela.math.*
import candela.sampling.SampleHash

/** A random walk between the base and the outer interface of a layered surface. Mutable; local to
  * one evaluation.
  *
  * @param seed seed of all its random numbers
  */
private[bsdf] final class LayerPath(layers: Layers, seed: Long):
  private val top = layers.top
  private val ownW = MutableVec3()
  private var counter = SampleHash.mix64(seed)

  var throughput: Rgb = Rgb.White

  /** Direction of propagation: upwards if z > 0; zero once the walk has ended. */
  def w: MutableVec3 = ownW
  def w_=(v: Vec3): Unit = ownW.set(v)

  /** Height above the base, in mean free paths. */
  var height: Float = layers.thickness

  /** The pdf with which `scatterAtBase` sampled `w`. */
  var basePdf: Float = 0f

  /** Whether all scattering events so far were specular. */
  var isSpecular: Boolean = top.isSmooth

  def next(): Float =
    counter += SampleHash.Step
    SampleHash.toUnit((SampleHash.mix64(counter) >>> 32).toInt)

  def isOver: Boolean = w.z == 0f || throughput.isBlack

  /** Enters through the outer interface. */
  def start(below: Vec3, weight: Float): Unit =
    w = below
    throughput = Rgb.gray(weight)
    height = layers.thickness

  /** Advances to the next event: [[LayerPath.Base]], [[LayerPath.Top]] or [[LayerPath.Medium]]. */
  def advance(): Int =
    val isUpward = w.z > 0f
    val event = if isUpward then LayerPath.Top else LayerPath.Base
    if layers.isClear then
      throughput = throughput * layers.attenuation(layers.thickness, w)
      height = if isUpward then layers.thickness else 0f
      event
    else
      val far = -log(1f - next()) * w.z
      val reached = height + far
      if reached > 0f && reached < layers.thickness then
        height = reached
        LayerPath.Medium
      else
        height = if isUpward then layers.thickness else 0f
        event

  def scatterAtBase(u1: Float, u2: Float): Unit =
    val sampled = layers.base.sample(-w, next(), u1, u2)
    if sampled.pdf > 0f then
      throughput = throughput * sampled.weight
      basePdf = if sampled.isSpecular then Float.PositiveInfinity else sampled.pdf
      isSpecular = isSpecular && sampled.isSpecular
      w = sampled.wi
    else w = Vec3.Zero

  def scatterInMedium(): Unit =
    isSpecular = false
    w = layers.phase.sample(-w, next(), next()).normalized

  /** Continues with the reflection at the outer interface, weighted by its reflectance. */
  def reflectAtTop(): Unit =
    val o = inside
    val m = top.facet(o, next(), next())
    reflect(o, m, Fresnel.dielectric(Math.max(o dot m, 0f), 1f / top.eta))

  /** Reflects at the outer interface, or transmits and returns the outgoing direction; zero if
    * reflected.
    */
  def scatterAtTop(): Vec3 =
    val o = inside
    val m = top.facet(o, next(), next())
    if next() < Fresnel.dielectric(Math.max(o dot m, 0f), 1f / top.eta) then
      reflect(o, m, 1f)
      Vec3.Zero
    else
      val i = top.refracted(o, m, 1f / top.eta)
      w = Vec3.Zero
      if i.isZero then i
      else
        throughput = throughput * top.weight(o, i, m)
        Hemisphere.flipped(i)

  /** Reverse direction of propagation, in a frame whose upper hemisphere is the inside. */
  private def inside: Vec3 = Vec3(-w.x, -w.y, w.z)

  private def reflect(o: Vec3, m: Vec3, fraction: Float): Unit =
    val i = top.reflected(o, m)
    w = Hemisphere.flipped(i)
    if !i.isZero then throughput = throughput * (fraction * top.weight(o, i, m))

  /** Russian roulette, after more than 3 events and below a throughput of 0.25. */
  def roulette(events: Int): Unit =
    val survival = throughput.max
    if events > 3 && survival < 0.25f then
      if next() < survival then throughput = throughput * (1f / survival) else w = Vec3.Zero

private[bsdf] object LayerPath:
  inline val Base = 0
  inline val Top = 1
  inline val Medium = 2

/** The interface of a layered surface, seen from either side.
  *
  * Directions are in a frame in which the side of `o` is above: `o.z` ≥ 0. `relative` is the index
  * beyond the interface over that on the side of `o`. Quantities are powers, not radiances: those
  * differ by the square of the index, which cancels for a path that exits again.
  *
  * @param eta index of refraction inside over that outside; greater than 0
  */
private[bsdf] final class Boundary(val distribution: TrowbridgeReitz, val eta: Float):

  /** Without a change of index, light passes unrefracted at any roughness. */
  val isSmooth: Boolean = distribution.isSmooth || eta == 1f

  /** Samples a microfacet visible from `o`. */
  def facet(o: Vec3, u1: Float, u2: Float): Vec3 =
    if isSmooth then Vec3.Z else distribution.sample(o, u1, u2)

  /** Masking-shadowing weight of a sampled microfacet that scatters `o` to `i`. */
  def weight(o: Vec3, i: Vec3, m: Vec3): Float =
    if isSmooth then 1f else distribution.sampleWeight(o, i, m)

  /** Refracts `o` at the microfacet, to z < 0; zero if impossible. */
  def refracted(o: Vec3, m: Vec3, relative: Float): Vec3 =
    val cosM = o dot m
    val cosT = if cosM > 0f then Fresnel.cosRefracted(cosM, relative) else -1f
    if cosT <= 0f then Vec3.Zero
    else
      val i = Fresnel.refracted(o, m, cosM, cosT, relative)
      if i.z < 0f then i else Vec3.Zero

  /** Reflects `o` at the microfacet; zero if impossible. */
  def reflected(o: Vec3, m: Vec3): Vec3 =
    val cosM = o dot m
    if cosM <= 0f then Vec3.Zero
    else
      val i = Hemisphere.reflected(o, m, cosM)
      if i.z > 0f then i else Vec3.Zero

  /** The BTDF of the rough interface for power, without the cosine: the transmitted value times the
    * square of the index.
    */
  def crossing(o: Vec3, i: Vec3): Float =
    val m = RoughDielectric.facet(o, i, eta)
    if m.isZero then 0f
    else
      val passed = 1f - Fresnel.dielectric(o dot m, eta)
      val spread = 4f * (o dot m) * RoughDielectric.jacobian(o, i, m, eta)
      passed * distribution.d(m) * distribution.visibility(o, i, m) * spread

  /** The pdf of `i`, per solid angle, for microfacets sampled for `o` that refract. */
  def crossingPdf(o: Vec3, i: Vec3): Float =
    val m = RoughDielectric.facet(o, i, eta)
    if m.isZero then 0f
    else distribution.pdf(o, m) * RoughDielectric.jacobian(o, i, m, eta)

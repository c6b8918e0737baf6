package candela.integrators

import candela.bsdf.Bssrdf
import candela.color.{MutableRgb, Rgb}
import candela.geometry.Ray
import candela.guiding.{Guide, GuideMixture, GuidePath, GuideRecords}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** A [[Walk]] that samples directions from BSDFs and from what earlier paths have learnt, and
  * records what it finds. Specular directions, those through the surface, and those that the BSDF
  * would not sample, are left to it.
  *
  * Each direction is weighted by the density of both ways of sampling it. That of BSDF sampling may
  * be approximate, if it is the same for both: it only weighs them.
  */
final class GuidedWalk(
    scene: Scene,
    volumes: VolumeMarch | Null,
    options: WalkOptions,
    guide: Guide
) extends Walk(scene, volumes, options = options):
  import GuidedWalk.*
  private val path = GuidePath()
  private var lesson = guide.lesson
  private var part: GuideRecords.Part | Null = lesson.newPart()
  private val mixture = GuideMixture()
  private val tally = guide.newTally()

  /** The throughput that BSDF sampling of the same path would have. */
  private val unguided = MutableRgb()

  /** Density of the path over that of BSDF sampling. */
  private var ratio = 1f

  // Of the vertex: is it guided or recorded?
  private var isKept = false
  private var isFitted = false
  private var share = 1f
  private val wi, localWi, normal = MutableVec3()
  private var region = -1

  /** Light that paths like this one find on average, as the region of its first event knows it; 0:
    * not known.
    */
  private var whole = 0f

  /** Has the field decided at this vertex whether the path ends? */
  private var isExpected = false

  override def begin(cameraRay: Ray, sampler: Sampler): Unit =
    super.begin(cameraRay, sampler)
    if lesson ne guide.lesson then
      lesson = guide.lesson
      part = lesson.newPart()
    path.clear()
    unguided.set(Rgb.White)
    ratio = 1f
    whole = 0f

  override def evaluate(): Unit =
    super.evaluate()
    val field = lesson.field
    isKept = (part != null || field.guides) && !vertex.bsdf.isSpecular
    isFitted = false
    share = 1f
    region = -1
    if isKept then
      val n = vertex.at.frame.n
      if vertex.localWo.z < 0f then normal.set(-n.x, -n.y, -n.z) else normal.set(n)
      region = mixture.region(field, vertex.at.p, normal)
      share = if ratio < LeastRatio then 1f else field.shares(region)
      isFitted = field.isFitted(region)
      isKept = part != null || share < 1f
      if isKept && isFitted then mixture.locate(field, region, vertex.at.p)

  override def emerge(inside: Bssrdf, sampler: Sampler): Boolean =
    isKept = false
    region = -1
    share = 1f
    super.emerge(inside, sampler)

  override def scatterPdf(local: Vec3): Float =
    val byBsdf = vertex.localPdf(local)
    if share == 1f || byBsdf == 0f then byBsdf
    else share * byBsdf + (1f - share) * fieldPdf(local, light.wi)

  /** Density of the field's directions. */
  private def fieldPdf(local: Vec3, world: Vec3): Float =
    if vertex.crosses(local) then 0f else mixture.pdf(world)

  override def finish(): Unit =
    val to = part
    if to != null then path.record(radiance.toRgb.average, to)

  override def scatter(sampler: Sampler): Unit =
    if !vertex.bsdf.isSpecular then tally.bounces += 1
    endOrGoOn(sampler)
    if !isKept then
      super.scatter(sampler)
      unguided.scale(vertex.bounce.weight)
    else
      val choice = sampler.next1D()
      sampler.next2D()
      if share < 1f then tally.guided += 1
      if choice < share then scatterByBsdf(Math.min(choice / share, LargestBelowOne), sampler)
      else scatterByField(sampler)

  private def scatterByBsdf(choice: Float, sampler: Sampler): Unit =
    val bounce = vertex.bounce
    vertex.bsdf.draw(vertex.localWo, choice, sampler.x, sampler.y, bounce)
    // The density of the draw may be that of its random walk only
    val byBsdf =
      if bounce.isSpecular || bounce.pdf == 0f then 0f else vertex.localPdf(bounce.wi)
    if byBsdf == 0f then
      unguided.scale(bounce.weight)
      if share < 1f then
        ratio *= share
        bounce.set(
          bounce.wi,
          bounce.weight * (1f / share),
          bounce.pdf,
          bounce.isSpecular,
          bounce.eta
        )
      throughput.scale(bounce.weight)
    else
      vertex.at.frame.toWorld(bounce.wi, wi)
      take(byBsdf, bounce.weight * byBsdf)

  private def scatterByField(sampler: Sampler): Unit =
    mixture.sample(sampler.x, sampler.y, wi)
    vertex.at.frame.toLocal(wi, localWi)
    val byBsdf = if vertex.crosses(localWi) then 0f else vertex.localPdf(localWi)
    if byBsdf == 0f then
      vertex.bounce.absorb()
      throughput.scale(vertex.bounce.weight)
    else
      vertex.bounce.set(localWi, Rgb.Black, byBsdf, isSpecular = false)
      take(byBsdf, vertex.bsdf.f(vertex.localWo, localWi) * Math.abs(localWi.z))

  /** Goes on in the direction `wi`, which is also that of the bounce.
    *
    * @param value f·|cos|, or an estimate of it
    */
  private def take(byBsdf: Float, value: Rgb): Unit =
    val bounce = vertex.bounce
    val byField = if isFitted then fieldPdf(bounce.wi, wi) else 0f
    val pdf = share * byBsdf + (1f - share) * byField
    val before = throughput.toRgb.average
    bounce.set(bounce.wi, value * (1f / pdf), pdf, isSpecular = false, bounce.eta)
    throughput.scale(bounce.weight)
    unguided.scale(value * (1f / byBsdf))
    ratio *= pdf / byBsdf
    val to = part
    if to != null && before > 0f && !vertex.crosses(bounce.wi) then
      to.saw(region)
      path.add(
        vertex.at.p, normal, wi, radiance.toRgb.average, before, pdf, byBsdf, byField, ratio
      )

  /** Russian roulette by what the field expects the path to find: relative to what camera paths
    * find where this one began, so that all paths that go on contribute about as much.
    *
    * Light through the surface is not in the field: there, and where it knows nothing,
    * [[roulette]] decides.
    *
    * Source: Vorba, Křivánek, "Adjoint-Driven Russian Roulette and Splitting in Light Transport
    * Simulation", SIGGRAPH 2016; the image's estimate is that of the first region.
    */
  private def endOrGoOn(sampler: Sampler): Unit =
    isExpected = false
    if region >= 0 then
      val field = lesson.field
      val expected = field.scattered(region)
      if whole == 0f then whole = field.whole(region) * throughput.toRgb.average
      else if expected > 0f && !vertex.bsdf.isTransmissive then
        isExpected = true
        val u = sampler.next1D()
        val survival = Expectation * throughput.toRgb.average * expected / whole
        if survival < 1f then
          val q = Math.max(LeastSurvival, survival)
          val factor = if u < q then 1f / q else 0f
          throughput.scale(factor)
          unguided.scale(factor)

  /** Russian roulette by the throughput of BSDF sampling. That of a guided path is small where
    * paths are many because much light comes from there: it must not end them.
    */
  override def roulette(threshold: Float, sampler: Sampler): Unit =
    val factor =
      if isExpected then 1f
      else LightTransport.roulette(unguided.largest * etaScale, threshold, sampler)
    throughput.scale(factor)
    unguided.scale(factor)
    goesOn = !throughput.isBlack

private object GuidedWalk:
  /** A path goes on if what it is expected to add is at least the average light of such paths over
    * this; else with a probability in proportion, but with the least one.
    */
  inline val Expectation = 3f
  inline val LeastSurvival = 0.1f

  inline val LargestBelowOne = 0.99999994f

  /** Paths that are as much rarer than by BSDF sampling are guided no further: it bounds how much
    * their light counts.
    */
  inline val LeastRatio = 0.1f

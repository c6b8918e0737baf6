package candela.integrators

import candela.geometry.Ray
import candela.guiding.*
import candela.math.*
import candela.sampling.Sampler

/** Samples directions at the vertices of a path from BSDFs and from what earlier paths have learnt,
  * and records what the path finds. Specular directions, those through a surface, and those that
  * the BSDF would not sample, are left to it. Mutable, one per worker.
  *
  * BSDF and field are combined by the one-sample balance heuristic. Its weights need only sum to 1,
  * so the BSDF's density may be approximate, as for layered BSDFs, if both techniques use the same
  * one.
  *
  * Throughputs and light are averages of the colours.
  *
  * @param vertex where the path is
  */
private[integrators] final class Guidance(guide: Guide, vertex: SurfaceVertex):
  import Guidance.*
  private val path = GuidePath()
  private var pass = guide.pass
  private var ownPart: GuideRecords.Part | Null = pass.newPart()

  /** Where the path records; null: nowhere. */
  private var buffer = ownPart
  private val mixture = GuideMixture()
  private val tally = guide.newTally()

  /** Density of the path over that of BSDF sampling: its throughput times this is the one that BSDF
    * sampling of the same path would have.
    */
  private var ratio = 1f

  /** Product of the numbers of branches that were expected, below one where roulette was played;
    * and of those above one.
    */
  private var chances, splits = 1f

  // Of the vertex: is it guided or recorded?
  private var isGuidedOrRecorded = false
  private var isFitted = false
  private var bsdfProbability = 1f

  private val wi, localWi = MutableVec3()
  private var side, region = -1

  /** Light that paths like this one find on average, as the region of its first event knows it; 0:
    * not known.
    */
  private var measurement = 0f

  /** Has the field decided at this vertex whether the path ends? */
  private var fieldDecidesRoulette = false

  private val points = BranchPoints()

  /** In how many branches does the path leave the vertex, if it goes on? */
  def branches: Int = Math.max(1, points.count)

  /** Keeps what is known of the branch. */
  def store(to: BranchState): Unit =
    to.ratio = ratio
    to.chances = chances
    to.splits = splits
    to.measurement = measurement
    to.lastEvent = path.lastEvent

  /** Keeps where the random numbers of a branch go on. */
  def keepPosition(branch: Int, to: BranchState): Unit = to.position = points.position(branch)

  /** Goes on with another branch, after so much radiance in all. */
  def follow(from: BranchState, radianceSoFar: Float): Unit =
    ratio = from.ratio
    chances = from.chances
    splits = from.splits
    measurement = from.measurement
    path.follow(from.lastEvent, radianceSoFar)

  /** Starts a path with a camera ray. */
  def startPath(ray: Ray): Unit =
    if pass ne guide.pass then
      pass = guide.pass
      ownPart = pass.newPart()
    buffer = if pass.learnsFrom(ray.origin, ray.direction) then ownPart else null
    path.clear()
    ratio = 1f
    chances = 1f
    splits = 1f
    measurement = 0f

  /** The vertex has its BSDF. */
  def arrive(): Unit =
    val field = pass.field
    skipVertex()
    path.step()
    isGuidedOrRecorded = (buffer != null || field.guides) && !vertex.bsdf.isSpecular
    if isGuidedOrRecorded then
      side =
        if vertex.isInMedium then GuideField.Medium
        else
          GuideField.side(if vertex.localWo.z < 0f then -vertex.point.frame.n
          else vertex.point.frame.n)
      region = mixture.region(field, vertex.point.p, side)
      bsdfProbability = if ratio < MinDensityRatio then 1f else field.bsdfProbabilities(region)
      isFitted = field.isFitted(region)
      isGuidedOrRecorded = buffer != null || bsdfProbability < 1f
      if isGuidedOrRecorded && isFitted then mixture.locate(field, region, vertex.point.p)

  /** The vertex is neither guided nor recorded. */
  def skipVertex(): Unit =
    isGuidedOrRecorded = false
    isFitted = false
    region = -1
    bsdfProbability = 1f

  /** Density of the directions that are taken. */
  def pdf(local: Vec3, world: Vec3, byBsdf: Float): Float =
    if bsdfProbability == 1f || byBsdf == 0f then byBsdf
    else bsdfProbability * byBsdf + (1f - bsdfProbability) * fieldPdf(local, world)

  /** Density of the field's directions. */
  private def fieldPdf(local: Vec3, world: Vec3): Float =
    if crosses(local) then 0f else mixture.pdf(world)

  private def crosses(local: Vec3) = !vertex.isInMedium && vertex.crosses(local)

  /** The path is over, and found `light` in all. */
  def finish(light: Float): Unit =
    val to = buffer
    if to != null then path.record(light, to)

  /** Samples a direction: the vertex' bounce. One coordinate of the point also chooses between BSDF
    * and field, so that evenly spread points give evenly spread directions of both.
    *
    * @param throughput    before it
    * @param radianceSoFar in all branches
    * @param branch        whose point is taken
    */
  def scatter(throughput: Float, radianceSoFar: Float, branch: Int): Unit =
    if throughput == 0f then vertex.bounce.absorb()
    else if !isGuidedOrRecorded then
      if !vertex.bsdf.isSpecular then tally.bounces += 1
      vertex.draw(points.choice(branch), points.x(branch), points.y(branch))
    else
      tally.bounces += 1
      if bsdfProbability < 1f then tally.guided += 1
      val x = points.x(branch)
      val y = points.y(branch)
      val byBsdf =
        if x < bsdfProbability then
          drawBsdf(points.choice(branch), belowOne(x / bsdfProbability), y)
        else drawField(belowOne((x - bsdfProbability) / (1f - bsdfProbability)), y)
      if byBsdf > 0f then weighDirection(byBsdf, throughput, radianceSoFar)

  /** @return the BSDF's density of the direction; 0: the bounce is as it shall be */
  private def drawBsdf(choice: Float, x: Float, y: Float): Float =
    val bounce = vertex.bounce
    vertex.bsdf.draw(vertex.localWo, choice, x, y, bounce)
    // The density of the draw may be that of its random walk only
    val byBsdf =
      if bounce.isSpecular || bounce.pdf == 0f then 0f else vertex.localPdf(bounce.wi)
    if byBsdf > 0f then
      vertex.point.frame.toWorld(bounce.wi, wi)
      bounce.scale(byBsdf)
    else if bsdfProbability < 1f then
      ratio *= bsdfProbability
      bounce.scale(1f / bsdfProbability)
    byBsdf

  /** Likewise. */
  private def drawField(x: Float, y: Float): Float =
    mixture.sample(x, y, wi)
    vertex.point.frame.toLocal(wi, localWi)
    val byBsdf = if crosses(localWi) then 0f else vertex.localPdf(localWi)
    if byBsdf == 0f then vertex.bounce.absorb()
    else
      val cosine = if vertex.isInMedium then 1f else Math.abs(localWi.z)
      val value = vertex.bsdf.f(vertex.localWo, localWi) * cosine
      vertex.bounce.set(localWi, value, byBsdf, isSpecular = false)
    byBsdf

  /** Goes on in the direction `wi`, which is also that of the bounce, whose weight is f·|cos|, or
    * an estimate of it.
    */
  private def weighDirection(byBsdf: Float, throughput: Float, radianceSoFar: Float): Unit =
    val bounce = vertex.bounce
    val byField = if isFitted then fieldPdf(bounce.wi, wi) else 0f
    val pdf = bsdfProbability * byBsdf + (1f - bsdfProbability) * byField
    bounce.set(bounce.wi, bounce.weight * (1f / pdf), pdf, isSpecular = false, bounce.eta)
    ratio *= pdf / byBsdf
    val to = buffer
    if to != null && !crosses(bounce.wi) then
      to.countEvent(region)
      path.add(
        region,
        vertex.point.p,
        side,
        wi,
        radianceSoFar,
        throughput,
        pdf,
        byBsdf,
        byField,
        ratio * chances
      )

  /** Russian roulette and splitting by what the field expects the path to find, relative to what
    * camera paths find where this one began: as many [[branches]] go on from here as reduce the
    * variance of the image most for what they cost. Draws their points.
    *
    * Light through the surface is not in the field: there, and where it knows nothing,
    * the path's own roulette decides.
    *
    * Sources: Vorba, Křivánek, "Adjoint-Driven Russian Roulette and Splitting in Light Transport
    * Simulation", SIGGRAPH 2016; Rath et al., "EARS: Efficiency-Aware Russian Roulette and
    * Splitting", SIGGRAPH 2022, with second moments everywhere; the image's estimate is that of the
    * first region.
    *
    * @return factor of the throughput
    */
  def rouletteOrSplit(throughput: Float, sampler: Sampler): Float =
    val n = expectedBranches(throughput)
    points.draw(n, vertex.bsdf.choosesLobes, sampler)
    if points.count == 0 then 0f else 1f / n

  /** Branches in which the path leaves on average; one where the field does not know. */
  private def expectedBranches(throughput: Float): Float =
    fieldDecidesRoulette = false
    if region < 0 then 1f
    else
      val field = pass.field
      val factor = field.splittingFactors(region)
      if measurement == 0f then measurement = field.measurements(region) * throughput
      val transmits = !vertex.isInMedium && vertex.bsdf.isTransmissive
      if factor == 0f || measurement == 0f || transmits then 1f
      else if throughput.isNaN then 1f // a lost path: its sample is discarded
      else
        fieldDecidesRoulette = true
        val maxBranches = Math.min(BranchPoints.MaxBranches.toFloat, MaxBranchesOfPath / splits)
        val n = Math.max(MinBranches, Math.min(throughput * factor / measurement, maxBranches))
        chances *= n
        splits *= Math.max(1f, n)
        n

  /** The throughput that BSDF sampling of the same path would have; infinite where the field has
    * decided. That of a guided path is small where paths are many because much light comes from
    * there: it must not end them.
    */
  def rouletteThroughput(rrBeta: Float): Float =
    if fieldDecidesRoulette then Float.PositiveInfinity else rrBeta * ratio * splits

private object Guidance:
  /** Branches in which a path leaves a vertex, on average, where it is expected to meet little. */
  inline val MinBranches = 0.5f

  /** Branches of a path. */
  inline val MaxBranchesOfPath = 64f

  /** What is known of a branch that is followed later. Mutable. */
  final class BranchState:
    var ratio, chances, splits, measurement = 0f
    var lastEvent = -1

    /** Where its random numbers go on ([[Sampler.goTo]]). */
    var position = 0L

  /** Paths that are as much rarer than by BSDF sampling are guided no further: it bounds how much
    * their light counts.
    */
  inline val MinDensityRatio = 0.1f

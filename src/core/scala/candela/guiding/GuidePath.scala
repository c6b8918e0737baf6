package candela.guiding

import candela.math.*

/** Scattering events of one path and its branches, kept until their light is known. Branches are
  * followed one after the other. Mutable, one per worker.
  */
final class GuidePath:
  import GuidePath.*
  private val events = Array.fill(MaxEvents)(new Array[Float](GuideRecords.Size))
  private val throughputs, ratios = new Array[Float](MaxEvents)

  // Of each event: its region; the one before it on its branch, −1 if none
  private val regions, parents = new Array[Int](MaxEvents)

  // Light found and rays traced before the next recorded ones; addUp adds those. Of rays, one for
  // each direction taken and one for the light of each event: about as many
  private val lights = new Array[Float](MaxEvents)
  private val costs = new Array[Int](MaxEvents)
  private val laters = new Array[Float](MaxEvents)
  private var size = 0

  // The same before the first recorded event
  private var firstLight = 0f
  private var firstCost = 1

  // The last event of the branch that is followed, and all light when it was
  private var last = -1
  private var counted = 0f

  def clear(): Unit =
    size = 0
    last = -1
    counted = 0f
    firstLight = 0f
    firstCost = 1

  /** Where the branch is that is followed: behind this event; −1: none was recorded. */
  def lastEvent: Int = last

  /** From here on another branch is followed.
    *
    * @param light light so far, of all branches
    */
  def follow(event: Int, light: Float): Unit =
    count(light)
    last = event

  /** The branch has come to a scattering event, and traces a ray there. */
  def step(): Unit = if last < 0 then firstCost += 1 else costs(last) += 1

  private def count(light: Float): Unit =
    if last < 0 then firstLight += light - counted else lights(last) += light - counted
    counted = light

  /** @param region     of the field that the path uses
    * @param side       of the surface ([[GuideField.side]])
    * @param wi         direction taken
    * @param before     light that the path found so far, with all its branches
    * @param throughput before the event
    * @param pdf        density of the direction
    * @param bsdfPdf    that of BSDF sampling
    * @param guidePdf   that of the field; 0 if nothing was learnt
    * @param ratio      density of the path so far over that of BSDF sampling, times the number of
    *                   branches that were expected
    */
  def add(
      region: Int,
      p: Vec3,
      side: Int,
      wi: Vec3,
      before: Float,
      throughput: Float,
      pdf: Float,
      bsdfPdf: Float,
      guidePdf: Float,
      ratio: Float
  ): Unit =
    import GuideRecords.*
    if size < MaxEvents && throughput > 0f then
      val to = events(size)
      to(0) = p.x
      to(1) = p.y
      to(2) = p.z
      to(Side) = side.toFloat
      to(Wi) = wi.x
      to(Wi + 1) = wi.y
      to(Wi + 2) = wi.z
      to(Pdf) = pdf
      to(BsdfPdf) = bsdfPdf
      to(GuidePdf) = guidePdf
      count(before)
      throughputs(size) = throughput
      ratios(size) = ratio
      regions(size) = region
      parents(size) = last
      lights(size) = 0f
      laters(size) = 0f
      costs(size) = 1
      last = size
      size += 1

  /** Records the path, which found `light` in all. */
  def record(light: Float, to: GuideRecords.Part): Unit =
    count(light)
    val earlierLight = firstLight
    val unguided = addUp()
    to.countPath(firstCost)
    var isFirst = true
    var i = 0
    while i < size do
      to.countRays(regions(i), costs(i))
      val radiance = lights(i) / throughputs(i)
      if radiance > 0f && radiance < Float.PositiveInfinity && light < Float.PositiveInfinity then
        val event = events(i)
        val isFirstHere = isFirst && parents(i) < 0
        isFirst &&= !isFirstHere
        event(GuideRecords.Light) = radiance
        event(GuideRecords.Total) = if isFirstHere then light else 0f
        event(GuideRecords.EarlierLight) = if isFirstHere then earlierLight else 0f
        event(GuideRecords.Unguided) = if isFirstHere then unguided else 0f
        to.add(event)
      i += 1

  /** Adds up what was found and met after each event, in all branches from there.
    *
    * @return the second moment of the light if BSDFs alone were sampled, and paths had no branches:
    *   light found after the events `j` and `k`, where `k` is `j` or comes later on the same
    *   branch, contributes its product times the ratio of densities up to `j`. Where the first
    *   direction leads to an emitter or the sky, and no further, it counts less: evenly spread
    *   points are worth more there the fewer decisions a path has made
    */
  private def addUp(): Float =
    var laterLight, sum = 0f
    var i = size - 1
    while i >= 0 do
      // Where the BSDF would hardly sample what was guided, ratios overflow
      val moment = lights(i) * (lights(i) + 2f * laters(i))
      if moment > 0f then
        val isDirect = parents(i) < 0 && costs(i) == 1
        sum += ratios(i) * moment * (if isDirect then DirectNoise else 1f)
      lights(i) += laters(i)
      val parent = parents(i)
      if parent < 0 then
        laterLight += lights(i)
        firstCost += costs(i)
      else
        laters(parent) += lights(i)
        costs(parent) += costs(i)
      i -= 1
    Math.min(sum + firstLight * (firstLight + 2f * laterLight), Float.MaxValue)

object GuidePath:
  /** Later events are rare, find little, and are not recorded. */
  private inline val MaxEvents = 256

  /** What evenly spread points leave of the noise of light that the first direction of an unguided
    * path finds, about, relative to what they leave of a guided one's.
    */
  private inline val DirectNoise = 0.25f

package candela.guiding

import candela.math.*

/** Scattering events of one path, kept until its light is known. Mutable, one per worker. */
final class GuidePath:
  import GuidePath.Most
  private val events = Array.fill(Most)(new Array[Float](GuideRecords.Size))
  private val befores, throughputs, ratios = new Array[Float](Most)
  private var size = 0

  def clear(): Unit = size = 0

  /** @param side       of the surface ([[GuideField.side]])
    * @param wi         direction taken
    * @param before     light that the path found so far
    * @param throughput before the event
    * @param pdf        density of the direction
    * @param bsdfPdf    that of BSDF sampling
    * @param guidePdf   that of the field; 0 if nothing was learnt
    * @param ratio      density of the path so far over that of BSDF sampling
    */
  def add(
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
    if size < Most && throughput > 0f then
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
      befores(size) = before
      throughputs(size) = throughput
      ratios(size) = ratio
      size += 1

  /** Records the path, which found `light` in all. */
  def record(light: Float, to: GuideRecords.Part): Unit =
    var i = 0
    while i < size do
      val found = (light - befores(i)) / throughputs(i)
      if found > 0f && found < Float.PositiveInfinity then
        val event = events(i)
        event(GuideRecords.Light) = found
        event(GuideRecords.Total) = if i == 0 then light else 0f
        event(GuideRecords.Unguided) = if i == 0 then unguided(light) else 0f
        to.add(event)
      i += 1

  /** The second moment of the light if BSDFs alone were sampled. Light found after the events `j`
    * and `k`, `j` ≤ `k`, contributes its product times the ratio of densities up to `j`.
    */
  private def unguided(light: Float): Float =
    var later = light - befores(0)
    var sum = befores(0) * (befores(0) + 2f * later)
    var i = 0
    while i < size do
      val end = if i + 1 < size then befores(i + 1) else light
      val found = end - befores(i)
      later -= found
      sum += ratios(i) * found * (found + 2f * Math.max(0f, later))
      i += 1
    sum

object GuidePath:
  /** Events that are recorded; later ones are rare, and find little. */
  private inline val Most = 64

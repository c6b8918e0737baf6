package candela.guiding

import candela.math.*

/** Scattering events of one path, kept until its light is known. Mutable, one per worker. */
final class GuidePath:
  import GuidePath.Most
  private val events = Array.fill(Most)(new Array[Float](GuideRecords.Size))
  private val befores, throughputs = new Array[Float](Most)
  private var size = 0

  def clear(): Unit = size = 0

  /** @param n          normal on the side where the path came from
    * @param wi         direction taken
    * @param before     light that the path found so far
    * @param throughput before the event
    * @param pdf        density of the direction
    * @param bsdfPdf    that of BSDF sampling
    * @param guidePdf   that of the field; 0 if nothing was learnt
    */
  def add(
      p: Vec3,
      n: Vec3,
      wi: Vec3,
      before: Float,
      throughput: Float,
      pdf: Float,
      bsdfPdf: Float,
      guidePdf: Float
  ): Unit =
    import GuideRecords.*
    if size < Most && throughput > 0f then
      val to = events(size)
      to(0) = p.x
      to(1) = p.y
      to(2) = p.z
      to(Side) = GuideField.side(n).toFloat
      to(Wi) = wi.x
      to(Wi + 1) = wi.y
      to(Wi + 2) = wi.z
      to(Pdf) = pdf
      to(BsdfPdf) = bsdfPdf
      to(GuidePdf) = guidePdf
      befores(size) = before
      throughputs(size) = throughput
      size += 1

  /** Records the path, which found `light` in all. */
  def record(light: Float, to: GuideRecords.Part): Unit =
    var i = 0
    while i < size do
      val found = (light - befores(i)) / throughputs(i)
      if found > 0f && found < Float.PositiveInfinity then
        events(i)(GuideRecords.Light) = found
        to.add(events(i))
      i += 1

object GuidePath:
  /** Events that are recorded; later ones are rare, and find little. */
  private inline val Most = 64

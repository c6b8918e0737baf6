package candela.bsdf.measured

import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path}

import candela.bsdf.{ConductorReflectance, Lambert}
import candela.bsdf.microfacet.{MicrofacetReflection, RoughDielectric, TrowbridgeReitz}
import candela.color.Rgb
import candela.math.*

/** Makes tables of Fourier series from BSDFs that are known otherwise, as objects and as files. */
final class FourierTables(val cosines: Array[Float], order: Int, channels: Int, eta: Float)(
    f: (Vec3, Vec3) => Rgb
):
  private val size = cosines.length

  /** f·|cos θi| of luminance, red and blue, by k. */
  private def series(eye: Float, light: Float): Array[Float] =
    val steps = 4 * order
    val wo = Vec3(safeSqrt(1f - eye * eye), 0f, eye)
    val values = Array.tabulate(steps): j =>
      val phi = (j + 0.5) * Math.PI / steps
      val r = safeSqrt(1f - light * light)
      val wi = Vec3(-r * Math.cos(phi).toFloat, -r * Math.sin(phi).toFloat, -light)
      // The table leaves it to its reader that refraction changes the solid angle
      val spread = if wo.z * wi.z >= 0f then 1f else square(if wo.z < 0f then 1f / eta else eta)
      f(wo, wi) * (Math.abs(light) * spread)
    def terms(channel: Rgb => Float) = Array.tabulate(order): k =>
      val cosine = (0 until steps).map: j =>
        channel(values(j)) * Math.cos(k * (j + 0.5) * Math.PI / steps)
      (cosine.sum * (if k == 0 then 1 else 2) / steps).toFloat
    if channels == 1 then terms(_.g)
    else terms(FourierTables.luminance) ++ terms(_.r) ++ terms(_.b)

  private val pairs = for o <- 0 until size; i <- 0 until size yield series(cosines(o), cosines(i))
  private val counts = pairs.map(s => if s.forall(_ == 0f) then 0 else order).toArray
  private val kept = pairs.zip(counts).filter(_._2 > 0).flatMap(_._1).toArray
  private val offsets = counts.scanLeft(0)((at, n) => at + n * channels).take(counts.length)

  def table: FourierTable = FourierTable(cosines, offsets, counts, kept, channels, eta)

  /** As a `.bsdf` file. */
  def bytes: Array[Byte] =
    val out = ByteBuffer.allocate(64 + 4 * (size + 3 * size * size + kept.length))
    out.order(ByteOrder.LITTLE_ENDIAN).put("SCATFUN\u0001".getBytes("ISO-8859-1"))
    for n <- Seq(1, size, kept.length, order, channels, 1, 0, 0, 0) do out.putInt(n)
    out.putFloat(eta).position(64)
    cosines.foreach(out.putFloat)
    for row <- table.means.grouped(size); sum <- CatmullRom.integrals(cosines, row) do
      out.putFloat(sum)
    for (at, n) <- offsets.zip(counts) do out.putInt(at).putInt(n)
    kept.foreach(out.putFloat)
    out.array

object FourierTables:
  /** What [[FourierBsdf.green]] makes green of. */
  def luminance(c: Rgb): Float = (c.g + 0.100913f * c.b + 0.297375f * c.r) / 1.39829f

  /** Denser towards grazing angles and the normal: −cos of even angles. */
  def cosines(count: Int): Array[Float] =
    val half = Array.tabulate(count / 2)(i => Math.cos(Math.PI * i / (count - 1)).toFloat)
    half.map(-_) ++ half.reverse

  /** Scatters a little forwards, to both sides; smooth everywhere. */
  def cushion(color: Rgb)(wo: Vec3, wi: Vec3): Rgb =
    val along = 1f - 0.5f * (wo.x * wi.x + wo.y * wi.y)
    color * (0.15f * wo.z * wo.z * wi.z * wi.z * along)

  /** Writes the files that `scenes/v3-fourier.pbrt` reads. */
  def main(arguments: Array[String]): Unit =
    val folder = Files.createDirectories(Path.of("scenes", "bsdfs"))
    val gloss = MicrofacetReflection(
      TrowbridgeReitz(0.45f, 0.45f),
      ConductorReflectance.ofReflectance(Rgb(0.6f, 0.45f, 0.2f))
    )
    val base = Lambert(Rgb(0.1f, 0.2f, 0.35f))
    val coloured = FourierTables(cosines(20), 12, 3, 1f)((o, i) => gloss.f(o, i) + base.f(o, i))
    val _ = Files.write(folder.resolve("gloss.bsdf"), coloured.bytes)
    val glass = RoughDielectric(TrowbridgeReitz(0.5f, 0.5f), 1.4f)
    val clear = FourierTables(cosines(24), 16, 1, 1.4f)(glass.f)
    val _ = Files.write(folder.resolve("frosted.bsdf"), clear.bytes)

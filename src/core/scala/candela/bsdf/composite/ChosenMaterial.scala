package candela.bsdf.composite

import candela.bsdf.{Bsdf, Lobes, Material, WrappedMaterial}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.sampling.SampleHash

import java.lang.Float.floatToRawIntBits

/** A blend of so many parts that evaluating all of them takes too long: at each point one of them,
  * chosen at random by its share. The choice is a function of the point, as in PBRT 4; the mean
  * over points is the blend.
  */
final class ChosenMaterial(blend: MixedMaterial) extends WrappedMaterial(blend):
  override val isConstant: Boolean = false

  def bsdf(at: ShadingPoint): Bsdf =
    var current: Material = blend
    var weight = Rgb.White
    var bits = ChosenMaterial.hash(at)
    var goesOn = true
    while goesOn do
      current match
        case chosen: ChosenMaterial => current = chosen.mixture
        case mixed: MixedMaterial if mixed.first eq mixed.second => current = mixed.first
        case mixed: MixedMaterial =>
          val share = mixed.amountAt(at)
          val isGray = share.r == share.g && share.r == share.b && share.r <= 1f
          val fraction = share.map(Math.min(_, 1f))
          val chance = if isGray then share.r else (fraction.r + fraction.g + fraction.b) / 3f
          bits = SampleHash.mix64(bits + SampleHash.Step)
          if SampleHash.toUnit((bits >>> 32).toInt) < chance then
            if !isGray then weight *= share * (1f / chance)
            current = mixed.first
          else
            if !isGray then weight *= MixedMaterial.complement(share) * (1f / (1f - chance))
            current = mixed.second
        case _ => goesOn = false
    val scattered = MixedMaterial.scatter(current, at)
    if weight == Rgb.White then scattered else Lobes.Builder().addScaled(scattered, weight).result

  private def mixture: Material = blend

object ChosenMaterial:
  private def hash(at: ShadingPoint): Long =
    def mixed(bits: Long, x: Float) =
      SampleHash.mix64(bits * SampleHash.Step + floatToRawIntBits(x))
    mixed(mixed(mixed(0L, at.p.x), at.p.y), at.p.z)

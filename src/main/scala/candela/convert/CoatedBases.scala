package candela.convert

import candela.bsdf.layered.{BaseSeries, Coat, Coats}
import candela.bsdf.microfacet.TrowbridgeReitz
import candela.color.Rgb
import candela.diagnostics.Code
import candela.math.square
import candela.scenefile.Param

/** The diffuse base under a coat of v4, for models that don't attenuate it. */
private[convert] object CoatedBases:
  private val coats = Coats()

  /** As many reflections of the base as any coat shows. */
  private val Hits = 100

  /** The albedo of the diffuse lobe of Ashikhmin and Shirley's model, over all directions, where
    * `Kd` · (1 − `Ks`) is 1 ("An Anisotropic Phong BRDF Model", JGT 5(2), 2000).
    */
  val BlendAlbedo: Float = 23f / 28f

  /** The coat of a statement.
    *
    * @param alpha of a roughness in the statement's dialect, and of whether that is remapped
    */
  def coatOf(s: Statement, eta: Float, roughness: Float)(alpha: (Float, Boolean) => Float): Coat =
    def number(name: String) = s.peek(name).flatMap(s.numberOf)
    val isRemapped = s.peek("remaproughness").forall(!_.bools.contains(false))
    def alphaOf(name: String) =
      alpha(number(name).orElse(number("roughness")).getOrElse(roughness), isRemapped)
    val top = TrowbridgeReitz(alphaOf("uroughness"), alphaOf("vroughness"))
    val thickness = Math.max(number("thickness").getOrElse(0.01f), 0f)
    if top.isSmooth then coats.of(top, eta, thickness)
    else Coats.interpolate(coats.family(eta, thickness), top)

  /** Light that gets through the coat to the base, and from there out again. */
  private def passed(coat: Coat, eta: Float): Float = square(coat.meanTransmittance / eta)

  /** The albedo of a base of this reflectance, as seen through the coat. */
  def albedo(reflectance: Float, coat: Coat, eta: Float): Float =
    passed(coat, eta) * BaseSeries.sum(reflectance, Hits, coat)

  /** The reflectance of the base that has this albedo through the coat, at most 1. */
  def reflectance(albedo: Float, coat: Coat, eta: Float): Float =
    val single = albedo / passed(coat, eta)
    Math.min(single / (1f + single * coat.internalReflectance), 1f)

  /** Adds the colour of a base under another name, its values changed.
    *
    * @param unchanged what a texture that can't be changed is like in the target dialect
    */
  def add(s: Statement, base: Option[Param], default: Float, name: String, unchanged: String)(
      change: Float => Float
  ): Unit =
    base.fold(Some(Rgb.gray(default)))(s.colorOf) match
      case Some(c) => s.addRgb(name, c.map(change))
      case None =>
        for p <- base do
          val texture = s.run.texture(p.strings.headOption.getOrElse(""), "spectrum")
          val reason = s"`$name` is of equal albedo"
          val baked = texture.flatMap(BakedTextures.define(s, _, reason)(_.map(change)))
          baked.fold {
            val message = s"texture of `${p.name}` is unchanged, which is $unchanged in ${s.target}"
            s.warn(Code.Inexpressible, p.pos, message)
            s.addRaw(Values.renamed(p, name))
          }(s.addTexture(name, _)(using p.pos))

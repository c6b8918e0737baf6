package candela.convert

import candela.diagnostics.Code
import candela.bsdf.microfacet.Roughness
import candela.color.Rgb
import candela.math.{safeSqrt, sqrt}
import candela.scenefile.{Dialect, Param, ParamType}

/** Converts roughness. A number becomes the microfacet distribution's `alpha`, with
  * `remaproughness` false, which is equivalent in v3 and v4. Textures are baked, or else kept as
  * they are, so that remapped textures change their meaning.
  */
object RoughnessSteps:

  /** Converts v3's parameters to v4's.
    *
    * @param default default of `roughness`, or of `uroughness` and `vroughness` if the material has
    *   these
    * @param smoothAtZero whether roughness 0 is specular, as of glass
    */
  def v3(default: Float, smoothAtZero: Boolean = false): Step =
    Step("`roughness`, `uroughness`, `vroughness`, `remaproughness`", "alpha, not remapped"): s =>
      val remap = s.takeBool("remaproughness", true)
      val smooth =
        smoothAtZero && Names.tail.forall(n => s.peek(n).forall(Steps.isNumber(0f)(_, s)))
      def alpha(r: Float) =
        if smooth then 0f else alphaOfV3(r, remap)
      write(s, default, remap, alpha)

  /** Converts v2's roughness, 1 / exponent of Blinn's distribution, to v3's: the `alpha` of equal
    * lobe width is √(2 / (e + 2)) (Walter et al. 2007, §5.2).
    */
  def v2(default: Float): Step =
    Step("`roughness`, `uroughness`, `vroughness`", "alpha of equal lobe width"): s =>
      def alpha(r: Float) = sqrt(2f / (1f / Math.max(r, 1e-4f) + 2f))
      write(s, default, remap = true, alpha)

  /** Converts v4's parameters to v3's, whose minimum roughness is 0.001. */
  def v4(default: Float, smoothAtZero: Boolean = false): Step =
    Step("`roughness`, `uroughness`, `vroughness`, `remaproughness`", "alpha, not remapped"): s =>
      val remap = s.takeBool("remaproughness", true)
      def alpha(r: Float) =
        val a = alphaOfV4(r, remap)
        if smoothAtZero then a else Math.max(a, 1e-3f)
      write(s, default, remap, alpha)

  /** The microfacet distribution's `alpha` in v3. */
  private[convert] def alphaOfV3(roughness: Float, remap: Boolean): Float =
    Math.max(if remap then Roughness.polynomialAlpha(roughness) else roughness, 1e-3f)

  /** The microfacet distribution's `alpha` in v4. */
  private[convert] def alphaOfV4(roughness: Float, remap: Boolean): Float =
    if remap then safeSqrt(roughness) else roughness

  private val Names = Vector("roughness", "uroughness", "vroughness")

  private def isTexture(p: Param, s: Statement) =
    p.paramType == ParamType.Texture && s.numberOf(p).isEmpty

  /** The texture of a roughness as an image of alpha. */
  private def paint(s: Statement, p: Param, alpha: Float => Float): Option[String] =
    for
      t <- s.run.texture(p.strings.headOption.getOrElse(""), "float")
      reason = s"${s.target} maps the texture of `${p.name}` differently"
      name <- BakedTextures.define(s, t, reason)(c => Rgb.gray(alpha(c.r)))
    yield name

  private def write(s: Statement, default: Float, remap: Boolean, alpha: Float => Float): Unit =
    val stated = Names.flatMap(n => s.take(n).map(n -> _))
    val baked =
      val textures = if remap then stated.filter((_, p) => isTexture(p, s)) else Vector.empty
      val painted = textures.flatMap((name, p) => paint(s, p, alpha).map(name -> _))
      if painted.size == textures.size then painted.toMap else Map.empty
    val textured = stated.exists((name, p) => isTexture(p, s) && !baked.contains(name))
    // Beside a remapped texture, numbers are remapped too.
    def encoded(r: Float) =
      val a = alpha(r)
      if textured && remap && s.run.pass.to == Dialect.V4 then a * a
      else if textured && remap then r
      else a
    for (name, p) <- stated do
      if baked.contains(name) then s.addTexture(name, baked(name))(using p.pos)
      else if isTexture(p, s) then
        if remap then
          s.warn(
            Code.Inexpressible,
            p.pos,
            s"texture of `$name` is unchanged, but maps differently in ${s.target}"
          )
        s.add(name, p)
      else s.numberOf(p).foreach(r => s.addFloat(name, encoded(r))(using p.pos))
    if stated.isEmpty then s.addFloat("roughness", alpha(default))
    if !(textured && remap) then s.addBool("remaproughness", false)

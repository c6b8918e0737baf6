package candela.convert

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.pow

import java.util.Locale

/** Materials and textures, from v2 to v3. */
object FromV2Surfaces:
  import Steps.*

  private val bump = retain("bumpmap")
  private val index = rename("index" -> "eta")
  private val highlight = "highlights of equal width, but another shape than in v2"

  /** Exponents along the two directions; converted to lobes of equal width. */
  private val substrateRoughness =
    Step("`uroughness`, `vroughness`", "alpha of equal lobe width"): s =>
      for name <- Seq("uroughness", "vroughness") if !s.contains(name) do
        s.addSource(number(s, name, 0.1f))
      RoughnessSteps.v2(0.1f).run(s)

  private def number(s: Statement, name: String, value: Float) =
    val position = s.declaration.pos
    candela.scenefile.Param(
      candela.scenefile.ParamType.Float, name, position, position, floats = Array(value)
    )

  private val subsurface = Seq(
    retain("name", "sigma_a", "scale", "g", "Kr"),
    rename("sigma_prime_s" -> "sigma_s", "index" -> "eta", "meanfreepath" -> "mfp"),
    bump
  )

  val materials: Table = Table("Material", fallback = "matte")(
    Rule("matte" -> "matte")(retain("Kd", "sigma"), bump),
    Rule.approximate(
      "plastic" -> "plastic",
      highlight
    )(retain("Kd", "Ks"), RoughnessSteps.v2(0.1f), bump),
    Rule.approximate(
      "metal" -> "metal",
      highlight
    )(retain("eta", "k"), RoughnessSteps.v2(0.01f), bump),
    Rule.approximate(
      "substrate" -> "substrate",
      highlight
    )(retain("Kd", "Ks"), substrateRoughness, bump),
    Rule.approximate("uber" -> "uber", highlight)(
      retain("Kd", "Ks", "Kr", "opacity"),
      index,
      RoughnessSteps.v2(0.1f),
      bump
    ),
    Rule.approximate("translucent" -> "translucent", highlight)(
      retain("Kd", "Ks", "reflect", "transmit"),
      RoughnessSteps.v2(0.1f),
      bump
    ),
    Rule.approximate("shinymetal" -> "uber", "a mirror under a glossy coating")(
      retain("Ks", "Kr"),
      otherwise("Kd", "`Kd` 0")(_.addRgb("Kd", Rgb.Black)),
      RoughnessSteps.v2(0.1f),
      bump
    ),
    Rule("glass" -> "glass")(retain("Kr", "Kt"), index, bump),
    Rule("mirror" -> "mirror")(retain("Kr"), bump),
    Rule("mix" -> "mix")(retain("amount", "namedmaterial1", "namedmaterial2")),
    Rule("subsurface" -> "subsurface")(subsurface*),
    Rule("kdsubsurface" -> "kdsubsurface")((retain("Kd") +: subsurface)*)
  )

  private val mapping = retain("mapping", "uscale", "vscale", "udelta", "vdelta", "v1", "v2")

  /** v2 applies an exponent after the scale; v3 supports only sRGB's curve. */
  private val gamma =
    Step("`filename`, `gamma`, `scale`", "`filename`, `gamma` false, `scale`; or a new image"): s =>
      val p = s.take("gamma")
      val (power, scale) = (p.flatMap(s.numberOf).getOrElse(1f), s.takeNumber("scale", 1f))
      for file <- s.take("filename") do
        if power == 1f then
          s.add("filename", file)
          s.addBool("gamma", false)
          if scale != 1f then s.addFloat("scale", scale)
        else
          val decoded = (x: Float, _: Int) => pow(Math.max(scale * x, 0f), power)
          val baked = RewrittenImages.baked(s, file, (power, scale))(decoded)
          s.addString("filename", baked)(using file.pos)

  /** v2 flips only TGA files vertically. */
  private val upright =
    Step("`vscale`, `vdelta` except of .tga files", "flipped vertically"): s =>
      val file =
        s.peek("filename").flatMap(_.strings.headOption).getOrElse("").toLowerCase(Locale.ROOT)
      val isUv = s.peek("mapping").forall(_.strings.headOption.contains("uv"))
      if !file.endsWith(".tga") then
        if isUv then
          val (scale, delta) = (s.takeNumber("vscale", 1f), s.takeNumber("vdelta", 0f))
          s.addFloat("vscale", -scale)
          s.addFloat("vdelta", 1f - delta)
        else s.warn(Code.Inexpressible, s.declaration.pos, "v3 flips this image vertically")

  private def common = Seq(
    Rule("constant" -> "constant")(retain("value")),
    Rule("scale" -> "scale")(retain("tex1", "tex2")),
    Rule("mix" -> "mix")(retain("tex1", "tex2", "amount")),
    Rule("bilerp" -> "bilerp")(retain("v00", "v01", "v10", "v11"), mapping),
    Rule("imagemap" -> "imagemap")(
      upright,
      gamma,
      retain("wrap", "trilinear", "maxanisotropy"),
      mapping
    ),
    Rule("checkerboard" -> "checkerboard")(retain("tex1", "tex2", "dimension", "aamode"), mapping),
    Rule("dots" -> "dots")(retain("inside", "outside"), mapping)
  ) ++ Noise.rules :+ Rule("uv" -> "uv")(mapping)

  val floats: Table = Table("float texture", fallback = "constant")(common*)

  val colors: Table = Table("spectrum texture", fallback = "constant")(
    (common :+ Noise.marble)*
  )

package candela.convert

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.sqrt
import candela.scenefile.{GraphicsState, Param, ParamType, TextureDescription, Declaration}

/** Materials, from v3 to v4. */
object ToV4Materials:
  import Steps.*

  private val bump = Step("`bumpmap`", "`displacement`")(bumps(_, "bumpmap", "displacement"))
  private val white = isColor(1f)
  private val black = isColor(0f)

  private val kr = unsupported("Kr", "reflection is not attenuated")(white)
  private val kt = unsupported("Kt", "refraction is not attenuated")(white)

  /** Index of refraction, which v4 does not texture. */
  private def eta(default: Float): Step =
    Step("`eta`, `index`", "`eta`"): s =>
      val (index, named) = (s.take("index"), s.take("eta"))
      for p <- named.orElse(index) do
        val value = s.numberOf(p)
        if value.isEmpty then
          s.warn(
            Code.Inexpressible,
            p.pos,
            s"the index of refraction can't be a texture in v4; using $default"
          )
        s.addFloat("eta", value.getOrElse(default))(using p.pos)

  /** A diffuse and a glossy lobe side by side, as a base and its coat.
    *
    * @param fresnel reflectance at normal incidence of a gloss with `Ks` 1
    * @param albedo  of the diffuse lobe, from `Kd` and the reflectance at normal incidence
    */
  private def coatedBase(kd: Float, ks: Float, fresnel: Float)(
      albedo: (Float, Float) => Float
  ): Step =
    Step(
      "`Kd`, `Ks`",
      "`reflectance` of equal albedo, `eta` of a coating of equal reflectance at normal incidence"
    ): s =>
      val p = s.take("Ks")
      val gloss = p.flatMap(s.colorOf).getOrElse(Rgb.gray(ks))
      if p.exists(s.colorOf(_).isEmpty) then
        s.warn(Code.Inexpressible, p.get.pos, "v4's coating can't be textured; using a constant")
      else if !Values.isGray(gloss) then
        s.warn(Code.Inexpressible, p.get.pos, "v4's coating can't be coloured; using gray")
      val normal = Math.min(Math.max(gloss.luminance * fresnel, 1e-4f), 0.9f)
      val eta = (1f + sqrt(normal)) / (1f - sqrt(normal))
      s.addFloat("eta", eta)
      val coat = CoatedBases.coatOf(s, eta, roughness = 0.1f)(RoughnessSteps.alphaOfV3)
      CoatedBases.add(s, s.take("Kd"), kd, "reflectance", "darker by up to a third"): value =>
        CoatedBases.reflectance(albedo(value, normal), coat, eta)

  private val coatNote = "another model of a coated base"

  /** A material with a black specular lobe is exactly `diffuse`. */
  private def plainIfBlack(names: String*): Step =
    Step(names.mkString("`", "` and `", "` black"), "\"diffuse\""): s =>
      val absent = names.forall(n => s.peek(n).exists(isColor(0f)(_, s)))
      if absent then
        s.convertTo("diffuse")
        (names ++ Seq("roughness", "uroughness", "vroughness", "remaproughness", "eta", "index"))
          .foreach(s.take)

  /** Steps by what the material has become. */
  private def ifCoated(step: Step): Step =
    Step(step.source, step.target)(s => if s.targetName == "coateddiffuse" then step.run(s))

  private def ifPlain(step: Step): Step =
    Step(step.source, step.target)(s => if s.targetName == "diffuse" then step.run(s))

  /** What two lobes side by side become: without gloss diffuse, else a coated base. */
  private def twoLobes(kd: Float, coated: Step): Seq[Step] = Seq(
    plainIfBlack("Ks"),
    ifPlain(rename("Kd" -> "reflectance")),
    ifPlain(otherwise("reflectance", s"`reflectance` $kd")(
      _.addRgb("reflectance", Rgb.gray(kd))
    )),
    ifCoated(coated),
    ifCoated(RoughnessSteps.v3(0.1f))
  )

  /** Lambertian reflection of albedo `Kd` beside a gloss. */
  private val lambertian = coatedBase(0.25f, 0.25f, 0.04f)((kd, _) => kd)

  /** Ashikhmin and Shirley's model. */
  private val fresnelBlend =
    coatedBase(0.5f, 0.5f, 1f)((kd, ks) => CoatedBases.BlendAlbedo * kd * (1f - ks))

  private val uber: Step = Step(
    "`Kr`, `Kt`, `opacity`",
    "dropped, unless neutral; `Kt` without " +
      "`Kd` makes it \"dielectric\""
  ): s =>
    def isBlack(name: String, default: Float) =
      s.peek(name).fold(default == 0f)(isColor(0f)(_, s))
    if isBlack("Kd", 0.25f) && !isBlack("Kt", 0f) then
      s.convertTo("dielectric")
      Seq("Kd", "Ks", "Kr", "Kt").foreach(s.take)
    for (name, consequence) <- Seq("Kr" -> "no second, specular lobe", "Kt" -> "no transmission") do
      for p <- s.take(name) if !isColor(0f)(p, s) do
        s.warn(
          Code.Inexpressible,
          p.pos,
          s"`$name` of \"uber\" is not supported in v4; $consequence"
        )
    for p <- s.take("opacity") if !isColor(1f)(p, s) do
      s.warn(Code.Inexpressible, p.pos, "`opacity` of \"uber\" is not supported in v4; opaque")

  /** v4 has two textures where v3 has one texture and two factors. */
  private val translucent: Step =
    Step("`Kd`, `reflect`, `transmit`", "`reflectance` and `transmittance`, multiplied"): s =>
      val kd = s.take("Kd")
      for (factor, name) <- Seq("reflect" -> "reflectance", "transmit" -> "transmittance") do
        val p = s.take(factor)
        val f = p.flatMap(s.colorOf).getOrElse(Rgb.gray(0.5f))
        if p.exists(s.colorOf(_).isEmpty) then
          s.warn(Code.Inexpressible, p.get.pos, s"`$factor` can't be a texture in v4; using 0.5")
        kd.map(k => (k, s.colorOf(k))) match
          case Some((k, None)) =>
            if !Values.isGray(f) then
              s.warn(
                Code.Inexpressible,
                k.pos,
                s"`$factor` can't be coloured beside a texture in v4; using gray"
              )
            s.addTexture(name, product(s, k.strings.head, f.luminance))(using k.pos)
          case colored => s.addRgb(name, colored.flatMap(_._2).getOrElse(Rgb.gray(0.25f)) * f)

  private def product(s: Statement, texture: String, factor: Float): String =
    val position = s.declaration.pos
    val params = Vector(
      Param(ParamType.Texture, "tex", position, position, strings = Vector(texture)),
      Param(ParamType.Float, "scale", position, position, floats = Array(factor))
    )
    val scale = Declaration("Texture", "scale", params, position, s.declaration.folder)
    s.run.define(
      TextureDescription(s"$texture times", "spectrum", scale, GraphicsState.Identity)
    )

  private val mix: Step =
    Step(
      "`namedmaterial1`, `namedmaterial2`, `amount`",
      "`materials` in reverse order, `amount`"
    ): s =>
      val names = Seq("namedmaterial2", "namedmaterial1").map(s.takeString(_, ""))
      s.addString("materials", names*)
      for p <- s.take("amount") do
        s.numberOf(p).orElse(s.colorOf(p).map(_.average)) match
          case Some(a) =>
            if s.colorOf(p).exists(!Values.isGray(_)) then
              s.warn(
                Code.Inexpressible,
                p.pos,
                "`amount` can't be coloured in v4; using its average"
              )
            s.addFloat("amount", a)(using p.pos)
          case None =>
            s.addTexture("amount", ToV4Textures.floatTwin(s, p))(using p.pos)

  private val subsurface = Seq(
    retain("name", "sigma_a", "sigma_s", "mfp", "g", "scale"),
    eta(1.33f),
    kr,
    kt,
    RoughnessSteps.v3(0f, smoothAtZero = true),
    bump
  )

  val table: Table = Table("Material", fallback = "diffuse")(
    Rule("matte" -> "diffuse")(
      rename("Kd" -> "reflectance"),
      unsupported("sigma", "Lambertian")(isNumber(0f)),
      bump
    ),
    Rule.approximate("plastic" -> "coateddiffuse", coatNote)(
      (twoLobes(0.25f, lambertian) :+ bump)*
    ),
    Rule.approximate("substrate" -> "coateddiffuse", coatNote)(
      (twoLobes(0.5f, fresnelBlend) :+ bump)*
    ),
    Rule.approximate("uber" -> "coateddiffuse", coatNote)(
      (uber +: twoLobes(0.25f, lambertian)) ++ Seq(ofUber, bump)*
    ),
    Rule("glass" -> "dielectric")(
      eta(1.5f),
      kr,
      kt,
      RoughnessSteps.v3(0f, smoothAtZero = true),
      bump
    ),
    Rule("metal" -> "conductor")(retain("eta", "k"), RoughnessSteps.v3(0.01f), bump),
    Rule.approximate("mirror" -> "conductor", "higher reflectance at grazing angles")(
      rename("Kr" -> "reflectance"),
      otherwise("reflectance", "`reflectance` 0.9")(_.addRgb("reflectance", Rgb.gray(0.9f))),
      otherwise("roughness", "`roughness` 0")(_.addFloat("roughness", 0f)),
      bump
    ),
    Rule("translucent" -> "diffusetransmission")(
      translucent,
      unsupported("Ks", "no glossy lobe")(black),
      otherwise("Ks", "warning: the glossy lobe is dropped")(s =>
        if !s.isSpecified("Ks") then
          s.warn(
            Code.Inexpressible,
            s.declaration.pos,
            "v4 has no glossy lobe for \"translucent\"; ignored"
          )
      ),
      drop("roughness", "remaproughness"),
      bump
    ),
    Rule("subsurface" -> "subsurface")(subsurface*),
    Rule("kdsubsurface" -> "subsurface")(rename("Kd" -> "reflectance") +: subsurface*),
    Rule("mix" -> "mix")(mix, drop("bumpmap")),
    Rule("hair" -> "hair")(
      rename("color" -> "reflectance"),
      retain("sigma_a", "eumelanin", "pheomelanin", "eta", "beta_m", "beta_n", "alpha")
    ),
    Rule.approximate("disney" -> "diffuse", "only the base colour is kept")(
      rename("color" -> "reflectance"),
      drop(
        "metallic", "eta", "roughness", "speculartint", "anisotropic", "sheen", "sheentint",
        "clearcoat", "clearcoatgloss", "spectrans", "scatterdistance", "thin", "flatness",
        "difftrans"
      ),
      bump
    ),
    Rule("|none" -> "interface")()
  )

  private def ofUber: Step =
    Step("`eta`, `index`", "only of \"dielectric\""): s =>
      if s.targetName == "dielectric" then
        eta(1.5f).run(s)
        RoughnessSteps.v3(0.1f).run(s)
      else Seq("eta", "index").foreach(s.take)

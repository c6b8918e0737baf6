package candela.convert

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.safeSqrt
import candela.scenefile.{Param, ParamType}

/** Materials, from v4 to v3. */
object ToV3Materials:
  import Steps.*

  private val bump = Step("`displacement`, `normalmap`", "`bumpmap`; `normalmap` is dropped"): s =>
    bumps(s, "displacement", "bumpmap")
    for p <- s.take("normalmap") do
      s.warn(Code.Inexpressible, p.pos, "v3 does not support normal maps; ignored")

  private def reflectance(default: Float): Seq[Step] = Seq(
    rename("reflectance" -> "Kd"),
    otherwise("Kd", s"`Kd` $default")(_.addRgb("Kd", Rgb.gray(default)))
  )

  /** Index of refraction as a number; of a spectrum, the value at 589 nm. */
  private def eta(name: String, default: Float): Step = Step(s"`$name`", "`eta`, at 589 nm"): s =>
    val value = s.take(name).flatMap: p =>
      if p.paramType == ParamType.Spectrum then
        val spectrum = s.run.values.spectrum(p, s.declaration)
        if spectrum.exists(_.values.distinct.length > 1) then
          s.warn(
            Code.Inexpressible,
            p.pos,
            "v3 does not support dispersion; using the index of refraction at 589 nm"
          )
        spectrum.map(_(589.3f))
      else s.numberOf(p)
    s.addFloat("eta", value.getOrElse(default))

  /** Fresnel reflectance at normal incidence. */
  private def normalReflectance(eta: Float): Float =
    val r = (eta - 1) / (eta + 1)
    r * r

  /** Index of refraction of a coat or a pane, at 589 nm. */
  private def takeIndex(s: Statement): Float =
    s.take("eta").flatMap(p =>
      s.numberOf(p).orElse(s.run.values.spectrum(p, s.declaration).map(_(589.3f)))
    ).getOrElse(1.5f)

  /** A coat, and the reflectance of its base, as those of Ashikhmin and Shirley's model: `Ks`
    * is the reflectance at normal incidence, `Kd` what gives the base the same albedo.
    */
  private val coatedBase = Step("`reflectance`, `eta`", "`Kd` of equal albedo, `Ks`"): s =>
    val eta = takeIndex(s)
    val ks = normalReflectance(eta)
    val coat = CoatedBases.coatOf(s, eta, roughness = 0f)(RoughnessSteps.alphaOfV4)
    s.addRgb("Ks", Rgb.gray(ks))
    CoatedBases.add(s, s.take("reflectance"), 0.5f, "Kd", "brighter by up to a half"):
      reflectance =>
        val albedo = CoatedBases.albedo(reflectance, coat, eta)
        Math.min(albedo / (CoatedBases.BlendAlbedo * (1f - ks)), 1f)

  /** Absorption `k` for which a v4 conductor of index 1 has the given reflectance. */
  private def absorption(r: Float): Float =
    val x = Math.min(Math.max(r, 0f), 0.9999f)
    2f * safeSqrt(x) / safeSqrt(1f - x)

  private def metal(prefix: String): Step =
    Step(s"`${prefix}eta`, `${prefix}k`, `reflectance`", "`eta`, `k`"): s =>
      s.take("reflectance") match
        case Some(p) =>
          s.colorOf(p) match
            case Some(c) =>
              s.addRgb("eta", Rgb.White)(using p.pos)
              s.addRgb("k", c.map(absorption))(using p.pos)
            case None =>
              s.warn(
                Code.Inexpressible,
                p.pos,
                "metal can't have a `reflectance` texture in v3; using \"mirror\""
              )
              s.convertTo("mirror")
              s.add("Kr", p)
        case None =>
          for name <- Seq("eta", "k"); p <- s.take(prefix + name) do s.add(name, p)

  private def rough(default: Float, smoothAtZero: Boolean = false): Step =
    val step = RoughnessSteps.v4(default, smoothAtZero)
    Step(step.source, step.target): s =>
      if s.targetName == "mirror" then
        Seq("roughness", "uroughness", "vroughness", "remaproughness").foreach(s.take)
      else step.run(s)

  private val glassRoughness: Step = directional(rough(0f, smoothAtZero = true))
  private val bothRoughnesses: Step = directional(rough(0f))

  /** Glass and substrate have only the two directional roughnesses. */
  private def directional(step: Step): Step =
    Step(step.source, "`uroughness`, `vroughness`: alpha, not remapped"): s =>
      for p <- s.take("roughness") do
        for name <- Seq("uroughness", "vroughness") if !s.contains(name) do
          s.addSource(Values.renamed(p, name))
      if !s.contains("uroughness") then s.addSource(zero(s))
      step.run(s)

  private def zero(s: Statement) =
    Param(ParamType.Float, "uroughness", s.declaration.pos, s.declaration.pos, floats = Array(0f))

  private val coatParams = Seq("thickness", "albedo", "g", "maxdepth", "nsamples")

  /** Light transmitted by a thin dielectric passes unscattered, which v3 expresses as opacity. Both
    * sides together reflect `2R / (1 + R)`.
    */
  private val thinDielectric = Step("`eta`", "`opacity` and `Kr`, exact at normal incidence"): s =>
    val n = takeIndex(s)
    val singleSide = normalReflectance(n)
    val bothSides = 2 * singleSide / (1 + singleSide)
    s.addRgb("Kd", Rgb.Black)
    s.addRgb("Ks", Rgb.Black)
    s.addRgb("opacity", Rgb.gray(bothSides))
    if singleSide > 0f then s.addRgb("Kr", Rgb.gray(1f / singleSide))
    s.addFloat("eta", n)

  private val transmission =
    Step("`reflectance`, `transmittance`, `scale`", "`reflect`, `transmit`, `Kd` 1"): s =>
      val scale = s.takeNumber("scale", 1f)
      for (from, to) <- Seq("reflectance" -> "reflect", "transmittance" -> "transmit") do
        s.take(from) match
          case Some(p) if s.colorOf(p).isEmpty => s.add(to, p)
          case p => s.addRgb(to, p.flatMap(s.colorOf).getOrElse(Rgb.gray(0.25f)) * scale)
      if scale != 1f && s.hasAdded(ParamType.Texture) then
        s.warn(Code.Inexpressible, s.declaration.pos, "`scale` does not apply to textures in v3")
      s.addRgb("Kd", Rgb.White)
      s.addRgb("Ks", Rgb.Black)

  private val mix =
    Step("`materials`, `amount`", "`namedmaterial1`, `namedmaterial2`, `amount`"): s =>
      val names = s.take("materials").fold(Vector.empty[String])(_.strings)
      for (name, key) <- names.reverse.zip(Seq("namedmaterial1", "namedmaterial2")) do
        s.addString(key, name)
      for p <- s.take("amount") do
        s.numberOf(p) match
          case Some(a) => s.addRgb("amount", Rgb.gray(a))(using p.pos)
          case None =>
            s.warn(Code.Inexpressible, p.pos, "`amount` can't be a float texture in v3; using 0.5")

  private val subsurface = Seq(
    retain("name", "sigma_a", "sigma_s", "mfp", "g", "scale"),
    eta("eta", 1.33f),
    Step("`reflectance`", "`Kd` of \"kdsubsurface\"")(s =>
      for p <- s.take("reflectance") do
        s.convertTo("kdsubsurface")
        s.add("Kd", p)
    ),
    glassRoughness,
    bump
  )

  private val coatNote = "v3's model of a coated diffuse base"

  val table: Table = Table("Material", fallback = "matte")(
    Rule("diffuse" -> "matte")((reflectance(0.5f) :+ bump)*),
    Rule.approximate("coateddiffuse" -> "substrate", coatNote)(
      Seq(coatedBase, bothRoughnesses, bump, drop(coatParams*))*
    ),
    Rule("conductor" -> "metal")(metal(""), rough(0f), bump),
    Rule.approximate("coatedconductor" -> "metal", "without coating")(
      metal("conductor."),
      rename(
        "conductor.roughness" -> "roughness",
        "conductor.uroughness" -> "uroughness",
        "conductor.vroughness" -> "vroughness"
      ),
      drop((coatParams ++ Seq("interface.roughness", "interface.uroughness", "interface.vroughness",
        "interface.eta", "remaproughness"))*),
      bump
    ),
    Rule("dielectric" -> "glass")(eta("eta", 1.5f), glassRoughness, bump),
    Rule.approximate("thindielectric" -> "uber", "different reflectance at grazing angles")(
      thinDielectric,
      bump
    ),
    Rule("diffusetransmission" -> "translucent")(transmission, bump),
    Rule("subsurface" -> "subsurface")(subsurface*),
    Rule("mix" -> "mix")(mix),
    Rule("hair" -> "hair")(
      rename("reflectance" -> "color"),
      retain("color", "sigma_a", "eumelanin", "pheomelanin", "eta", "beta_m", "beta_n", "alpha")
    ),
    Rule("interface||none" -> "")(drop("displacement"))
  )

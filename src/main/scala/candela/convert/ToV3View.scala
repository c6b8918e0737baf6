package candela.convert

import candela.diagnostics.Code
import candela.math.square
import candela.scenefile.Dialect

/** Options and media, from v4 to v3. */
object ToV3View:
  import Steps.*

  private val shutter = retain("shutteropen", "shutterclose")
  private val projective =
    retain("frameaspectratio", "screenwindow", "lensradius", "focaldistance")

  private val mapping = Step("`mapping`", "\"equirectangular\", the only one of v3"): s =>
    val p = s.take("mapping")
    if !p.exists(_.strings.headOption.contains("equirectangular")) then
      s.warn(
        Code.Inexpressible,
        p.fold(s.declaration.pos)(_.pos),
        "v3 does not support the equal-area mapping; using " +
          "\"equirectangular\""
      )

  private val cameras = Table("Camera", fallback = "perspective")(
    Rule("perspective" -> "perspective")(retain("fov"), projective, shutter),
    Rule("orthographic" -> "orthographic")(projective, shutter),
    Rule("spherical" -> "environment")(mapping, projective, shutter),
    Rule("realistic" -> "realistic")(
      retain("lensfile", "aperturediameter", "focusdistance"),
      shutter,
      otherwise("simpleweighting", "`simpleweighting` false")(_.addBool("simpleweighting", false)),
      unsupported("aperture", "circular aperture")
    )
  )

  private val exposure = Step("`iso`", "`scale`, times the exposure time"): s =>
    // v3's lens systems, too, integrate over the exposure time
    val isLens = s.run.scene.camera.exists(_.name == "realistic")
    val factor = s.takeNumber("iso", 100f) / 100f * (if isLens then 1f else ToV4View.shutterTime(s))
    if factor != 1f then s.addFloat("scale", factor)

  private val components = Step("`maxcomponentvalue`", "`maxsampleluminance`, with a warning"): s =>
    for p <- s.take("maxcomponentvalue"); x <- s.numberOf(p) do
      s.warn(Code.Inexpressible, p.pos, "v3 clamps a sample's luminance, v4 its largest component")
      s.addFloat("maxsampleluminance", x)(using p.pos)

  /** A window of pixels, in fractions of the image. */
  private val pixelBounds = Step("`pixelbounds`", "`cropwindow`"): s =>
    def size(name: String, default: Int) =
      s.peek(name).flatMap(_.ints.headOption).getOrElse(default).toFloat
    val (width, height) = (size("xresolution", 1280), size("yresolution", 720))
    for p <- s.take("pixelbounds") if p.ints.length == 4 do
      val edges = p.ints.zip(Seq(width, width, height, height)).map((x, extent) => x / extent)
      s.addFloat("cropwindow", edges.toSeq*)(using p.pos)

  private val film = Seq(
    pixelBounds,
    retain("xresolution", "yresolution", "cropwindow", "diagonal", "filename"),
    exposure,
    components,
    drop("savefp16"),
    unsupported("sensor", "CIE 1931 observer")((p, _) =>
      p.strings.headOption.contains("cie1931")
    ),
    unsupported("whitebalance", "no white balance")(isNumber(0f))
  )

  private val films = Table("Film", fallback = "image")(
    Rule("rgb" -> "image")(film*),
    Rule.approximate(
      "gbuffer" -> "image",
      "writes colour only"
    )((film :+ drop("coordinatesystem"))*),
    Rule.approximate("spectral" -> "image", "writes colour only")(
      (film :+ drop("nbuckets", "lambdamin", "lambdamax"))*
    )
  )

  private val extents = Step("`xradius`, `yradius`", "`xwidth`, `ywidth`"): s =>
    for axis <- Seq("x", "y"); p <- s.take(s"${axis}radius") do s.add(s"${axis}width", p)

  private val gaussian = Seq(
    extents,
    otherwise("xwidth", "`xwidth`, `ywidth` 1.5 by default")(s =>
      for axis <- Seq("x", "y") if !s.contains(s"${axis}width") do s.addFloat(s"${axis}width", 1.5f)
    ),
    Step("`sigma`", "`alpha`: 1 / 2 sigma²")(s =>
      s.addFloat("alpha", 1f / (2f * square(s.takeNumber("sigma", 0.5f))))
    )
  )

  private val filters = Table("PixelFilter", fallback = "box")(
    Rule("box" -> "box")(extents),
    Rule("triangle" -> "triangle")(extents),
    Rule("gaussian" -> "gaussian")(gaussian*),
    Rule("mitchell" -> "mitchell")(extents, retain("B", "C")),
    Rule("sinc" -> "sinc")(extents, retain("tau"))
  )

  private val points = Seq(retain("pixelsamples"), drop("seed", "randomization"))

  private val samplers = Table("Sampler", fallback = "halton")(
    Rule("halton|zsobol|paddedsobol|pmj02bn" -> "halton")(points*),
    Rule("sobol" -> "sobol")(points*),
    Rule("independent" -> "random")(points*),
    Rule("stratified" -> "stratified")(retain("xsamples", "ysamples", "jitter"), drop("seed"))
  )

  private val strategy = Step("`lightsampler`", "`lightsamplestrategy`"): s =>
    for p <- s.take("lightsampler") do
      val name = p.strings.headOption.filter(Set("uniform", "power"))
      name.foreach(s.addString("lightsamplestrategy", _)(using p.pos))

  private val regularize = unsupported("regularize", "no regularisation")((p, _) =>
    p.bools == Vector(false)
  )

  private val path = Seq(retain("maxdepth"), strategy, regularize)
  private val simple = Seq(
    retain("maxdepth"),
    unsupported("samplelights", "lights are sampled, and point lights shine")((p, _) =>
      p.bools == Vector(true)
    ),
    unsupported("samplebsdf", "BSDFs are sampled, and mirrors reflect")((p, _) =>
      p.bools == Vector(true)
    )
  )

  private val integrators = Table("Integrator", fallback = "path")(
    Rule("path" -> "path")(path*),
    Rule("volpath" -> "volpath")(path*),
    Rule("simplepath" -> "path")(simple*),
    Rule.approximate(
      "randomwalk" -> "path",
      "point lights shine, and mirrors reflect"
    )(retain("maxdepth")),
    Rule.approximate("simplevolpath" -> "volpath", "point lights shine")(retain("maxdepth")),
    Rule.approximate("lightpath" -> "bdpt", "the sky, mirrors and smooth glass are seen")(
      retain("maxdepth")
    ),
    Rule("bdpt" -> "bdpt")(
      retain("maxdepth", "visualizestrategies", "visualizeweights"),
      regularize
    ),
    Rule("mlt" -> "mlt")(
      retain("maxdepth", "bootstrapsamples", "chains", "mutationsperpixel", "largestepprobability",
        "sigma"),
      regularize
    ),
    Rule("sppm" -> "sppm")(
      retain("maxdepth", "photonsperiteration", "radius"),
      drop("seed"),
      Step("the sampler's `pixelsamples`", "`iterations`")(s =>
        for p <- s.run.scene.sampler.flatMap(_.param("pixelsamples")) do
          s.addInteger("iterations", p.ints*)
      )
    ),
    Rule.approximate("ambientocclusion" -> "ambientocclusion", "the image is scaled by π")(
      retain("cossample"),
      unsupported("maxdistance", "unlimited distance")
    )
  )

  private val medium = retain("sigma_a", "sigma_s", "scale", "g", "preset")
  private val emission = Seq(
    unsupported("Le", "no emission")(isColor(0f)),
    unsupported("Lescale", "no emission")((_, s) => !s.isSpecified("Le"))
  )

  private val media = Table("Medium")(
    Rule("homogeneous" -> "homogeneous")((medium +: emission)*),
    Rule("uniformgrid" -> "heterogeneous")(
      (Seq(medium, retain("density", "nx", "ny", "nz", "p0", "p1")) ++ emission ++
        Seq(
          unsupported("temperature", "no emission"),
          drop("temperatureoffset", "temperaturecutoff", "temperaturescale")
        ))*
    )
  )

  // v4 has none of these.
  private val emptyTables = Seq(Table("Renderer")(), Table("VolumeIntegrator")(), Table("Volume")())

  val pass: Pass = Pass(
    Dialect.V4,
    Dialect.V3,
    Vector(
      cameras, films, samplers, filters, integrators, ToV4View.accelerators, media
    ) ++ emptyTables ++
      Vector(ToV3Materials.table, ToV3Textures.floats, ToV3Textures.colors, ToV3Lights.table,
        ToV3Lights.area, ToV3Shapes.table),
    Map(
      "PixelFilter" -> "gaussian",
      "Integrator" -> "volpath",
      "Film" -> "rgb",
      "Sampler" -> "zsobol"
    ),
    ToV3Shapes.placed,
    ToV3Textures.placed,
    // As in the opposite direction.
    (light, _) => Vector(ToV4Lights.flipped(light))
  )

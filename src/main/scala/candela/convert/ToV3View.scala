package candela.convert

import candela.base.Code

import candela.math.square
import candela.scenefile.Dialect

/** Options and media, from v4 to v3. */
object ToV3View:
  import Steps.*

  private val shutter = keep("shutteropen", "shutterclose")
  private val projective =
    keep("frameaspectratio", "screenwindow", "lensradius", "focaldistance")

  private val mapping = Step("`mapping`", "\"equirectangular\", the only one of v3"): s =>
    val p = s.take("mapping")
    if !p.exists(_.strings.headOption.contains("equirectangular")) then
      s.warn(
        Code.Inexpressible,
        p.fold(s.declaration.at)(_.at),
        "v3 does not support the equal-area mapping; using " +
          "\"equirectangular\""
      )

  private val cameras = Table("Camera", fallback = "perspective")(
    Rule("perspective" -> "perspective")(keep("fov"), projective, shutter),
    Rule("orthographic" -> "orthographic")(projective, shutter),
    Rule("spherical" -> "environment")(mapping, projective, shutter),
    Rule("realistic" -> "realistic")(
      keep("lensfile", "aperturediameter", "focusdistance"),
      shutter,
      otherwise("simpleweighting", "`simpleweighting` false")(_.addBool("simpleweighting", false)),
      lose("aperture", "circular aperture")
    )
  )

  private val exposure = Step("`iso`", "`scale`, times the exposure time"): s =>
    val factor = s.takeNumber("iso", 100f) / 100f * ToV4View.shutterTime(s)
    if factor != 1f then s.addFloat("scale", factor)

  private val components = Step("`maxcomponentvalue`", "`maxsampleluminance`, with a warning"): s =>
    for p <- s.take("maxcomponentvalue"); x <- s.numberOf(p) do
      s.warn(Code.Inexpressible, p.at, "v3 clamps a sample's luminance, v4 its largest component")
      s.addFloat("maxsampleluminance", x)(using p.at)

  /** A window of pixels, in fractions of the image. */
  private val pixelBounds = Step("`pixelbounds`", "`cropwindow`"): s =>
    def size(name: String, default: Int) =
      s.look(name).flatMap(_.ints.headOption).getOrElse(default).toFloat
    val (width, height) = (size("xresolution", 1280), size("yresolution", 720))
    for p <- s.take("pixelbounds") if p.ints.length == 4 do
      val edges = p.ints.zip(Seq(width, width, height, height)).map((x, of) => x / of)
      s.addFloat("cropwindow", edges.toSeq*)(using p.at)

  private val film = Seq(
    pixelBounds,
    keep("xresolution", "yresolution", "cropwindow", "diagonal", "filename"),
    exposure,
    components,
    drop("savefp16"),
    lose("sensor", "CIE 1931 observer")((p, _) =>
      p.strings.headOption.contains("cie1931")
    ),
    lose("whitebalance", "no white balance")(isNumber(0f))
  )

  private val films = Table("Film", fallback = "image")(
    Rule("rgb" -> "image")(film*),
    Rule.near(
      "gbuffer" -> "image",
      "writes colour only"
    )((film :+ drop("coordinatesystem"))*),
    Rule.near("spectral" -> "image", "writes colour only")(
      (film :+ drop("nbuckets", "lambdamin", "lambdamax"))*
    )
  )

  private val extents = Step("`xradius`, `yradius`", "`xwidth`, `ywidth`"): s =>
    for axis <- Seq("x", "y"); p <- s.take(s"${axis}radius") do s.add(s"${axis}width", p)

  private val gaussian = Seq(
    extents,
    otherwise("xwidth", "`xwidth`, `ywidth` 1.5 by default")(s =>
      for axis <- Seq("x", "y") if !s.has(s"${axis}width") do s.addFloat(s"${axis}width", 1.5f)
    ),
    Step("`sigma`", "`alpha`: 1 / 2 sigma²")(s =>
      s.addFloat("alpha", 1f / (2f * square(s.takeNumber("sigma", 0.5f))))
    )
  )

  private val filters = Table("PixelFilter", fallback = "box")(
    Rule("box" -> "box")(extents),
    Rule("triangle" -> "triangle")(extents),
    Rule("gaussian" -> "gaussian")(gaussian*),
    Rule("mitchell" -> "mitchell")(extents, keep("B", "C")),
    Rule("sinc" -> "sinc")(extents, keep("tau"))
  )

  private val points = Seq(keep("pixelsamples"), drop("seed", "randomization"))

  private val samplers = Table("Sampler", fallback = "halton")(
    Rule("halton|zsobol|paddedsobol|pmj02bn" -> "halton")(points*),
    Rule("sobol" -> "sobol")(points*),
    Rule("independent" -> "random")(points*),
    Rule("stratified" -> "stratified")(keep("xsamples", "ysamples", "jitter"), drop("seed"))
  )

  private val strategy = Step("`lightsampler`", "`lightsamplestrategy`"): s =>
    for p <- s.take("lightsampler") do
      val name = p.strings.headOption.filter(Set("uniform", "power"))
      name.foreach(s.addString("lightsamplestrategy", _)(using p.at))

  private val regularize = lose("regularize", "no regularisation")((p, _) =>
    p.bools == Vector(false)
  )

  private val path = Seq(keep("maxdepth"), strategy, regularize)
  private val simple = Seq(
    keep("maxdepth"),
    lose("samplelights", "lights are sampled, and point lights shine")((p, _) =>
      p.bools == Vector(true)
    ),
    lose("samplebsdf", "BSDFs are sampled, and mirrors reflect")((p, _) =>
      p.bools == Vector(true)
    )
  )

  private val integrators = Table("Integrator", fallback = "path")(
    Rule("path" -> "path")(path*),
    Rule("volpath" -> "volpath")(path*),
    Rule("simplepath" -> "path")(simple*),
    Rule.near("randomwalk" -> "path", "point lights shine, and mirrors reflect")(keep("maxdepth")),
    Rule.near("simplevolpath" -> "volpath", "point lights shine")(keep("maxdepth")),
    Rule.near("lightpath" -> "bdpt", "the sky, mirrors and smooth glass are seen")(
      keep("maxdepth")
    ),
    Rule("bdpt" -> "bdpt")(
      keep("maxdepth", "visualizestrategies", "visualizeweights"),
      regularize
    ),
    Rule("mlt" -> "mlt")(
      keep("maxdepth", "bootstrapsamples", "chains", "mutationsperpixel", "largestepprobability",
        "sigma"),
      regularize
    ),
    Rule("sppm" -> "sppm")(
      keep("maxdepth", "photonsperiteration", "radius"),
      drop("seed"),
      Step("the sampler's `pixelsamples`", "`iterations`")(s =>
        for p <- s.run.scene.sampler.flatMap(_.param("pixelsamples")) do
          s.addInteger("iterations", p.ints*)
      )
    ),
    Rule.near("ambientocclusion" -> "ambientocclusion", "the image is scaled by π")(
      keep("cossample"),
      lose("maxdistance", "unlimited distance")
    )
  )

  private val medium = keep("sigma_a", "sigma_s", "scale", "g", "preset")
  private val glow = Seq(
    lose("Le", "no emission")(isColor(0f)),
    lose("Lescale", "no emission")((_, s) => !s.wasGiven("Le"))
  )

  private val media = Table("Medium")(
    Rule("homogeneous" -> "homogeneous")((medium +: glow)*),
    Rule("uniformgrid" -> "heterogeneous")(
      (Seq(medium, keep("density", "nx", "ny", "nz", "p0", "p1")) ++ glow ++
        Seq(
          lose("temperature", "no emission"),
          drop("temperatureoffset", "temperaturecutoff", "temperaturescale")
        ))*
    )
  )

  // v4 has none of these.
  private val none = Seq(Table("Renderer")(), Table("VolumeIntegrator")(), Table("Volume")())

  val pass: Pass = Pass(
    Dialect.V4,
    Dialect.V3,
    Vector(cameras, films, samplers, filters, integrators, ToV4View.accelerators, media) ++ none ++
      Vector(ToV3Materials.table, ToV3Textures.floats, ToV3Textures.colors, ToV3Lights.table,
        ToV3Lights.area, ToV3Shapes.table),
    Map(
      "PixelFilter" -> "gaussian",
      "Integrator" -> "volpath",
      "Film" -> "rgb",
      "Sampler" -> "zsobol"
    ),
    ToV3Shapes.placed,
    // As in the opposite direction.
    ToV4Textures.placed,
    ToV4Lights.placed
  )

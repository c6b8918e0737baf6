package candela.convert

import candela.diagnostics.Code
import candela.math.sqrt
import candela.scenefile.Dialect

import java.util.Locale

/** Options and media, from v3 to v4. */
object ToV4View:
  import Steps.*

  /** When the shutter opens and closes by default. */
  private val Times = Vector("shutteropen" -> 0f, "shutterclose" -> 1f)

  /** Part of a unit of time, or of the time itself, in which a moment's image is taken. */
  private val Instant = 1e-3f

  /** v4's shutter closes after it opens. v2 and v3 swap its times, and also render an instant. */
  private val shutter =
    Step("`shutteropen`, `shutterclose`", "in order; an instant becomes a brief time"): s =>
      val (open, close) = shutterTimes(s)
      for ((name, default), time) <- Times.zip(Vector(open, close)) do
        val p = s.take(name)
        if p.nonEmpty || time != default then
          s.addFloat(name, time)(using p.fold(s.declaration.pos)(_.pos))

  private val projective =
    retain("frameaspectratio", "screenwindow", "lensradius", "focaldistance")
  private val planes = drop("hither", "yon")

  private val cameras = Table("Camera", fallback = "perspective")(
    Rule("perspective" -> "perspective")(
      retain("fov"),
      projective,
      shutter,
      planes,
      Step("`halffov`", "`fov`")(s =>
        for p <- s.take("halffov"); half <- s.numberOf(p) if half > 0f do
          s.addFloat("fov", 2 * half)(using p.pos)
      )
    ),
    Rule("orthographic" -> "orthographic")(projective, shutter, planes),
    Rule("environment" -> "spherical")(
      projective,
      shutter,
      planes,
      otherwise(
        "mapping",
        "`mapping` \"equirectangular\""
      )(_.addString("mapping", "equirectangular"))
    ),
    Rule("realistic" -> "realistic")(
      retain("lensfile", "aperturediameter", "focusdistance"),
      shutter,
      planes,
      // LensExposure has its effect on the film
      Step("`simpleweighting`", "the film's `iso`")(s => s.take("simpleweighting"): Unit)
    )
  )

  /** v4 writes other formats than v3. */
  private val filename: Step = Step("`filename`", "`filename`, or .exr if v4 can't write it"): s =>
    for p <- s.take("filename") do
      val name = p.strings.headOption.getOrElse("")
      val isKnown =
        Seq(".exr", ".png", ".pfm", ".qoi").exists(name.toLowerCase(Locale.ROOT).endsWith)
      if isKnown then s.add("filename", p)
      else s.addString("filename", s"${name.replaceFirst("\\.[A-Za-z]+$", "")}.exr")(using p.pos)

  /** When v4's shutter opens and closes, for the camera of v2 or v3. */
  private def shutterTimes(s: Statement): (Float, Float) =
    def time(i: Int) =
      val (name, default) = Times(i)
      s.run.scene.camera.flatMap(_.param(name)).flatMap(s.numberOf).getOrElse(default)
    val (open, close) = (time(0), time(1))
    if open != close then (Math.min(open, close), Math.max(open, close))
    else (open, open + Instant * Math.max(1f, Math.abs(open)))

  /** v4's film integrates over the exposure time; those of v2 and v3 don't. */
  private[convert] def shutterTime(s: Statement): Float =
    val (open, close) = shutterTimes(s)
    close - open

  private val films = Table("Film", fallback = "rgb")(
    Rule("image" -> "rgb")(
      retain("xresolution", "yresolution", "cropwindow", "diagonal"),
      filename,
      Step("`scale`", "`iso`, times 100, divided by the exposure time")(s =>
        val lens = LensExposure.of(s.run.scene)
        val factor = s.takeNumber("scale", 1f) * lens / shutterTime(s)
        if factor != 1f then s.addFloat("iso", 100f * factor)
      ),
      Step("`maxsampleluminance`", "`maxcomponentvalue`, with a warning")(s =>
        for p <- s.take("maxsampleluminance"); x <- s.numberOf(p) do
          s.warn(
            Code.Inexpressible,
            p.pos,
            "v4 clamps a sample's largest component, v3 its luminance"
          )
          s.addFloat("maxcomponentvalue", x)(using p.pos)
      ),
      pixelBounds,
      drop("display")
    )
  )

  /** An integrator's pixel bounds belong to the film in v4. */
  private def pixelBounds: Step = Step("the integrator's `pixelbounds`", "`pixelbounds`"): s =>
    for i <- s.run.scene.integrator; p <- i.param("pixelbounds") do s.addRaw(p)

  private val extents = Step("`xwidth`, `ywidth`", "`xradius`, `yradius`"): s =>
    for axis <- Seq("x", "y"); p <- s.take(s"${axis}width") do s.add(s"${axis}radius", p)

  private def extentsOf(default: Float): Step =
    otherwise("xradius", s"`xradius`, `yradius` $default by default"): s =>
      for axis <- Seq("x", "y") if !s.contains(s"${axis}radius") do
        s.addFloat(s"${axis}radius", default)

  private val filters = Table("PixelFilter", fallback = "box")(
    Rule("box" -> "box")(extents),
    Rule("triangle" -> "triangle")(extents),
    Rule("gaussian" -> "gaussian")(
      extents,
      extentsOf(2f),
      Step("`alpha`", "`sigma`: √(1 / 2 alpha)")(s =>
        s.addFloat("sigma", sqrt(1f / (2f * s.takeNumber("alpha", 2f))))
      )
    ),
    Rule("mitchell" -> "mitchell")(extents, retain("B", "C")),
    Rule("sinc" -> "sinc")(extents, retain("tau"))
  )

  private val pixelSamples = retain("pixelsamples")

  private val samplers = Table("Sampler", fallback = "zsobol")(
    Rule("halton" -> "halton")(pixelSamples, drop("samplepixelcenter")),
    Rule("sobol" -> "sobol")(pixelSamples),
    Rule("02sequence|lowdiscrepancy" -> "paddedsobol")(pixelSamples, drop("dimensions")),
    Rule("maxmindist" -> "pmj02bn")(pixelSamples, drop("dimensions")),
    Rule("random" -> "independent")(pixelSamples),
    Rule("stratified" -> "stratified")(retain("xsamples", "ysamples", "jitter"), drop("dimensions"))
  )

  private val strategy = Step("`lightsamplestrategy`", "`lightsampler`"): s =>
    for p <- s.take("lightsamplestrategy") do
      val name = p.strings.headOption.filter(Set("uniform", "power"))
      name.foreach(s.addString("lightsampler", _)(using p.pos))

  private val path = Seq(
    retain("maxdepth"),
    strategy,
    drop("rrthreshold", "pixelbounds")
  )

  /** v4 has no integrator that follows specular paths only. */
  private val direct = Step("`maxdepth`", "`maxdepth` 1, if no surface is specular"): s =>
    val depth = s.takeInteger("maxdepth", 5)
    if depth <= 1 || smoothMaterials(s).isEmpty then s.addInteger("maxdepth", 1)
    else
      s.warn(
        Code.Inexpressible,
        s.declaration.pos,
        s"v4 has no \"${s.name}\"; using \"path\", which adds " +
          "indirect light from non-specular surfaces"
      )
      s.addInteger("maxdepth", depth)

  private def smoothMaterials(s: Statement): Seq[String] =
    val smooth = Set("glass", "mirror", "uber", "mix", "hair", "disney")
    s.run.materials.map(_.name).filter(smooth)

  private val sppm = Seq(
    retain("maxdepth", "photonsperiteration", "radius"),
    drop("imagewritefrequency"),
    unsupported("iterations", "v4 uses the number of samples per pixel"),
    unsupported("numiterations", "v4 uses the number of samples per pixel")
  )

  private val integrators = Table("Integrator", fallback = "path")(
    Rule("path" -> "path")(path*),
    Rule("volpath" -> "volpath")(path*),
    Rule("directlighting" -> "path")(direct, drop("strategy", "pixelbounds")),
    Rule("whitted" -> "path")(direct, drop("pixelbounds")),
    Rule("bdpt" -> "bdpt")(
      retain("maxdepth", "visualizestrategies", "visualizeweights"),
      drop("lightsamplestrategy", "pixelbounds")
    ),
    Rule("mlt" -> "mlt")(
      retain("maxdepth", "bootstrapsamples", "chains", "mutationsperpixel", "largestepprobability",
        "sigma")
    ),
    Rule("sppm" -> "sppm")(sppm*),
    Rule.approximate("ambientocclusion" -> "ambientocclusion", "the image is scaled by 1/π")(
      retain("cossample"),
      drop("nsamples", "pixelbounds")
    )
  )

  private val bvh = retain("splitmethod", "maxnodeprims")
  private val kdtree =
    retain("intersectcost", "traversalcost", "emptybonus", "maxprims", "maxdepth")

  /** The accelerator does not affect the image. */
  private[convert] val accelerators = Table("Accelerator")(
    Rule("bvh" -> "bvh")(bvh),
    Rule("kdtree" -> "kdtree")(kdtree)
  )

  private val medium = retain("sigma_a", "sigma_s", "scale", "g", "preset")

  private val media = Table("Medium")(
    Rule("homogeneous" -> "homogeneous")(medium),
    Rule("heterogeneous" -> "uniformgrid")(
      medium,
      retain("density", "nx", "ny", "nz", "p0", "p1")
    )
  )

  // v2 only; removed before this pass.
  private val emptyTables = Seq(Table("Renderer")(), Table("VolumeIntegrator")(), Table("Volume")())

  val pass: Pass = Pass(
    Dialect.V3,
    Dialect.V4,
    Vector(cameras, films, samplers, filters, integrators, accelerators, media) ++ emptyTables ++
      Vector(ToV4Materials.table, ToV4Textures.floats, ToV4Textures.colors, ToV4Lights.table,
        ToV4Lights.area, ToV4Shapes.table),
    Map("PixelFilter" -> "box", "Integrator" -> "path", "Film" -> "image"),
    ToV4Shapes.placed,
    ToV4Textures.placed,
    ToV4Lights.placed
  )

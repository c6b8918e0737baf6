package candela.convert

import candela.diagnostics.Code
import candela.scenefile.{Dialect, MaterialRef, Param, SceneDescription, ShapeDescription}

/** Options, lights and shapes, from v2 to v3. */
object FromV2:
  import Steps.*

  private val camera = Seq(
    retain("frameaspectratio", "screenwindow", "lensradius", "focaldistance", "shutteropen",
      "shutterclose"),
    drop("hither", "yon")
  )

  private val cameras = Table("Camera", fallback = "perspective")(
    Rule("perspective" -> "perspective")((retain("fov", "halffov") +: camera)*),
    Rule("orthographic" -> "orthographic")(camera*),
    Rule("environment" -> "environment")(camera*)
  )

  private def size(name: String, default: Int) =
    otherwise(name, s"`$name` $default")(_.addInteger(name, default))

  private val films = Table("Film", fallback = "image")(
    Rule("image" -> "image")(
      retain("filename", "xresolution", "yresolution", "cropwindow", "scale"),
      size("xresolution", 640),
      size("yresolution", 480),
      drop("display")
    )
  )

  private val extents = retain("xwidth", "ywidth")

  private val filters = Table("PixelFilter", fallback = "box")(
    Rule("box" -> "box")(extents),
    Rule("triangle" -> "triangle")(extents),
    Rule("gaussian" -> "gaussian")(extents, retain("alpha")),
    Rule("mitchell" -> "mitchell")(extents, retain("B", "C")),
    Rule("sinc" -> "sinc")(
      Step("`xwidth`, `ywidth`, `tau`", "unchanged; v2 scales the filter to its width")(s =>
        val tau = s.peek("tau").flatMap(s.numberOf).getOrElse(3f)
        val widths = Seq("xwidth", "ywidth").map(s.peek(_).flatMap(s.numberOf).getOrElse(4f))
        if widths.exists(_ != tau) then
          s.warn(
            Code.Inexpressible,
            s.declaration.pos,
            "a sinc filter has another width in v3, unless its `tau` equals " +
              "its width"
          )
      ),
      extents,
      retain("tau")
    )
  )

  private val samples = Seq(
    retain("pixelsamples"),
    otherwise("pixelsamples", "`pixelsamples` 4")(_.addInteger("pixelsamples", 4))
  )

  private val samplers = Table("Sampler", fallback = "halton")(
    Rule("lowdiscrepancy|bestcandidate" -> "02sequence")(samples*),
    Rule("random" -> "random")(samples*),
    Rule("halton" -> "halton")(samples*),
    Rule.approximate(
      "adaptive" -> "02sequence",
      "takes the maximum number of samples in every pixel"
    )(
      rename("maxsamples" -> "pixelsamples"),
      otherwise("pixelsamples", "`pixelsamples` 32")(_.addInteger("pixelsamples", 32)),
      drop("minsamples", "method")
    ),
    Rule("stratified" -> "stratified")(
      retain("xsamples", "ysamples", "jitter"),
      otherwise("xsamples", "`xsamples` 2")(_.addInteger("xsamples", 2)),
      otherwise("ysamples", "`ysamples` 2")(_.addInteger("ysamples", 2))
    )
  )

  private def oneMore = Step(
    "`maxdepth`",
    "`maxdepth` plus one: v2 lights one vertex that it does " +
      "not count"
  )(s => s.addInteger("maxdepth", s.takeInteger("maxdepth", 5) + 1))

  private def ignored =
    Step("all others", "ignored")(s => s.declaration.params.foreach(p => s.take(p.name)))

  /** @param depth of its image */
  private def traced(names: String, depth: String)(of: Statement => Int) =
    Rule.approximate(names -> "path", "the same image, estimated by path tracing")(
      Step(depth, "`maxdepth`")(s => s.addInteger("maxdepth", of(s))),
      ignored
    )

  private val oneBounce = Step("one bounce", "`maxdepth` 1")(_.addInteger("maxdepth", 1))

  /** Light that materials let in and out, beside direct light. */
  private val beneath = Step("`maxdepth`", "`maxdepth` plus one, of specular bounces"): s =>
    s.addInteger("maxdepth", s.takeInteger("maxdepth", 5) + 1)
    if s.run.materials.exists(m => Set("subsurface", "kdsubsurface")(m.name)) then
      s.convertTo("path")
      s.warn(
        Code.Inexpressible,
        s.declaration.pos,
        "v3 has subsurface scattering in \"path\" alone, which adds indirect light between " +
          "surfaces: the image may be brighter"
      )

  /** The scene with the renderer "metropolis", which replaces the integrator, as one; and with the
    * one material that "glossyprt" gives to all surfaces.
    */
  def prepared(scene: SceneDescription): SceneDescription =
    val unified = scene.renderer.filter(_.name == "metropolis").fold(scene): d =>
      scene.copy(renderer = None, integrator = Some(d.copy(category = "Integrator")))
    unified.integrator.filter(_.name == "glossyprt").fold(unified): prt =>
      val params = prt.params.filter(p => Set("Kd", "Ks", "roughness")(p.name)) ++
        Option.unless(prt.param("Kd").isDefined)(Param.float("Kd", prt.pos, 0.5f))
      val plastic =
        MaterialRef.Inline(prt.copy(category = "Material", name = "plastic", params = params))
      def repainted(shapes: Vector[ShapeDescription]) = shapes.map(_.copy(material = plastic))
      unified.copy(
        shapes = repainted(unified.shapes),
        objects = unified.objects.map((name, shapes) => name -> repainted(shapes))
      )

  // Where v3's defaults are others
  private val metropolis = Seq(
    Step("`maxdepth`", "unchanged")(s => s.addInteger("maxdepth", s.takeInteger("maxdepth", 7))),
    Step("`largestepprobability`", "unchanged")(s =>
      s.addFloat("largestepprobability", s.takeNumber("largestepprobability", 0.25f))
    ),
    rename("samplesperpixel" -> "mutationsperpixel"),
    retain("bootstrapsamples"),
    drop("directsamples", "dodirectseparately", "bidirectional", "maxconsecutiverejects")
  )

  private val integrators = Table("Integrator", fallback = "path")(
    Rule("path" -> "path")(oneMore),
    Rule("directlighting" -> "directlighting")(retain("maxdepth", "strategy")),
    Rule("whitted" -> "whitted")(retain("maxdepth")),
    Rule.approximate(
      "ambientocclusion" -> "ambientocclusion",
      "rays are weighted by the cosine; an unoccluded point has value π"
    )(
      retain("nsamples"),
      unsupported("maxdist", "unlimited distance")
    ),
    Rule("metropolis" -> "mlt")(metropolis*),
    traced("photonmap|exphotonmap", "`maxphotondepth`, `maxspeculardepth`")(s =>
      Math.max(s.takeInteger("maxphotondepth", 5), s.takeInteger("maxspeculardepth", 5)) + 1
    ),
    // Paths to virtual lights have no limit
    traced("igi", "any depth")(_ => 1000),
    traced("irradiancecache", "`maxindirectdepth`")(_.takeInteger("maxindirectdepth", 3) + 1),
    traced("useprobes", "depth 6")(_ => 6),
    Rule("dipolesubsurface" -> "directlighting")(beneath, ignored),
    Rule.approximate(
      "diffuseprt" -> "directlighting",
      "exact direct light, of the materials as they are; v2 sees what they reflect as diffuse light"
    )(oneBounce, ignored),
    // Its material is that of all surfaces: [[prepared]]
    Rule.approximate("glossyprt" -> "directlighting", "exact direct light")(oneBounce, ignored)
  )

  private val lightSamples = Step("`nsamples`", "`samples`"): s =>
    for p <- s.take("nsamples") do s.add("samples", p)

  private def light(name: String, params: String*) =
    Rule(name -> name)((Seq(retain(params*), retain("scale", "samples")) :+ lightSamples)*)

  private val lights = Table("LightSource")(
    light("point", "I", "from"),
    light("spot", "I", "from", "to", "coneangle", "conedeltaangle"),
    light("goniometric", "I", "mapname"),
    light("projection", "I", "fov", "mapname"),
    light("distant", "L", "from", "to"),
    Rule("infinite|exinfinite" -> "infinite")(
      retain("L", "mapname", "scale", "samples"),
      lightSamples
    )
  )

  private val area = Table("AreaLightSource")(
    Rule("diffuse|area" -> "diffuse")(retain("L", "scale", "samples", "twosided"), lightSamples)
  )

  private val quadric = retain("radius", "zmin", "zmax", "phimax")

  private val shapes = Table("Shape")(
    Rule("sphere" -> "sphere")(quadric),
    Rule("cylinder" -> "cylinder")(quadric),
    Rule("paraboloid" -> "paraboloid")(quadric),
    Rule("disk" -> "disk")(retain("height", "radius", "innerradius", "phimax")),
    Rule("cone" -> "cone")(retain("radius", "height", "phimax")),
    Rule("hyperboloid" -> "hyperboloid")(retain("p1", "p2", "phimax")),
    Rule("trianglemesh" -> "trianglemesh")(
      retain("P", "N", "S", "uv", "st", "indices", "alpha"),
      drop("discarddegenerateUVs")
    ),
    Rule("plymesh" -> "plymesh")(retain("filename", "alpha")),
    Rule("loopsubdiv" -> "loopsubdiv")(retain("nlevels", "levels", "P", "indices", "scheme")),
    Rule("heightfield" -> "heightfield")(retain("nu", "nv", "Pz")),
    Rule("nurbs" -> "nurbs")(
      retain("nu", "nv", "uorder", "vorder", "uknots", "vknots", "u0", "u1", "v0", "v1", "P", "Pw")
    )
  )

  private val quadrics = Set("sphere", "cylinder", "paraboloid", "disk", "cone", "hyperboloid")

  /** The illuminated side is the same in both versions; the visibly bright side may differ. */
  private def areaLight(s: ShapeDescription, run: PassRun): Vector[ShapeDescription] =
    val isDisk = s.shape.name == "disk"
    val isMirrored = s.objectToWorld.start.swapsHandedness
    if s.areaLight.nonEmpty && quadrics(s.shape.name) && isDisk != isMirrored then
      val text =
        if isDisk then
          "v2 shows this disk bright on its unlit side, v3 on the other"
        else "v2 shows this reflected area light bright outside, v3 inside"
      run.warn(Code.Inexpressible, s.shape.pos, text)
    Vector(s)

  private val accelerators = Table("Accelerator")(
    Rule("bvh" -> "bvh")(retain("splitmethod"), rename("maxnodeprims" -> "maxnodeprims")),
    Rule("kdtree" -> "kdtree")(
      retain("intersectcost", "traversalcost", "emptybonus", "maxprims", "maxdepth")
    )
  )

  val pass: Pass = Pass(
    Dialect.V2,
    Dialect.V3,
    Vector(
      cameras,
      films,
      samplers,
      filters,
      integrators,
      accelerators,
      lights,
      area,
      shapes,
      FromV2Surfaces.materials,
      FromV2Surfaces.floats,
      FromV2Surfaces.colors,
      Table("Medium")(),
      Table("Renderer")(),
      Table("VolumeIntegrator")(),
      Table("Volume")()
    ),
    Map(
      "PixelFilter" -> "box",
      "Integrator" -> "directlighting",
      "Film" -> "image",
      "Sampler" -> "lowdiscrepancy"
    ),
    shape = areaLight
  )

package candela.mitsuba

import candela.diagnostics.Code

/** The types of Mitsuba 3 and 0.6 that are read, by the element that names them. Those they have
  * besides are known, too, so that messages can tell them from misspelled ones.
  */
object Plugins:
  val bsdfs: Vector[String] = Vector(
    "blendbsdf", "bumpmap", "circular", "coating", "conductor", "dielectric", "difftrans",
    "diffuse", "hair", "hk", "mask", "measured", "mixturebsdf", "normalmap", "null", "phong",
    "plastic", "polarizer", "pplastic", "principled", "principledthin", "retarder", "roughcoating",
    "roughconductor", "roughdielectric", "roughdiffuse", "roughplastic", "thindielectric",
    "twosided", "ward"
  )
  val shapes: Vector[String] =
    Vector(
      "bsplinecurve", "cube", "cylinder", "deformable", "disk", "hair", "heightfield",
      "instance", "linearcurve", "merge", "obj", "ply", "rectangle", "serialized", "shapegroup",
      "sphere"
    )
  val emitters: Vector[String] =
    Vector("area", "constant", "directional", "envmap", "point", "projector", "sky", "spot", "sun",
      "sunsky", "timed_sunsky")
  val textures: Vector[String] = Vector(
    "bitmap", "blackbody", "checkerboard", "d65",
    "gridtexture", "irregular", "mesh_attribute", "rawconstant", "regular", "scale", "srgb",
    "uniform", "vertexcolors", "volume"
  )
  val sensors: Vector[String] =
    Vector("orthographic", "perspective", "perspective_rdist", "spherical", "telecentric",
      "thinlens")
  val integrators: Vector[String] = Vector(
    "adaptive", "ao", "aov", "bdpt", "direct", "erpt",
    "irrcache", "mlt", "moment", "multichannel", "path", "photonmapper", "ppm", "prb",
    "prb_basic", "prbvolpath", "pssmlt", "ptracer", "sppm", "stokes", "volpath", "volpath_simple",
    "volpathmis", "vpl"
  )
  val media: Vector[String] = Vector("heterogeneous", "homogeneous")
  val samplers: Vector[String] =
    Vector("halton", "hammersley", "independent", "ldsampler", "multijitter", "orthogonal",
      "sobol", "stratified")
  val filters: Vector[String] =
    Vector("box", "catmullrom", "gaussian", "lanczos", "mitchell", "tent")
  val films: Vector[String] = Vector("hdrfilm", "ldrfilm", "tiledhdrfilm")
  val phases: Vector[String] =
    Vector("blendphase", "hg", "isotropic", "mixturephase", "rayleigh", "tabphase")
  val volumes: Vector[String] = Vector("constvolume", "gridvolume", "volcache")
  val subsurfaces: Vector[String] = Vector("dipole", "singlescatter")

  /** Types that exist in Mitsuba 3 or 0.6, but are not read. */
  val unsupportedTypes: Map[String, Vector[String]] = Map(
    "bsdf" -> Vector("acousticbsdf", "irawan", "measured_polarized"),
    "texture" -> Vector("curvature", "wireframe"),
    "shape" -> Vector("ellipsoids", "ellipsoidsmesh", "sdfgrid"),
    "emitter" -> Vector("collimated", "directionalarea", "volumelight"),
    "sensor" -> Vector("batch", "distant", "fluencemeter", "irradiancemeter", "radiancemeter"),
    "integrator" -> Vector("acousticpath", "depth", "direct_projective", "emission", "field",
      "motion", "prb_projective", "volprim_rf_basic"),
    "film" -> Vector("mfilm", "specfilm"),
    "phase" -> Vector("kkay", "microflake", "sggx"),
    "volume" -> Vector("hgridvolume")
  )

  /** By element. */
  val read: Map[String, Vector[String]] = Map(
    "bsdf" -> bsdfs,
    "shape" -> shapes,
    "emitter" -> emitters,
    "texture" -> textures,
    "sensor" -> sensors,
    "integrator" -> integrators,
    "medium" -> media,
    "sampler" -> samplers,
    "rfilter" -> filters,
    "film" -> films,
    "phase" -> phases,
    "subsurface" -> subsurfaces,
    "volume" -> volumes
  )

  /** Reports a type that is not read: a warning if Mitsuba has it. */
  def unsupported(p: Plugin, instead: String, session: Session): Unit =
    if unsupportedTypes.getOrElse(p.kind, Vector.empty).contains(p.name) then
      session.warn(Code.Unsupported, p.pos, s"${p.description} is not supported; $instead")
    else
      session.missing(
        Code.UnknownType,
        p.pos,
        s"unknown ${p.description}",
        instead,
        candela.diagnostics.Suggest.help(p.name, read.getOrElse(p.kind, Vector.empty))
      )

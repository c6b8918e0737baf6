package candela.mitsuba

import candela.base.NumberedNames
import candela.color.Rgb
import candela.diagnostics.{Code, SourcePos}
import candela.scenefile.{Declaration, MaterialRef, Param, ParamType}

import scala.collection.mutable

/** A BSDF in terms of pbrt-v4.
  *
  * @param isOneSided whether it is black from behind
  * @param alpha      opacity, a parameter of shapes
  */
final case class Surface(
    material: Declaration,
    isOneSided: Boolean,
    alpha: Option[Param] = None
)

/** Bumps of a surface: a height, or the file of a normal map with the affine map of u and v. */
private[mitsuba] enum Bump:
  case Flat
  case Height(texture: Plugin, scale: Float)
  case Normals(file: String, mapping: Vector[Float])

/** Translates BSDFs, each once. */
final class Surfaces(session: Session, colors: Colors, textures: Textures):
  private val cache = mutable.HashMap.empty[(Plugin, Option[MeshAttributes]), Surface]
  private val named = mutable.LinkedHashMap.empty[String, Declaration]
  private val names = mutable.HashMap.empty[Declaration, String]
  private val numberedNames = NumberedNames()
  private val basic = BasicSurfaces(session, colors, textures)
  private val earlier = EarlierSurfaces(session, colors, textures, basic)
  private val kinds = SurfaceKinds(named.get)
  private var depth = 0

  /** Materials with a name, in order. */
  def result(): Vector[(String, Declaration)] = named.toVector

  def apply(p: Plugin): Surface =
    cache.getOrElse(
      (p, textures.mesh), {
        depth += 1
        if depth > Session.MaxDepth then
          Values.fail(
            Code.Circle,
            p.pos,
            s"more than ${Session.MaxDepth} BSDFs refer to each other"
          )
        val surface =
          try session.translate(p)(translated)
          finally depth -= 1
        cache((p, textures.mesh)) = surface
        surface
      }
    )

  /** On a mesh with attributes. */
  def onMesh(mesh: MeshAttributes, p: Plugin): Surface =
    textures.mesh = Some(mesh)
    try apply(p)
    finally textures.mesh = None

  /** Types of textures that a BSDF uses. */
  def textureTypes(p: Plugin): Set[String] =
    val visited = mutable.HashSet.empty[Plugin]
    def visit(p: Plugin): Unit =
      if visited.add(p) then
        p.properties.map(_.value).foreach:
          case Value.Nested(inner) => visit(inner)
          case Value.Reference(id) => session.lookup(id).foreach(visit)
          case _ => ()
    visit(p)
    visited.iterator.filter(_.kind == "texture").map(_.name).toSet

  /** The material of a shape: by name if the BSDF has an id. */
  def ref(p: Plugin, s: Surface): MaterialRef =
    if p.id.isEmpty then MaterialRef.Inline(s.material)
    else MaterialRef.Named(name(p.id.get, s.material), p.pos)

  private def name(wanted: String, material: Declaration): String =
    names.getOrElseUpdate(
      material, {
        val unique = numberedNames(wanted)
        named(unique) = material
        unique
      }
    )

  private def translated(in: Properties): Surface =
    if in.plugin.isOld then in.ignore("ensure_energy_conservation")
    kindOf(in)

  private def kindOf(in: Properties): Surface = in.plugin.name match
    case "twosided" => twoSided(in)
    case "mask" => masked(in)
    case "bumpmap" | "bump" => bumped(in)
    case "normalmap" => mapped(in)
    case "blendbsdf" => blended(in)
    case "mixturebsdf" => mixture(in)
    case "coating" => coated(in, Vector.empty)
    case "roughcoating" => coated(in, basic.roughness(in))
    case name if EarlierSurfaces.types(name) => earlier(in)
    case _ => basic(in)

  /** The only BSDF within another. */
  private def child(in: Properties): Surface =
    in.nested("bsdf").toList match
      case only :: Nil => apply(only)
      case Nil =>
        session.error(
          Code.MissingParameter,
          in.pos,
          s"${in.plugin.description} must contain a bsdf"
        )
        basic.grey(in)
      case first :: surplus =>
        warnSurplus(in, surplus)
        apply(first)

  private def warnSurplus(in: Properties, surplus: List[Plugin]): Unit =
    for p <- surplus do
      session.warn(
        Code.Nesting,
        p.pos,
        s"${in.plugin.description} has one bsdf too many; this one is ignored"
      )

  private def twoSided(in: Properties): Surface =
    val inner = in.nested("bsdf").toList
    for p <- inner.find(p => kinds.isTransmissive(apply(p))) do
      session.warn(
        Code.Nesting,
        p.pos,
        "Mitsuba rejects \"twosided\" around a transmissive bsdf"
      )
    inner match
      case front :: back :: surplus =>
        warnSurplus(in, surplus)
        sides(in, front, back)
      case only :: Nil
          if !kinds.isTransmissive(apply(only)) && kinds.hasDistinctSides(apply(only)) =>
        sides(in, only, only).copy(alpha = apply(only).alpha)
      case _ => child(in).copy(isOneSided = false)

  private def sides(in: Properties, front: Plugin, back: Plugin): Surface =
    for p <- List(front, back).distinct; alpha <- apply(p).alpha if front ne back do
      unsupported(alpha.pos, "one-sided masks are not supported; this one is opaque")
    val names = List(front, back).map(p => nameOf(p, apply(p)))
    Surface(
      session.declare(
        "Material",
        "twosided",
        in.pos,
        Seq(Param.string("materials", in.pos, names*))
      ),
      isOneSided = false
    )

  private def nameOf(p: Plugin, s: Surface): String = name(p.id.getOrElse(p.name), s.material)

  private def masked(in: Properties): Surface =
    val opacity = textures.number("alpha", in, "opacity", 0.5)
    val inner = child(in)
    // What a mask within another one lets through is a part of its BSDF
    (if inner.alpha.isDefined then inlineMask(inner) else inner).copy(alpha = Some(opacity))

  /** A surface whose mask is a part of its BSDF, as within others: a blend with nothing. */
  def inlineMask(s: Surface): Surface =
    val surface =
      if s.material.name == "interface" then s.copy(material = clear(s.material.pos)) else s
    surface.alpha match
      case None => surface
      case Some(opacity) =>
        val Seq(first, second) = Seq(clear(opacity.pos), blackBehind(surface).material).map: d =>
          name(d.name, d)
        mixed(opacity.pos, first, second, opacity.renamed("amount"))

  /** What passes all light unscattered, but is a surface. */
  private def clear(at: SourcePos): Declaration =
    session.declare("Material", "thindielectric", at, Seq(Param.float("eta", at, 1f)))

  /** With a material that is black from behind by itself, if the surface is. */
  private def blackBehind(s: Surface): Surface =
    if !s.isOneSided then s
    else
      val side = Param.bool("onesided", s.material.pos, true)
      s.copy(material = nested(s.material, Vector(side)), isOneSided = false)

  /** A material within another one that changes it. */
  private def nested(d: Declaration, changes: Vector[Param]): Declaration =
    val inner = Param.string("material", d.pos, name(d.name, d))
    session.declare("Material", "nested", d.pos, inner +: changes)

  private def mixed(at: SourcePos, first: String, second: String, amount: Param): Surface =
    val materials = Param.string("materials", at, first, second)
    Surface(session.declare("Material", "mix", at, Seq(materials, amount)), isOneSided = false)

  private def bumped(in: Properties): Surface =
    val scale = in.number("scale", 1).toFloat
    val texture = in.nested("texture").headOption
    raised(child(in), texture.fold(Bump.Flat)(Bump.Height(_, scale)), normalOptions(in))

  /** How normals that are perturbed are seen. */
  private def normalOptions(in: Properties): Seq[Param] =
    for
      (theirs, ours) <-
        Seq("use_shadowing_function" -> "softedges", "flip_invalid_normals" -> "turnednormals")
      if !in.flag(theirs, true)
    yield Param.bool(ours, in.posOf(theirs), false)

  private def mapped(in: Properties): Surface =
    val maps = in.nested("texture", "normalmap") ++ in.nested("texture")
    val file = maps.headOption.flatMap: t =>
      if t.name != "bitmap" then
        unsupported(t.pos, "only bitmaps can be normal maps; this one is ignored")
        None
      else
        session.translate(t): bitmap =>
          bitmap.ignore("raw", "filter_type", "wrap_mode", "format", "accel")
          bitmap.ignore(Textures.OldOptions*)
          val mapping = textures.imageMapping(bitmap)
          bitmap.text("filename").flatMap(session.file(_, bitmap.posOf("filename"), "ignored"))
            .map(path => Bump.Normals(session.named(path), mapping))
    raised(child(in), file.getOrElse(Bump.Flat), normalOptions(in))

  private def raised(s: Surface, bump: Bump, normalOptions: Seq[Param]): Surface =
    val d = s.material
    val isV4 = d.dialect.isEmpty
    def plain =
      val base = if kinds.takesBump(d) then d else nested(d, Vector.empty)
      if isV4 then base.copy(params = base.params ++ normalOptions) else base
    val material = bump match
      case Bump.Flat => d
      case _ if d.name == "interface" => d
      case Bump.Height(texture, scale) =>
        val name = if isV4 then "displacement" else "bumpmap"
        val shade = Shade.Textured(texture)
        plain.copy(params = plain.params :+ textures.number(name, shade, d.pos, scale))
      case Bump.Normals(file, mapping) if isV4 =>
        val uvMapping = Option.when(mapping != Textures.Upright):
          Param.floats(ParamType.Float, "normalmapuv", d.pos, mapping.toArray)
        plain.copy(params = (plain.params :+ Param.string("normalmap", d.pos, file)) ++ uvMapping)
      case Bump.Normals(_, _) =>
        unsupported(d.pos, "normal maps of this BSDF are not supported; ignored")
        d
    s.copy(material = material)

  private def blended(in: Properties): Surface =
    val weight = textures.number("amount", in, "weight", 0.5)
    in.nested("bsdf").toList match
      case a :: b :: surplus =>
        warnSurplus(in, surplus)
        Mixture.warnOfSmooth(in, Seq(a, b))
        val (Seq(first, second), isOneSided) = components(Seq(a, b)): @unchecked
        mixed(in.pos, first, second, weight).copy(isOneSided = isOneSided)
      case _ =>
        session.error(Code.MissingParameter, in.pos, "blendbsdf must contain two bsdfs")
        basic.grey(in)

  /** Names of what is blended, and whether all of it is black from behind. */
  private def components(inner: Seq[Plugin]): (Seq[String], Boolean) =
    val surfaces = inner.map(p => inlineMask(apply(p)))
    val isOneSided = surfaces.forall(_.isOneSided)
    val names = inner.zip(surfaces).map: (p, s) =>
      nameOf(p, if isOneSided then s else blackBehind(s))
    (names, isOneSided)

  /** A sum of any number of BSDFs by weight; what the weights leave of 1 is black. */
  private def mixture(in: Properties): Surface =
    val inner = in.nested("bsdf")
    Mixture.weights(in, inner.size, "bsdf").filter(_ => inner.nonEmpty).fold(basic.grey(in)):
      weights =>
        val (names, isOneSided) = components(inner)
        val remainder = Math.max(0.0, 1.0 - weights.sum)
        val black = Option.when(remainder > Surfaces.MinRest):
          val d = session.declare(
            "Material",
            "diffuse",
            in.pos,
            Seq(Textures.rgb("reflectance", Rgb.Black, in.pos))
          )
          (name("black", d), remainder)
        val weighted = names.zip(weights).filter(_._2 > 0.0) ++ black
        val (last, _) = weighted.init.foldRight(weighted.last):
          case ((first, weight), (second, others)) =>
            val amount = (others / (weight + others)).toFloat
            val blend = mixed(in.pos, first, second, Param.float("amount", in.pos, amount))
            (name(in.plugin.id.getOrElse("mixturebsdf"), blend.material), weight + others)
        Surface(named(last), isOneSided)

  /** What scatters light beneath a surface, by pbrt's diffusion of photon beams. The roughness of
    * the surface remains.
    */
  def scattering(p: Plugin, s: Option[Surface]): Surface = session.translate(p): in =>
    in.ignore(Surfaces.Sampling*)
    val medium = Presets.coefficients(in, colors)
    for surface <- s if !Surfaces.Interfaces(surface.material.name) do
      unsupported(
        surface.material.pos,
        "the surface of what scatters light beneath it reflects as glass does; this one does, too"
      )
    for
      surface <- s if surface.material.name == "roughplastic"
      base <- surface.material.param("reflectance")
      if base.strings.nonEmpty || base.floats.exists(_ > 0f)
    do
      unsupported(
        base.pos,
        s"diffuse reflection is not supported beside ${p.description}; it is left out"
      )
    unsupported(
      p.pos,
      s"${p.description} is rendered as multiple and single scattering by photon beam diffusion"
    )
    val rough = s.toVector.flatMap(_.material.params)
      .filter(q => Set("uroughness", "vroughness", "remaproughness")(q.name))
    val params = Vector(
      Textures.rgb("sigma_a", medium.sigmaA, in.pos),
      Textures.rgb("sigma_s", medium.sigmaS, in.pos),
      Param.float("eta", in.pos, medium.eta.toFloat)
    )
    Surface(session.declare("Material", "subsurface", in.pos, params ++ rough), isOneSided = false)

  /** A BSDF under a coat, which reflects on either side. */
  private def coated(in: Properties, rough: Vector[Param]): Surface =
    val inner = blackBehind(inlineMask(child(in)))
    val absorption = colors.shade(in, "sigma_a", Rgb.Black, Role.Unbounded)
    val params = Vector(
      Param.string("material", in.pos, name(inner.material.name, inner.material)),
      Param.float("eta", in.pos, Indices.relative(in, "bk7").toFloat),
      Param.float("thickness", in.posOf("thickness"), in.number("thickness", 1).toFloat),
      textures.color("sigma_a", absorption, in.posOf("sigma_a"))
    )
    val gloss = basic.scales(in, "specular_reflectance" -> "specular")
    Surface(
      session.declare("Material", "coating", in.pos, params ++ gloss ++ rough),
      isOneSided = false
    )

  private def unsupported(pos: SourcePos, message: String): Unit =
    session.warn(Code.Unsupported, pos, message)

private object Surfaces:
  /** How precisely Mitsuba 0.6 computes subsurface scattering. */
  private val Sampling = Vector(
    "irr_samples", "irr_indirect", "sample_multiplier", "quality", "fast_single_scatter",
    "fss_samples", "single_scatter_shadow_rays", "single_scatter_transmittance",
    "single_scatter_depth"
  )

  /** Materials whose interface is a dielectric one. */
  private val Interfaces = Set("roughplastic", "dielectric")

  /** What is left of 1 by the rounding of decimal weights. */
  private val MinRest = 1e-6

/** Properties of materials, derived from their declarations.
  *
  * @param named the materials that others contain, by name
  */
private final class SurfaceKinds(named: String => Option[Declaration]):
  private def children(d: Declaration): Iterator[Declaration] =
    for
      p <- d.params.iterator if p.name == "materials" || p.name == "material"
      name <- p.strings.iterator
      inner <- named(name)
    yield inner

  private def isFlat(d: Declaration) = !d.params.exists(p => SurfaceKinds.BumpParams(p.name))

  /** Whether bumps can be added to it. */
  def takesBump(d: Declaration): Boolean = d.name != "mix" && isFlat(d)

  /** Whether the back does not look like the front: it is black, or has bumps. */
  def hasDistinctSides(s: Surface): Boolean = hasDistinctSides(s.material)

  private def hasDistinctSides(d: Declaration): Boolean = d.name match
    case _ if !isFlat(d) => true
    case "principled" => !d.param("thin").exists(_.bools.contains(true))
    case "nested" if d.param("onesided").exists(_.bools.contains(true)) => true
    case "mix" | "nested" | "coating" => children(d).exists(hasDistinctSides)
    case _ => false

  /** Whether light passes through it. */
  def isTransmissive(s: Surface): Boolean = s.alpha.isDefined || isTransmissive(s.material)

  private def isTransmissive(d: Declaration): Boolean = d.name match
    case "interface" | "dielectric" | "thindielectric" | "hair" => true
    case "diffusetransmission" | "scatteringlayer" => true
    case "principled" => Seq("spectrans", "difftrans").flatMap(d.param).exists: p =>
        p.strings.nonEmpty || p.floats.exists(_ > 0f)
    case "mix" | "nested" | "coating" => children(d).exists(isTransmissive)
    case _ => false

private object SurfaceKinds:
  private val BumpParams = Set("displacement", "bumpmap", "normalmap", "normalmapuv")

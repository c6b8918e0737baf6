package candela.mitsuba

import candela.base.{Code, SourcePos}
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
private[mitsuba] enum Relief:
  case Flat
  case Height(texture: Plugin, scale: Float)
  case Normals(file: String, mapping: Vector[Float])

/** Translates BSDFs, each once. */
final class Surfaces(session: Session, colors: Colors, textures: Textures):
  private val made = mutable.HashMap.empty[(Plugin, Option[MeshAttributes]), Surface]
  private val named = mutable.LinkedHashMap.empty[String, Declaration]
  private val names = mutable.HashMap.empty[Declaration, String]
  private val basic = BasicSurfaces(session, colors, textures)
  private val kinds = SurfaceKinds(named.get)
  private var depth = 0

  /** Materials with a name, in order. */
  def result(): Vector[(String, Declaration)] = named.toVector

  def apply(p: Plugin): Surface =
    made.getOrElse(
      (p, textures.mesh), {
        depth += 1
        if depth > Session.Deepest then
          Values.fail(Code.Circle, p.at, s"more than ${Session.Deepest} BSDFs refer to each other")
        val surface =
          try session.of(p)(translated)
          finally depth -= 1
        made((p, textures.mesh)) = surface
        surface
      }
    )

  /** On a mesh with attributes. */
  def on(mesh: MeshAttributes, p: Plugin): Surface =
    textures.mesh = Some(mesh)
    try apply(p)
    finally textures.mesh = None

  /** Types of textures that a BSDF uses. */
  def textureTypes(p: Plugin): Set[String] =
    val seen = mutable.HashSet.empty[Plugin]
    def visit(p: Plugin): Unit =
      if seen.add(p) then
        p.properties.map(_.value).foreach:
          case Value.Nested(inner) => visit(inner)
          case Value.Reference(id) => session.known(id).foreach(visit)
          case _ => ()
    visit(p)
    seen.iterator.filter(_.kind == "texture").map(_.name).toSet

  /** The material of a shape: by name if the BSDF has an id. */
  def ref(p: Plugin, s: Surface): MaterialRef =
    if p.id.isEmpty then MaterialRef.Inline(s.material)
    else MaterialRef.Named(name(p.id.get, s.material), p.at)

  private def name(wanted: String, material: Declaration): String =
    names.getOrElseUpdate(
      material, {
        val unique =
          (Iterator(
            wanted
          ) ++ Iterator.from(2).map(i => s"$wanted $i")).find(!named.contains(_)).get
        named(unique) = material
        unique
      }
    )

  private def translated(in: Asked): Surface = in.plugin.name match
    case "twosided" => twoSided(in)
    case "mask" => masked(in)
    case "bumpmap" => bumped(in)
    case "normalmap" => mapped(in)
    case "blendbsdf" => blended(in)
    case _ => basic(in)

  /** The only BSDF within another. */
  private def child(in: Asked): Surface =
    in.nested("bsdf").toList match
      case only :: Nil => apply(only)
      case Nil =>
        session.error(Code.MissingParameter, in.at, s"${in.plugin.shown} must contain a bsdf")
        basic.grey(in)
      case first :: others =>
        surplus(in, others)
        apply(first)

  private def surplus(in: Asked, others: List[Plugin]): Unit =
    for p <- others do
      session.warn(
        Code.Nesting,
        p.at,
        s"${in.plugin.shown} has one bsdf too many; this one is ignored"
      )

  private def twoSided(in: Asked): Surface =
    val inner = in.nested("bsdf").toList
    for p <- inner.find(p => kinds.isTransmissive(apply(p))) do
      session.warn(
        Code.Nesting,
        p.at,
        "Mitsuba rejects \"twosided\" around a transmissive bsdf"
      )
    inner match
      case front :: back :: others =>
        surplus(in, others)
        sides(in, front, back)
      case only :: Nil if !kinds.isTransmissive(apply(only)) && kinds.tellsSides(apply(only)) =>
        sides(in, only, only).copy(alpha = apply(only).alpha)
      case _ => child(in).copy(isOneSided = false)

  private def sides(in: Asked, front: Plugin, back: Plugin): Surface =
    for p <- List(front, back).distinct; alpha <- apply(p).alpha if front ne back do
      session.warn(
        Code.Unsupported,
        alpha.at,
        "one-sided masks are not supported; this one is opaque"
      )
    val names = List(front, back).map(p => nameOf(p, apply(p)))
    Surface(
      session.declare(
        "Material",
        "twosided",
        in.at,
        Seq(Param.string("materials", in.at, names*))
      ),
      isOneSided = false
    )

  private def nameOf(p: Plugin, s: Surface): String = name(p.id.getOrElse(p.name), s.material)

  private def masked(in: Asked): Surface =
    val opacity = textures.number("alpha", in, "opacity", 0.5)
    val inner = child(in)
    // What a mask within another one lets through is a part of its BSDF
    (if inner.alpha.isDefined then whole(inner) else inner).copy(alpha = Some(opacity))

  /** A surface whose mask is a part of its BSDF, as within others: a blend with nothing. */
  def whole(s: Surface): Surface =
    val there =
      if s.material.name == "interface" then s.copy(material = clear(s.material.at)) else s
    there.alpha match
      case None => there
      case Some(opacity) =>
        val Seq(first, second) = Seq(clear(opacity.at), one(there).material).map: d =>
          name(d.name, d)
        mixed(opacity.at, first, second, opacity.renamed("amount"))

  /** What passes all light unscattered, but is a surface. */
  private def clear(at: SourcePos): Declaration =
    session.declare("Material", "thindielectric", at, Seq(Param.float("eta", at, 1f)))

  /** With a material that is black from behind by itself, if the surface is. */
  private def one(s: Surface): Surface =
    if !s.isOneSided then s
    else
      val side = Param.bool("onesided", s.material.at, true)
      s.copy(material = nested(s.material, Vector(side)), isOneSided = false)

  /** A material within another one that changes it. */
  private def nested(d: Declaration, changes: Vector[Param]): Declaration =
    val inner = Param.string("material", d.at, name(d.name, d))
    session.declare("Material", "nested", d.at, inner +: changes)

  private def mixed(at: SourcePos, first: String, second: String, amount: Param): Surface =
    val parts = Param.string("materials", at, first, second)
    Surface(session.declare("Material", "mix", at, Seq(parts, amount)), isOneSided = false)

  private def bumped(in: Asked): Surface =
    val scale = in.number("scale", 1).toFloat
    val texture = in.nested("texture").headOption
    raised(child(in), texture.fold(Relief.Flat)(Relief.Height(_, scale)), seen(in))

  /** How normals that are perturbed are seen. */
  private def seen(in: Asked): Seq[Param] =
    for
      (theirs, ours) <-
        Seq("use_shadowing_function" -> "softedges", "flip_invalid_normals" -> "turnednormals")
      if !in.flag(theirs, true)
    yield Param.bool(ours, in.atOf(theirs), false)

  private def mapped(in: Asked): Surface =
    val maps = in.nested("texture", "normalmap") ++ in.nested("texture")
    val file = maps.headOption.flatMap: t =>
      if t.name != "bitmap" then
        session.warn(Code.Unsupported, t.at, "only bitmaps can be normal maps; this one is ignored")
        None
      else
        session.of(t): of =>
          of.ignore("raw", "filter_type", "wrap_mode", "format", "accel")
          val mapping = textures.imageMapping(of)
          of.text("filename").flatMap(session.file(_, of.atOf("filename"), "ignored"))
            .map(path => Relief.Normals(session.named(path), mapping))
    raised(child(in), file.getOrElse(Relief.Flat), seen(in))

  private def raised(s: Surface, relief: Relief, seen: Seq[Param]): Surface =
    val d = s.material
    val isV4 = d.dialect.isEmpty
    def plain =
      val own = if kinds.takesRelief(d) then d else nested(d, Vector.empty)
      if isV4 then own.copy(params = own.params ++ seen) else own
    val material = relief match
      case Relief.Flat => d
      case _ if d.name == "interface" => d
      case Relief.Height(texture, scale) =>
        val name = if isV4 then "displacement" else "bumpmap"
        val shade = Shade.Textured(texture)
        plain.copy(params = plain.params :+ textures.number(name, shade, d.at, scale))
      case Relief.Normals(file, mapping) if isV4 =>
        val place = Option.when(mapping != Textures.Upright):
          Param.floats(ParamType.Float, "normalmapuv", d.at, mapping.toArray)
        plain.copy(params = (plain.params :+ Param.string("normalmap", d.at, file)) ++ place)
      case Relief.Normals(_, _) =>
        session.warn(Code.Unsupported, d.at, "normal maps of this BSDF are not supported; ignored")
        d
    s.copy(material = material)

  private def blended(in: Asked): Surface =
    val weight = textures.number("amount", in, "weight", 0.5)
    in.nested("bsdf").toList match
      case a :: b :: others =>
        surplus(in, others)
        val parts = List(a, b).map(p => whole(apply(p)))
        val isOneSided = parts.forall(_.isOneSided)
        val Seq(first, second) = List(a, b).zip(parts).map: (p, s) =>
          nameOf(p, if isOneSided then s else one(s))
        mixed(in.at, first, second, weight).copy(isOneSided = isOneSided)
      case _ =>
        session.error(Code.MissingParameter, in.at, "blendbsdf must contain two bsdfs")
        basic.grey(in)

/** Properties of materials, derived from their declarations.
  *
  * @param named the materials that others contain, by name
  */
private final class SurfaceKinds(named: String => Option[Declaration]):
  private def within(d: Declaration): Iterator[Declaration] =
    for
      p <- d.params.iterator if p.name == "materials" || p.name == "material"
      name <- p.strings.iterator
      inner <- named(name)
    yield inner

  private def isFlat(d: Declaration) = !d.params.exists(p => SurfaceKinds.Reliefs(p.name))

  /** Whether bumps can be added to it. */
  def takesRelief(d: Declaration): Boolean = d.name != "mix" && isFlat(d)

  /** Whether the back does not look like the front: it is black, or has bumps. */
  def tellsSides(s: Surface): Boolean = tellsSides(s.material)

  private def tellsSides(d: Declaration): Boolean = d.name match
    case _ if !isFlat(d) => true
    case "principled" => !d.param("thin").exists(_.bools.contains(true))
    case "nested" if d.param("onesided").exists(_.bools.contains(true)) => true
    case "mix" | "nested" => within(d).exists(tellsSides)
    case _ => false

  /** Whether light passes through it. */
  def isTransmissive(s: Surface): Boolean = s.alpha.isDefined || isTransmissive(s.material)

  private def isTransmissive(d: Declaration): Boolean = d.name match
    case "interface" | "dielectric" | "thindielectric" | "hair" => true
    case "principled" => Seq("spectrans", "difftrans").flatMap(d.param).exists: p =>
        p.strings.nonEmpty || p.floats.exists(_ > 0f)
    case "mix" | "nested" => within(d).exists(isTransmissive)
    case _ => false

private object SurfaceKinds:
  private val Reliefs = Set("displacement", "bumpmap", "normalmap", "normalmapuv")

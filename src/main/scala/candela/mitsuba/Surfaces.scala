package candela.mitsuba

import candela.scenefile.{Declaration, MaterialRef, Param, ParamType}

import scala.collection.mutable

/** What a BSDF becomes.
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
  private val made = mutable.HashMap.empty[(Plugin, Relief, Option[MeshAttributes]), Surface]
  private val named = mutable.LinkedHashMap.empty[String, Declaration]
  private val names = mutable.HashMap.empty[Declaration, String]
  private val basic = BasicSurfaces(session, colors, textures)
  private var depth = 0

  /** Materials with a name, in order. */
  def result(): Vector[(String, Declaration)] = named.toVector

  def apply(p: Plugin): Surface = of(p, Relief.Flat)

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

  private def of(p: Plugin, relief: Relief): Surface =
    made.getOrElse(
      (p, relief, textures.mesh), {
        depth += 1
        if depth > Session.Deepest then
          Values.fail(p.at, s"more than ${Session.Deepest} BSDFs refer to each other")
        val surface =
          try session.of(p)(translated(_, relief))
          finally depth -= 1
        made((p, relief, textures.mesh)) = surface
        surface
      }
    )

  private def translated(in: Asked, relief: Relief): Surface = in.plugin.name match
    case "twosided" => twoSided(in, relief)
    case "mask" => masked(in, relief)
    case "bumpmap" => bumped(in, relief)
    case "normalmap" => mapped(in, relief)
    case "blendbsdf" => blended(in, relief)
    case _ =>
      val s = basic(in)
      s.copy(material = raised(s.material, relief))

  /** The only BSDF within another. */
  private def child(in: Asked, relief: Relief): Surface =
    in.nested("bsdf").toList match
      case only :: Nil => of(only, relief)
      case Nil =>
        session.error(in.at, s"${in.plugin.shown} must contain a bsdf")
        basic.grey(in)
      case first :: second :: _ =>
        session.warn(second.at, s"${in.plugin.shown} has one bsdf too many; this one is ignored")
        of(first, relief)

  private def twoSided(in: Asked, relief: Relief): Surface =
    in.nested("bsdf").toList match
      case front :: back :: others =>
        others.foreach: p =>
          session.warn(p.at, s"${in.plugin.shown} has one bsdf too many; this one is ignored")
        val both = sides(in, side(front), side(back), Vector.empty)
        both.copy(material = raised(both.material, relief))
      case only :: Nil =>
        val s = of(only, relief)
        if !isBlackBehind(s.material) then s.copy(isOneSided = false)
        else
          val (bumps, plain) = level(s)
          sides(in, only -> plain, only -> plain, bumps).copy(alpha = s.alpha)
      case _ => child(in, relief).copy(isOneSided = false)

  /** One of two sides. */
  private def side(p: Plugin): (Plugin, Surface) =
    val s = of(p, Relief.Flat)
    val (bumps, plain) = level(s)
    if bumps.nonEmpty then
      session.warn(p.at, "bumps of one side alone are not supported; this side is level")
    for alpha <- s.alpha do
      session.warn(alpha.at, "a mask of one side alone is not supported; it is opaque")
    p -> plain

  /** The parameters of bumps, and the surface without them. */
  private def level(s: Surface): (Vector[Param], Surface) =
    val (bumps, others) = s.material.params.partition(p => Surfaces.Reliefs(p.name))
    (bumps, if bumps.isEmpty then s else s.copy(material = s.material.copy(params = others)))

  private def sides(
      in: Asked,
      front: (Plugin, Surface),
      back: (Plugin, Surface),
      bumps: Vector[Param]
  ): Surface =
    val names = List(front, back).map((p, s) => name(p.id.getOrElse(p.name), s.material))
    val params = Param.string("materials", in.at, names*) +: bumps
    Surface(session.declare("Material", "twosided", in.at, params), isOneSided = false)

  /** Whether its lobes are black from behind. */
  private def isBlackBehind(d: Declaration): Boolean = d.name match
    case "principled" => !d.param("thin").exists(_.bools.contains(true))
    case "mix" =>
      d.param("materials").exists(_.strings.flatMap(named.get).exists(isBlackBehind))
    case _ => false

  private def masked(in: Asked, relief: Relief): Surface =
    child(in, relief).copy(alpha = Some(textures.number("alpha", in, "opacity", 0.5)))

  private def bumped(in: Asked, relief: Relief): Surface =
    val scale = in.number("scale", 1).toFloat
    val heights = in.nested("texture")
    if relief != Relief.Flat then
      session.warn(in.at, "bumps of bumps are not supported; using the outer ones")
    child(
      in,
      heights.headOption.filter(_ => relief == Relief.Flat).fold(relief):
        Relief.Height(_, scale)
    )

  private def mapped(in: Asked, relief: Relief): Surface =
    val maps = in.nested("texture", "normalmap") ++ in.nested("texture")
    in.ignore("flip_invalid_normals", "use_shadowing_function")
    val file = maps.headOption.flatMap: t =>
      if t.name != "bitmap" then
        session.warn(t.at, "only bitmaps can be normal maps; this one is ignored")
        None
      else
        session.of(t): of =>
          of.ignore("raw", "filter_type", "wrap_mode", "format", "accel")
          val mapping = textures.imageMapping(of)
          of.text("filename").flatMap(session.file(_, of.atOf("filename"), "ignored"))
            .map(path => Relief.Normals(session.named(path), mapping))
    child(in, file.getOrElse(relief))

  private def raised(d: Declaration, relief: Relief): Declaration =
    val isV4 = d.dialect.isEmpty
    relief match
      case Relief.Flat => d
      case _ if d.name == "interface" || d.name == "mix" => d
      case Relief.Height(texture, scale) =>
        val name = if isV4 then "displacement" else "bumpmap"
        d.copy(params = d.params :+ textures.number(name, Shade.Textured(texture), d.at, scale))
      case Relief.Normals(file, mapping) if isV4 =>
        val place = Option.when(mapping != Textures.Upright):
          Param.floats(ParamType.Float, "normalmapuv", d.at, mapping.toArray)
        d.copy(params = (d.params :+ Param.string("normalmap", d.at, file)) ++ place)
      case Relief.Normals(_, _) =>
        session.warn(d.at, "normal maps of this BSDF are not supported; ignored")
        d

  private def blended(in: Asked, relief: Relief): Surface =
    val weight = textures.number("amount", in, "weight", 0.5)
    in.nested("bsdf").toList match
      case a :: b :: _ =>
        val (first, second) = (of(a, relief), of(b, relief))
        for s <- List(first, second); alpha <- s.alpha do
          session.warn(alpha.at, "a mask within a blend is not supported; it is opaque")
        val parts = List(a -> first, b -> second).map: (p, s) =>
          name(p.id.getOrElse(p.name), s.material)
        val material = session.declare(
          "Material",
          "mix",
          in.at,
          Seq(Param.string("materials", in.at, parts*), weight)
        )
        Surface(material, first.isOneSided && second.isOneSided)
      case _ =>
        session.error(in.at, "blendbsdf must contain two bsdfs")
        basic.grey(in)

private object Surfaces:
  private val Reliefs = Set("displacement", "bumpmap", "normalmap", "normalmapuv")

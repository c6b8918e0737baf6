package candela.convert

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.*

import scala.collection.mutable

/** Paints textures over the surface parameters u and v. */
object BakedTextures:

  /** Defines an image texture of the target dialect that replaces a texture of the source dialect;
    * returns its name. None if the user did not choose to bake, or if the texture is not a function
    * of u and v alone.
    *
    * @param why    what the target dialect lacks, for the warning
    * @param change applied to the values
    */
  def define(s: Statement, texture: TextureDescription, reason: String)(
      change: Rgb => Rgb = identity
  ): Option[String] =
    for
      baking <- s.run.baking
      dependencies = s.run.textureUses.closure(texture)
      window <- Window.of(dependencies.map(_.texture))
      value <- baking.values(SceneDescription(s.run.pass.from, textures = dependencies))
    yield
      val file = baking.write(s.run.files): (x, y) =>
        change(value(window.u(x), window.v(y), Vec3.Zero))
      val repeats = if window.repeats then "" else ", which repeats where u or v is not in [0, 1]"
      s.warn(Code.Inexpressible, s.declaration.pos, s"$reason; using ${baking.describe}$repeats")
      s.run.define(texture.copy(
        name = s"${texture.name} baked",
        texture = window.image(texture.texture, file, s.run.pass.to),
        textureToWorld = GraphicsState.Identity
      ))

/** Which textures of a scene others use. */
final class TextureUses(textures: Vector[TextureDescription]):
  private val named = textures.zipWithIndex.groupBy(_._1.name)

  /** The textures that one needs, in statement order, with itself last. */
  def closure(texture: TextureDescription): Vector[TextureDescription] =
    val visited = mutable.TreeSet.empty[Int]
    def visit(t: TextureDescription): Unit =
      for
        p <- t.texture.params if p.paramType == ParamType.Texture
        name <- p.strings
        (needed, i) <- named.getOrElse(name, Vector.empty) if needed != texture && visited.add(i)
      do visit(needed)
    visit(texture)
    visited.iterator.map(textures).toVector :+ texture

/** Part of the texture plane that a baked image shows: u = (s − du) / su, and v likewise.
  *
  * @param repeats whether the texture repeats beyond it
  */
final class Window(su: Float, sv: Float, du: Float, dv: Float, val repeats: Boolean = true):
  def u(s: Float): Float = (s - du) / su
  def v(t: Float): Float = (t - dv) / sv

  /** The image texture that shows it. */
  def image(source: Declaration, file: String, dialect: Dialect): Declaration =
    val position = source.pos
    def word(name: String, value: String) =
      Param(ParamType.String, name, position, position, strings = Vector(value))
    // v2 reads images upside down
    val (scale, delta) = if dialect == Dialect.V2 then (-sv, 1f - dv) else (sv, dv)
    val numbers = Vector("uscale" -> su, "vscale" -> scale, "udelta" -> du, "vdelta" -> delta)
    val placed =
      for (name, x) <- numbers if x != (if name.endsWith("scale") then 1f else 0f)
      yield Param(ParamType.Float, name, position, position, floats = Array(x))
    // v3 always filters by EWA unless told otherwise
    val filter = Option.when(dialect == Dialect.V4)(word("filter", "ewa"))
    source.copy(
      name = "imagemap",
      params = (word("filename", file) +: placed) ++ filter,
      colorSpace = "srgb"
    )

object Window:
  private val Whole = Window(1f, 1f, 0f, 0f, _)

  /** What shows all of a texture that is made of these; None if it does not depend on u and v
    * alone.
    */
  def of(declarations: Vector[Declaration]): Option[Window] =
    val mapped = declarations.filter(d => Mapped(d.name))
    Option.when(declarations.forall(d => (Mapped(d.name) || Plain(d.name)) && isFlat(d))):
      val placements = mapped.map(Placement.of).distinct
      val periods = mapped.map(period)
      val isPeriodic = periods.forall(_.nonEmpty)
      val maxPeriod = periods.flatten.maxOption.getOrElse(1f)
      placements match
        case Vector(p) if isPeriodic && p.su != 0f && p.sv != 0f =>
          Window(
            p.su / maxPeriod,
            p.sv / maxPeriod,
            p.du / maxPeriod,
            p.dv / maxPeriod,
            repeats = true
          )
        case _ =>
          def fits(scale: Float) = (scale / maxPeriod).isWhole
          Whole(isPeriodic && placements.forall(p => fits(p.su) && fits(p.sv)))

  private val Mapped = Set("imagemap", "checkerboard", "dots", "bilerp", "uv")
  private val Plain = Set("constant", "scale", "mix")

  private def isFlat(d: Declaration) =
    d.param("mapping").forall(_.strings == Vector("uv")) &&
      d.param("dimension").forall(_.ints.headOption.forall(_ == 2))

  /** Period of a texture in s and t, if it has one. */
  private def period(d: Declaration): Option[Float] = d.name match
    case "uv" => Some(1f)
    case "checkerboard" => Some(2f)
    case "imagemap" =>
      Option.when(d.param("wrap").forall(_.strings == Vector("repeat")))(1f)
    case _ => None

  /** Coordinates of a texture: s = su · u + du, and t likewise. */
  private final case class Placement(su: Float, sv: Float, du: Float, dv: Float)

  private object Placement:
    def of(d: Declaration): Placement =
      def number(name: String, default: Float) =
        d.param(name).flatMap(_.floats.headOption).getOrElse(default)
      Placement(
        number("uscale", 1f),
        number("vscale", 1f),
        number("udelta", 0f),
        number("vdelta", 0f)
      )

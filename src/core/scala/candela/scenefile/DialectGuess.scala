package candela.scenefile

import candela.diagnostics.SourcePos
import scala.collection.mutable

/** Collects a file's directives and names, and estimates its dialect. Parsing never depends on the
  * estimate.
  */
final class DialectGuess:
  private val occurrences = mutable.HashMap.empty[String, mutable.LinkedHashMap[String, SourcePos]]

  /** Records a directive, parameter type, or implementation of a category. */
  def uses(category: String, name: String, at: SourcePos): Unit =
    if name.nonEmpty then
      val names = occurrences.getOrElseUpdate(category, mutable.LinkedHashMap.empty)
      if !names.contains(name) then names(name) = at

  /** The evidence so far. */
  def clues: Vector[DialectClue] =
    val evidence =
      for
        e <- DialectGuess.Table
        names <- occurrences.get(e.category)
        (name, at) <- names.find((n, _) => e.names(n))
      yield DialectClue(DialectGuess.description(e.category, name), Some(at), e.v2, e.v3, e.v4)
    val hasEnd = occurrences.get("directive").exists(_.contains("WorldEnd"))
    evidence.toVector ++ Option.unless(hasEnd)(DialectGuess.NoWorldEnd)

  def dialect: Dialect = DialectGuess.likeliest(clues)

/** Evidence for some dialects.
  *
  * @param what as shown in messages
  */
final case class DialectClue(what: String, pos: Option[SourcePos], v2: Int, v3: Int, v4: Int):
  def weight(d: Dialect): Int = d match
    case Dialect.V2 => v2
    case Dialect.V3 => v3
    case Dialect.V4 => v4
    case Dialect.Mitsuba | Dialect.Gltf => 0

/** Weight of any of these names for each dialect, counted once: 20 is decisive, 6 is known to no
  * other dialect, 1 to 3 are conventions.
  */
private final case class Evidence(category: String, names: Set[String], v2: Int, v3: Int, v4: Int)

object DialectGuess:
  /** The dialect with the highest total weight; ties go to the newest. */
  def likeliest(clues: Vector[DialectClue]): Dialect =
    Dialect.ofPbrt.reverse.maxBy(d => clues.map(_.weight(d)).sum)

  private val NoWorldEnd = DialectClue("no WorldEnd", None, 0, 0, 6)

  private def description(category: String, name: String): String = category match
    case "directive" => name
    case "type" => s"the type \"$name\""
    case _ => s"$category \"$name\""

  /** Sources: the implementation names of pbrt-v2, -v3 and -v4, and frequencies in public scene
    * files (which prefer `color` and `point` in v2, `rgb` in v3, `point3` in v4).
    */
  private val Table: List[Evidence] = List(
    row("directive", 20, 0, 0)("SurfaceIntegrator VolumeIntegrator Renderer Volume"),
    row("directive", 0, 6, 6)("Integrator"),
    row("directive", 0, 4, 4)("MakeNamedMedium MediumInterface"),
    row("directive", 0, 0, 20)("Attribute Option ColorSpace Import"),
    row("directive", 4, 4, 0)("WorldEnd"),
    row("Film", 4, 4, 0)("image"),
    row("Film", 0, 0, 10)("rgb gbuffer spectral"),
    row("Sampler", 6, 0, 0)("bestcandidate adaptive"),
    row("Sampler", 5, 1, 0)("lowdiscrepancy"),
    row("Sampler", 0, 6, 0)("02sequence maxmindist"),
    row("Sampler", 0, 0, 6)("zsobol paddedsobol pmj02bn independent"),
    row("Sampler", 1, 3, 2)("halton"),
    row("Sampler", 0, 3, 3)("sobol"),
    row("Sampler", 2, 2, 0)("random"),
    row("Camera", 3, 3, 0)("environment"),
    row("Camera", 0, 0, 6)("spherical"),
    row("Accelerator", 6, 0, 0)("grid"),
    row("Integrator", 0, 4, 0)("directlighting whitted"),
    row("Integrator", 0, 0, 6)("simplepath simplevolpath lightpath randomwalk function"),
    row("Material", 3, 3, 0)("matte plastic metal glass mirror uber substrate"),
    row("Material", 3, 3, 0)("translucent kdsubsurface"),
    row("Material", 6, 0, 0)("shinymetal"),
    row("Material", 3, 0, 3)("measured"),
    row("Material", 0, 6, 0)("fourier disney"),
    row("Material", 0, 0, 6)("diffuse coateddiffuse conductor coatedconductor dielectric"),
    row("Material", 0, 0, 6)("thindielectric diffusetransmission interface"),
    row("Shape", 0, 2, 2)("plymesh curve"),
    row("Shape", 2, 2, 0)("cone paraboloid hyperboloid heightfield nurbs"),
    row("Shape", 0, 0, 6)("bilinearmesh"),
    row("AreaLightSource", 2, 1, 0)("area"),
    row("AreaLightSource", 1, 2, 2)("diffuse"),
    row("type", 2, 1, 0)("color"),
    row("type", 1, 1, 0)("point vector"),
    row("type", 0, 1, 2)("point2 point3 vector2 vector3"),
    row("type", 0, 2, 2)("rgb")
  )

  private def row(category: String, v2: Int, v3: Int, v4: Int)(names: String): Evidence =
    Evidence(category, names.split(' ').toSet, v2, v3, v4)

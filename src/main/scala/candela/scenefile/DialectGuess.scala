package candela.scenefile

import scala.collection.mutable

/** Collects a file's directives and names, and estimates its dialect. Parsing never depends on the
  * estimate.
  */
final class DialectGuess:
  private val seen = mutable.HashMap.empty[String, mutable.HashSet[String]]

  /** Records a directive, parameter type, or implementation of a category. */
  def uses(category: String, name: String): Unit =
    if name.nonEmpty then
      val names = seen.getOrElseUpdate(category, mutable.HashSet.empty)
      if !names.contains(name) then names += name

  /** The dialect with the highest total weight; ties go to the newest. */
  def dialect: Dialect =
    val found = DialectGuess.Table.filter(e => seen.get(e.category).exists(s => e.names.exists(s)))
    val absent = if seen.get("directive").exists(_("WorldEnd")) then Nil else List(NoWorldEnd)
    def sum(weight: Evidence => Int) = (found ++ absent).map(weight).sum
    List(Dialect.V4 -> sum(_.v4), Dialect.V3 -> sum(_.v3), Dialect.V2 -> sum(_.v2)).maxBy(_._2)._1

  private val NoWorldEnd = Evidence("directive", Set.empty, 0, 0, 6)

/** Weight of any of these names for each dialect, counted once: 10 is decisive, 6 is known to no
  * other dialect, 1 to 3 are conventions.
  */
private final case class Evidence(category: String, names: Set[String], v2: Int, v3: Int, v4: Int)

object DialectGuess:

  /** Sources: the implementation names of pbrt-v2, -v3 and -v4, and frequencies in public scene
    * files (which prefer `color` and `point` in v2, `rgb` in v3, `point3` in v4).
    */
  private val Table: List[Evidence] = List(
    row("directive", 10, 0, 0)("SurfaceIntegrator VolumeIntegrator Renderer Volume"),
    row("directive", 0, 6, 6)("Integrator"),
    row("directive", 0, 4, 4)("MakeNamedMedium MediumInterface"),
    row("directive", 0, 0, 10)("Attribute Option ColorSpace Import"),
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

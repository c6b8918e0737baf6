package candela.build

import candela.diagnostics.{Code, Problem}
import scala.collection.mutable

import candela.build.recipe.{Dialects, Recipes, ValueTypes}
import candela.scenefile.*

/** The dialect of a scene that does not say it: the parser's estimate, weighed with the parameters,
  * which only recipes know. v4 scenes are read by other rules and stay v4.
  */
object DialectChoice:
  /** Weight of a parameter that only one of v2 and v3 has, and of all of them together. */
  private val PerParameter = 3
  private val MaxParameterWeight = 15

  /** Weight from which a clue against the choice is told. */
  private val Contrary = 3

  /** @param asked the dialect that the user asked for, if any */
  def of(scene: SceneDescription, asked: Option[Dialect]): SceneDescription =
    if asked.nonEmpty then scene.copy(dialectReason = "as requested")
    else
      val clues = scene.clues ++
        (if scene.dialect == Dialect.V4 then Vector.empty else parameters(scene))
      val likeliest = Vector(Dialect.V3, Dialect.V2).maxBy(d => clues.map(_.weight(d)).sum)
      val chosen = if scene.dialect == Dialect.V4 then Dialect.V4 else likeliest
      scene.copy(
        dialect = chosen,
        dialectReason = reason(clues, chosen),
        warnings = scene.warnings ++ contradiction(clues, chosen)
      )

  /** What speaks for the choice, strongest first. */
  private def reason(clues: Vector[DialectClue], chosen: Dialect): String =
    val alternatives = Dialect.ofPbrt.filter(_ != chosen)
    def lead(c: DialectClue) = c.weight(chosen) - alternatives.map(c.weight).min
    val telling = clues.filter(lead(_) > 0).sortBy(c => -lead(c)).take(4)
    if telling.isEmpty then "the file has no clues"
    else "for " + telling.map(describe).mkString(", ")

  private def describe(c: DialectClue): String =
    c.what + c.pos.fold("")(at => s" (line ${at.line})")

  private def contradiction(clues: Vector[DialectClue], chosen: Dialect): Option[Problem] =
    val contrary = clues.filter: c =>
      c.weight(chosen) == 0 && Dialect.ofPbrt.exists(c.weight(_) >= Contrary) && c.pos.nonEmpty
    contrary.headOption.map: first =>
      val contradictions = contrary.map: c =>
        val owners = Dialect.ofPbrt.toSet.filter(c.weight(_) > 0)
        s"${describe(c)} is of ${Dialects.list(owners)}"
      val name = Dialects.name(chosen)
      // Of two that fit as well, the newer one
      val alternative = Dialect.ofPbrt.reverse.maxBy(d => contrary.map(_.weight(d)).sum)
      Problem.warning(
        Code.MixedDialects,
        first.pos.get,
        s"the scene is read as $name (${reason(clues, chosen)}), but " +
          contradictions.mkString(", "),
        Some(
          s"`--dialect ${Dialects.name(alternative)}` reads it as ${Dialects.name(alternative)}, " +
            s"`--dialect $name` without this warning"
        )
      )

  /** Parameters that only one of v2 and v3 has, each counted once. */
  private def parameters(scene: SceneDescription): Vector[DialectClue] =
    val keys = mutable.HashSet.empty[(String, String, ParamType, String)]
    val clues = Vector.newBuilder[DialectClue]
    def add(category: String, d: Declaration): Unit =
      for p <- d.params do
        if keys.add((category, d.name, p.paramType, p.name)) then
          val recipes = Language.categories.find(_.name == category).get.recipes
          val (inV2, inV3) = (fits(recipes, d, p, Dialect.V2), fits(recipes, d, p, Dialect.V3))
          if inV2 != inV3 then
            val description = s"\"${p.paramType.spelling} ${p.name}\" of \"${d.name}\""
            val (v2, v3) = if inV2 then (PerParameter, 0) else (0, PerParameter)
            clues += DialectClue(description, Some(p.pos), v2, v3, 0)
    def addMaterial(m: MaterialRef): Unit = m match
      case MaterialRef.Inline(d) => add("Material", d)
      case _ => ()
    for (category, d) <- settings(scene); declared <- d do add(category, declared)
    for (_, d) <- scene.namedMaterials do add("Material", d)
    for t <- scene.textures do add(s"Texture (${t.valueType})", t.texture)
    for l <- scene.lights do add("LightSource", l.light)
    for s <- scene.shapes.iterator ++ scene.objects.valuesIterator.flatten do
      add("Shape", s.shape)
      addMaterial(s.material)
      for l <- s.areaLight do add("AreaLightSource", l)
    capped(clues.result())

  /** Many files repeat what one exporter writes. */
  private def capped(clues: Vector[DialectClue]): Vector[DialectClue] =
    val limit = MaxParameterWeight / PerParameter
    val (v2, v3) = clues.partition(_.v2 > 0)
    v2.take(limit) ++ v3.take(limit)

  private def settings(scene: SceneDescription): Vector[(String, Option[Declaration])] =
    Vector(
      "Camera" -> scene.camera,
      "Film" -> scene.film,
      "PixelFilter" -> scene.filter,
      "Sampler" -> scene.sampler,
      "Integrator" -> scene.integrator,
      "Accelerator" -> scene.accelerator
    )

  private def fits(recipes: Recipes[?], d: Declaration, p: Param, dialect: Dialect): Boolean =
    recipes.all.exists: r =>
      r.name == d.name && r.dialects(dialect) && r.fields.exists: f =>
        f.name == p.name && f.dialects(dialect) &&
          ValueTypes.accepts(ValueTypes.plain(f.typeName), f.name, p, dialect)

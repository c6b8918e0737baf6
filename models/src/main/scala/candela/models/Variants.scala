package candela.models

import candela.diagnostics.{Code, Problem, SceneError, Suggest}

/** Which materials primitives have, by the variant that is asked for.
  *
  * Source: KHR_materials_variants.
  */
private[models] final class Variants(file: GltfFile, session: Session, asked: Option[String]):
  private val extension = file.root.extension(Variants.Name)
  private val entries = extension.toVector.flatMap(_.list("variants"))
  private val names = entries.map(_.text("name").getOrElse(""))

  private val chosen: Option[Int] = asked.map: name =>
    val index = names.indexOf(name)
    if index < 0 then
      val message =
        if names.isEmpty then s"`${session.file}` has no variants, of which --variant shows one"
        else s"`${session.file}` has no variant `$name`"
      throw SceneError(Problem.general(Code.OptionMisfit, message, Suggest.help(name, names)))
    index

  for e <- extension if asked.isEmpty && names.nonEmpty do
    val listed = names.map(n => s"`$n`").mkString(", ")
    session.warn(
      e.at,
      s"no variant is shown; --variant NAME shows one of $listed",
      Code.SeveralWorlds
    )

  /** The index of a primitive's material, if it has one. */
  def material(primitive: Json): Option[Json] =
    val mapped =
      for
        e <- primitive.extension(Variants.Name).toVector
        mapping <- e.required("mappings").items
        variant <- mapping.required("variants").items
        _ = variant.element(entries, "variants")
        if chosen.contains(variant.size)
      yield mapping.required("material")
    mapped.headOption.orElse(primitive("material"))

private[models] object Variants:
  val Name = "KHR_materials_variants"

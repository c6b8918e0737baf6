package candela.cli

import candela.build.Category
import candela.build.recipe.{Dialects, Field, Recipe, Support}
import candela.scenefile.Dialect

/** A parameter in words. */
final case class DescribedParameter(
    name: String,
    typeName: String,
    default: String,
    dialects: String,
    meaning: String
)

/** A type of a category in words, with what the dialects asked for know of it. */
final case class DescribedType(
    category: Category,
    name: String,
    dialects: String,
    meaning: String,
    pending: Option[String],
    parameters: Vector[DescribedParameter]
):
  /** As a scene file writes it; options have no name of their own. */
  def title: String = category.name match
    case s"Texture ($values)" => s"Texture \"…\" \"$values\" \"$name\""
    case "Option" => "Option"
    case "MakeNamedMedium" => s"MakeNamedMedium \"…\" \"string type\" \"$name\""
    case statement => s"$statement \"$name\""

/** Turns the tables of the bridge into words. */
final class Described(asked: Set[Dialect]):

  /** The types that the dialects know, in the order of the table. */
  def types(category: Category): Vector[DescribedType] =
    for recipe <- category.recipes.all if recipe.dialects.exists(asked)
    yield DescribedType(
      category,
      recipe.name,
      named(recipe.dialects),
      recipe.meaning,
      recipe.pending,
      parameters(recipe)
    )

  private def parameters(recipe: Recipe[?]): Vector[DescribedParameter] =
    val known = recipe.fields.filter(_.dialects.exists(d => recipe.dialects(d) && asked(d)))
    // What changes the picture comes first
    for field <- known.sortBy(recipe.support(_).ordinal)
    yield DescribedParameter(
      field.name,
      field.typeName,
      default(field, recipe),
      named(field.dialects.intersect(recipe.dialects)),
      meaning(field, recipe)
    )

  private def named(dialects: Set[Dialect]): String =
    Dialect.values.filter(dialects).map(Dialects.name).mkString(" ")

  /** One default, or each with its dialects: `80 (v2 v3), 5 (v4)`. */
  private def default(field: Field[?], recipe: Recipe[?]): String =
    val dialects =
      Dialect.values.toVector.filter(d => field.dialects(d) && recipe.dialects(d) && asked(d))
    val texts = dialects.map(field.shown).distinct
    if texts.size == 1 then texts.head
    else
      texts
        .map(t => s"$t (${named(dialects.filter(field.shown(_) == t).toSet)})")
        .mkString(", ")

  private def meaning(field: Field[?], recipe: Recipe[?]): String =
    val unit = if field.unit.isEmpty then "" else s" [${field.unit}]"
    val support = recipe.support(field) match
      case Support.Used => ""
      case Support.NotYet(instead) => s"; not supported yet: $instead"
      case Support.NoMeaning(reason) => s"; no effect: $reason"
    s"${field.doc}$unit$support"

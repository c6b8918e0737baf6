package candela.build.recipe

import candela.base.Suggest
import candela.scenefile.Dialect

/** All recipes of a category, by name.
  *
  * @param category in messages
  */
final class Recipes[A](val category: String, val all: Vector[Recipe[A]]):

  /** The recipe of this name; if the dialect has none, another dialect's. */
  def find(name: String, dialect: Dialect): Option[Recipe[A]] =
    val candidates = all.filter(_.name == name)
    candidates.find(_.dialects(dialect)).orElse(candidates.headOption)

  /** Follows the recipe that the declaration names. A type that is pending is a warning; a name
    * that nobody knows is an error, with the nearest known.
    */
  def build(site: Site): Option[A] =
    val name = site.declaration.name
    find(name, site.dialect) match
      case Some(recipe) =>
        for instead <- recipe.pending do
          site.warn(s"$category \"$name\" is not supported yet: $instead")
        Some(recipe.build(inDialectOf(recipe, site)))
      case None =>
        val known = all.filter(_.dialects(site.dialect)).map(_.name).filter(_.nonEmpty)
        val standIn = StandIns.ofCategory(category)
        site.missing(s"no $category is named `$name`", standIn, Suggest.help(name, known))
        None

  /** A type of another dialect is made as that one makes it. */
  private def inDialectOf(recipe: Recipe[A], site: Site): Site =
    if recipe.dialects(site.dialect) then site
    else
      val nearest = Dialects.nearest(site.dialect, recipe.dialects)
      site.warn(
        s"$category \"${recipe.name}\" is of ${Dialects.list(recipe.dialects)}, not of " +
          s"${Dialects.name(site.dialect)}: it is made as ${Dialects.name(nearest)} does"
      )
      site.in(nearest)

package candela.build

import scala.collection.mutable

import candela.base.Suggest
import candela.scenefile.{Dialect, Param}

/** One parameter of a recipe: its name, type, default and meaning, and how to read it.
  *
  * @param typeName how scene files spell its type, for documentation and messages
  * @param default  as text, by dialect
  */
final class Field[T](
    val name: String,
    val typeName: String,
    val doc: String,
    val dialects: Set[Dialect],
    val default: Dialect => T,
    read: (Param, Site) => Option[T]
):
  /** The value given at the site, else the default. A value of the wrong type is reported. */
  def apply()(using site: Site): T = given_().getOrElse(default(site.dialect))

  /** The value, if the scene file gives one. */
  def given_()(using site: Site): Option[T] =
    site.declaration.param(name).filter(_ => dialects(site.dialect)).flatMap(read(_, site))

/** How one name of a scene file becomes a runtime object: its parameters, declared once, and
  * `make`.
  *
  * The declarations are the documentation, the defaults, the type checks and the list of what is
  * not used; nothing else in the program knows a parameter's name. Each kind of field is in
  * [[Fields]].
  */
abstract class Recipe[A](val name: String, val dialects: Set[Dialect] = Dialect.values.toSet)
    extends Fields:
  private val declared = mutable.ArrayBuffer.empty[Field[?]]
  private val unsupported = mutable.LinkedHashMap.empty[String, String]

  protected def make()(using Site): A

  /** All parameters; a name may stand for one in one dialect and for another in the next. */
  final def fields: Vector[Field[?]] = declared.toVector

  protected final def register[T](field: Field[T]): Field[T] =
    declared += field
    field

  /** A parameter that pbrt knows and Candela does not: named in a warning, with what is done
    * instead.
    */
  protected final def notYet(name: String, instead: String): Unit = unsupported(name) = instead

  /** A parameter that has no meaning here (a cache size, a quality hint): silently accepted. */
  protected final def irrelevant(names: String*): Unit = ignored ++= names
  private val ignored = mutable.Set.empty[String]

  final def build(site: Site): A =
    for p <- site.declaration.params do
      val named = declared.filter(_.name == p.name)
      if unsupported.contains(p.name) then
        site.problems.warn(
          p.at,
          s"`${p.name}` of \"$name\" is not supported yet: ${unsupported(p.name)}"
        )
      else if named.nonEmpty && !named.exists(_.dialects(site.dialect)) then
        val dialect = site.dialect.toString.toLowerCase
        site.problems.warn(
          p.at,
          s"`${p.name}` is no parameter of \"$name\" in $dialect; it has no effect"
        )
      else if named.isEmpty && !ignored(p.name) then
        site.problems.warn(
          p.at,
          s"`${p.name}` is not a parameter of \"$name\"; it has no effect",
          Suggest.help(p.name, declared.filter(_.dialects(site.dialect)).map(_.name))
        )
    make()(using site)

/** All recipes of a category, by name.
  *
  * @param pending names that pbrt knows and Candela does not yet, with what happens instead
  */
final class Recipes[A](
    val category: String,
    val all: Vector[Recipe[A]],
    pending: Map[String, String] = Map.empty
):

  /** Follows the recipe that the declaration names. A name that is pending is a warning; one that
    * nobody knows is an error, with the nearest known.
    */
  def build(site: Site): Option[A] =
    val name = site.declaration.name
    val candidates = all.filter(_.name == name)
    candidates.find(_.dialects(site.dialect)).orElse(candidates.headOption) match
      case Some(recipe) => Some(recipe.build(site))
      case None =>
        pending.get(name) match
          case Some(instead) => site.warn(s"$category \"$name\" is not supported yet: $instead")
          case None =>
            site.error(s"no $category is named `$name`", Suggest.help(name, all.map(_.name)))
        None

package candela.build.recipe

import scala.collection.mutable

import candela.base.Suggest
import candela.scenefile.Dialect

/** How one name of a scene file becomes a runtime object: its parameters, declared once, and
  * `make`.
  *
  * The declarations are the documentation, the defaults, the type checks and the list of what is
  * not used; nothing else in the program knows a parameter's name. Each kind of field is in
  * [[Fields]].
  *
  * @param meaning one line for the reference
  */
abstract class Recipe[A](
    val name: String,
    val meaning: String,
    val dialects: Set[Dialect] = Dialect.values.toSet
) extends Fields:
  private val declared = mutable.ArrayBuffer.empty[Field[?]]
  private val unused = mutable.HashMap.empty[Field[?], Support]

  protected def make()(using Site): A

  /** What all recipes of a category add to `make`. */
  protected def made(site: Site): A = make()(using site)

  /** What is done instead, if Candela does not render this type yet. Its fields are declared all
    * the same, so that slips are found and the reference is whole.
    */
  def pending: Option[String] = None

  /** All parameters; a name may stand for one in one dialect and for another in the next. */
  final def fields: Vector[Field[?]] = declared.toVector

  final def takes(parameter: String, dialect: Dialect): Boolean =
    declared.exists(f => f.name == parameter && f.dialects(dialect))

  final def support(field: Field[?]): Support = unused.getOrElse(field, Support.Used)

  protected final def register[T](field: Field[T]): Field[T] =
    declared += field
    field

  /** Parameters that nothing reads by name, because the whole type is [[pending]]. */
  protected final def declare(fields: Field[?]*): Unit = assert(fields.forall(declared.contains))

  /** Parameters that pbrt knows and Candela does not yet: each is a warning where it is given. */
  protected final def notYet(instead: String)(fields: Field[?]*): Unit =
    for f <- fields do unused(f) = Support.NotYet(instead)

  /** Parameters that have no meaning here (a cache size, a quality hint), and why: accepted. */
  protected final def noMeaning(reason: String)(fields: Field[?]*): Unit =
    for f <- fields do unused(f) = Support.NoMeaning(reason)

  final def build(site: Site): A =
    for p <- site.declaration.params do
      val named = declared.filter(_.name == p.name)
      named.find(_.dialects(site.dialect)) match
        case Some(field) => inspect(field, p.at, site)
        case None if named.nonEmpty =>
          val owners = Dialects.list(named.flatMap(_.dialects).toSet)
          site.problems.warn(
            p.at,
            s"`${p.name}` is no parameter of \"$name\" in ${Dialects.name(site.dialect)}, but in " +
              s"$owners; it has no effect"
          )
        case None if p.isDefault => () // an `Attribute` speaks to many
        case None =>
          site.problems.warn(
            p.at,
            s"`${p.name}` is not a parameter of \"$name\"; it has no effect",
            Suggest.help(p.name, declared.filter(_.dialects(site.dialect)).map(_.name))
          )
    made(site)

  /** What nothing reads is checked for its type here. */
  private def inspect(field: Field[?], at: candela.base.SourcePos, site: Site): Unit =
    val isRead = support(field) == Support.Used && pending.isEmpty
    if !isRead then
      val _ = field.given_()(using site)
      support(field) match
        case Support.NotYet(instead) =>
          site.problems.warn(at, s"`${field.name}` of \"$name\" is not supported yet: $instead")
        case _ => ()

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

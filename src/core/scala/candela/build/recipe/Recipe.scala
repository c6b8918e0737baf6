package candela.build.recipe

import candela.diagnostics.{Code, Refusal, Suggest}
import scala.collection.mutable
import scala.jdk.CollectionConverters.*

import candela.scenefile.Dialect

/** Builds a runtime object from a declaration of one type: the parameters, declared once, and
  * `create`.
  *
  * The declarations provide the documentation, the defaults, the type checks and the list of
  * unsupported parameters; no other code knows a parameter's name. [[Fields]] declares the types of
  * parameters.
  *
  * @param meaning one-line description for the reference
  */
abstract class Recipe[A](
    val name: String,
    val meaning: String,
    val dialects: Set[Dialect] = every
) extends Fields:
  private val declared = mutable.ArrayBuffer.empty[Field[?]]
  private val unused = mutable.HashMap.empty[Field[?], Support]

  // Statements ask for it a million times
  private lazy val byName =
    java.util.HashMap(declared.toVector.groupBy(_.name).view.mapValues(_.toArray).toMap.asJava)

  /** Makes the object from the statement's parameters.
    *
    * Must be pure, but for what it reports: spectral scenes make it again for each set of
    * wavelengths, in parallel. What all of these share, and takes long, is a field of type
    * [[Once]].
    */
  protected def create()(using Site): A

  /** Wraps `create` with the steps common to a category. */
  protected def assemble(site: Site): A = create()(using site)

  /** The substitute for this type, and why. Its fields are declared nevertheless, for error
    * messages and the reference.
    */
  def substitute: Option[String] = None

  /** Whether other dialects' scenes don't know it: their pbrt renders something else. */
  def isUnknownElsewhere: Boolean = false

  /** Is the type Candela's own? The programs of its dialects don't have it. */
  def isOwn: Boolean = false

  /** All parameters. A name may denote different parameters in different dialects. */
  final def fields: Vector[Field[?]] = declared.toVector

  /** The dialects in which this type has the parameter; others than pbrt's only if v4's has not.
    */
  final def dialectsOf(field: Field[?]): Set[Dialect] =
    if dialects.exists(Dialect.ofOthers) then
      dialects.filter(d => field.dialects(d) || field.dialects(d.base))
    else
      val supported = if dialects(Dialect.V4) then dialects ++ Dialect.ofOthers else dialects
      supported.intersect(field.dialects)

  final def hasParameter(parameter: String, dialect: Dialect): Boolean =
    declared.exists(f => f.name == parameter && f.dialects(dialect))

  final def support(field: Field[?]): Support = unused.getOrElse(field, Support.Used)

  protected final def register[T](field: Field[T]): Field[T] =
    declared += field
    field

  /** Declares parameters that are not read, because the whole type is substituted. */
  protected final def declare(fields: Field[?]*): Unit = assert(fields.forall(declared.contains))

  /** Parameters that Candela does not support. Each use is a warning. */
  protected final def unsupported(instead: String)(fields: Field[?]*): Unit =
    for f <- fields do unused(f) = Support.Unsupported(instead)

  /** Parameters without a meaning here (a cache size, a quality hint): accepted and ignored. */
  protected final def noMeaning(reason: String)(fields: Field[?]*): Unit =
    for f <- fields do unused(f) = Support.NoMeaning(reason)

  final def build(site: Site): A =
    for p <- site.declaration.params do
      val named = byName.getOrDefault(p.name, Recipe.NoFields)
      named.find(f => site.speaks(f.dialects)) match
        case Some(field) => inspect(field, p.pos, site)
        case None if named.nonEmpty =>
          val owners = Dialects.list(named.flatMap(_.dialects).toSet)
          site.problems.warn(
            Code.UnknownParameter,
            p.pos,
            s"`${p.name}` is a parameter of \"$name\" in $owners only, not in " +
              s"${Dialects.name(site.rules.dialect)}; it is ignored"
          )
        case None if p.isDefault => () // `Attribute` sets defaults for many types
        case None =>
          val names = declared.filter(f => site.speaks(f.dialects)).map(_.name)
          site.problems.warn(
            Code.UnknownParameter,
            p.pos,
            s"`${p.name}` is not a parameter of \"$name\"; it is ignored",
            OtherNames.parameter(p.name, names).orElse(Suggest.help(p.name, names))
          )
    assemble(site)

  /** Checks the type of a parameter that `create` does not read. */
  private def inspect(field: Field[?], at: candela.diagnostics.SourcePos, site: Site): Unit =
    val isRead = support(field) == Support.Used && substitute.isEmpty
    if !isRead then
      val _ = field.given_()(using site)
      support(field) match
        case Support.Unsupported(instead) =>
          site.problems.warn(
            Code.Unsupported,
            at,
            s"`${field.name}` of \"$name\" is not supported; $instead"
          )
        case _ => ()

private object Recipe:
  val NoFields: Array[Field[?]] = Array.empty

/** Something that is made when it is first asked for, and shared from then on. */
final class Once[T]:
  /** One for each statement, in every colour basis. */
  def apply(make: => T)(using site: Site): T =
    site.resources.memoize(site.declaration, this)(make)

  /** One for each of equal keys, whatever statements ask. */
  def of(key: AnyRef)(make: => T)(using site: Site): T =
    site.resources.memoizeFor(key, this)(make)

/** All recipes of a category, by name.
  *
  * @param category name of the category in messages
  */
final class Recipes[A](val category: String, val all: Vector[Recipe[A]]):

  private lazy val byName = all.groupBy(_.name)

  /** Finds the recipe of this name, preferably of this dialect. pbrt's scenes may have types of
    * another pbrt, but not of other formats.
    */
  def lookUp(name: String, dialect: Dialect): Option[Recipe[A]] =
    lookUp(name, (r: Recipe[A]) => r.dialects(dialect))

  private def lookUp(name: String, isHere: Recipe[A] => Boolean): Option[Recipe[A]] =
    val named = byName.getOrElse(name, Vector.empty)
    named.find(isHere).orElse:
      named.find(r => !r.isUnknownElsewhere && r.dialects.exists(Dialect.ofPbrt.contains))

  /** Builds the declared type. A substituted type is a warning; an unknown one is an error, or a
    * warning where this dialect's pbrt only warns. Both suggest the nearest known name.
    */
  def build(site: Site): Option[A] =
    // Sets of wavelengths have materials made while they are rendered, which ends in its own way
    if site.resources.isPlain then site.allowance.checkTime(Some(site.declaration.pos))
    val name = site.declaration.name
    lookUp(name, (r: Recipe[A]) => site.speaks(r.dialects)) match
      // Parameters that could not be read would seem to be missing
      case Some(_) if site.declaration.isFaulty => None
      case Some(recipe) =>
        for instead <- recipe.substitute do
          site.warn(Code.OtherDialect, s"$category \"$name\" is substituted: $instead")
        try Some(recipe.build(inDialectOf(recipe, site)))
        catch
          case Refusal.OfFile(problem) =>
            site.problems.error(
              problem.code,
              problem.pos.getOrElse(site.declaration.pos),
              problem.message,
              problem.help
            )
            None
      case None =>
        val message = s"unknown $category \"$name\""
        val help = OtherNames.ofMitsubas(name).filter(_ => byName.contains(name))
          .orElse(suggested(name, site))
        StandIns.ofPbrt(category, site.dialect) match
          case Some(standIn) =>
            site.warn(Code.UnknownType, s"$message; $standIn, as pbrt does", help)
          case None => site.missing(Code.UnknownType, message, StandIns.ofCategory(category), help)
        None

  /** The nearest name of the site's dialect or, if one of another dialect is as near as a slip of
    * the pen, what that is called here.
    */
  private def suggested(name: String, site: Site): Option[String] =
    val (here, elsewhere) = all.filter(_.name.nonEmpty).partition(r => site.speaks(r.dialects))
    val names = here.map(_.name)
    def translated =
      for
        meant <- Suggest.nearest(name, elsewhere.map(_.name))
        hint <- OtherNames.hint(category, meant, site.dialect)
      yield s"did you mean `$meant`? $hint"
    if Suggest.nearest(name, names).isDefined then Suggest.help(name, names)
    else translated.orElse(Suggest.help(name, names))

  /** A type of another dialect is built by the rules of that dialect. */
  private def inDialectOf(recipe: Recipe[A], site: Site): Site =
    if site.speaks(recipe.dialects) then site
    else
      val nearest = Dialects.nearest(site.dialect, recipe.dialects)
      site.warn(
        Code.OtherDialect,
        s"$category \"${recipe.name}\" exists only in ${Dialects.list(recipe.dialects)}; " +
          s"using ${Dialects.name(nearest)}'s",
        OtherNames.hint(category, recipe.name, site.dialect)
      )
      site.in(nearest)

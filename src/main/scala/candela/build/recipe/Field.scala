package candela.build.recipe

import candela.scenefile.{Dialect, Param}

/** One parameter of a recipe: its name, type, default and meaning, and how to read it.
  *
  * @param typeName how scene files spell its type, for documentation and messages
  * @param unit     of the values, or empty
  * @param default  by dialect
  * @param shown    the default as text, by dialect
  */
final class Field[T](
    val name: String,
    val typeName: String,
    val doc: String,
    val dialects: Set[Dialect],
    val unit: String,
    val default: Dialect => T,
    val shown: Dialect => String,
    read: (Param, Site) => Option[T]
):
  /** The value given at the site, else the default. A value of the wrong type is reported. */
  def apply()(using site: Site): T = given_().getOrElse(default(site.dialect))

  /** The value, if the scene file gives one. */
  def given_()(using site: Site): Option[T] =
    site.declaration.param(name).filter(_ => dialects(site.dialect)).flatMap(read(_, site))

/** What Candela does with a parameter. */
enum Support:
  case Used

  /** Not supported yet: the scene gets a warning that says what is done instead. */
  case NotYet(instead: String)

  /** It can't change the picture here: accepted for this reason. */
  case NoMeaning(reason: String)

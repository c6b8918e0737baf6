package candela.build

import candela.diagnostics.{Severity, SourcePos}
import candela.io.SceneFolder
import org.scalatest.funsuite.AnyFunSuite

import candela.build.recipe.*
import candela.color.ColorBasis
import candela.scenefile.{Declaration, Dialect}

/** What holds for every recipe of a category.
  *
  * @param demanding recipes that cannot do without some parameter
  * @param demandingIn the dialects in which they cannot
  * @param use       makes what the recipe gives, if it gives a function
  */
abstract class RecipeLaws[A](
    recipes: Recipes[A],
    demanding: Set[String] = Set.empty,
    demandingIn: Set[Dialect] = Dialect.values.toSet,
    use: A => Any = (a: A) => a
) extends AnyFunSuite:
  private val place = SourcePos("laws.pbrt", 1, 1)

  private def site(name: String, dialect: Dialect): Site =
    Site(
      Declaration(recipes.category, name, Vector.empty, place, SceneFolder.Nowhere),
      dialect.base,
      Resources(ColorBasis.Srgb, rules = Some(Rules.of(dialect))),
      Findings()
    )

  for recipe <- recipes.all; dialect <- Dialect.values if recipe.dialects(dialect) do
    val called = s"${recipes.category} \"${recipe.name}\" in $dialect"
    if demanding(recipe.name) && demandingIn(dialect) then
      test(s"$called says what it needs"):
        val here = site(recipe.name, dialect)
        recipe.build(here): Unit
        // pbrt-v2 and v3 skip some shapes, with an error that stops nothing
        val found = here.problems.result
        if dialect.base == Dialect.V4 then assert(found.exists(_.severity == Severity.Error))
        else assert(found.nonEmpty)
    else
      test(s"$called builds with its defaults"):
        val here = site(recipe.name, dialect)
        assert(use(recipe.build(here)) != null)
        assert(!here.problems.hasErrors, here.problems.result)

  for recipe <- recipes.all if recipe.fields.nonEmpty do
    val called =
      s"${recipes.category} \"${recipe.name}\" of ${Dialects.list(recipe.dialects)}"
    test(s"$called: each parameter has a meaning, a type, a default and a dialect"):
      for f <- recipe.fields do
        assert(f.doc.trim.nonEmpty && f.typeName.nonEmpty, f.name)
        assert(f.dialects.nonEmpty, f.name)
        for d <- f.dialects do assert(f.defaultText(d).nonEmpty, f.name)

    test(s"$called: a name means one thing in each dialect"):
      for dialect <- Dialect.values do
        val names = recipe.fields.filter(_.dialects(dialect)).map(_.name)
        assert(names.distinct == names)

  test(s"${recipes.category}: a type is declared once in each dialect"):
    for dialect <- Dialect.values do
      val names = recipes.all.filter(_.dialects(dialect)).map(_.name)
      assert(names.distinct == names)

  test(s"${recipes.category}: recipes are named alike"):
    for recipe <- recipes.all do
      val name = recipe.getClass.getSimpleName.stripSuffix("$")
      assert(name.endsWith("Recipe"), recipe.name)

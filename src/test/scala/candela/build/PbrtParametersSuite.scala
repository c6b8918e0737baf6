package candela.build

import org.scalatest.funsuite.AnyFunSuite

import candela.build.recipe.*
import candela.build.options.OptionRecipe
import candela.scenefile.{Dialect, SceneOptions}

/** The recipes against what pbrt's sources read. */
final class PbrtParametersSuite extends AnyFunSuite:

  private def field(p: PbrtParameter): Option[Field[?]] =
    for
      category <- Language.categories.find(_.name == p.category)
      recipe <- category.recipes.all.find(r => r.name == p.typeName && r.dialects(p.dialect))
      field <- recipe.fields.find(f => f.name == p.name && f.dialects(p.dialect))
    yield field

  for
    ((dialect, category), parameters) <-
      PbrtParameters.all.groupBy(p => (p.dialect, p.category)).toVector.sortBy(_._1.toString)
  do
    test(s"$category in $dialect: each of ${parameters.size} parameters is pbrt's"):
      val wrong = parameters.flatMap: p =>
        val what = s"${p.typeName}.${p.name}"
        field(p) match
          case None => Some(s"$what is not declared")
          case Some(f) if f.typeName != p.values =>
            Some(s"$what holds ${p.values}, not ${f.typeName}")
          case Some(f) if f.defaultText(dialect) != p.default =>
            Some(s"$what defaults to ${p.default}, not ${f.defaultText(dialect)}")
          case _ => None
      assert(wrong.isEmpty, wrong.mkString("\n", "\n", ""))

  test("no more is declared than pbrt reads, but what old scenes say"):
    val known = PbrtParameters.all.map(p => (p.dialect, p.category, p.typeName, p.name)).toSet
    val beyond =
      for
        category <- Language.categories
        recipe <- category.recipes.all if !recipe.isOwn
        field <- recipe.fields
        dialect <- Dialect.ofPbrt
        if recipe.dialects(dialect) && field.dialects(dialect)
        if !known((dialect, category.name, recipe.name, field.name))
      yield (dialect, recipe.name, field.name)
    // pbrt-v1's cameras clipped; some scenes of v2 call the sampler renderer "sample"
    val cameras =
      for
        camera <- Vector("perspective", "orthographic", "environment")
        parameter <- Vector("hither", "yon")
      yield (Dialect.V2, camera, parameter)
    // and of pbrt-v2 only forks have lenses
    val forks = Set("shutteropen", "shutterclose").map((Dialect.V2, "realistic", _))
    assert(
      beyond.toSet == cameras.toSet ++ forks + ((Dialect.V2, "sample", "visualizeobjectids"))
    )

  test("no roughness is negative"):
    val wrong =
      for
        category <- Language.categories if category.name == "Material"
        recipe <- category.recipes.all
        field <- recipe.fields if field.name.endsWith("roughness")
        dialect <- recipe.dialects if field.dialects(dialect)
        if field.typeName.startsWith("float") && field.range(dialect).least != 0f
      yield s"$dialect: ${recipe.name}.${field.name}"
    assert(wrong.isEmpty)

  test("the reader knows the names of v4's options, too"):
    for f <- OptionRecipe.fields do
      val at = candela.diagnostics.SourcePos("options.pbrt", 1, 1)
      assert(SceneOptions.typeOf(f.name, at).spelling == f.typeName, f.name)

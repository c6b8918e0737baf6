package candela.cli.commands

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import candela.io.WholeFile
import java.nio.charset.StandardCharsets.UTF_8
import java.util.Locale

import candela.build.{Category, Language}
import candela.build.recipe.{Dialects, Field, Recipe, Support}
import candela.cli.files.{FileRegister, Output, OutputFiles}
import candela.cli.options.{CommandsPage, ManPage, Options, Page, PbrtOptions}
import candela.cli.terminal.{ExitCode, Report, Terminal, TextTable}
import candela.mitsuba.{DescribedPlugin, TypeReference}
import candela.scenefile.Dialect

/** `candela describe`: prints the scene reference, generated from the recipes that build scenes. */
final class DescribeCommand(options: Options, terminal: Terminal, report: Report):
  private val dialect = options.settings.reading.dialect

  /** Of Mitsuba's types, their own names and not those that scenes are described by. */
  private val described = Described(dialect.fold(Dialect.ofPbrt.toSet)(Set(_)))
  private val categories =
    if dialect.contains(Dialect.Mitsuba) then Vector.empty else Language.categories
  private val elements =
    if dialect.forall(_ == Dialect.Mitsuba) then TypeReference.elements else Vector.empty
  private val text = ReferenceText(described, terminal.columns)

  def run(): ExitCode = report.guarded:
    val outputs = options.outfiles.map: name =>
      OutputFiles.ofText(name, "describe writes text", "md")(_ => true)
    FileRegister().write(Output(outputs, "reference", "Candela"))
    val lines =
      options.pages.lastOption match
        case Some(Page.PbrtOptions) => PbrtOptions.page.linesIterator.toVector
        case Some(Page.Reference) =>
          ReferenceMarkdown(Described(dialect.fold(Dialect.values.toSet)(Set(_)))).page
        case Some(Page.Commands) => CommandsPage.lines
        case Some(Page.Manual) => ManPage.lines
        case Some(Page.Problems) => ProblemsPage.lines
        case None => answer(options.files)
    outputs match
      case Vector() =>
        lines.foreach(terminal.out.println)
        terminal.out.flush()
      case files =>
        for f <- files do
          WholeFile.write(f, lines.map(_ + "\n").mkString.getBytes(UTF_8))
    ExitCode.Done

  private def answer(words: Vector[String]): Vector[String] = words match
    case Vector() => text.categories(categories, elements)
    case Vector(word) =>
      val (named, inMitsuba) = called(word)
      val lists = named.map(text.category) ++ inMitsuba.map(text.element)
      if lists.nonEmpty then separated(lists)
      else of(categories, elements, word, categories.flatMap(c => c.name +: c.aliases) ++ elements)
    case Vector(category, name) =>
      val (named, inMitsuba) = called(category)
      if named.isEmpty && inMitsuba.isEmpty then
        unknown("category", category, categories.flatMap(c => c.name +: c.aliases) ++ elements)
      else of(named, inMitsuba, name, Vector.empty)
    case _ => throw SceneError(Problem.general(
        Code.UnknownEntry,
        "describe expects a category, a type, or both"
      ))

  /** Categories of pbrt's types, and elements of Mitsuba's, of this name. */
  private def called(word: String): (Vector[Category], Vector[String]) =
    (categories.filter(isCalled(_, word)), elements.filter(_.equalsIgnoreCase(word)))

  /** The types called `name`, or else those that have a parameter called so. */
  private def of(
      in: Vector[Category],
      inMitsuba: Vector[String],
      name: String,
      others: Vector[String]
  ): Vector[String] =
    val types = in.flatMap(described.types)
    val plugins = inMitsuba.flatMap(e => TypeReference.types(e).map(e -> _))
    val named = types.filter(_.name.equalsIgnoreCase(name)).map(text.parameters) ++
      plugins.filter(_._2.equalsIgnoreCase(name)).map(TypeReference.describe).map(text.plugin)
    if named.nonEmpty then separated(named)
    else
      val all = plugins.map(TypeReference.describe)
      val having = types.flatMap(_.withParameter(name)).map(text.parameters) ++
        all.flatMap(_.withParameter(name)).map(text.plugin)
      if having.nonEmpty then separated(having)
      else
        val candidates = types.map(_.name).filter(_.nonEmpty) ++ plugins.map(_._2) ++ others
        val parameters = types.flatMap(_.parameters.map(_.name)) ++
          all.flatMap(_.parameters.map(_.name))
        val kinds = in.map(_.name) ++ inMitsuba
        unknown(
          if kinds.size == 1 then kinds.head else "type",
          name,
          candidates ++ parameters.distinct
        )

  private def isCalled(c: Category, word: String): Boolean =
    (c.name +: c.aliases).exists(n => n.equalsIgnoreCase(word) || (n + "s").equalsIgnoreCase(word))

  private def separated(texts: Vector[Vector[String]]): Vector[String] =
    texts.reduce((a, b) => a ++ Vector("", "") ++ b)

  private def unknown(kind: String, word: String, known: Vector[String]): Nothing =
    val start = known.find(_.toLowerCase(Locale.ROOT).startsWith(word.toLowerCase(Locale.ROOT)))
    val help = Suggest.nearest(word, known).orElse(start).map(k => s"did you mean `$k`?")
    val dialectNote =
      options.settings.reading.dialect.fold("")(d => s" in ${d.toString.toLowerCase(Locale.ROOT)}")
    throw SceneError(
      Problem.general(
        Code.UnknownEntry,
        s"unknown ${kind.toLowerCase(Locale.ROOT)} `$word`$dialectNote",
        help.orElse(Some("`candela describe` lists all categories"))
      )
    )

/** A parameter, formatted for display.
  *
  * @param unsupported what happens instead, if it has no effect though it should have one
  */
final case class DescribedParameter(
    name: String,
    typeName: String,
    default: String,
    dialects: String,
    meaning: String,
    unsupported: Option[String]
)

/** A type of a category, formatted for display and restricted to the requested dialects. */
final case class DescribedType(
    category: Category,
    name: String,
    dialects: String,
    meaning: String,
    substitute: Option[String],
    parameters: Vector[DescribedParameter]
):
  /** With the parameters of this name alone, if there are any. */
  def withParameter(parameter: String): Option[DescribedType] =
    val named = parameters.filter(_.name.equalsIgnoreCase(parameter))
    Option.when(named.nonEmpty)(copy(parameters = named))

  /** The statement as written in a scene file; options have no type name. */
  def title: String = category.name match
    case s"Texture ($values)" => s"Texture \"…\" \"$values\" \"$name\""
    case "Option" => "Option"
    case "MakeNamedMedium" => s"MakeNamedMedium \"…\" \"string type\" \"$name\""
    case statement => s"$statement \"$name\""

/** Formats the recipes for display. */
final class Described(requested: Set[Dialect]):

  /** The types of the requested dialects, in table order. */
  def types(category: Category): Vector[DescribedType] =
    for recipe <- category.recipes.all if recipe.dialects.exists(requested)
    yield DescribedType(
      category,
      recipe.name,
      named(recipe.dialects),
      recipe.meaning,
      recipe.substitute,
      parameters(recipe)
    )

  private def parameters(recipe: Recipe[?]): Vector[DescribedParameter] =
    val supported = recipe.fields.filter(recipe.dialectsOf(_).exists(requested))
    // Parameters that affect the image come first.
    for field <- supported.sortBy(recipe.support(_).ordinal)
    yield DescribedParameter(
      field.name,
      field.typeName,
      default(field, recipe),
      named(recipe.dialectsOf(field)),
      meaning(field, recipe),
      recipe.support(field) match
        case Support.Unsupported(instead) => Some(instead)
        case _ => None
    )

  private def named(dialects: Set[Dialect]): String =
    Dialect.values.filter(dialects).map(Dialects.name).mkString(" ")

  private def default(field: Field[?], recipe: Recipe[?]): String =
    byDialect(field, recipe)(field.defaultText)

  /** What holds in all dialects, or in each with its dialects: `80 (v2 v3), 5 (v4)`. */
  private def byDialect(field: Field[?], recipe: Recipe[?])(text: Dialect => String): String =
    val dialects =
      Dialect.values.toVector.filter(d => recipe.dialectsOf(field)(d) && requested(d))
    val texts = dialects.map(text).distinct
    if texts.size == 1 then texts.head
    else
      texts
        .map(t => s"$t (${named(dialects.filter(text(_) == t).toSet)})")
        .mkString(", ")

  /** The numbers that it takes; of colours, which all take the same, none. */
  private def range(field: Field[?], recipe: Recipe[?]): String =
    val isColor = field.typeName.startsWith("spectrum")
    val text = if isColor then "" else byDialect(field, recipe)(d => field.range(d.base).brief)
    if text.isEmpty then "" else s"; $text"

  private def meaning(field: Field[?], recipe: Recipe[?]): String =
    val unit = if field.unit.isEmpty then "" else s" [${field.unit}]"
    val support = recipe.support(field) match
      case Support.Used => ""
      case Support.Unsupported(instead) => s"; not supported: $instead"
      case Support.NoMeaning(reason) => s"; no effect: $reason"
    s"${field.doc}${range(field, recipe)}$unit$support"

/** Formats the reference for a terminal. */
final class ReferenceText(described: Described, columns: Int):
  private val table = TextTable(columns)

  /** Lists all categories. */
  def categories(ofPbrt: Vector[Category], ofMitsuba: Vector[String]): Vector[String] =
    val pbrtRows =
      for c <- ofPbrt; types = described.types(c) if types.nonEmpty
      yield
        val counted = types.map(_.name).distinct.size
        Vector(c.name, if counted > 1 then s"$counted types" else "", c.meaning)
    val mitsubaRows = ofMitsuba.map: e =>
      Vector(e, s"${TypeReference.types(e).size} types", s"<$e> in Mitsuba's scenes")
    table.lines(pbrtRows ++ mitsubaRows, indent = 0) ++
      Vector(
        "",
        "`candela describe CATEGORY` lists types, `candela describe TYPE` parameters,",
        "`candela describe PARAMETER` the types that have it."
      )

  /** Lists a category's types; of a single type, its parameters. */
  def category(c: Category): Vector[String] =
    described.types(c) match
      case Vector(only) => parameters(only)
      case types =>
        val rows = types.map: t =>
          val substituteNote = t.substitute.fold("")(instead => s"; substituted: $instead")
          Vector(s"\"${t.name}\"", t.dialects, t.meaning + substituteNote)
        s"${c.name}: ${c.meaning}" +: "" +: table.lines(rows)

  /** Lists the types of an element of Mitsuba's. */
  def element(name: String): Vector[String] =
    s"<$name> in Mitsuba's scenes:" +: "" +:
      TextTable.wrap(TypeReference.types(name).mkString(", "), columns)

  def plugin(p: DescribedPlugin): Vector[String] =
    val rows = p.parameters.map: a =>
      Vector(a.name, a.kind, if a.default.isEmpty then "none" else a.default)
    val body =
      if rows.isEmpty then Vector("  no parameters")
      else
        table.lines(Vector("name", "type", "default") +: rows) ++
          Vector("", "meanings: the plugin reference of https://mitsuba.readthedocs.io")
    s"<${p.element} type=\"${p.name}\"> (mitsuba)" +: "" +: body

  def parameters(t: DescribedType): Vector[String] =
    val head = TextTable.wrap(s"${t.title} (${t.dialects}): ${t.meaning}", columns)
    val substituteLines = t.substitute.toVector.flatMap: instead =>
      TextTable.wrap(s"Substituted: $instead.", columns)
    val names = Vector("name", "type", "default", "in", "meaning")
    val rows = t.parameters.map(p => Vector(p.name, p.typeName, p.default, p.dialects, p.meaning))
    val body =
      if rows.isEmpty then Vector("  no parameters") else table.lines(names +: rows)
    head ++ substituteLines ++ ("" +: body)

/** Formats the reference as a Markdown page. */
final class ReferenceMarkdown(described: Described):

  def page: Vector[String] =
    ReferenceMarkdown.Introduction.linesIterator.toVector ++ substitutes ++
      Language.categories.filter(described.types(_).nonEmpty).flatMap(category)

  /** Types that are not rendered as they are. */
  private def substitutes: Vector[String] =
    val rows =
      for c <- Language.categories; t <- described.types(c); instead <- t.substitute
      yield row(c.name, s"`${t.name}`", t.dialects, instead)
    val parameters =
      for
        c <- Language.categories; t <- described.types(c); p <- t.parameters
        if p.unsupported.nonEmpty
      yield row(t.title, s"`${p.name}`", p.dialects, p.unsupported.get)
    Vector("", "## What is substituted", "", ReferenceMarkdown.Substitutes, "") ++
      (row("category", "type", "in", "instead") +: rule(4) +: rows) ++
      Vector("", ReferenceMarkdown.Unsupported, "") ++
      (row("statement", "parameter", "in", "instead") +: rule(4) +: parameters)

  private def category(c: Category): Vector[String] =
    val types = described.types(c).map: t =>
      t.copy(parameters = t.parameters.map: p =>
        if p.dialects == t.dialects then p.copy(dialects = "") else p)
    val several = shared(types)
    val title = s"${c.name}: several types"
    val links = types.map: t =>
      s"[`${if t.name.isEmpty then t.title else t.name}`](#${anchor(heading(t))})"
    val index = if links.size < 2 then Vector.empty else Vector("", links.mkString(", ") + ".")
    val common =
      if several.isEmpty then Vector.empty
      else "" +: s"### $title" +: "" +: table(several)
    Vector("", s"## ${c.name}", "", c.meaning.capitalize + ".") ++ index ++ common ++
      types.flatMap(parameters(_, several, anchor(title)))

  /** Parameters that at least three of the types have in the same form: of each name, the most
    * frequent form.
    */
  private def shared(types: Vector[DescribedType]): Vector[DescribedParameter] =
    val supported = types.flatMap(_.parameters).filter(_.unsupported.isEmpty)
    def uses(p: DescribedParameter) = supported.count(_ == p)
    val forms = supported.distinct.groupBy(_.name).values.map(_.maxBy(uses)).toVector
    forms.filter(uses(_) >= ReferenceMarkdown.Several).sortBy(supported.indexOf)

  private def heading(t: DescribedType): String = s"${t.title}, ${t.dialects}"

  private def parameters(
      t: DescribedType,
      shared: Vector[DescribedParameter],
      link: String
  ): Vector[String] =
    val (common, special) = t.parameters.partition(shared.contains)
    val support = t.substitute.map(instead => s" Substituted: $instead.").getOrElse("")
    val names = common.map(p => s"`${p.name}`").mkString(", ")
    val footer =
      if common.isEmpty then Vector.empty else Vector("", s"[Shared](#$link): $names.")
    Vector("", s"### ${heading(t)}", "", s"${t.meaning.capitalize}.$support") ++
      (if special.isEmpty then Vector.empty else "" +: table(special)) ++ footer

  /** The address of a heading, as GitHub makes it. */
  private def anchor(heading: String): String =
    heading.toLowerCase(Locale.ROOT).filter(c => c.isLetterOrDigit || "-_ ".contains(c)).replace(
      ' ',
      '-'
    )

  private def table(parameters: Vector[DescribedParameter]): Vector[String] =
    val rows = parameters.map: p =>
      row(s"`${p.name}`", p.typeName, p.default, p.dialects, p.meaning)
    row("name", "type", "default", "in", "meaning") +: rule(5) +: rows

  private def row(cells: String*): String =
    cells.map(_.replace("|", "\\|")).mkString("| ", " | ", " |")

  private def rule(cells: Int): String = "|" + "---|" * cells

private object ReferenceMarkdown:
  /** From so many types on, a parameter is described once for its category. */
  val Several = 3

  val Substitutes: String =
    "These types are replaced, with a warning at each use that says by what."

  val Unsupported: String =
    "These parameters are not supported; each use is a warning."

  val Introduction: String =
    """# Scene reference
      |
      |All types and parameters of pbrt-v2, v3 and v4, and Candela's support for them. Scenes of
      |Mitsuba are described by those of v4, and by those marked `mitsuba`, which no pbrt has;
      |`candela describe --dialect mitsuba` has the names that these scenes use themselves. This
      |page is generated: `./sbt "run describe --markdown --outfile docs/REFERENCE.md"`.
      |
      |A parameter's type precedes its name: `"float radius" 2`. `float texture` and `spectrum
      |texture` accept a value or `"texture NAME" "TEXTURE"`. A `spectrum` is given as `rgb`,
      |`spectrum` or `blackbody`; in v2 and v3 also as `color` or `xyz`. Units are in
      |brackets, ranges before them: other numbers are an error, or a warning says what is used
      |instead. All numbers must be within ±1e30. pbrt-v4 rejects colours below 0 and reflectances
      |above 1; they are used, with a warning. A parameter without an entry under *in* exists in
      |all dialects of its type. Parameters that several types have are described once for each
      |category.""".stripMargin

package candela.mitsuba

import candela.diagnostics.{Code, Limit, Problem, SceneError, SourcePos, Suggest}
import candela.io.{InputFile, SceneFolder}
import java.nio.file.Path

import scala.collection.mutable

/** The elements of a scene after `default`, `$name`, `include`, `path` and `alias` took effect.
  *
  * @param elements children of `scene`
  * @param aliases  ids by their aliases
  * @param folders  where to look for files, first those of `path`
  * @param sources  the scene file and its includes
  * @param parameters names of values that it has
  * @param problems references to values that it lacks; elements with them are left out
  */
final class Expanded(
    val elements: Vector[Element],
    val aliases: Map[String, String],
    val folders: Vector[Path],
    val sources: Vector[Path],
    val parameters: Set[String],
    val problems: Vector[Problem]
):
  /** The same of some of its elements. */
  def of(elements: Vector[Element]): Expanded =
    Expanded(elements, aliases, folders, sources, parameters, problems)

/** Expands one scene file.
  *
  * @param folder  its folder
  * @param defines values of `$name` that override those of `default`
  * @param parsed  its root, if that is not read from the file
  * @param usedElsewhere names of `defines` that need no use here
  */
final class Expansion(
    file: Path,
    folder: SceneFolder,
    defines: Map[String, String],
    parsed: Option[Element] = None,
    usedElsewhere: Set[String] = Set.empty
):
  private val values = mutable.HashMap.from(defines)
  private val referenced = mutable.HashSet.empty[String]
  private val aliases = mutable.HashMap.empty[String, String]

  /** Those of the scene file's `path` elements: of equal files, Mitsuba takes the last one's. */
  private var paths = Vector.empty[Path]
  private var pathsOfIncludes = Vector.empty[Path]
  private val sources = mutable.ArrayBuffer.from(Option.when(parsed.isEmpty)(file))
  private var remainingLength = Expansion.MaxTextLength
  private val problems = mutable.ArrayBuffer.empty[Problem]

  def result(): Expanded =
    val elements = parsed match
      case Some(root) => contents(root, Nil)
      case None =>
        val main = folder.scene(file)
        contents(XmlFile.read(main, None), List(main))
    val unused = defines.keySet -- referenced -- usedElsewhere
    if unused.nonEmpty then
      val name = unused.min
      val help = Suggest.help(name, values.keySet.toSet -- unused)
      throw SceneError(Problem.general(
        Code.SceneParameter,
        s"the scene has no parameter `$$$name`",
        help
      ))
    Expanded(
      elements,
      aliases.toMap,
      folders,
      sources.toVector,
      referenced.toSet,
      problems.toVector
    )

  private def folders: Vector[Path] = (paths :+ folder.path) ++ pathsOfIncludes

  /** As `folders`, after that of the innermost file. */
  private def foldersFrom(files: List[InputFile]): Vector[Path] =
    if files.sizeIs <= 1 then folders
    else Option(files.head.path.getParent).getOrElse(Path.of("")) +: folders

  /** @param files files being read, innermost first */
  private def contents(root: Element, files: List[InputFile]): Vector[Element] =
    if root.tag != "scene" then fail(Code.Nesting, root, s"expected <scene>, found <${root.tag}>")
    val oldNames = OldNames.of(root)
    root.children.flatMap: child =>
      folder.allowance.checkTime(Some(child.pos))
      child.tag match
        case "default" =>
          val e = substituted(child)
          val (name, value) = (required(e, "name"), required(e, "value"))
          referenced += name
          if !values.contains(name) then values(name) = value
          Vector.empty
        case "include" => included(substituted(child), files)
        case "path" =>
          val e = substituted(child)
          val name = required(e, "value")
          if !SceneFolder.isName(name) then
            fail(Code.NoSuchFile, e, s"`$name` is not a valid file name")
          if paths.size + pathsOfIncludes.size >= Expansion.MaxFolders then
            fail(Code.IncludeCircle, e, s"more than ${Expansion.MaxFolders} folders are named")
          val added = folder.existing(foldersFrom(files), name, Some(e.pos)).map(_.path)
          if files.sizeIs > 1 then pathsOfIncludes = added ++: pathsOfIncludes
          else paths = added ++: paths
          Vector.empty
        case "alias" =>
          val e = substituted(child)
          aliases(required(e, "as")) = required(e, "id")
          Vector.empty
        case _ => defined(child).map(e => oldNames.fold(e)(_.upgraded(e)))

  private def included(e: Element, files: List[InputFile]): Vector[Element] =
    val name = required(e, "filename")
    if !SceneFolder.isName(name) then fail(Code.NoSuchFile, e, s"`$name` is not a valid file name")
    val searched = foldersFrom(files)
    val file = folder.existing(searched, name, Some(e.pos)).filter(_.isRegular).getOrElse:
      val (message, help) =
        folder.absence(name, Some(e.pos), s"no such file: `$name`", searched)
      fail(Code.NoSuchFile, e, message, help)
    folder.allowance.check(Limit.Depth, files.size, Some(e.pos)):
      s"includes are nested ${files.size} deep"
    if files.exists(_.isSame(file)) then fail(Code.IncludeCircle, e, s"`$name` includes itself")
    else if files.size > Expansion.MaxIncludes then
      fail(Code.IncludeCircle, e, s"more than ${Expansion.MaxIncludes} files include each other")
    else if sources.size > Expansion.MaxFiles then
      fail(Code.IncludeCircle, e, s"more than ${Expansion.MaxFiles} files are included")
    sources += file.path
    contents(root(file, e), file :: files)

  /** Reads the root. Text of a file outside the scene's folder is shown only if that is a scene.
    */
  private def root(file: InputFile, include: Element): Element =
    def failed() = fail(
      Code.Nesting,
      include,
      s"can't include `$file`: it is not a scene: expected <scene> (the file is not shown: it " +
        "is outside the scene's folder)"
    )
    if file.isShown then XmlFile.read(file, Some(include.pos))
    else
      val root =
        try XmlFile.read(file, Some(include.pos))
        catch case _: SceneError => failed()
      if root.tag == "scene" then root else failed()

  private def required(e: Element, attribute: String): String =
    e(attribute).getOrElse(fail(
      Code.UnknownElement,
      e,
      s"<${e.tag}> must have the attribute `$attribute`"
    ))

  /** The element, if it needs no value that is undefined, without children that do. */
  private def defined(e: Element): Option[Element] =
    val missing = undefinedIn(e)
    problems ++= missing
    Option.when(missing.isEmpty)(withValues(e, e.children.flatMap(defined)))

  private def substituted(e: Element): Element =
    for problem <- undefinedIn(e).headOption do throw SceneError(problem)
    withValues(e, e.children.map(substituted))

  private def namesIn(text: String) =
    if !text.contains('$') then Vector.empty
    else Expansion.Variable.findAllMatchIn(text).map(_.group(1)).toVector

  private def undefinedIn(e: Element): Vector[Problem] =
    val names = e.attributes.values.toVector.flatMap(namesIn)
    referenced ++= names
    names.filterNot(values.contains).distinct.map(undefined(_, e.pos))

  private def withValues(e: Element, children: Vector[Element]): Element =
    def text(original: String) =
      Expansion.Variable.replaceAllIn(original, m => value(m.group(1), e.pos))
    val attributes =
      if !e.attributes.values.exists(_.contains('$')) then e.attributes
      else e.attributes.map((name, original) => name -> text(original))
    e.copy(attributes = attributes, children = children)

  private def undefined(name: String, at: SourcePos): Problem =
    val near = Suggest.nearest(name, values.keys).map(n => s"did you mean `$$$n`?")
    val help = s"""write <default name="$name" value="…"/> before it, or use -D$name=…"""
    Problem.error(
      Code.SceneParameter,
      at,
      s"undefined parameter `$$$name`",
      near.orElse(Some(help))
    )

  private def value(name: String, at: SourcePos): String =
    remainingLength -= values(name).length
    if remainingLength < 0 then
      val message =
        s"values of parameters add up to more than ${Expansion.MaxTextLength} characters"
      throw SceneError(Problem.error(Code.TooLarge, at, message))
    java.util.regex.Matcher.quoteReplacement(values(name))

  private def fail(
      code: Code,
      e: Element,
      message: String,
      help: Option[String] = None
  ): Nothing =
    throw SceneError(Problem.error(code, e.pos, message, help))

object Expansion:
  /** Films of Mitsuba 0.6 write `$sensor['toWorld']`, which is no parameter. */
  private val Variable = raw"\$$(\w++)(?!\[)".r
  private val MaxIncludes = 15
  private val MaxFiles = 10_000

  /** Each file is looked for in all of them. */
  private val MaxFolders = 100

  /** Put in place of names; values of values may be exponentially long. */
  private val MaxTextLength = 20_000_000

package candela.job

import candela.diagnostics.{Code, Problem, Suggest}
import candela.io.{ForeignKind, InputFile}
import candela.scenefile.{Directives, Source, Token, Tokenizer}

import java.nio.file.{Files, Path}

import scala.util.Try

/** Tells what else to do with files that are no scenes. */
private[job] object ForeignAdvice:
  import ForeignKind.*

  /** The problem if a file of another kind was given as a scene. */
  def problem(file: Path, isConfined: Boolean): Option[Problem] =
    // A pipe can be read only once
    if !Files.isRegularFile(file) then None
    else
      MissingFormats.problem(file, SceneFormat.all, isConfined).orElse:
        Source.read(InputFile.named(file)).toOption.flatMap(problem(file, _))

  private def problem(file: Path, source: Source): Option[Problem] =
    try
      source.foreign(file) match
        case Some(found) if SceneFormat.named(file).exists(_.owns(found.kind)) => None
        case Some(found) =>
          val scene = if found.kind == Mitsuba then "a pbrt scene" else "a scene"
          val message = s"`$file` is ${found.what}, not $scene"
          Some(Problem.general(Code.NoScene, message, advice(found.kind, file)))
        case None => SceneFormat.named(file) match
            case None => Option.when(!mayBeOurs(source)):
                val message = s"`$file` is not a scene: its first word is not a pbrt directive"
                Problem.general(Code.NoScene, message, Some(Formats))
            case Some(format) =>
              Option.when(!format.hasDialects && firstWord(source).exists(Directives.all.contains)):
                val message = s"`$file` is a pbrt scene, not a ${format.name} scene"
                Problem.general(Code.NoScene, message, Some("its name must end with .pbrt"))
    finally source.close()

  /** Whether a text begins with a directive, though a mistyped one; or has nothing to tell by. */
  private def mayBeOurs(source: Source): Boolean =
    firstWord(source).forall(Suggest.nearest(_, Directives.all.keys).isDefined)

  /** None of a text that has nothing; an empty word if it begins with something else. */
  private def firstWord(source: Source): Option[String] =
    val words = Tokenizer(source, None)
    val first = Try:
      words.advance()
      words.current match
        case Token.End => None
        case Token.Word => Some(words.text)
        case _ => Some("")
    first.toOption.flatten

  private val Formats = s"supported scene formats: ${SceneFormat.inWords}"

  private def readsModels: Boolean = SceneFormat.all.exists(_.isModel)

  private def advice(kind: ForeignKind, file: Path): Option[String] = kind match
    case Picture => Some(s"`candela view $file` shows it")
    case Film => Some(s"`candela resume $file` continues it; `candela info $file` describes it")
    case Suite => Some(s"`candela bench $file` runs it")
    case Triangles =>
      val inScene = s"Shape \"plymesh\" \"string filename\" \"$file\" in a scene shows it"
      Some(if readsModels then s"its name must end with .ply; or $inScene" else inScene)
    case MitsubaMesh =>
      Some("load it by <shape type=\"serialized\"> in a Mitsuba scene")
    case Model =>
      val module = "candela-models on the class path, in a fat jar with its META-INF/services, " +
        "reads glTF, OBJ, PLY and STL; or "
      Some(
        (if readsModels then "" else module) +
          s"export it as a scene of ${SceneFormat.inWords}, for example from Blender"
      )
    case Volume => Some("a scene can load it as a medium")
    case Photometry => Some("LightSource \"goniometric\" \"string filename\" loads it")
    case Packed => Some("unpack it, then render the scene inside")
    case Mitsuba => Some("its name must end with .xml")
    case Other => Some(Formats)

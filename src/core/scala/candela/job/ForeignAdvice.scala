package candela.job

import candela.base.{Code, ForeignKind, InputFile, Problem, Suggest}
import candela.scenefile.{Directives, Source, Token, Tokenizer}

import java.nio.file.{Files, Path}

import scala.util.Try

/** Tells what else to do with files that are no scenes. */
private[job] object ForeignAdvice:
  import ForeignKind.*

  /** What is wrong with a file that should be a scene, if it is another kind of file. */
  def problem(file: Path): Option[Problem] =
    // A pipe can be read only once
    Option.when(Files.isRegularFile(file))(Source.read(InputFile.asked(file)))
      .flatMap(_.toOption).flatMap(problem(file, _))

  private def problem(file: Path, source: Source): Option[Problem] =
    try
      source.foreign(file) match
        case Some(found) =>
          val what = s"`$file` is ${found.what}, not a scene"
          Some(Problem.general(Code.NoScene, what, advice(found.kind, file)))
        case None =>
          Option.when(SceneFormat.named(file).isEmpty && !mayBeOurs(source)):
            val what = s"`$file` is no scene: it begins with no directive of pbrt"
            Problem.general(Code.NoScene, what, Some(Formats))
    finally source.close()

  /** Whether a text begins with a directive, though a mistyped one; or has nothing to tell by. */
  private def mayBeOurs(source: Source): Boolean =
    val words = Tokenizer(source, None)
    val first = Try:
      words.advance()
      words.current match
        case Token.End => None
        case Token.Word => Some(words.text)
        case _ => Some("")
    first.toOption.flatten.forall(Suggest.nearest(_, Directives.all.keys).isDefined)

  private val Formats = s"scenes are of ${SceneFormat.inWords}"

  private def advice(kind: ForeignKind, file: Path): Option[String] = kind match
    case Picture => Some(s"`candela view $file` shows it")
    case Film => Some(s"`candela resume $file` continues it; `candela info $file` tells of it")
    case Suite => Some(s"`candela bench $file` runs it")
    case Triangles =>
      Some(s"Shape \"plymesh\" \"string filename\" \"$file\" in a scene shows it")
    case MitsubaMesh =>
      Some("a scene of Mitsuba's shows it by <shape type=\"serialized\"> in an .xml file")
    case Model =>
      Some(
        s"export it as a scene of ${SceneFormat.inWords}, for example from Blender; OBJ and " +
          "PLY meshes may be shapes of Mitsuba's scenes"
      )
    case Volume => Some("a scene shows it as a medium")
    case Photometry => Some("a LightSource \"goniometric\" takes it as its \"string filename\"")
    case Packed => Some("unpack it, and name the scene in it")
    case Mitsuba => Some("its name must end with .xml")
    case Other => Some(Formats)

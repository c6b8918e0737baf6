package candela.job

import candela.base.{ForeignFile, ForeignKind, InputFile, Problem}
import candela.scenefile.Source

import java.nio.file.{Files, Path}

/** Tells what else to do with files that are no scenes. */
private[job] object ForeignAdvice:
  import ForeignKind.*

  /** What is wrong with a file that should be a scene, if it is another kind of file. */
  def problem(file: Path): Option[Problem] =
    // A pipe can be read only once
    for
      source <- Option.when(Files.isRegularFile(file))(Source.read(InputFile.asked(file)))
        .flatMap(_.toOption)
      found <- recognised(file, source)
    yield Problem.general(s"`$file` is ${found.what}, not a scene", advice(found.kind, file))

  private def recognised(file: Path, source: Source): Option[ForeignFile] =
    try source.foreign(file)
    finally source.close()

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
        "export it as a scene of pbrt or Mitsuba, for example from Blender; OBJ and PLY meshes " +
          "may be shapes of Mitsuba's scenes"
      )
    case Volume => Some("a scene shows it as a medium")
    case Lamp => Some("a LightSource \"goniometric\" takes it as its \"string filename\"")
    case Packed => Some("unpack it, and name the scene in it")
    case Mitsuba => Some("its name must end with .xml")
    case Other => None

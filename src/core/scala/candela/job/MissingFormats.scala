package candela.job

import candela.diagnostics.{Code, Problem}
import candela.io.FileName

import java.nio.file.Path

/** Formats of modules that may not be installed. */
object MissingFormats:
  /** Suffixes of what the module `candela-assimp` reads, the usual ones first. */
  val OfAssimp: Vector[String] =
    ("fbx dae 3ds 3mf ac ac3d acc amf ase ask b3d dxf ifc ifczip lwo lxo md2 md5mesh ms3d nff " +
      "off smd x x3d x3db zae").split(' ').toVector

  /** What to do about a file, if it has such a format.
    *
    * @param installed  the formats that are there
    * @param isConfined whether it is in a sandbox, in which Assimp would read nothing
    */
  private[job] def problem(
      file: Path,
      installed: Vector[SceneFormat],
      isConfined: Boolean
  ): Option[Problem] =
    val suffix = FileName.suffix(file)
    Option.when(OfAssimp.contains(suffix) && !installed.exists(_.suffixes.contains(suffix))):
      if isConfined then unconfined(file)
      else
        val help = "unpack candela-VERSION-PLATFORM-assimp.zip of the release into the program's " +
          "folder, which has lib; a library needs candela-assimp_3"
        val message =
          s"`$file` needs candela-assimp, which is not installed: it reads .$suffix files"
        Problem.general(Code.MissingLibrary, message, Some(help))

  /** Of a file in a sandbox. */
  def unconfined(file: Path): Problem =
    Problem.general(
      Code.Sandboxed,
      s"`$file` is read by Assimp, which no sandbox confines",
      Some("convert it to glTF, which --sandbox reads; or, if you trust the file, omit --sandbox")
    )

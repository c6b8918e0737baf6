package candela.convert

import java.nio.file.{Files, InvalidPathException, Path}

import candela.scenefile.{Declaration, Param, ParamType}

/** Names of files in parameters, which are relative to the folder of the scene: what they become
  * for a scene in another folder.
  */
final class FileNames(to: Path):

  private val target = to.toAbsolutePath.normalize

  def moved(d: Declaration): Declaration =
    val from = d.folder.toAbsolutePath.normalize
    if from == target || !d.params.exists(FileNames.isFile(d, _)) then d.copy(folder = to)
    else
      val params = d.params.map: p =>
        if FileNames.isFile(d, p) then p.withStrings(p.strings.map(name(from, _))) else p
      d.copy(params = params, folder = to)

  private def name(from: Path, written: String): String =
    try
      val file = Path.of(written.replace('\\', '/'))
      if written.isEmpty || file.isAbsolute then written
      else target.relativize(from.resolve(file).normalize).toString.replace('\\', '/')
    catch
      // such a name names nothing here, nor there; or the folders have no common root
      case _: IllegalArgumentException => written

object FileNames:
  private val Names =
    Set("filename", "mapname", "bsdffile", "lensfile", "emissionfilename", "normalmap", "aperture")

  /** These write a file of that name, which goes where it is wanted. */
  private val Outputs = Set("Film", "Integrator", "SurfaceIntegrator", "Renderer")

  private def isFile(d: Declaration, p: Param): Boolean = p.paramType match
    case ParamType.String => Names(p.name) && !Outputs(d.category) && isNoWord(p, d)
    case ParamType.Spectrum => p.strings.exists(exists(d, _))
    case _ => false

  /** An aperture may also be called "star"; all else are files. */
  private def isNoWord(p: Param, d: Declaration): Boolean =
    p.name != "aperture" || p.strings.exists(exists(d, _))

  private def exists(d: Declaration, name: String): Boolean =
    try name.nonEmpty && Files.isRegularFile(d.folder.resolve(name.replace('\\', '/')))
    catch case _: InvalidPathException => false

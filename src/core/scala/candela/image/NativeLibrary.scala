package candela.image

import candela.diagnostics.Code
import org.lwjgl.system.{APIUtil, SharedLibrary}

/** A shared library, loaded at run time.
  *
  * @param name product and version, for messages
  * @param path where it was found
  */
private[image] final class NativeLibrary private (
    library: SharedLibrary,
    name: String,
    val path: String
):
  /** Address of a function, for LWJGL's calls. */
  def function(symbol: String): Long =
    val address = library.getFunctionAddress(symbol)
    if address == 0 then
      throw ImageError(Code.MissingLibrary, s"$path: not $name: it lacks $symbol")
    address

private[image] object NativeLibrary:
  /** The first that can be loaded of these paths or names. */
  def loadFirst(name: String, paths: Vector[String]): Option[NativeLibrary] =
    Natives.require("")
    paths.iterator.flatMap(path => opened(name, path)).nextOption()

  private def opened(name: String, path: String): Option[NativeLibrary] =
    try Some(new NativeLibrary(APIUtil.apiCreateLibrary(path), name, path))
    catch case _: UnsatisfiedLinkError => None

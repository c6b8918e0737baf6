package candela.image

import java.io.{OutputStream, PrintStream}
import java.nio.file.{Files, Path}
import java.util.Locale
import java.util.concurrent.ConcurrentHashMap
import java.util.function.Supplier

import org.lwjgl.system.Configuration

import scala.util.Try

/** The native libraries of LWJGL, by which images are read and written. */
object Natives:

  /** For who starts the program's jar by itself, or has it on a class path. */
  private lazy val besideProgram = programsJar.flatMap(beside)

  /** LWJGL's own advice on missing libraries is for programmers. */
  def quieten(): Unit =
    if sys.props.get("org.lwjgl.util.Debug").isEmpty && sys.props.get(StreamProperty).isEmpty then
      val _ = System.setProperty(StreamProperty, classOf[NoStream].getName)

  /** The folder of the libraries that come with a jar. */
  private[image] def beside(jar: Path): Option[Path] =
    Option(jar.getParent).map(_.resolve("natives").resolve(platform)).filter(Files.isDirectory(_))

  private def programsJar: Option[Path] =
    Try(Path.of(getClass.getProtectionDomain.getCodeSource.getLocation.toURI)).toOption
      .filter(_.toString.endsWith(".jar"))

  /** As their folders are called. */
  private[image] def platform: String =
    def property(name: String) = sys.props.getOrElse(name, "").toLowerCase(Locale.ROOT)
    val system = property("os.name") match
      case s"mac$_" => "macos"
      case s"windows$_" => "windows"
      case _ => "linux"
    val processor = if Set("aarch64", "arm64")(property("os.arch")) then "arm64" else "x64"
    s"$system-$processor"

  /** Called before LWJGL is: without its libraries, that prints advice of its own.
    *
    * @param module  of LWJGL, such as `tinyexr`; empty: its base
    * @param library its file without prefix and suffix
    * @throws MissingNatives if a library is not there
    */
  private[candela] def require(module: String, library: String): Unit =
    if Configuration.LIBRARY_PATH.get == null then
      besideProgram.foreach(folder => Configuration.LIBRARY_PATH.set(folder.toString))
    for (m, name) <- Map("" -> "lwjgl", module -> library) if !loadedModules.contains(m) do
      if !isThere(m, name) then throw MissingNatives(m, name, platform)
      loadedModules.add(m): Unit

  private[image] def require(module: String): Unit =
    require(module, if module.isEmpty then "lwjgl" else s"lwjgl_$module")

  /** Modules whose libraries were found, lest each image looks for them. */
  private val loadedModules = ConcurrentHashMap.newKeySet[String]()

  private def isThere(module: String, library: String): Boolean =
    val file = System.mapLibraryName(library)
    val subfolder = if module.isEmpty then "" else s"$module/"
    val folder = s"${platform.replace('-', '/')}/org/lwjgl/$subfolder"
    // LWJGL itself sets the place once it has unpacked a library
    def onPath = (Option(Configuration.LIBRARY_PATH.get) ++
      Vector(PathProperty, "java.library.path").flatMap(sys.props.get(_)))
      .flatMap(_.split(java.io.File.pathSeparator)).filter(_.nonEmpty)
    classOf[org.lwjgl.PointerBuffer].getClassLoader.getResource(folder + file) != null ||
    onPath.exists(p => Try(Files.isRegularFile(Path.of(p, file))).getOrElse(false))

  /** The missing library and the cure, if that is the cause of `e`. */
  def missing(e: Throwable): Option[(String, String)] = e match
    case l: UnsatisfiedLinkError if String.valueOf(l.getMessage).contains("another classloader") =>
      Some((
        "the native libraries that read and write images belong to another class loader",
        "let both programs share a class loader that has LWJGL"
      ))
    case l: LinkageError if isOfLwjgl(l) =>
      val folder = sys.props.getOrElse(PathProperty, s"lib/natives/$platform")
      Some((
        s"the native libraries that read and write images are missing: LWJGL's, for $platform",
        s"start the program by bin/candela, or java -D$PathProperty=FOLDER -jar candela.jar, " +
          s"where FOLDER is $folder of the whole program"
      ))
    case _ => None

  private def isOfLwjgl(e: LinkageError): Boolean =
    (String.valueOf(e.getMessage) +: e.getStackTrace.take(Frames).map(_.getClassName))
      .exists(_.contains("lwjgl"))

  private[image] val PathProperty = "org.lwjgl.librarypath"
  private val StreamProperty = "org.lwjgl.util.DebugStream"
  private val Frames = 20

/** A native library of LWJGL is not there.
  *
  * @param module  of LWJGL; empty: its base
  * @param library its file without prefix and suffix
  */
final class MissingNatives private[image] (module: String, library: String, platform: String)
    extends UnsatisfiedLinkError(s"no native library $library for $platform"):

  /** For who depends on the library. */
  def help: String =
    val classifier = "natives-" + platform.stripSuffix("-x64")
    val name = if module.isEmpty then "lwjgl" else s"lwjgl-$module"
    val version = org.lwjgl.Version.getVersion.takeWhile(c => c.isDigit || c == '.')
    s"add org.lwjgl:$name:$version with the classifier $classifier to the dependencies; " +
      "EXR files need lwjgl and lwjgl-tinyexr, PNG, JPEG and TGA files that are read need lwjgl " +
      "and lwjgl-stb, models of Assimp lwjgl-assimp; or " +
      s"-D${Natives.PathProperty}=FOLDER, the program's lib/natives/$platform"

/** What LWJGL prints is lost. */
final class NoStream extends Supplier[PrintStream]:
  def get(): PrintStream = PrintStream(OutputStream.nullOutputStream())

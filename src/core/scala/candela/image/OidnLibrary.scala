package candela.image

import java.nio.file.{Files, InvalidPathException, Path}

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** Where the library of Open Image Denoise may be installed. */
private[image] object OidnLibrary:

  /** The environment variable that names the library or its folder. */
  val Variable = "CANDELA_OIDN"

  /** File names on Linux, macOS and Windows; version 2 has the functions that [[Oidn]] calls. */
  val Names: Vector[String] = Vector(
    "libOpenImageDenoise.so.2",
    "libOpenImageDenoise.2.dylib",
    "OpenImageDenoise.dll",
    "libOpenImageDenoise.so",
    "libOpenImageDenoise.dylib"
  )

  /** Places of the library in a Python package or in the archive of its makers. */
  private val Subfolders = Vector("", "lib", "bin", "oidn/lib", "pyoidn/oidn/lib", "oidn")

  /** Files to try, best first. If the variable is set, only what it names.
    *
    * @param root file system root: `/`, except in tests
    */
  def candidates(environment: Map[String, String], root: Path = Path.of("/")): Vector[Path] =
    environment.get(Variable).filter(_.nonEmpty) match
      case Some(named) =>
        path(named).toVector.flatMap(p => if isFile(p) then Vector(p) else librariesIn(p))
      case None => folders(environment, root).flatMap(librariesIn).distinct

  private def librariesIn(folder: Path): Vector[Path] =
    for
      subfolder <- Subfolders.map(folder.resolve)
      name <- Names
      file = subfolder.resolve(name) if isFile(file)
    yield file

  private def folders(environment: Map[String, String], root: Path): Vector[Path] =
    def listed(variable: String) =
      environment.getOrElse(variable, "").split(java.io.File.pathSeparator).toVector
        .filter(_.nonEmpty).flatMap(path)
    val home = environment.get("HOME").flatMap(path).toVector
    val python = (environment.get("VIRTUAL_ENV").flatMap(path).toVector ++
      home.map(_.resolve(".local")) ++ Vector("usr/local", "usr").map(root.resolve))
      .flatMap(prefix =>
        sorted(prefix.resolve("lib")).filter(_.getFileName.toString.startsWith("python3"))
      )
      .flatMap(lib => Vector("site-packages", "dist-packages").map(lib.resolve))
    val system = Vector("usr/local/lib", "usr/lib64", "usr/lib", "opt/homebrew/lib")
      .map(root.resolve)
    val multiarch = sorted(root.resolve("usr/lib")).filter(_.toString.endsWith("-linux-gnu"))
    listed("LD_LIBRARY_PATH") ++ listed("PYTHONPATH") ++ python ++ system ++ multiarch ++
      listed("PATH")

  private def sorted(folder: Path): Vector[Path] =
    Try(Using.resource(Files.list(folder))(_.iterator.asScala.toVector.sorted))
      .getOrElse(Vector.empty)

  private def path(name: String): Option[Path] =
    try Some(Path.of(name))
    catch case _: InvalidPathException => None

  private def isFile(p: Path): Boolean = Files.isRegularFile(p)

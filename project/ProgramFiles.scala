package packaging

import java.nio.file.{FileVisitOption, Files, Path}

/** What the package of a platform contains. */
object ProgramFiles {

  /** @param program all files of the program, with their names: natives of all platforms
    * @param runtime files of a Java runtime, if it is to be part
    */
  def of(platform: Platform, program: Seq[Entry], runtime: Seq[Entry]): Seq[Entry] =
    program.filter(e => belongs(e.name, platform) && !isOfAssimp(e.name)) ++ runtime

  /** What the package of Assimp adds to the program's folder. */
  def assimp(platform: Platform, program: Seq[Entry]): Seq[Entry] =
    program.filter(e => belongs(e.name, platform) && isOfAssimp(e.name))

  private def isOfAssimp(name: String): Boolean =
    name == "lib/candela-assimp.jar" || name.matches("lib/natives/.*(?:assimp|draco)\\.[a-z]+")

  private def belongs(name: String, platform: Platform): Boolean =
    if (name.startsWith("lib/natives/")) name.startsWith(s"lib/natives/${platform.name}/")
    else if (name.endsWith(".bat") || name.endsWith(".ps1")) platform.isWindows
    else if (name == "bin/candela" || name.startsWith("share/")) !platform.isWindows
    else true

  /** The runtime's files; links are followed, as our zip files have none. */
  def runtime(folder: Path): Seq[Entry] = in(folder, isProgram = true).map(_.in("runtime"))

  /** The sources of the Python module. */
  def module(folder: Path): Seq[Entry] =
    in(folder, isProgram = false).filterNot(_.name.contains("__pycache__"))

  private def in(folder: Path, isProgram: Boolean): Seq[Entry] = {
    val files = Files.walk(folder, FileVisitOption.FOLLOW_LINKS)
    try {
      val found = Vector.newBuilder[Entry]
      files.filter(p => Files.isRegularFile(p)).forEach { path =>
        val name = folder.relativize(path).toString.replace('\\', '/')
        found += Entry.file(name, path, isProgram && Files.isExecutable(path))
      }
      found.result()
    } finally files.close()
  }
}

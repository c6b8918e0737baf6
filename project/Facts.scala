package packaging

/** The facts of a release: every package and manifest is made from this table.
  *
  * @param release  the number, such as 0.1.0; between releases, that of the next one
  * @param version  the same, or with `-SNAPSHOT` where the sources are no release
  * @param homepage of the project; its releases have the packages
  */
final case class Facts(
    release: String,
    version: String,
    homepage: String,
    name: String = "Candela",
    command: String = "candela",
    wheel: String = "candela-renderer",
    description: String = "Physically based renderer for pbrt and Mitsuba scenes",
    licence: String = "Apache-2.0",
    oldestJava: Int = 17,
    bestJava: Int = 25
) {

  /** The address of a file of the release. */
  def address(file: String): String = s"$homepage/releases/download/v$version/$file"

  /** The folder at the top of each zip file. */
  def folder: String = s"$command-$version"

  def zip(platform: Platform, hasRuntime: Boolean): String =
    s"$command-$version-${platform.name}${if (hasRuntime) "" else "-without-java"}.zip"

  /** The reader of further formats of models. */
  def assimp(platform: Platform): String = s"$command-$version-${platform.name}-assimp.zip"

  def wheelFile(platform: Platform): String =
    s"${wheel.replace('-', '_')}-$wheelVersion-py3-none-${platform.wheelTag}.whl"

  def addonFile: String = s"$command-blender-$version.zip"

  /** As Python spells versions (PEP 440). */
  def wheelVersion: String = version.replace("-SNAPSHOT", ".dev0")
}

/** A system and a processor.
  *
  * @param wheelTag Python's name; that of Linux tells the oldest C library of the natives
  */
final case class Platform(system: String, processor: String, wheelTag: String) {
  def name: String = s"$system-$processor"
  def isWindows: Boolean = system == "windows"
}

object Platform {
  val all: Vector[Platform] = Vector(
    Platform("linux", "x64", "manylinux_2_28_x86_64"),
    Platform("linux", "arm64", "manylinux_2_28_aarch64"),
    Platform("macos", "x64", "macosx_11_0_x86_64"),
    Platform("macos", "arm64", "macosx_11_0_arm64"),
    Platform("windows", "x64", "win_amd64"),
    Platform("windows", "arm64", "win_arm64")
  )

  /** That of this Java. */
  def here: Option[Platform] = {
    val system = System.getProperty("os.name").toLowerCase match {
      case name if name.startsWith("linux") => "linux"
      case name if name.startsWith("mac") => "macos"
      case name if name.startsWith("windows") => "windows"
      case _ => ""
    }
    val processor = System.getProperty("os.arch") match {
      case "amd64" | "x86_64" => "x64"
      case "aarch64" => "arm64"
      case _ => ""
    }
    all.find(p => p.system == system && p.processor == processor)
  }
}

/** A file of the release. */
final case class Artifact(
    file: String,
    platform: Platform,
    hasRuntime: Boolean,
    sha256: String,
    size: Long
)

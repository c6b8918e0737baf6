package candela.bench.peers

import candela.diagnostics.SceneError
import candela.io.WholeFile
import candela.bench.suite.{Suite, SuiteFile, SuiteScene}

import java.nio.file.{Files, Path}

/** A suite for the renderers of this machine.
  *
  * @param leftOut (what, why)
  */
final case class PeerSuite(suite: Suite, leftOut: Vector[(String, String)])

object PeerSuite:

  /** The suite's scenes, each in the format of each renderer, for all that are installed.
    *
    * @param environment variables that name programs
    * @param folder receives scenes and scripts
    */
  def of(
      suite: Suite,
      environment: Map[String, String],
      folder: Path
  ): PeerSuite =
    val (programs, absent) = PeerPrograms(environment, folder).detect
    val (scenes, failures) = suite.scenes.map: scene =>
      converted(scene, folder.resolve(s"scene-${scene.name}"), programs)
    .unzip
    val missing = absent.map(a => a.title -> s"not found: ${a.obtain}")
    PeerSuite(suite.copy(programs = programs, scenes = scenes.flatten), missing ++ failures.flatten)

  private val Preferred = Vector("v4", "v3", "v2", "mitsuba", "scene")

  private def converted(
      scene: SuiteScene,
      folder: Path,
      programs: Vector[candela.bench.suite.Program]
  ): (Option[SuiteScene], Vector[(String, String)]) =
    val source = Preferred.flatMap(scene.files.get).filter(Files.isRegularFile(_)).headOption
    source match
      case None => (Some(scene), Vector.empty) // the runner says which file is missing
      case Some(file) =>
        try
          val peerFiles = PeerScenes.of(file, folder)
          val reference = scene.reference.filter(_ => peerFiles.isSame)
          val failures = programs.flatMap: p =>
            p.kinds.headOption.filterNot(
              peerFiles.files.contains
            ).flatMap(peerFiles.failures.get).map: why =>
              s"${p.title} on ${scene.title}" -> why
          val dropped = Option.when(scene.reference.isDefined && reference.isEmpty):
            s"reference of ${scene.title}" -> "it has another filter or integrator"
          val peers = scene.copy(files = peerFiles.files, reference = reference, programs = None)
          (Some(peers), failures ++ dropped)
        catch
          case e: SceneError => (None, Vector(scene.title -> e.problems.head.message))

  /** The suite that takes a few minutes, with its scenes; in `folder`. */
  def short(folder: Path): Suite =
    for name <- "short.conf" +: ShortScenes do
      WholeFile.write(folder.resolve(name), PeerResources.bytes(s"short/$name"))
    SuiteFile.read(folder.resolve("short.conf"))

  private val ShortScenes =
    Vector("box.pbrt", "lamps.pbrt", "metals.pbrt", "glass.pbrt", "texture.pbrt", "checks.png")

package candela.cli.options

import candela.base.Version
import candela.accel.tracing.Hierarchies

import java.util.Properties

import scala.util.Using

/** What `--version` prints: which sources, which Java, which kernels. */
private[cli] object VersionText:

  /** @param facts written by build.sbt */
  def lines(facts: Properties = written): Vector[String] =
    val commit = facts.getProperty("commit", "")
    val sources = if commit.isEmpty then "" else s", commit $commit"
    Vector(s"${program(facts)}$sources", java, kernels)

  /** As `candela 0.1.0`. */
  def program(facts: Properties = written): String =
    s"candela ${facts.getProperty("version", Version.current)}"

  private def java: String =
    val vm = System.getProperty("java.vm.version", "")
    val vendor = System.getProperty("java.vendor", "unknown vendor")
    val system = s"${System.getProperty("os.name")} ${System.getProperty("os.arch")}"
    s"Java $vm, $vendor, on $system"

  private def kernels: String =
    val state = if Hierarchies.hasVectors then "active" else "none: rays are traced by scalar code"
    s"SIMD kernels: $state"

  private def written: Properties =
    val properties = Properties()
    for resource <- Option(getClass.getResourceAsStream("/candela/build.properties")) do
      Using.resource(resource)(properties.load)
    properties

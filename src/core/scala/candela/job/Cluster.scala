package candela.job

import candela.base.Services
import candela.render.storage.FilmHeader

import java.nio.file.{Files, Path}

import scala.util.Try

/** Connects to clusters; another module brings it. */
abstract class ClusterService:

  /** @param note receives what users should know, line by line */
  def connect(master: String, note: String => Unit): Cluster

/** Machines that render together. */
abstract class Cluster extends AutoCloseable:

  /** Begins to render, or queues behind what was submitted before; returns at once. */
  def submit(work: ClusterWork): ClusterRun

  /** Resources used and data sent, in one line. */
  def summary: String

/** A rendering to divide.
  *
  * @param header describes the whole
  * @param scene  the scene file
  * @param files  of the scene
  * @param shards number of parts, instead of the cluster's choice
  * @param total  camera samples of the whole
  */
final case class ClusterWork(
    header: FilmHeader,
    scene: Path,
    files: Vector[Path],
    shards: Option[Int],
    total: Long
)

/** A rendering that was submitted. Thread-safe. */
abstract class ClusterRun:
  def isDone: Boolean

  /** Camera samples taken until now, about. */
  def samples: Long

  /** Ends the rendering soon; what is complete of it remains. */
  def cancel(): Unit

  /** The films of all shards, or, if cancelled, of some. Waits until they are there.
    *
    * @param folder for the films
    * @throws ClusterFailure if the cluster can't render it
    */
  def films(folder: Path): Vector[Path]

/** A cluster can't render, for a reason that users can act upon. */
final class ClusterFailure(message: String, cause: Throwable | Null = null)
    extends RuntimeException(message, cause)

object Cluster:
  /** @param environment tells where Spark is
    * @throws ClusterFailure if there is no such cluster, or nothing that can connect to it
    */
  def connect(
      master: String,
      note: String => Unit,
      environment: Map[String, String],
      services: => Iterator[ClusterService] = Services.installed(classOf[ClusterService])
  ): Cluster =
    try
      services.nextOption() match
        case Some(service) => service.connect(master, note)
        case None => throw ClusterFailure(MissingJar)
    // The jar without Spark
    catch case e: LinkageError => throw ClusterFailure(missingSpark(master, environment), e)

  private val MissingJar =
    "--spark needs candela-spark.jar in the program's folder lib\n`./sbt cluster/sparkJar` makes it"

  private def missingSpark(master: String, environment: Map[String, String]): String =
    def hasScript(home: String) = Files.isExecutable(Path.of(home).resolve("bin/spark-submit"))
    val cure = "set SPARK_HOME to Spark's folder, which has bin/spark-submit, for the launcher " +
      "bin/candela; or use `spark-submit --master MASTER candela-spark.jar scene.pbrt`"
    if !Masters.exists(master.matches) then
      s"`$master` is no master of Spark\nexpected spark://HOST:PORT, local, local[N], yarn or " +
        "k8s://ADDRESS"
    else
      environment.get("SPARK_HOME").filter(_.nonEmpty) match
        case None => s"--spark needs Apache Spark, but SPARK_HOME is not set\n$cure"
        case Some(home) if !Try(hasScript(home)).getOrElse(false) =>
          s"--spark needs Apache Spark, but there is none in SPARK_HOME: `$home`\n$cure"
        case Some(_) => s"--spark needs Apache Spark's classes\n$cure"

  /** As the launcher has them. */
  private val Masters =
    Vector("spark://.*", raw"local(\[.*)?", raw"local-cluster\[.*", "yarn", "k8s://.*")

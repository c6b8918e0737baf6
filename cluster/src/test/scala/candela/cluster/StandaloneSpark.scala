package candela.cluster

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*
import scala.jdk.OptionConverters.*
import scala.util.Try

/** A master and two workers on this machine, in processes of their own.
  *
  * @param home   of Spark
  * @param folder for their files
  */
final class StandaloneSpark(home: Path, folder: Path) extends AutoCloseable:
  private val launcher = home.resolve("bin").resolve("spark-class").toString
  private val java = Path.of(System.getProperty("java.home")).toString
  private val master = start(
    "master",
    Vector("org.apache.spark.deploy.master.Master", "--host", "127.0.0.1", "--port", "0")
  )
  val address: String = announced("master", "Starting Spark master at (\\S+)".r)
  private val workers = Vector("a", "b").map: name =>
    val words = Vector("org.apache.spark.deploy.worker.Worker", "--cores", "1", "--memory", "1g")
    start(s"worker-$name", words ++ Vector("--work-dir", folder.resolve(name).toString, address))
  for name <- Vector("a", "b") do announced(s"worker-$name", "Successfully registered (.*)".r)

  private def start(name: String, words: Vector[String]): Process =
    process(Vector(launcher) ++ words.take(1) ++ Vector("--webui-port", "0") ++ words.drop(1))
      .redirectOutput(folder.resolve(s"$name.log").toFile)
      .start()

  private def process(command: Vector[String]): ProcessBuilder =
    val builder = ProcessBuilder(command.asJava).redirectErrorStream(true)
    val own = Map("SPARK_LOCAL_IP" -> "127.0.0.1", "JAVA_HOME" -> java, "SPARK_HOME" -> home)
    for (name, value) <- own do builder.environment.put(name, value.toString): Unit
    builder

  private def announced(name: String, what: scala.util.matching.Regex): String =
    val log = folder.resolve(s"$name.log")
    val found = Iterator.continually:
      Thread.sleep(50)
      what.findFirstMatchIn(Files.readString(log)).map(_.group(1))
    .take(1200).flatten.nextOption()
    found.getOrElse(throw IllegalStateException(s"no $name: ${Files.readString(log)}"))

  /** Processes that run tasks. */
  def executors: Vector[ProcessHandle] =
    workers.flatMap(_.descendants.toList.asScala).filter: p =>
      val file = Path.of(s"/proc/${p.pid}/cmdline") // the API omits long command lines
      Try(Files.readString(file)).toOption.orElse(p.info.commandLine.toScala)
        .exists(_.contains("CoarseGrainedExecutorBackend"))

  /** Submits a rendering.
    *
    * @param conf of Spark
    */
  def submit(words: Seq[String], conf: Map[String, String] = Map.empty): Submission =
    val options = conf.toVector.flatMap((name, value) => Vector("--conf", s"$name=$value"))
    val jar = System.getProperty("candela.spark.jar")
    val command = Vector(home.resolve("bin").resolve("spark-submit").toString, "--master", address)
    val log = Files.createTempFile(folder, "driver", ".log")
    waitFor("the end of the executors before", None)(Option.when(executors.isEmpty)(()))
    val all =
      process(Vector(
        "python3",
        "-c",
        StandaloneSpark.Listens
      ) ++ command ++ options ++ Vector(jar) ++ words)
    Submission(all.redirectOutput(log.toFile).start(), log)

  private def waitFor[A](what: String, run: Option[Submission])(found: => Option[A]): A =
    val first = Iterator.continually { Thread.sleep(20); found }
      .takeWhile(_ => run.forall(_.process.isAlive)).take(6000).flatten.nextOption()
    first.getOrElse(throw IllegalStateException(s"no $what: ${run.fold("")(_.text)}"))

  final class Submission(val process: Process, log: Path):
    def text: String = Files.readString(log)
    def awaitText(part: String): Unit =
      waitFor(part, Some(this))(Option.when(text.contains(part))(()))

    /** An executor that has begun to render. */
    def executor(): ProcessHandle =
      def begun(p: ProcessHandle) = p.info.totalCpuDuration.toScala.exists(_.toSeconds >= 7)
      waitFor("executor", Some(this))(executors.find(begun))

    /** Exit code and output. */
    def result: (Int, String) =
      if !process.waitFor(300, TimeUnit.SECONDS) then
        val _ = process.destroyForcibly()
        throw IllegalStateException(s"no end: $text")
      (process.exitValue, text)

  def close(): Unit =
    for p <- (executors ++ (workers :+ master).map(_.toHandle)).distinct do
      p.descendants.forEach(d => d.destroyForcibly(): Unit)
      p.destroyForcibly(): Unit

object StandaloneSpark:

  /** Runs a command that reacts to Ctrl-C, even if this process was started without. */
  private val Listens = "import os, signal, sys; signal.signal(signal.SIGINT, signal.SIG_DFL); " +
    "os.execvp(sys.argv[1], sys.argv[1:])"

  /** Where Spark of the right version is installed; or why it is not found. */
  lazy val home: Either[String, Path] =
    val version = System.getProperty("candela.spark.version")
    val asked = Option(System.getenv("SPARK_HOME")).filter(_.nonEmpty).orElse(ofPython)
    asked.map(Path.of(_)) match
      case None => Left(s"SPARK_HOME is not set; `pip install pyspark==$version` installs Spark")
      case Some(home) =>
        val core = home.resolve("jars").resolve(s"spark-core_2.13-$version.jar")
        if Files.exists(core) then Right(home) else Left(s"$home has not Spark $version")

  private def ofPython: Option[String] = Try:
    val code = "import pyspark; print(pyspark.__path__[0])"
    val python = ProcessBuilder("python3", "-c", code).redirectErrorStream(false).start()
    String(python.getInputStream.readAllBytes()).trim
  .toOption.filter(_.nonEmpty)

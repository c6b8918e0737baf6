import java.io.File
import java.lang.ProcessBuilder.Redirect

import scala.annotation.tailrec
import scala.util.{Failure, Success, Try}

import sbt.{ForkOptions, ForkRun, Logger}
import sbt.internal.util.MessageOnlyException

/** Runs the program in a separate JVM that inherits sbt's input and output instead of pipes.
  *
  * So output is neither prefixed nor delayed, the program can detect a terminal, and Ctrl-C reaches
  * it directly; sbt then waits until it has written its image.
  */
final class TerminalRun(options: ForkOptions) extends ForkRun(options) {

  override def run(
      mainClass: String,
      classpath: Seq[File],
      args: Seq[String],
      log: Logger
  ): Try[Unit] = {
    val home = options.javaHome.getOrElse(new File(sys.props("java.home")))
    val java = new File(new File(home, "bin"), "java")
    val command = java.getPath +: (options.runJVMOptions ++
      Seq("-cp", classpath.mkString(File.pathSeparator), mainClass) ++ args)
    log.debug(command.mkString(" "))

    val builder = new ProcessBuilder(command: _*)
      .redirectInput(Redirect.INHERIT)
      .redirectOutput(Redirect.INHERIT)
      .redirectError(Redirect.INHERIT)
    options.workingDirectory.foreach(builder.directory)
    options.envVars.foreach { case (name, value) => builder.environment.put(name, value) }

    val child = builder.start()
    val hook = sys.addShutdownHook(end(child))
    val code =
      try child.waitFor()
      catch { case _: InterruptedException => end(child) }
    Try(hook.remove()) // fails during sbt's shutdown, when it is not needed
    if (code == 0) Success(()) else Failure(new MessageOnlyException(s"exit code $code"))
  }

  /** Requests the program's termination and waits for it. The program may be writing a partial
    * image, so a second interrupt does not shorten the wait.
    */
  @tailrec
  private def end(child: Process): Int = {
    child.destroy()
    val code =
      try Some(child.waitFor())
      catch { case _: InterruptedException => None }
    if (code.isDefined) code.get else end(child)
  }
}

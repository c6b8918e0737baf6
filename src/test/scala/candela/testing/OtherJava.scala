package candela.testing

import java.io.File

import scala.jdk.CollectionConverters.*

import org.scalatest.Assertions.assert

/** Another JVM of the same JDK. */
object OtherJava:

  /** What it writes on its output and its error stream alike.
    *
    * @param main    object that it runs
    * @param uses    classes beside which it finds what `main` uses, apart from Scala's library
    * @param options of the JVM
    */
  def output(main: AnyRef, uses: Class[?]*)(options: String*)(words: String*): String =
    val java = Seq(sys.props("java.home"), "bin", "java").mkString(File.separator)
    val places = (main.getClass +: uses :+ classOf[Option[?]] :+ classOf[scala.deriving.Mirror])
      .map(c => File(c.getProtectionDomain.getCodeSource.getLocation.toURI).getPath)
      .distinct
    val command = Seq(java) ++ options ++ Seq("-cp", places.mkString(File.pathSeparator)) :+
      main.getClass.getName.stripSuffix("$")
    val builder = ProcessBuilder((command ++ words).asJava).redirectErrorStream(true)
    val _ = builder.environment.remove("JAVA_TOOL_OPTIONS") // with them the JVM says so
    val process = builder.start()
    val output = String(process.getInputStream.readAllBytes, "UTF-8")
    assert(process.waitFor() == 0, output)
    output

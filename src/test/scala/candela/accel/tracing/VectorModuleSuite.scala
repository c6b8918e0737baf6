package candela.accel.tracing

import java.io.File
import java.lang.module.ModuleFinder

import scala.jdk.CollectionConverters.*

import org.scalatest.funsuite.AnyFunSuite

class VectorModuleSuite extends AnyFunSuite:
  private val isInThisJdk = ModuleFinder.ofSystem.find("jdk.incubator.vector").isPresent

  /** What another JVM says that asks for vectors, on its output and its error stream alike. */
  private def said(options: String*): String =
    val java = Seq(sys.props("java.home"), "bin", "java").mkString(File.separator)
    val classes = Seq(
      PrintsVectors.getClass,
      VectorModule.getClass,
      classOf[Option[?]],
      classOf[scala.deriving.Mirror]
    ).map(c => File(c.getProtectionDomain.getCodeSource.getLocation.toURI).getPath)
    val command = (java +: options) ++
      Seq("-cp", classes.mkString(File.pathSeparator), "candela.accel.tracing.PrintsVectors")
    val builder = ProcessBuilder(command.asJava).redirectErrorStream(true)
    val _ = builder.environment.remove("JAVA_TOOL_OPTIONS") // with them the JVM says so
    val process = builder.start()
    val output = String(process.getInputStream.readAllBytes, "UTF-8")
    assert(process.waitFor() == 0, output)
    output

  test("vectors are there if the JDK has them, and no JVM warns of them"):
    assert(VectorModule.isLoaded == isInThisJdk)
    assert(said("--add-exports=java.base/jdk.internal.module=ALL-UNNAMED") == s"$isInThisJdk")

  test("where the JDK's loader of modules is closed, there are none, and nothing breaks"):
    assert(said() == "false")

/** Is started by [[VectorModuleSuite]]. */
object PrintsVectors:
  def main(words: Array[String]): Unit = print(VectorModule.isLoaded)

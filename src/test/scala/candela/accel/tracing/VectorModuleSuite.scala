package candela.accel.tracing

import candela.testing.OtherJava

import java.lang.module.ModuleFinder

import org.scalatest.funsuite.AnyFunSuite

class VectorModuleSuite extends AnyFunSuite:
  private val isInThisJdk = ModuleFinder.ofSystem.find("jdk.incubator.vector").isPresent

  private val open = "--add-exports=java.base/jdk.internal.module=ALL-UNNAMED"

  /** What another JVM says that asks for vectors. */
  private def said(options: String*): String =
    OtherJava.output(PrintsVectors, VectorModule.getClass)(options*)()

  test("vectors are there if the JDK has them, and no JVM warns of them"):
    assert(VectorModule.isLoaded == isInThisJdk)
    assert(said(open) == s"$isInThisJdk")

  test("without C2 there are none: it compiles their operations to instructions"):
    for option <- Seq("-XX:TieredStopAtLevel=1", "-Xint") do assert(said(open, option) == "false")

  test("where the JDK's loader of modules is closed, there are none, and nothing breaks"):
    assert(said() == "false")

/** Is started by [[VectorModuleSuite]]. */
object PrintsVectors:
  def main(words: Array[String]): Unit = print(VectorModule.isLoaded)

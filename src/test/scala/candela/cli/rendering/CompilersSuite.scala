package candela.cli.rendering

import candela.base.{JavaCompilers, WholeFile}
import candela.testing.OtherJava

import scala.util.Try

import org.scalatest.funsuite.AnyFunSuite

class CompilersSuite extends AnyFunSuite:

  /** What another JVM says of its compilers, after a rendering of so many samples began. */
  private def told(samples: Long, options: String*): String =
    OtherJava.output(
      TellsCompilers,
      Compilers.getClass,
      WholeFile.getClass,
      JavaCompilers.getClass
    )(options*)(s"$samples")

  private val open = "--add-exports=java.base/jdk.internal.module=ALL-UNNAMED"

  test("few samples are left to C1, without a word"):
    assert(told(100, open) == "false")

  test("many samples have C2"):
    assert(told(100000000, open) == "true")

  test("where C1 compiles everything, nothing is told"):
    assert(told(100, open, "-XX:TieredStopAtLevel=1") == "true")

  test("where the JVM can't be told, C2 stays, and nothing breaks"):
    assert(told(100) == "true")

/** Is started by [[CompilersSuite]]. Prints whether C2 may compile. */
object TellsCompilers:
  def main(words: Array[String]): Unit =
    Compilers.expect(words.head.toLong)
    val directives = Try(Compilers.tell("Compiler.directives_print"))
    print(!directives.toOption.exists(_.contains("Exclude:true")))

package candela.base

import org.scalatest.funsuite.AnyFunSuite

class JavaHeapSuite extends AnyFunSuite:

  test("the hint on memory names the variable that no other one overrides"):
    def cure(command: String, environment: (String, String)*) =
      JavaHeap.cure("-Xmx8g", command, environment.toMap)
    val ofProgram = cure("candela.cli.Main render a.pbrt", "JDK_JAVA_OPTIONS" -> "-Xmx1g")
    assert(ofProgram.endsWith("the environment variable JAVA_OPTS=-Xmx8g"))
    assert(cure("Service").contains("Java's option -Xmx8g"))
    assert(cure("Service").endsWith("JAVA_TOOL_OPTIONS"))
    assert(cure("Service", "JDK_JAVA_OPTIONS" -> "-Xmx1g").endsWith("JDK_JAVA_OPTIONS"))
    assert(cure("Service", "JDK_JAVA_OPTIONS" -> "-Xss4m").endsWith("JAVA_TOOL_OPTIONS"))

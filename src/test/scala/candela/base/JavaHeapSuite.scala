package candela.base

import org.scalatest.funsuite.AnyFunSuite

class JavaHeapSuite extends AnyFunSuite:

  test("the hint on memory names the variable that no other one overrides"):
    def variable(classPath: String, environment: (String, String)*) =
      JavaHeap.variable(classPath, environment.toMap)
    assert(variable("/opt/candela/lib/candela.jar", "JDK_JAVA_OPTIONS" -> "-Xmx1g") == "JAVA_OPTS")
    assert(variable("classes:a.jar") == "JAVA_TOOL_OPTIONS")
    assert(variable("classes", "JDK_JAVA_OPTIONS" -> "-Xmx1g") == "JDK_JAVA_OPTIONS")
    assert(variable("classes", "JDK_JAVA_OPTIONS" -> "-Xss4m") == "JAVA_TOOL_OPTIONS")

package candela.base

/** The memory that Java may use for objects. */
object JavaHeap:
  /** In bytes. */
  def limit: Long = Runtime.getRuntime.maxMemory

  /** How to raise the limit.
    *
    * @param to as Java's options say it, e.g. `8g`
    */
  def raise(to: String): String = raised(s"-Xmx$to")

  /** How to raise a limit by an option of Java. */
  def raised(option: String): String =
    val name = variable(sys.props.getOrElse("java.class.path", ""), sys.env)
    s"raise the limit, e.g. with the environment variable $name=$option"

  /** The variable whose limit of the heap counts: the launcher's options precede Java's own. */
  private[candela] def variable(classPath: String, environment: Map[String, String]): String =
    val javas = "JDK_JAVA_OPTIONS"
    if classPath.endsWith("candela.jar") then "JAVA_OPTS"
    else if environment.get(javas).exists(_.contains("-Xmx")) then javas
    else "JAVA_TOOL_OPTIONS"

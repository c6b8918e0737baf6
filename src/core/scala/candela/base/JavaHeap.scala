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
    cure(option, sys.props.getOrElse("sun.java.command", ""), sys.env)

  /** @param command main class or jar, and arguments, of this JVM: the launcher alone reads
    *                JAVA_OPTS, and Java the other variables, unless its own arguments have a limit
    */
  private[candela] def cure(
      option: String,
      command: String,
      environment: Map[String, String]
  ): String =
    val javas = "JDK_JAVA_OPTIONS"
    if command.startsWith("candela.cli.Main") then
      s"raise the limit, e.g. with the environment variable JAVA_OPTS=$option"
    else
      val variable =
        if environment.get(javas).exists(_.contains("-Xmx")) then javas else "JAVA_TOOL_OPTIONS"
      s"raise the limit by Java's option $option, or with the environment variable $variable"

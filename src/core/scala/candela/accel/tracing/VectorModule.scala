package candela.accel.tracing

/** The JDK's incubating Vector API, loaded when it is first needed. To ask for it on the command
  * line (`--add-modules`) costs every start time, and the JVM then prints a warning.
  *
  * The JDK itself loads modules at run time, for agents. Its method is internal: unless the JVM is
  * told to export it (`--add-exports=java.base/jdk.internal.module=ALL-UNNAMED`), there are no
  * vectors.
  */
private[tracing] object VectorModule:
  private val Name = "jdk.incubator.vector"

  /** False, too, where its operations would be calls, not instructions: a hundred times slower. */
  lazy val isLoaded: Boolean = hasC2 && (ModuleLayer.boot.findModule(Name).isPresent || load())

  /** Whether hot code is compiled by C2, as usual, or by a compiler as good. Not with
    * `-XX:TieredStopAtLevel=1`, and not with `-Xint`.
    */
  private def hasC2: Boolean =
    val mode = System.getProperty("java.vm.info", "")
    !Vector("emulated-client", "interpreted mode").exists(mode.contains)

  private def load(): Boolean =
    try
      val modules = Class.forName("jdk.internal.module.Modules")
      val _ = modules.getMethod("loadModule", classOf[String]).invoke(null, Name)
      true
    catch case _: ReflectiveOperationException => false

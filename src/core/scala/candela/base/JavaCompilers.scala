package candela.base

/** The compilers of this JVM. */
object JavaCompilers:
  /** Whether hot code is compiled by C2, as usual, or by a compiler as good. Not with
    * `-XX:TieredStopAtLevel=1`, with which the launcher starts renderings of few samples, and not
    * with `-Xint`. Code that needs C2, such as the Vector API's, is a hundred times slower then.
    */
  val hasC2: Boolean =
    val mode = System.getProperty("java.vm.info", "")
    !Vector("emulated-client", "interpreted mode").exists(mode.contains)

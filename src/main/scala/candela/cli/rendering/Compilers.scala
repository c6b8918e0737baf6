package candela.cli.rendering

import candela.base.{JavaCompilers, WholeFile, WriteError}

import java.io.IOException
import java.nio.charset.StandardCharsets
import java.nio.file.Files

/** The JVM's two compilers. C2's code is faster than C1's, but a rendering of few samples ends
  * before the time is earned that compiling by C2 takes.
  */
private[cli] object Compilers:

  /** Camera samples from which C2 may pay; in most scenes it takes two to four times as many. */
  private inline val Few = 131072L

  /** Leaves what is not compiled yet to C1, but for [[Loops]], for the rest of the JVM's life, if
    * it renders so few samples. Without effect if the JVM doesn't let its compilers be told, or
    * exports no `jdk.internal.module`.
    */
  def expect(samples: Long): Unit =
    if samples < Few && JavaCompilers.hasC2 then
      try
        val directives = Files.createTempFile("candela-", ".json")
        try
          WholeFile.write(directives, isForced = false): file =>
            file.write(StandardCharsets.US_ASCII.encode(WithoutC2)): Unit
          val _ = tell(s"Compiler.directives_add \"$directives\"")
        finally Files.deleteIfExists(directives): Unit
      catch
        case _: (IOException | WriteError | ReflectiveOperationException | LinkageError) => ()

  /** Loops over many texels, primitives or bytes, which the JVM has to compile well in any case.
    * What is done once for each hit or lookup is not among them.
    */
  private val Loops =
    def methods(folder: String, names: String*) = names.map(name => s"$folder/$name")
    methods("candela", "accel/*.*", "base/*.*", "image/*.*") ++
      methods("candela/scenefile", "Tokenizer*.*", "ValueReader*.*", "NumberReader*.*") ++
      methods("candela/shapes", "CornerTable*.*", "LoopSubdivision*.*", "Nurbs*.*", "Curve*.*") ++
      methods("candela/shapes", "BilinearMesh*.*", "DisplacedMesh*.*", "TriangleTest*.*") ++
      methods("candela/shapes", "*.intersect", "*.worldBounds") ++
      methods("candela/textures", "Enlargement*.*", "Pyramid*.*", "MadeTexels*.*", "Texel*.*") ++
      methods("candela/textures", "ByteTexels*.*", "FloatTexels*.*", "Tile*.*") ++
      methods("java", "lang/*.*", "nio/*.*", "util/zip/*.*", "util/Arrays.*") ++
      Vector("sun/*.*", "com/*.*")

  /** Source: "Writing Directives", Java Platform, Standard Edition, Java Virtual Machine Guide. */
  private val WithoutC2 =
    val loops = Loops.map(name => s"\"$name\"").mkString(", ")
    s"""[{ match: [$loops], c2: { Exclude: false } },
      { match: ["*.*"], c2: { Exclude: true } }]"""

  /** Runs a command as `jcmd` does from outside. The JDK's management bean for it has many more
    * classes to load than the one behind it.
    *
    * @return what the JVM says
    * @throws ReflectiveOperationException if the JVM does not let itself be told
    */
  private[rendering] def tell(command: String): String =
    // Loads the native library
    val _ = Class.forName(s"$Package.PlatformMBeanProviderImpl")
    val commands = Class.forName(s"$Package.DiagnosticCommandImpl")
    Class.forName("jdk.internal.module.Modules")
      .getMethod("addOpens", classOf[Module], classOf[String], classOf[Module])
      .invoke(null, commands.getModule, Package, getClass.getModule)
    def method(name: String, parameters: Class[?]*) =
      val method = commands.getDeclaredMethod(name, parameters*)
      method.setAccessible(true)
      method
    val bean = method("getDiagnosticCommandMBean").invoke(null)
    method("executeDiagnosticCommand", classOf[String]).invoke(bean, command).toString

  private inline val Package = "com.sun.management.internal"

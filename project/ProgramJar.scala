import java.io.{BufferedOutputStream, File, FileOutputStream}
import java.time.LocalDateTime
import java.util.jar.{JarFile, JarOutputStream}
import java.util.zip.{CRC32, ZipEntry}

import scala.collection.JavaConverters._
import scala.collection.mutable

import org.objectweb.asm._
import sbt.io.IO

/** Packs all classes and resources into one jar optimised for start-up: uncompressed, and with
  * lambdas that class-data sharing can archive. docs/decisions/0014-start-up.md has measurements.
  */
object ProgramJar {

  /** @param jars      for equal names the first jar's entry is used; legal texts of all are kept
    * @param mainClass for the manifest
    */
  def write(jars: Seq[File], to: File, mainClass: Option[String] = None): Unit = {
    IO.createDirectory(to.getParentFile)
    val out = new JarOutputStream(new BufferedOutputStream(new FileOutputStream(to)))
    out.setMethod(ZipEntry.STORED)
    val taken = mutable.Set.empty[String]
    def put(name: String, bytes: Array[Byte]): Unit = if (taken.add(name)) {
      val sum = new CRC32
      sum.update(bytes)
      val entry = new ZipEntry(name)
      entry.setTimeLocal(SameForAll)
      entry.setSize(bytes.length.toLong)
      entry.setCrc(sum.getValue)
      out.putNextEntry(entry)
      out.write(bytes)
      out.closeEntry()
    }
    try {
      // What the launcher passes as options, as far as a jar can ask for it
      val asked = "Add-Exports: java.base/jdk.internal.module\nEnable-Native-Access: ALL-UNNAMED\n"
      val main = mainClass.fold("")(c => s"Main-Class: $c\n$asked")
      val manifest = s"Manifest-Version: 1.0\n${main}Multi-Release: true\n\n"
      put(JarFile.MANIFEST_NAME, manifest.getBytes("UTF-8"))
      for (jar <- jars; (name, bytes) <- entries(jar)) name match {
        case Useless() =>
        case Legal(text) => put(s"META-INF/legal/${jar.getName.stripSuffix(".jar")}/$text", bytes)
        case n if n.endsWith(".class") && !n.startsWith("META-INF/") => put(n, plainLambdas(bytes))
        case n => put(n, bytes)
      }
    } finally out.close()
  }

  /** Unpacks the native libraries of all platforms into folders such as `linux-x64`. */
  def unpackNatives(jars: Seq[File], to: File): Seq[File] =
    for (jar <- jars; (Native(system, processor, file), bytes) <- entries(jar)) yield {
      val target = new File(new File(to, s"$system-$processor"), file)
      IO.write(target, bytes)
      target
    }

  /** Fixed timestamp for reproducible jars: in 1980, the start of the zip format's time. It has no
    * time zone, as the format has none.
    */
  private val SameForAll = LocalDateTime.of(1980, 1, 2, 0, 0)

  private val Native = "(linux|macos|windows)/(x64|arm64)/(?:.*/)?([^/]+\\.(?:so|dylib|dll))".r
  private val Legal = "(?:META-INF/)?((?i:license|notice|copyright)[^/]*)".r
  private val Useless = "META-INF/(?:MANIFEST.MF|INDEX.LIST)|.*module-info.class|.*\\.tasty".r

  private def entries(jar: File): Seq[(String, Array[Byte])] = {
    val file = new JarFile(jar)
    try
      for (e <- file.entries.asScala.toVector.sortBy(_.getName) if !e.isDirectory)
        yield e.getName -> IO.readBytes(file.getInputStream(e))
    finally file.close()
  }

  /** Makes lambdas non-serialisable. Scala makes every lambda serialisable, which class-data
    * sharing can't archive: a few hundred classes would be generated at every start. This program
    * never serialises lambdas.
    *
    * Also removes the bridges that Scala requests: the interfaces below declare only the erased
    * method.
    */
  private def plainLambdas(bytes: Array[Byte]): Array[Byte] = {
    val reader = new ClassReader(bytes)
    val writer = new ClassWriter(reader, 0)
    reader.accept(new PlainLambdas(writer), 0)
    writer.toByteArray
  }

  private final class PlainLambdas(to: ClassVisitor) extends ClassVisitor(Opcodes.ASM9, to) {

    /** Leaves out the identity of the `.tasty` file, which the jar lacks: it depends on which other
      * files were compiled at the same time.
      */
    override def visitAttribute(attribute: Attribute): Unit =
      if (attribute.`type` != "TASTY") super.visitAttribute(attribute)

    override def visitMethod(
        access: Int,
        name: String,
        descriptor: String,
        signature: String,
        exceptions: Array[String]
    ): MethodVisitor = {
      val inner = super.visitMethod(access, name, descriptor, signature, exceptions)
      new MethodVisitor(Opcodes.ASM9, inner) {
        override def visitInvokeDynamicInsn(
            name: String,
            descriptor: String,
            bootstrap: Handle,
            arguments: AnyRef*
        ): Unit =
          if (isPlain(bootstrap, descriptor, arguments))
            super.visitInvokeDynamicInsn(name, descriptor, Metafactory, arguments.take(3): _*)
          else super.visitInvokeDynamicInsn(name, descriptor, bootstrap, arguments: _*)
      }
    }
  }

  private def isPlain(bootstrap: Handle, descriptor: String, arguments: Seq[AnyRef]): Boolean =
    bootstrap.getOwner == Factory && bootstrap.getName == "altMetafactory" && {
      val interface = Type.getReturnType(descriptor).getInternalName
      val flags = arguments(3).asInstanceOf[Integer].intValue
      (flags & LambdaMarkers) == 0 && Interfaces.exists(interface.startsWith(_))
    }

  private val Interfaces = Seq("scala/Function", "scala/runtime/", "java/util/function/")

  /** `LambdaMetafactory.FLAG_MARKERS`: additional marker interfaces, which must stay. */
  private val LambdaMarkers = 2
  private val Factory = "java/lang/invoke/LambdaMetafactory"
  private val Metafactory = {
    val (types, handles) = ("Ljava/lang/invoke/MethodType;", "Ljava/lang/invoke/MethodHandle")
    val caller = s"$handles" + "s$Lookup;Ljava/lang/String;"
    val descriptor = s"($caller$types$types$handles;$types)Ljava/lang/invoke/CallSite;"
    new Handle(Opcodes.H_INVOKESTATIC, Factory, "metafactory", descriptor, false)
  }
}

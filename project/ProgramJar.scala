import java.io.{BufferedOutputStream, File, FileOutputStream}
import java.time.LocalDateTime
import java.util.jar.{JarFile, JarOutputStream}
import java.util.zip.{CRC32, ZipEntry}

import scala.collection.JavaConverters._
import scala.collection.mutable

import packaging.PlainLambdas
import sbt.io.IO

/** Packs all classes and resources into one jar optimised for start-up: uncompressed, and with
  * [[packaging.PlainLambdas]]. docs/decisions/0014-start-up.md has measurements.
  */
object ProgramJar {

  /** @param jars      for equal names the first jar's entry is used; legal texts of all are kept
    * @param mainClass for the manifest
    * @param modules   names of jars that belong to the class path if they lie beside this one
    */
  def write(
      jars: Seq[File],
      to: File,
      mainClass: Option[String] = None,
      modules: Seq[String] = Nil
  ): Unit = {
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
      val path = if (modules.isEmpty) "" else modules.mkString("Class-Path: ", " ", "\n")
      val manifest = s"Manifest-Version: 1.0\n$main${path}Multi-Release: true\n\n"
      put(JarFile.MANIFEST_NAME, manifest.getBytes("UTF-8"))
      for (jar <- jars; (name, bytes) <- entries(jar)) name match {
        case Useless() =>
        case Legal(text) => put(s"META-INF/legal/${jar.getName.stripSuffix(".jar")}/$text", bytes)
        case n if n.endsWith(".class") && !n.startsWith("META-INF/") => put(n, PlainLambdas(bytes))
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
}

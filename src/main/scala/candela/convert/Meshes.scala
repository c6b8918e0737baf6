package candela.convert

import java.io.{BufferedInputStream, IOException}
import java.nio.file.{Files, InvalidPathException, Path}

import candela.scenefile.{Declaration, ParamType}

/** Properties of meshes. */
object Meshes:

  /** Whether every vertex has a shading normal. */
  def hasNormals(shape: Declaration): Boolean = shape.name match
    case "trianglemesh" | "bilinearmesh" => shape.param("N").exists(_.floats.nonEmpty)
    case "loopsubdiv" => true // of the limit surface
    case "plymesh" => shape.param("filename").exists(p => plyHasNormals(shape, p.strings.head))
    case _ => false

  private def plyHasNormals(shape: Declaration, name: String): Boolean =
    try
      val path = shape.folder.resolve(name.replace('\\', '/'))
      Files.isRegularFile(path) && header(path).exists(_.matches("property \\S+ nx"))
    catch case _: InvalidPathException => false

  private def header(path: Path): Vector[String] =
    try
      val raw = BufferedInputStream(Files.newInputStream(path))
      val in = if path.toString.endsWith(".gz") then java.util.zip.GZIPInputStream(raw) else raw
      try
        val text = String(in.readNBytes(LongestHeader), "ISO-8859-1")
        text.linesIterator.map(_.trim).takeWhile(_ != "end_header").toVector
      finally in.close()
    catch case _: IOException => Vector.empty

  private val LongestHeader = 16384

  /** Whether a PLY file can hold the mesh: only positions, normals and texture coordinates. */
  def fitsPly(shape: Declaration): Boolean =
    def numbers(name: String) = shape.param(name).fold(0)(_.floats.length)
    val count = numbers("P") / 3
    def matches(name: String, each: Int) = numbers(name) == 0 || numbers(name) == each * count
    shape.name == "trianglemesh" && count > 0 && numbers("P") == 3 * count &&
    shape.param("indices").exists(p =>
      p.ints.length % 3 == 0 && p.ints.forall(i => i >= 0 && i < count)
    ) &&
    matches("N", 3) && matches("uv", 2) && matches("st", 2) &&
    shape.param("P").exists(_.paramType == ParamType.Point3) &&
    !shape.params.exists(p => p.name == "S" || p.isDefault)

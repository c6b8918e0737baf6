package candela.convert

import candela.io.InputFile
import java.io.IOException

import candela.scenefile.{Declaration, Param, ParamType}

/** Properties of meshes. */
object Meshes:
  val OtherSide = "v3 lights the other side of a reversed mesh with normals"

  /** Whether every vertex has a shading normal. */
  def hasNormals(shape: Declaration): Boolean = shape.name match
    case "trianglemesh" | "bilinearmesh" => shape.param("N").exists(_.floats.nonEmpty)
    case "loopsubdiv" => true // of the limit surface
    case "plymesh" => shape.param("filename").exists(plyHasNormals(shape, _))
    case _ => false

  private def plyHasNormals(shape: Declaration, p: Param): Boolean =
    shape.folder.locate(p.strings.head, Some(p.valuesAt))
      .exists(header(_).exists(_.matches("property \\S+ nx")))

  private def header(file: InputFile): Vector[String] =
    try
      val raw = file.stream()
      val input = if file.toString.endsWith(".gz") then java.util.zip.GZIPInputStream(raw) else raw
      try
        val text = String(input.readNBytes(LongestHeader), "ISO-8859-1")
        text.linesIterator.map(_.trim).takeWhile(_ != "end_header").toVector
      finally input.close()
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

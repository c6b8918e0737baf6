package candela.jmh

import java.io.{BufferedOutputStream, DataOutputStream, OutputStream}
import java.nio.file.{Files, Path}
import java.util.SplittableRandom
import java.util.zip.GZIPOutputStream

/** Files of a size, written anew for each run, always the same. */
object MeshText:

  /** Their size in 10^6 bytes, up to a line. */
  final val Megabytes = 32

  def write(kind: String, packed: Boolean): Path =
    val path = Files.createTempFile("candela-bench", if packed then ".pbrt.gz" else ".pbrt")
    val file = BufferedOutputStream(Files.newOutputStream(path), 1 << 16)
    val out = Lines(if packed then GZIPOutputStream(file) else file)
    out.line("WorldBegin")
    kind match
      case "statements" =>
        while out.isBelow(1.0) do
          out.line(s"AttributeBegin\n  Translate ${out.place} ${out.place} ${out.place}")
          out.line("  Material \"matte\" \"rgb Kd\" [ 0.5 0.25 0.125 ]")
          out.line("  Shape \"sphere\" \"float radius\" [ 0.01 ]\nAttributeEnd")
      case _ =>
        out.line("Shape \"trianglemesh\"\n\"point3 P\" [")
        val shares = Map("floats" -> (0.5, 1.0), "integers" -> (0.0, 0.0), "mixed" -> (0.3, 0.6))
        val (places, normals) = shares(kind)
        while out.isBelow(places) do out.line(s"${out.place} ${out.place} ${out.place}")
        out.line("0 0 0 ]\n\"normal N\" [")
        while out.isBelow(normals) do out.line(s"${out.unit} ${out.unit} ${out.unit}")
        out.line("0 0 1 ]\n\"integer indices\" [")
        while out.isBelow(1.0) do out.line(s"${out.index} ${out.index} ${out.index}")
        out.line("0 1 2 ]")
    out.line("WorldEnd")
    out.close()
    path

  /** A third of the file is vertices with normals, the rest is triangles. */
  def ply(format: String): Path =
    val isAscii = format == "ascii"
    val vertices = Megabytes * 1000000 / 3 / (if isAscii then 56 else 24)
    val faces = Megabytes * 1000000 / 3 * 2 / (if isAscii then 21 else 13)
    val path = Files.createTempFile("candela-bench", ".ply")
    val file = BufferedOutputStream(Files.newOutputStream(path), 1 << 16)
    val out = Lines(file)
    out.line(s"ply\nformat $format 1.0\nelement vertex $vertices")
    for name <- "x y z nx ny nz".split(' ') do out.line(s"property float $name")
    out.line(s"element face $faces\nproperty list uchar int vertex_indices\nend_header")
    val random = SplittableRandom(1)
    val binary = DataOutputStream(file)
    def vertex() = random.nextInt(vertices)
    def put(bits: Int) = binary.writeInt(Integer.reverseBytes(bits))
    for _ <- 0 until vertices do
      if isAscii then
        out.line(s"${out.place} ${out.place} ${out.place} ${out.unit} ${out.unit} ${out.unit}")
      else
        for _ <- 0 until 6 do
          put(java.lang.Float.floatToIntBits(random.nextDouble(-1, 1).toFloat))
    for _ <- 0 until faces do
      if isAscii then out.line(s"3 ${vertex()} ${vertex()} ${vertex()}")
      else
        binary.write(3)
        for _ <- 0 until 3 do put(vertex())
    out.close()
    path

  private final class Lines(to: OutputStream):
    private val random = SplittableRandom(7)
    private var written = 0L

    def line(text: String): Unit =
      val bytes = (text + "\n").getBytes("US-ASCII")
      to.write(bytes)
      written += bytes.length

    def isBelow(share: Double): Boolean = written < share * Megabytes * 1e6

    /** A coordinate of 6 to 9 digits, and one of a unit vector. */
    def place: String = decimal(random.nextInt(5, 9), 10)
    def unit: String = decimal(6, 1)
    def index: Int = random.nextInt(3000000)

    private def decimal(digits: Int, size: Int): String =
      String.format(java.util.Locale.ROOT, s"%.${digits}f", random.nextDouble(-size, size))

    def close(): Unit = to.close()

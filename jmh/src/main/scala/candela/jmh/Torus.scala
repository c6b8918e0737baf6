package candela.jmh

import candela.accel.Primitives
import candela.io.WholeFile
import candela.shapes.{Mesh, TriangleSoup}

import java.io.BufferedOutputStream
import java.nio.channels.Channels
import java.nio.file.Path
import java.nio.{ByteBuffer, ByteOrder}
import java.util.SplittableRandom

/** A torus with bumps, of any number of triangles: a closed surface, as most meshes are. Positions
  * and indices are all that it has.
  */
final class Torus(triangles: Int):
  private val sides = Math.max(3, Math.sqrt(triangles / 2.0).round.toInt)

  val positions: Array[Float] =
    val all = new Array[Float](3 * sides * sides)
    val random = SplittableRandom(1)
    for v <- 0 until sides; u <- 0 until sides do
      val a = 2 * Math.PI * u / sides
      val b = 2 * Math.PI * v / sides
      val bumps = 0.05 * Math.sin(9 * a) * Math.sin(13 * b) + 0.02 * Math.sin(50 * a + 31 * b)
      val r = 0.4 + bumps + 0.3 / sides * random.nextDouble()
      val at = 3 * (v * sides + u)
      all(at) = ((1 + r * Math.cos(b)) * Math.cos(a)).toFloat
      all(at + 1) = ((1 + r * Math.cos(b)) * Math.sin(a)).toFloat
      all(at + 2) = (r * Math.sin(b)).toFloat
    all

  val indices: Array[Int] =
    val all = new Array[Int](6 * sides * sides)
    for v <- 0 until sides; u <- 0 until sides do
      val (here, right) = (v * sides + u, v * sides + (u + 1) % sides)
      val (below, beside) = ((v + 1) % sides * sides + u, (v + 1) % sides * sides + (u + 1) % sides)
      val at = 6 * (v * sides + u)
      all(at) = here
      all(at + 1) = right
      all(at + 2) = beside
      all(at + 3) = here
      all(at + 4) = beside
      all(at + 5) = below
    all

  def count: Int = indices.length / 3

  def primitives: Primitives =
    val mesh = Mesh(0, 0, count, Array.empty, Array.empty, false, material = 0, firstLight = -1)
    val soup = TriangleSoup(positions, indices, Array(mesh), tangents = false)
    Primitives(soup, Array.empty)

  /** As a binary PLY file. */
  def write(path: Path): Unit = WholeFile.write(path): channel =>
    val out = BufferedOutputStream(Channels.newOutputStream(channel), 1 << 20)
    val header =
      s"ply\nformat binary_little_endian 1.0\nelement vertex ${positions.length / 3}\n" +
        "property float x\nproperty float y\nproperty float z\n" +
        s"element face $count\nproperty list uchar int vertex_indices\nend_header\n"
    out.write(header.getBytes("US-ASCII"))
    val words = ByteBuffer.allocate(13).order(ByteOrder.LITTLE_ENDIAN)
    def put(fill: => Unit): Unit =
      words.clear()
      fill
      out.write(words.array, 0, words.position)
    for i <- positions.indices do put(words.putFloat(positions(i)): Unit)
    for f <- 0 until count do
      put:
        words.put(3.toByte)
        for k <- 0 until 3 do words.putInt(indices(3 * f + k)): Unit
    out.flush()

object Torus:

  /** A scene of that file, seen from above, lit from the sky. */
  def scene(mesh: String): String =
    s"""Film "rgb" "integer xresolution" 400 "integer yresolution" 300
       |  "string filename" "torus.exr"
       |Sampler "zsobol" "integer pixelsamples" 4
       |LookAt 0 -2.5 2.5  0 0 0  0 0 1
       |Camera "perspective" "float fov" 45
       |WorldBegin
       |LightSource "infinite"
       |Material "diffuse"
       |Shape "plymesh" "string filename" "$mesh"
       |""".stripMargin

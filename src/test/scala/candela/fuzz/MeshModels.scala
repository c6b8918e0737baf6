package candela.fuzz

import candela.image.{Image, ImageFiles}

import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}
import java.nio.{ByteBuffer, ByteOrder}

import scala.util.Random

/** Broken models in OBJ with materials in MTL, PLY and STL.
  *
  * @param folder of the files that they name
  */
private[fuzz] final class MeshModels(folder: Path, random: Random):
  import MeshModels.*

  ImageFiles.write(folder.resolve("small.png"), Image.rgb(4, 4))
  private val objects = Mutator(Vector(obj), random)
  private val materials = Mutator(Vector(mtl), random)
  private val polygons = Mutator(Vector(ply), random)
  private val texts = Mutator(Vector(textStl), random)
  private val binaries = Mutator(Vector(binaryStl), random)

  /** A model, and the name of its file. */
  def next(): (Array[Byte], String) = random.nextInt(5) match
    case 0 =>
      Files.write(folder.resolve("broken.mtl"), mtl): Unit
      (damaged(objects), "broken.obj")
    case 1 =>
      Files.write(folder.resolve("broken.mtl"), damaged(materials)): Unit
      (obj, "broken.obj")
    case 2 => (damaged(polygons), "broken.ply")
    case 3 => (damaged(texts), "broken.stl")
    case _ => (claimed(binaries.bytes()), "broken.stl")

  /** By words, bytes or hostile words of the format. */
  private def damaged(mutator: Mutator): Array[Byte] = random.nextInt(3) match
    case 0 => mutator.text()
    case 1 => mutator.bytes()
    case _ =>
      val words = String(mutator.meaning(), ISO_8859_1).split("(?<=\\s)(?=\\S)")
      for _ <- 0 to random.nextInt(3) do
        words(random.nextInt(words.length)) = Words(random.nextInt(Words.size)) + " "
      words.mkString.getBytes(ISO_8859_1)

  /** Perhaps with another number of triangles. */
  private def claimed(bytes: Array[Byte]): Array[Byte] =
    if bytes.length < 84 || random.nextBoolean() then bytes
    else
      val count = Odd.Ints(random.nextInt(Odd.Ints.size))
      ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN).putInt(80, count).array

private object MeshModels:
  private val Words = Odd.Numbers ++ Vector(
    "nan",
    "-nan(ind)",
    "1.#INF",
    "1/2/3",
    "1//",
    "/",
    "-1/-1/-1",
    "99999999999/1",
    "2147483647",
    "-2147483648",
    "\\\n",
    "#",
    "\"",
    "f",
    "v",
    "vt",
    "s",
    "usemtl",
    "mtllib ../../etc/passwd",
    "mtllib /dev/zero\n",
    "newmtl",
    "map_Kd -s 1 -o",
    "map_Kd ../small.png\n",
    "map_Bump /dev/zero\n",
    "map_d C:\\x\\small.png\n",
    "map_Ke models\n",
    "-imfchan",
    "illum 1e9",
    "facet",
    "endfacet",
    "vertex",
    "4294967295",
    "list",
    "\u0000",
    "\u001b[31m",
    "f" + " 1" * 5000 + "\n",
    "f" + (1 to 3000).map(i => s" ${i % 4 + 1}").mkString + "\n"
  )

  private val obj: Array[Byte] =
    """mtllib broken.mtl
      |v 0 0 0 1 0.5 0
      |v 1 0 0
      |v 1 1 0.5
      |v 0 1 0 0 1 0
      |v 0.5 0.5 2
      |vt 0 0
      |vt 1 1
      |vn 0 0 1
      |o a
      |g b c
      |usemtl red
      |s 1
      |f 1/1/1 2/2/1 3/1/1 4/2/1
      |f -1 1 2 \\
      | 3
      |usemtl glass
      |s off
      |f 1/1 2/2 5/1
      |l 1 2
      |curv 0 1 1 2
      |""".stripMargin.getBytes(ISO_8859_1)

  private val mtl: Array[Byte] =
    """newmtl red
      |Ka 0.1 0.1 0.1
      |Kd 0.8 0.1 0.1
      |Ks 0.5 0.5 0.5
      |Ke 0 0 0.1
      |Ns 100
      |illum 3
      |d -halo 0.9
      |map_Kd -s 2 2 1 -o 0.5 0.5 0 -clamp on small.png
      |map_d -imfchan m small.png
      |map_Bump -bm 0.5 small.png
      |newmtl glass
      |Tf 0.9 0.9 1
      |Ni 1.5
      |illum 7
      |Pr 0.1
      |Pm 0
      |Ps 0.5
      |Pc 1
      |Pcr 0.2
      |aniso 0.5
      |anisor 0.25
      |map_Ke small.png
      |norm small.png
      |""".stripMargin.getBytes(ISO_8859_1)

  private val ply: Array[Byte] =
    """ply
      |format ascii 1.0
      |element vertex 5
      |property float x
      |property float y
      |property float z
      |property uchar red
      |property uchar green
      |property uchar blue
      |property float alpha
      |element face 2
      |property list uchar int vertex_indices
      |property uchar red
      |property list uchar float texcoord
      |end_header
      |0 0 0 255 0 0 1
      |4 4 0 255 0 0 0.5
      |0 1 0 255 0 0 1
      |-4 4 0 255 0 0 1
      |0 0 1 0 0 0 1
      |4 0 1 2 3 9 2 0 0
      |5 0 1 2 3 4 9 0
      |""".stripMargin.getBytes(ISO_8859_1)

  private val corners = Vector(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1)

  private val textStl: Array[Byte] =
    corners.grouped(9).map(_.grouped(3).map(_.mkString("vertex ", " ", "\n"))
      .mkString("facet normal 0 0 1\nouter loop\n", "", "endloop\nendfacet\n"))
      .mkString("solid a\n", "", "endsolid a\n").getBytes(ISO_8859_1)

  private val binaryStl: Array[Byte] =
    val out = ByteBuffer.allocate(84 + 50 * 2).order(ByteOrder.LITTLE_ENDIAN)
    out.put("COLOR=abcd".getBytes(ISO_8859_1)).position(80).putInt(2): Unit
    for triangle <- corners.grouped(9) do
      for x <- Vector(0, 0, 1) ++ triangle do out.putFloat(x.toFloat)
      out.putShort(0x8123.toShort)
    out.array

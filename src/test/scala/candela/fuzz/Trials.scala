package candela.fuzz

import candela.diagnostics.{Refusal, SceneError, Severity}
import candela.io.{InputFile, SceneFolder}
import candela.job.SceneFormat
import java.awt.image.BufferedImage
import java.io.ByteArrayOutputStream
import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path}
import java.util.zip.GZIPOutputStream
import scala.jdk.CollectionConverters.*
import scala.util.Random

import candela.build.SceneBuilder
import candela.build.media.{NanoVdbError, NanoVdbFile}
import candela.build.shapes.PlyFile
import candela.image.{Image, ImageError, ImageFiles, OutputFormat}
import candela.mitsuba.MitsubaScene
import candela.scenefile.Parser
import candela.settings.{ReadSettings, RenderSettings}
import candela.testing.{NanoVdb, VdbGrid}

/** Broken files, each read in its own way.
  *
  * @param short number of files in each run of the tests
  */
enum FileKind(val name: String, val short: Int):
  case Scenes extends FileKind("scenes", 2000)
  case Builds extends FileKind("builds", 150)
  case Meshes extends FileKind("meshes", 1500)
  case Pictures extends FileKind("pictures", 500)
  case Volumes extends FileKind("volumes", 200)
  case Mitsuba extends FileKind("mitsuba", 400)
  case Models extends FileKind("models", 400)
  case MeshModels extends FileKind("mesh-models", 600)

/** Reads broken files, all of them written into `folder`. Each must give an answer or a clean
  * refusal; whatever else happens is a finding.
  *
  * @param from a folder of scenes, meshes and pictures to break
  */
final class Trials(from: Path, folder: Path, random: Random):
  private val all =
    val found = Files.walk(from)
    try found.iterator.asScala.toVector.sorted
    finally found.close()

  private def files(endings: String*): Vector[Array[Byte]] =
    for
      path <- all
      if Files.isRegularFile(path) && endings.exists(path.toString.endsWith)
      bytes = Files.readAllBytes(path)
      if bytes.length < 20000 || endings.contains(".pbrt")
    yield bytes.take(12000)

  if !Files.exists(folder.resolve("bomb.pbrt")) then Trials.prepare(folder)
  // meshes and pictures that scenes mention are found
  for path <- all if Files.isRegularFile(path) && Files.size(path) < 200000 do
    val copy = folder.resolve(from.relativize(path).toString)
    val _ = Files.createDirectories(copy.getParent)
    if !Files.exists(copy) then Files.copy(path, copy): Unit

  private val scenes = Mutator(files(".pbrt"), random)
  private val meshes = Mutator(files(".ply") ++ Trials.meshes, random)
  private val pictures =
    Mutator(
      files(".exr", ".png", ".hdr", ".tga", ".jpg", ".pfm", ".qoi") ++ Trials.pictures(folder) ++
        Trials.foreignExr,
      random
    )

  private val volumes = Mutator(Trials.volumes, random)
  private val grids = Mutator(Trials.grids, random)
  private val documents = Mutator(files(".xml") ++ Trials.documents, random)
  private val quilts = Mutator(Vector(Trials.quilt), random)
  private val curves = Mutator(Vector(Trials.curves), random)
  private lazy val models = Models(Files.createDirectories(folder.resolve("models")), random)
  private lazy val meshModels =
    MeshModels(Files.createDirectories(folder.resolve("models")), random)
  private val objects = Mutator(files(".obj") ++ files(".serialized"), random)

  /** The next broken file; `judge` reads it. */
  def next(kind: FileKind): Path =
    val (bytes, name) = kind match
      case FileKind.Scenes => perhapsPacked(scenes.text(), "self.pbrt")
      case FileKind.Builds =>
        (if random.nextInt(4) == 0 then scenes.text() else scenes.meaning(), "self.pbrt")
      case FileKind.Meshes =>
        val bytes = if random.nextBoolean() then meshes.bytes() else meshes.text()
        perhapsPacked(bytes, "broken.ply")
      case FileKind.Pictures =>
        (pictures.bytes(), if random.nextBoolean() then "broken.tga" else "broken.png")
      case FileKind.Volumes => (volumes.bytes(), "broken.nvdb")
      case FileKind.Mitsuba =>
        // one in three: a sound scene of broken meshes, curves and of a broken volume
        for mesh <- Vector("broken.obj", "broken.serialized") do
          Files.write(folder.resolve(mesh), objects.bytes())
        Files.write(folder.resolve("broken.vol"), grids.bytes())
        Files.write(folder.resolve("broken.txt"), curves.text())
        Files.write(folder.resolve("quilt.ply"), quilts.text())
        val bytes = random.nextInt(3) match
          case 0 => documents.text()
          case 1 => documents.meaning()
          case _ => Trials.documents.last
        (bytes, "mitsuba/self.xml")
      case FileKind.Models =>
        val (bytes, isBinary) = models.next()
        (bytes, if isBinary then "models/broken.glb" else "models/broken.gltf")
      case FileKind.MeshModels =>
        val (bytes, name) = meshModels.next()
        (bytes, s"models/$name")
    Files.write(folder.resolve(name), bytes)

  /** One in eight compressed, and one in eight a broken archive. */
  private def perhapsPacked(bytes: Array[Byte], name: String): (Array[Byte], String) =
    random.nextInt(8) match
      case 0 => (Trials.zipped(bytes), s"$name.gz")
      case 1 => (Mutator(Vector(Trials.zipped(bytes)), random).bytes(), s"$name.gz")
      case _ => (bytes, name)

  /** What is wrong with the answer to a broken file, if it is. */
  def judge(kind: FileKind, file: Path): Option[String] =
    try
      kind match
        case FileKind.Scenes => Option.when(Parser.parse(file).shapes.contains(null))("no shape")
        case FileKind.Builds =>
          val _ =
            SceneBuilder.build(Parser.parse(file), RenderSettings(samples = Some(1), quick = true))
          None
        case FileKind.Mitsuba =>
          val scene = Parser.validated(MitsubaScene.readable(file, Map.empty, keepGoing = false))
          val _ = SceneBuilder.build(scene, RenderSettings(samples = Some(1), quick = true))
          None
        case FileKind.Models | FileKind.MeshModels =>
          val format = SceneFormat.named(file).get
          val scene =
            format.read(file, SceneFolder.of(file, isConfined = true), ReadSettings(), None)
          val _ =
            SceneBuilder.build(
              Parser.validated(scene),
              RenderSettings(samples = Some(1), quick = true)
            )
          Option.unless(scene.sources.forall(_.startsWith(file.getParent)))("a file of elsewhere")
        case FileKind.Meshes =>
          val mesh = PlyFile.read(InputFile.named(file))
          val vertices = mesh.positions.length / 3
          val isSound = mesh.indices.forall(i => i >= 0 && i < vertices) &&
            mesh.positions.forall(java.lang.Float.isFinite)
          Option.when(!isSound)("an unsound mesh")
        case FileKind.Pictures =>
          val picture = ImageFiles.read(file)
          Option.when(picture.width < 1 || picture.height < 1)("an empty picture")
        case FileKind.Volumes =>
          val all =
            Vector("density", "heat").flatMap(NanoVdbFile.read(InputFile.named(file), _).toOption)
          Option.when(all.exists(_.tree.maximum.isNaN))("an unsound volume")
    catch
      case e: SceneError => unclear(e)
      case e: Refusal => unclear(SceneError(e.problem))
      case e: NanoVdbError => Option.when(e.getMessage.isBlank)("an error without a message")
      case e: ImageError => Option.when(e.getMessage.isBlank)("an error without a message")
      case e: Throwable =>
        Some((e.toString.take(300) +: e.getStackTrace.take(12).toVector).mkString("\n    at "))

  /** An error says what is wrong, on one line, and where, unless it is about the whole file. */
  private def unclear(e: SceneError): Option[String] =
    val errors = e.problems.filter(_.severity == Severity.Error)
    val bad = errors.find(p => p.message.isBlank || p.message.exists(c => c == '\n' || c == '\r'))
    // Line 0: of the whole file, or a place that its name tells
    val lost =
      errors.find(p => p.pos.exists(a => a.file.isEmpty || a.line > 0 && a.column < 1))
    if errors.isEmpty then Some("an error without errors")
    else bad.orElse(lost).map(p => s"an unclear message: $p")

object Trials:

  /** Files that other files can include. */
  private def prepare(folder: Path): Unit =
    def write(name: String, text: String) = Files.writeString(folder.resolve(name), text): Unit
    write("a.pbrt", "Include \"b.pbrt\"")
    write("b.pbrt", "Shape \"sphere\" Include \"a.pbrt\"")
    for i <- 0 to 220 do write(s"deep-$i.pbrt", s"Include \"deep-${i + 1}.pbrt\"")
    write("noise.pbrt", "\u0000\u0001\"[[[ ]]] \\ nan -- 1e 1e999999999999")
    val _ = Files.createDirectories(folder.resolve("folder.pbrt"))
    Files.write(folder.resolve("bomb.pbrt"), zipped(" " * 1000000, 72)): Unit
    val head = "ply\nformat ascii 1.0\nelement vertex 20000000\nproperty float x\n" +
      "property float y\nproperty float z\nelement face 1\n" +
      "property list uchar int vertex_indices\nend_header\n"
    Files.write(folder.resolve("bomb.ply.gz"), zipped(head + "0 " * 1000, 1)): Unit

  private def zipped(text: String, times: Int): Array[Byte] =
    zipped(text.getBytes("ISO-8859-1"), times)

  private def zipped(piece: Array[Byte], times: Int = 1): Array[Byte] =
    val bytes = ByteArrayOutputStream()
    val zip = new GZIPOutputStream(bytes):
      `def`.setLevel(java.util.zip.Deflater.BEST_SPEED)
    for _ <- 0 until times do zip.write(piece)
    zip.close()
    bytes.toByteArray

  /** A tetrahedron in all formats. */
  private def meshes: Vector[Array[Byte]] =
    def head(format: String) = s"ply\nformat $format 1.0\nelement vertex 4\nproperty float x\n" +
      "property float y\nproperty float z\nproperty double u\nproperty uchar v\n" +
      "element face 4\nproperty list uchar int vertex_indices\nproperty short group\nend_header\n"
    val corners = Vector(Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1))
    val faces = Vector(Vector(0, 1, 2), Vector(0, 1, 3), Vector(0, 2, 3), Vector(1, 2, 3))
    val text = corners.map(_.mkString("", " ", " 0.5 1\n")).mkString +
      faces.map(_.mkString("3 ", " ", " 7\n")).mkString
    def binary(name: String, order: ByteOrder) =
      val body = ByteBuffer.allocate(144).order(order)
      for c <- corners do
        c.foreach(x => body.putFloat(x.toFloat))
        body.putDouble(0.5).put(1.toByte)
      for f <- faces do
        body.put(3.toByte)
        f.foreach(body.putInt)
        body.putShort(7)
      head(name).getBytes("ISO-8859-1") ++ body.array
    Vector(
      (head("ascii") + text).getBytes("ISO-8859-1"),
      binary("binary_little_endian", ByteOrder.LITTLE_ENDIAN),
      binary("binary_big_endian", ByteOrder.BIG_ENDIAN)
    )

  /** Hostile scenes of Mitsuba's: entities that grow, references and includes in circles; last, one
    * of the two broken meshes and of the broken volume.
    */
  private def documents: Vector[Array[Byte]] =
    def scene(body: String) =
      s"""<scene version="3.0.0"><sensor type="perspective"/>$body</scene>"""
    val entities = (1 to 9).map(i => s"<!ENTITY e$i '${s"&e${i - 1};" * 10}'>").mkString
    Vector(
      s"<!DOCTYPE scene [<!ENTITY e0 'x'>$entities]>" +
        scene("<shape type='&e9;'/>"),
      "<!DOCTYPE scene [<!ENTITY f SYSTEM 'file:///etc/hostname'>]>" + scene("&f;"),
      scene("<include filename='self.xml'/>"),
      scene("<bsdf type='twosided' id='a'><ref id='b'/></bsdf>" +
        "<bsdf type='mask' id='b'><ref id='a'/></bsdf>" +
        "<shape type='sphere'><ref id='a'/></shape>"),
      scene("<texture type='checkerboard' id='t'><ref name='color0' id='t'/></texture>" +
        "<bsdf type='diffuse'><ref name='reflectance' id='t'/></bsdf>"),
      scene("<shape type='shapegroup' id='g'><shape type='merge'><ref id='g'/></shape>" +
        "</shape><shape type='instance'><ref id='g'/></shape>"),
      scene("<shape type='merge'>" * 3000),
      scene("<shape type='obj'><string name='filename' value='../broken.obj'/></shape>" +
        "<shape type='serialized'><string name='filename' value='../broken.serialized'/>" +
        "</shape><shape type='cube'><medium type='heterogeneous' name='interior'>" +
        "<volume type='gridvolume' name='sigma_t'>" +
        "<string name='filename' value='../broken.vol'/></volume></medium></shape>" +
        "<shape type='ply'><string name='filename' value='../quilt.ply'/><bsdf type='diffuse'>" +
        "<texture type='mesh_attribute' name='reflectance'>" +
        "<string name='name' value='vertex_color'/></texture></bsdf></shape>" +
        Seq("linearcurve", "bsplinecurve").map(kind =>
          s"<shape type='$kind'><string name='filename' value='../broken.txt'/></shape>"
        ).mkString)
    ).map(_.getBytes("UTF-8"))

  /** A mesh with numbers of vertices and faces. */
  private def quilt: Array[Byte] =
    ("ply\nformat ascii 1.0\nelement vertex 4\n" +
      "x y z r g b".split(" ").map(k => s"property float $k\n").mkString +
      "element face 2\nproperty float dirt_0\nproperty list uchar int vertex_indices\n" +
      "property uchar age_0\nend_header\n0 0 0 .1 .2 .3\n1 0 0 .4 .5 .6\n1 1 0 .7 .8 .9\n" +
      "0 1 0 1 0 1\n.5 4 0 1 2 3 7\n.6 3 0 1 2 8\n").getBytes("US-ASCII")

  /** Two of Mitsuba's curves. */
  private def curves: Array[Byte] =
    "0 0 0 .1\n0 1 0 .1\n1 1 0 .2\n1 2 0 .1\n1 2 1 0\n\n0 0 1 .1\n0 1 1 .1\n1 1 1 .2\n1 2 1 .1\n"
      .getBytes("US-ASCII")

  /** Mitsuba's volumes of 2 × 3 × 4 cells, of one channel and of three. */
  private def grids: Vector[Array[Byte]] =
    for channels <- Vector(1, 3) yield
      val bytes = ByteBuffer.allocate(48 + 4 * 24 * channels).order(ByteOrder.LITTLE_ENDIAN)
      bytes.put("VOL".getBytes("ISO-8859-1")).put(3.toByte).putInt(1)
      Vector(2, 3, 4, channels).foreach(bytes.putInt(_))
      Vector(0f, 0f, 0f, 1f, 1f, 1f).foreach(bytes.putFloat(_))
      for i <- 0 until 24 * channels do bytes.putFloat(i / 10f)
      bytes.array

  /** Two grids, as they are and compressed. */
  private def volumes: Vector[Array[Byte]] =
    val grids = Vector(
      VdbGrid("density", Map((0, 0, 0) -> 1f, (3, 9, 140) -> 2f)),
      VdbGrid("heat", Map((1, 1, 1) -> 900f))
    )
    Vector(NanoVdb.file(grids), NanoVdb.file(grids, zipped = true))

  /** Small pictures in all formats that can be read and in some codings. */
  private[fuzz] def pictures(folder: Path): Vector[Array[Byte]] =
    val random = Random(1)
    val image = Image(24, 16, Image.RgbNames, Array.fill(24 * 16 * 3)(random.nextFloat()))
    val written =
      for format <- OutputFormat.all.filter(_.isReadable) yield
        val path = folder.resolve(s"good.${format.suffix}")
        ImageFiles.write(path, image)
        Files.readAllBytes(path)
    def tga(kind: Int, body: Array[Byte]) =
      Array[Byte](0, 0, kind.toByte, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 8, 0, 24, 0) ++ body
    val pixels = Array.tabulate[Byte](8 * 8 * 3)(i => (i * 7).toByte)
    val runs = Array.fill(8)(Array[Byte](-121, 1, 2, 3)).flatten
    val hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 8\n".getBytes("ISO-8859-1") ++
      Array.fill(8)(Array[Byte](2, 2, 0, 8, -120, 9, -120, 8, -120, 7, -120, -128)).flatten
    val ppm = "P6 8 8 255\n".getBytes("ISO-8859-1") ++ pixels
    val wide = "P5 8 12 65535\n".getBytes("ISO-8859-1") ++ pixels
    val others = Vector("jpeg", "bmp", "gif").map(encoded(_, BufferedImage.TYPE_INT_RGB)) :+
      encoded("png", BufferedImage.TYPE_USHORT_GRAY)
    written ++ openExr ++ Vector(tga(2, pixels), tga(10, runs), hdr, ppm, wide) ++ others ++
      Vector(photoshop(8, pixels), photoshop(16, pixels ++ pixels))

  /** Codings of OpenEXR that other libraries write. */
  private def openExr: Vector[Array[Byte]] =
    val names = "tiled tiled-window multipart luminance window many integer decreasing half-piz " +
      "half-b44 half-pxr24 half-rle"
    exr(names)

  /** Codings that the OpenEXR library reads, where it is installed. */
  private def foreignExr: Vector[Array[Byte]] =
    exr("luminance-chroma half-dwaa half-dwab half-b44a half-htj2k")

  private def exr(names: String): Vector[Array[Byte]] =
    for name <- names.split(' ').toVector
    yield getClass.getResourceAsStream(s"/exr/$name.exr").readAllBytes()

  /** A PSD of 8 × 8 uncompressed pixels. */
  private def photoshop(depth: Short, pixels: Array[Byte]): Array[Byte] =
    val head = ByteBuffer.allocate(40)
    head.put("8BPS".getBytes).putShort(1).position(12)
    head.putShort(3).putInt(8).putInt(8).putShort(depth).putShort(3)
    head.array ++ pixels

  private def encoded(format: String, kind: Int): Array[Byte] =
    val bytes = ByteArrayOutputStream()
    val picture = BufferedImage(16, 16, kind)
    for i <- 0 until 256 do picture.setRGB(i % 16, i / 16, i * 65793 ^ 0x5500)
    val _ = javax.imageio.ImageIO.write(picture, format, bytes)
    bytes.toByteArray

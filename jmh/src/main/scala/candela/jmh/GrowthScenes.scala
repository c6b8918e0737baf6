package candela.jmh

import candela.io.WholeFile
import candela.bench.suite.{SuiteFile, SuiteScene}

import java.awt.image.BufferedImage
import java.io.{BufferedWriter, IOException, PrintWriter}
import java.nio.channels.Channels
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.util.{Locale, SplittableRandom}
import javax.imageio.ImageIO

/** Writes the scenes of `bench/suites/growth.conf`, where the suite looks for them: in the folder
  * that `CANDELA_GROWTH` names.
  *
  * Options: `--only WORD` writes the scenes whose name begins with the word, `--most N` those of at
  * most that size; files that are there are kept. All of them together take some 6 GB.
  */
object GrowthScenes:
  def main(words: Array[String]): Unit =
    val options = words.grouped(2).collect { case Array(k, v) => k -> v }.toMap
    val most = options.get("--most").map(_.toDoubleOption).getOrElse(Some(Double.PositiveInfinity))
    val isKnown = words.length % 2 == 0 && options.keySet.subsetOf(Set("--only", "--most"))
    most.filter(_ => isKnown) match
      case None =>
        fail(s"expected `--only WORD` and `--most N`, found ${words.mkString("`", " ", "`")}")
      case _ if !sys.env.contains("CANDELA_GROWTH") =>
        fail("CANDELA_GROWTH must name the folder of the scenes")
      case Some(most) => writeAll(options.getOrElse("--only", ""), most)

  private def fail(why: String): Unit =
    System.err.println(s"error: $why")
    sys.exit(1)

  private def writeAll(only: String, most: Double): Unit =
    for
      scene <- SuiteFile.read(Path.of("bench/suites/growth.conf")).scenes
      growth <- scene.growth
      if growth.size <= most && scene.name.startsWith(only)
      file <- scene.files.get("v4") if !Files.exists(file)
    do
      Files.createDirectories(file.getParent): Unit
      write(scene, growth.size.toInt, file)
      println(s"wrote $file")

  private def write(scene: SuiteScene, size: Int, file: Path): Unit =
    WholeFile.write(file): channel =>
      val out = PrintWriter(BufferedWriter(Channels.newWriter(channel, UTF_8), 1 << 16))
      val growing = GrowingScene(out, file.getParent)
      scene.name.takeWhile(_ != '-') match
        case "triangles" => growing.triangles(size)
        case "instances" => growing.instances(size)
        case "objects" => growing.objects(size)
        case "lamps" => growing.lamps(size)
        case "spheres" => growing.spheres(size)
        case "curves" => growing.curves(size)
        case "materials" => growing.materials(size)
        case "textures" => growing.textures(size)
        case "texels" => growing.texels(size)
        case "includes" => growing.includes(size)
        case "depth" => growing.depth(size)
        case "blocks" => growing.blocks(size)
        case "film" => growing.film(size)
        case "media" => growing.media(size)
        case "screens" => growing.screens(size)
        case "checkers" => growing.checkers(size)
        case "movers" => growing.movers(size)
        case "shifted" => growing.shifted(size)
        case "sky" => growing.sky(size)
        case "singles" => growing.singles(size)
      // All is written with this question
      if out.checkError() then throw IOException("its device takes no more")

/** One scene, for pbrt-v4.
  *
  * @param folder of the scene, and of the files that it names
  */
private final class GrowingScene(out: PrintWriter, folder: Path):
  private val random = SplittableRandom(1)
  private val daylight = "LightSource \"infinite\" \"rgb L\" [.6 .7 .9]"
  private val grey = "Material \"diffuse\""

  private def between(low: Double, high: Double): Double = random.nextDouble(low, high)
  private def words(numbers: Double*): String = numbers.map(number).mkString(" ")
  private def number(x: Double): String = "%.4f".formatLocal(Locale.ROOT, x)

  private def head(integrator: String = "path", width: Int = 128, height: Int = 96): Unit =
    out.println(s"Film \"rgb\" \"integer xresolution\" $width \"integer yresolution\" $height")
    out.println("Sampler \"zsobol\" \"integer pixelsamples\" 1")
    out.println(s"Integrator \"$integrator\" \"integer maxdepth\" 3")
    out.println("LookAt 0 -5 3  0 0 0  0 0 1")
    out.println("Camera \"perspective\" \"float fov\" 40")
    out.println("WorldBegin")

  private def place(low: Double = -1, high: Double = 1): String =
    words(between(-3, 3), between(-3, 3), between(low, high))

  private def block(inside: String*): Unit =
    out.println(inside.mkString("AttributeBegin\n", "\n", "\nAttributeEnd"))

  private def sphere(radius: Double): String = s"Shape \"sphere\" \"float radius\" $radius"

  /** @return a shape statement of a mesh that is written beside the scene */
  private def mesh(triangles: Int): String =
    val file = folder.resolve(s"torus-$triangles.ply")
    if !Files.exists(file) then Torus(triangles).write(file)
    s"Shape \"plymesh\" \"string filename\" \"${file.getFileName}\""

  def triangles(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey, mesh(count)) do out.println(line)

  def instances(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey, "ObjectBegin \"o\"", mesh(50_000), "ObjectEnd") do out.println(line)
    for _ <- 0 until count do
      block(
        s"Translate ${place()}",
        s"Rotate ${number(between(0, 360))} 0 0 1",
        "Scale .02 .02 .02",
        "ObjectInstance \"o\""
      )

  def objects(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey) do out.println(line)
    val shape = mesh(100)
    for i <- 0 until count do
      out.println(s"ObjectBegin \"o$i\"\n$shape\nObjectEnd")
      for _ <- 0 until 2 do
        block(s"Translate ${place()}", "Scale .04 .04 .04", s"ObjectInstance \"o$i\"")

  def lamps(count: Int): Unit =
    head()
    out.println(s"$grey\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]")
    out.println("  \"point3 P\" [-3 -3 0 3 -3 0 3 3 0 -3 3 0]")
    for _ <- 0 until count do
      block(
        "AreaLightSource \"diffuse\" \"rgb L\" [9 8 7]",
        s"Translate ${place(.1, 1.5)}",
        sphere(.004)
      )

  def spheres(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey) do out.println(line)
    for _ <- 0 until count do block(s"Translate ${place()}", sphere(.01))

  def curves(count: Int): Unit =
    head()
    for line <- Seq(daylight, "Material \"hair\" \"float eumelanin\" 1.3") do out.println(line)
    for _ <- 0 until count do
      val (x, y, lean) = (between(-2, 2), between(-2, 2), between(0, 2 * Math.PI))
      val points =
        for k <- 0 until 4
        yield words(x + .05 * k * Math.cos(lean), y + .05 * k * Math.sin(lean), k / 12.0)
      out.println(points.mkString("Shape \"curve\" \"point3 P\" [", "  ", "]"))
      out.println("  \"float width0\" .004 \"float width1\" .001")

  def materials(count: Int): Unit =
    head()
    out.println(daylight)
    for _ <- 0 until count do
      val color = words(between(0, 1), between(0, 1), between(0, 1))
      block(
        s"Material \"coateddiffuse\" \"rgb reflectance\" [$color]",
        s"Translate ${place()}",
        sphere(.03)
      )

  def textures(count: Int): Unit =
    head()
    out.println(daylight)
    val across = Math.ceil(Math.sqrt(count)).toInt
    def spot(i: Int) = 4 * (i + .5) / across - 2
    for i <- 0 until count do
      val name = s"texture-$i.png"
      picture(name, 2048, BufferedImage.TYPE_3BYTE_BGR, i)
      textured(name, s"Translate ${words(spot(i % across), spot(i / across), 0)}", 1.8 / across)

  def texels(count: Int): Unit =
    head()
    out.println(daylight)
    val side = Math.sqrt(count).round.toInt
    val name = s"grey-$side.png"
    picture(name, side, BufferedImage.TYPE_BYTE_GRAY, 1)
    textured(name, "", 2)

  private def textured(picture: String, place: String, half: Double): Unit =
    out.println(
      s"Texture \"$picture\" \"spectrum\" \"imagemap\" \"string filename\" \"$picture\""
    )
    val h = number(half)
    block(
      s"Material \"diffuse\" \"texture reflectance\" \"$picture\"",
      place,
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [0 0 1 0 1 1 0 1]",
      s"  \"point3 P\" [-$h -$h 0 $h -$h 0 $h $h 0 -$h $h 0]"
    )

  /** Waves of all bytes, so that pictures compress as photographs do, not as plain areas. */
  private def picture(name: String, side: Int, kind: Int, seed: Int): Unit =
    val file = folder.resolve(name)
    if !Files.exists(file) then
      val image = BufferedImage(side, side, kind)
      val raster = image.getRaster
      val bands = raster.getNumBands
      val noise = SplittableRandom(seed)
      val row = new Array[Int](bands * side)
      val across = Array.tabulate(side + 90 * bands)(x => Math.sin(.011 * x * (seed % 7 + 1)))
      for y <- 0 until side do
        val down = Math.cos(.013 * y * (seed % 5 + 1))
        for x <- 0 until side; b <- 0 until bands do
          row(bands * x + b) = (118 + 110 * across(x + 90 * b) * down + noise.nextInt(16)).toInt
        raster.setPixels(0, y, side, 1, row)
      WholeFile.write(file): channel =>
        ImageIO.write(image, "png", Channels.newOutputStream(channel)): Unit

  def includes(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey) do out.println(line)
    val within = folder.resolve("includes")
    Files.createDirectories(within): Unit
    for i <- 0 until count do
      val text = s"AttributeBegin Translate ${place()} ${sphere(.03)} AttributeEnd\n"
      Files.writeString(within.resolve(s"$i.pbrt"), text): Unit
      out.println(s"Include \"includes/$i.pbrt\"")

  def depth(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey) do out.println(line)
    val within = folder.resolve(s"depth-$count")
    Files.createDirectories(within): Unit
    for i <- 0 until count do
      val next = if i + 1 < count then s"Include \"depth-$count/${i + 1}.pbrt\"\n" else ""
      val text = s"AttributeBegin Translate ${place()} ${sphere(.1)} AttributeEnd\n$next"
      Files.writeString(within.resolve(s"$i.pbrt"), text): Unit
    out.println(s"Include \"depth-$count/0.pbrt\"")

  def blocks(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey) do out.println(line)
    for _ <- 0 until count do
      out.println(s"AttributeBegin Translate ${words(between(-.01, .01), between(-.01, .01), 0)}")
      out.println(sphere(.03))
    for _ <- 0 until count do out.println("AttributeEnd")

  def media(count: Int): Unit =
    head("volpath")
    out.println(daylight)
    for i <- 0 until count do
      out.println(s"MakeNamedMedium \"m$i\" \"string type\" \"homogeneous\"")
      out.println(s"  \"rgb sigma_s\" [${number(between(0, 9))} 3 2] \"rgb sigma_a\" [.1 .2 .1]")
      block(
        s"MediumInterface \"m$i\" \"\"",
        "Material \"interface\"",
        s"Translate ${place()}",
        sphere(.06)
      )

  /** Area lights of one image. */
  def screens(count: Int): Unit =
    head()
    picture("screen.png", 1024, BufferedImage.TYPE_3BYTE_BGR, 1)
    for line <- Seq(daylight, grey) do out.println(line)
    for _ <- 0 until count do
      block(
        "AreaLightSource \"diffuse\" \"string filename\" \"screen.png\" \"float scale\" 5",
        s"Translate ${place(.1, 1.5)}",
        "Shape \"bilinearmesh\" \"point3 P\" [-.05 -.05 0 .05 -.05 0 -.05 .05 0 .05 .05 0]"
      )

  def checkers(count: Int): Unit =
    head()
    out.println(daylight)
    for i <- 0 until count do
      out.println(s"Texture \"t$i\" \"spectrum\" \"checkerboard\" \"float vscale\" 4")
      out.println(s"  \"float uscale\" ${number(between(0, 9))} \"rgb tex2\" [.8 .7 .6]")
      out.println(s"  \"rgb tex1\" [${number(between(0, 1))} .2 .3]")
      block(
        s"Material \"diffuse\" \"texture reflectance\" \"t$i\"",
        s"Translate ${place()}",
        sphere(.03)
      )

  private def moving(turn: String, shape: String): Unit =
    block(
      s"Translate ${place()}",
      s"ActiveTransform EndTime\nTranslate .1 0 .1\n${turn}ActiveTransform All",
      shape
    )

  def movers(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey) do out.println(line)
    for _ <- 0 until count do moving("Rotate 30 0 0 1\n", sphere(.05))

  def shifted(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey, "ObjectBegin \"o\"", square, "ObjectEnd") do out.println(line)
    for _ <- 0 until count do moving("", "ObjectInstance \"o\"")

  def sky(texels: Int): Unit =
    head()
    val side = Math.sqrt(texels).round.toInt
    picture(s"sky-$side.png", side, BufferedImage.TYPE_3BYTE_BGR, 1)
    out.println(s"LightSource \"infinite\" \"string filename\" \"sky-$side.png\"")
    out.println(s"$grey\n${sphere(1)}")

  /** Objects of an instance each. */
  def singles(count: Int): Unit =
    head()
    for line <- Seq(daylight, grey) do out.println(line)
    for i <- 0 until count do
      out.println(s"ObjectBegin \"o$i\"\n$square\nObjectEnd")
      block(s"Translate ${place()}", s"ObjectInstance \"o$i\"")

  private val square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " +
    "\"point3 P\" [-.05 -.05 0 .05 -.05 0 .05 .05 0 -.05 .05 0]"

  def film(pixels: Int): Unit =
    val height = Math.sqrt(pixels * 9.0 / 16).round.toInt
    head(width = pixels / height, height = height)
    for line <- Seq(daylight, grey, mesh(100_000)) do out.println(line)

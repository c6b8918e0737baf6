package candela.image

import candela.color.Rgb

import java.nio.file.{Files, Path}

import scala.util.Random

import org.scalatest.funsuite.AnyFunSuite

class OidnSuite extends AnyFunSuite:

  private def image(width: Int, height: Int)(color: (Int, Int) => Rgb): Image =
    val made = Image.rgb(width, height)
    for y <- 0 until height; x <- 0 until width do
      val c = color(x, y)
      made.data(3 * (y * width + x)) = c.r
      made.data(3 * (y * width + x) + 1) = c.g
      made.data(3 * (y * width + x) + 2) = c.b
    made

  /** Skips with the reason where the library is not installed. */
  private def library: Oidn =
    try Oidn.load()
    catch
      case e: ImageError =>
        println(s"OidnSuite: skipped: ${e.getMessage}")
        cancel(e.getMessage)

  // Squares of four colours, brighter than 1
  private val squares = image(96, 80): (x, y) =>
    if (x / 24 + y / 20) % 2 == 0 then Rgb(4f, 0.5f, 0.1f) else Rgb(0.1f, 0.3f, 1.5f)
  private val albedo = image(96, 80): (x, y) =>
    if (x / 24 + y / 20) % 2 == 0 then Rgb(0.8f, 0.1f, 0.02f) else Rgb(0.02f, 0.06f, 0.3f)
  private val normal = image(96, 80)((_, _) => Rgb(0f, 0f, 1f))

  private def noisy(of: Image, seed: Int): Image =
    val random = Random(seed)
    Image(of.width, of.height, of.channelNames, of.data.map(v => v * 2 * random.nextFloat()))

  private def error(a: Image): Double =
    a.data.indices.map(i => Math.pow(a.data(i) - squares.data(i), 2)).sum / a.data.length

  test("noise falls, in light brighter than 1, too; guides help"):
    val oidn = library
    val input = noisy(squares, 1)
    val alone = oidn.denoise(input, None, None, threads = 1)
    val guided = oidn.denoise(input, Some(albedo), Some(normal), threads = 1)
    assert(error(alone) < error(input) / 5, s"${error(input)} ${error(alone)}")
    assert(error(guided) < error(alone) / 2, s"${error(alone)} ${error(guided)}")
    assert(input.data.sameElements(noisy(squares, 1).data))

  test("noisy guides are denoised first"):
    val oidn = library
    val input = noisy(squares, 1)
    val guided = oidn.denoise(input, Some(noisy(albedo, 2)), Some(normal), threads = 1)
    assert(error(guided) < error(input) / 5)

  test("the result does not depend on the number of threads"):
    val oidn = library
    val results = Vector(1, 2).map(oidn.denoise(noisy(squares, 1), Some(albedo), None, _).data)
    assert(results(0).sameElements(results(1)))

  test("the version is 2 or later"):
    assert(library.version.takeWhile(_ != '.').toInt >= 2)

  test("the library is looked up where packages and Python's wheels put it"):
    Samples.inFolder: root =>
      def install(place: String) =
        val file = root.resolve(place).resolve("libOpenImageDenoise.so.2")
        Files.createDirectories(file.getParent)
        Files.createFile(file)
      val system = install("usr/lib/x86_64-linux-gnu")
      val wheel = install("home/.local/lib/python3.11/site-packages/pyoidn/oidn/lib")
      val virtual = install("venv/lib/python3.12/site-packages/pyoidn/oidn/lib")
      val elsewhere = install("elsewhere/lib")
      def found(environment: (String, Path)*) =
        OidnLibrary.candidates(environment.map((k, v) => k -> v.toString).toMap, root)
      assert(found() == Vector(system))
      val home = "HOME" -> root.resolve("home")
      assert(found(home) == Vector(wheel, system))
      assert(found(home, "VIRTUAL_ENV" -> root.resolve("venv")) == Vector(virtual, wheel, system))
      assert(found(home, "CANDELA_OIDN" -> root.resolve("elsewhere")) == Vector(elsewhere))
      assert(found("CANDELA_OIDN" -> elsewhere) == Vector(elsewhere))
      assert(found("CANDELA_OIDN" -> root.resolve("none")).isEmpty)

  test("without the library, the message says how to get it"):
    Samples.inFolder: folder =>
      val message =
        intercept[ImageError](Oidn.load(Map("CANDELA_OIDN" -> folder.toString))).getMessage
      assert(message.startsWith(s"CANDELA_OIDN=$folder: no library of Open Image Denoise 2"))
      assert(message.contains("pip install pyoidn"))
      Files.writeString(folder.resolve("libOpenImageDenoise.so.2"), "no library")
      intercept[ImageError](Oidn.load(Map("CANDELA_OIDN" -> folder.toString)))

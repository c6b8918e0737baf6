package candela.build.materials

import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.measured.{FourierBsdf, FourierTable, FourierTables}
import candela.color.Rgb
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{Draws, SceneTexts}

class BsdfFileSuite extends AnyFunSuite:
  private val tables = FourierTables(FourierTables.cosines(8), 3, 3, 1.25f)(
    FourierTables.cushion(Rgb(0.9f, 0.5f, 0.2f))
  )
  private val bytes = tables.bytes

  private def broken(at: Int, value: Int): Either[String, Any] =
    val changed = bytes.clone
    ByteBuffer.wrap(changed).order(LITTLE_ENDIAN).putInt(at, value)
    BsdfFile.parse(changed)

  test("what was written is read"):
    val read = BsdfFile.parse(bytes)
    val (found, right) = (FourierBsdf(read.toOption.get), FourierBsdf(tables.table))
    val draws = Draws(11)
    for _ <- 0 until 100 do
      val (wo, wi) = (draws.direction(), draws.direction())
      assert(found.f(wo, wi) == right.f(wo, wi))

  test("a horizon that is there twice is read, and every direction scatters a finite amount"):
    val cosines = tables.table.cosines
    val doubled = broken(64 + 4 * 4, java.lang.Float.floatToRawIntBits(cosines(3)))
    val bsdf = FourierBsdf(doubled.toOption.get.asInstanceOf[FourierTable])
    val draws = Draws(12)
    for _ <- 0 until 1000 do
      val (wo, wi) = (draws.direction(), draws.direction())
      assert(bsdf.f(wo, wi).isFinite)
      val bounce = bsdf.sample(wo, draws.unit(), draws.unit(), draws.unit())
      assert(bounce.weight.isFinite && bounce.pdf >= 0f)

  test("what is no such file is refused with a reason"):
    def reason(e: Either[String, Any]) = e.swap.getOrElse("read!")
    assert(reason(broken(0, 7)).contains("SCATFUN"))
    assert(reason(BsdfFile.parse(Array(83, 67))).contains("SCATFUN"))
    assert(reason(broken(8, 3)).contains("flags must be 1 (a plain BSDF), found 3"))
    assert(reason(broken(12, -5)).contains("-5 cosines"))
    assert(reason(broken(12, 5000)).contains("5000 cosines"))
    assert(reason(broken(12, 4000)).contains("size must be at least"))
    assert(reason(broken(16, -1)).contains("-1 coefficients"))
    assert(reason(broken(24, 2)).contains("channels must be 1 or 3, found 2"))
    assert(reason(broken(28, 4)).contains("bases must be 1, found 4"))
    assert(reason(broken(44, 0)).contains("index of refraction must be above 0, found 0.0"))
    assert(reason(broken(64, 0)).contains("cosines must increase"))
    assert(reason(broken(68, 0x7fc00000)).contains("cosines must increase"))
    assert(reason(BsdfFile.parse(bytes.take(2000))).contains("size must be at least"))
    val firstPair = 64 + 4 * (8 + 64)
    assert(reason(broken(firstPair, -1)).contains("past the"))
    assert(reason(broken(firstPair + 4, Int.MaxValue)).contains("past the"))
    assert(reason(broken(bytes.length - 4, 0x7f800000)).contains("NaN or infinite"))

  test("a scene's file that is broken is an error at its name, and one that is right is not"):
    val folder = Files.createTempDirectory("bsdf")
    val file = folder.resolve("a.bsdf")
    val scene = "WorldBegin\nLightSource \"point\"\n" +
      "Material \"fourier\" \"string bsdffile\" \"a.bsdf\" Shape \"sphere\"\n"
    def found = SceneTexts.problems(scene, folder = folder).map(_.message)
    assert(found == Vector("no file `a.bsdf`"))
    val _ = Files.write(file, bytes.take(100))
    assert(found.size == 1 && found.head.contains("found 100"), found)
    val _ = Files.write(file, bytes)
    assert(found.isEmpty)
    val options = RenderSettings(color = ColorMode.Spectral)
    val spectral = SceneTexts.problems(scene, folder = folder, options = options)
    assert(spectral.map(_.message).exists(_.contains("red, green and blue only")), spectral)
    Files.delete(file)
    Files.delete(folder)

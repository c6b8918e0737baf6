package candela.build.materials

import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.measured.{FourierBsdf, FourierTables}
import candela.color.Rgb
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

  test("what is no such file is refused with a reason"):
    def reason(e: Either[String, Any]) = e.swap.getOrElse("read!")
    assert(reason(broken(0, 7)).contains("SCATFUN"))
    assert(reason(BsdfFile.parse(Array(83, 67))).contains("SCATFUN"))
    assert(reason(broken(8, 3)).contains("flags 3"))
    assert(reason(broken(12, -5)).contains("-5 cosines"))
    assert(reason(broken(12, 5000)).contains("5000 cosines"))
    assert(reason(broken(12, 4000)).contains("bytes, not the"))
    assert(reason(broken(16, -1)).contains("-1 coefficients"))
    assert(reason(broken(24, 2)).contains("2 channels"))
    assert(reason(broken(28, 4)).contains("4 bases"))
    assert(reason(broken(44, 0)).contains("index is 0.0"))
    assert(reason(broken(64, 0)).contains("do not rise"))
    assert(reason(broken(68, 0x7fc00000)).contains("do not rise"))
    assert(reason(BsdfFile.parse(bytes.take(2000))).contains("bytes, not the"))
    val firstPair = 64 + 4 * (8 + 64)
    assert(reason(broken(firstPair, -1)).contains("beyond"))
    assert(reason(broken(firstPair + 4, Int.MaxValue)).contains("beyond"))
    assert(reason(broken(bytes.length - 4, 0x7f800000)).contains("no numbers"))

  test("a scene's file that is broken is an error at its name, and one that is right is not"):
    val folder = Files.createTempDirectory("bsdf")
    val file = folder.resolve("a.bsdf")
    val scene = "WorldBegin\nLightSource \"point\"\n" +
      "Material \"fourier\" \"string bsdffile\" \"a.bsdf\" Shape \"sphere\"\n"
    def found = SceneTexts.problems(scene, folder = folder).map(_.message)
    assert(found == Vector("no file `a.bsdf`"))
    val _ = Files.write(file, bytes.take(100))
    assert(found.size == 1 && found.head.contains("`a.bsdf`: it has 100 bytes"), found)
    val _ = Files.write(file, bytes)
    assert(found.isEmpty)
    Files.delete(file)
    Files.delete(folder)

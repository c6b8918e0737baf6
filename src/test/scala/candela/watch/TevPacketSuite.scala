package candela.watch

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Try

class TevPacketSuite extends AnyFunSuite:

  private val update =
    TevPacket.update("a b", "Albedo.G", 3, 4, width = 2, Array(1f, -2.5f, 3e-9f, 4f))
  private val create = TevPacket.create("ä", 640, 480, Vector("R", "N.X"))

  private def hex(bytes: Array[Byte]) = bytes.map("%02x".format(_)).mkString

  test("packets are as the description says"):
    assert(hex(TevPacket.create("a", 2, 1, Vector("Y"))) ==
      "16000000" + "04" + "01" + "6100" + "02000000" + "01000000" + "01000000" + "5900")
    val one = TevPacket.update("a", "Y", 1, 0, 1, Array(1f))
    assert(hex(one) == "32000000" + "06" + "00" + "6100" + "01000000" + "5900" +
      "01000000" + "00000000" + "01000000" + "01000000" +
      "0000000000000000" + "0100000000000000" + "0000803f")

  test("the Python package `tevclient` makes the same packets"):
    val script =
      """import sys, numpy as np, tevclient.packet as p
        |tile = np.array([[1, -2.5], [3e-9, 4]], dtype=np.float32)
        |print(p.create_image("ä", 640, 480, ["R", "N.X"]).hex())
        |print(p.update_image("a b", tile, ["Albedo.G"], 3, 4).hex())
        |""".stripMargin
    def python(code: String): Option[String] = Try:
      val process = ProcessBuilder("python3", "-X", "utf8", "-c", code).start()
      val out = String(process.getInputStream.readAllBytes(), "UTF-8")
      Option.when(process.waitFor() == 0)(out)
    .toOption.flatten
    if python("import tevclient.packet").isEmpty then
      cancel("python3 has no package tevclient (pip install tevclient)")
    assert(python(script).get.linesIterator.toVector == Vector(hex(create), hex(update)))

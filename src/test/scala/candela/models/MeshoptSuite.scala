package candela.models

import candela.io.Sha256

import java.nio.ByteBuffer
import java.util.{Base64, SplittableRandom}

import scala.io.Source
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

class MeshoptSuite extends AnyFunSuite, GltfModels:
  private final case class Stream(
      name: String,
      mode: String,
      filter: String,
      count: Int,
      stride: Int,
      data: Array[Byte],
      expected: String
  ):
    def decoded(from: Array[Byte] = data): Array[Byte] =
      Meshopt.decode(from, count, stride, mode, filter).array

  private val streams: Vector[Stream] =
    Using.resource(Source.fromResource("candela/models/meshopt.txt")): source =>
      source.getLines.filterNot(_.startsWith("#")).map(_.split(' ')).map {
        case Array(name, mode, filter, count, stride, data, expected) =>
          val bytes = Base64.getDecoder.decode(data)
          Stream(name, mode, filter, count.toInt, stride.toInt, bytes, expected)
      }.toVector

  for s <- streams do
    test(s"${s.name}: is what meshoptimizer decodes"):
      val bytes = s.decoded()
      if s.expected.startsWith("sha256:") then
        assert(Sha256.of(ByteBuffer.wrap(bytes)) == s.expected.drop("sha256:".length))
      else
        val expected = Base64.getDecoder.decode(s.expected)
        assert(bytes.length == expected.length)
        // Filters may round otherwise by one unit, but for numbers, which are exact
        if s.filter == "EXPONENTIAL" then assert(bytes.sameElements(expected))
        else if s.stride == 4 then
          for (a, b) <- bytes.zip(expected) do assert(Math.abs(a - b) <= 1 || a + b == -1)
        else
          def shorts(all: Array[Byte]) =
            ByteBuffer.wrap(all).order(java.nio.ByteOrder.LITTLE_ENDIAN)
          val (a, b) = (shorts(bytes), shorts(expected))
          for i <- 0 until bytes.length / 2 do
            val difference = Math.abs(a.getShort(2 * i) - b.getShort(2 * i))
            assert(difference <= 1 || difference == 65535, i)

  test("damaged streams are refused, or decoded to something, and read no further than they are"):
    val random = SplittableRandom(7)
    for s <- streams; _ <- 0 until 200 do
      val data = s.data.clone
      for _ <- 0 to random.nextInt(3) do
        data(random.nextInt(data.length)) = random.nextInt().toByte
      val cut = if random.nextInt(3) == 0 then data.take(random.nextInt(data.length)) else data
      try s.decoded(cut): Unit
      catch case e: DamagedStream => assert(e.getMessage.nonEmpty)

  private def compressed(s: Stream, members: String): String =
    val data = s.data
    model(
      ""","mode":5""",
      Seq(s"""{"bufferView":1,"componentType":5126,"count":${s.count},"type":"VEC3"}"""),
      Seq(s"""{"buffer":1,"byteLength":${s.count * s.stride},"extensions":{
        "EXT_meshopt_compression":{"buffer":0,"byteOffset":48,"byteLength":${data.length},
        "byteStride":${s.stride},"count":${s.count},"mode":"ATTRIBUTES",
        "filter":"EXPONENTIAL"$members}}}"""),
      data,
      others = ""","extensionsRequired":["EXT_meshopt_compression"]"""
    ).replace("\"POSITION\":0", "\"POSITION\":1")
      .replace("}],\"extensionsRequired\"", "},{\"byteLength\":9999}],\"extensionsRequired\"")

  private val vectors = streams.find(_.name == "exp-20").get

  test("compressed buffer views need no buffer of their own"):
    val p = shape(compressed(vectors, "")).shape.param("P").get.floats
    val expected = ByteBuffer.wrap(Base64.getDecoder.decode(vectors.expected))
      .order(java.nio.ByteOrder.LITTLE_ENDIAN)
    assert(p.indices.forall(i => p(i) == expected.getFloat(4 * i)))

  test("what is wrong with compressed views has a place"):
    val at = "/bufferViews/1/extensions/EXT_meshopt_compression: "
    val broken = compressed(vectors.copy(data = vectors.data.updated(0, 0.toByte)), "")
    assert(error(broken).startsWith(at + "the data has no header of attributes"))
    val short = compressed(vectors, "").replace(
      s"\"count\":${vectors.count},\"mode\"",
      "\"count\":7,\"mode\""
    )
    assert(error(short).startsWith(at + "7 elements of 12 bytes are not the"))
    val unknown = compressed(vectors, "").replace("ATTRIBUTES", "VERTICES")
    assert(error(unknown).startsWith(at + "expected the mode ATTRIBUTES"))

  test("meshes of Draco are refused with a cure, unless they are there uncompressed, too"):
    val draco = ""","mode":5,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}}"""
    assert(shape(model(draco)).shape.param("P").isDefined)
    val alone = read(model(draco).replace(Position, Position.replace("\"bufferView\":0,", "")))
    val problem = alone.errors.head
    assert(problem.message.contains("Draco") && problem.help.exists(_.contains("Blender")))

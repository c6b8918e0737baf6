package candela.scenefile

import candela.diagnostics.SceneError

import org.scalatest.funsuite.AnyFunSuite

import scala.collection.mutable
import scala.util.Random

class TokenDigestSuite extends AnyFunSuite:

  /** Kinds and texts, as they are written. */
  private def tokens(text: String): Option[Vector[String]] =
    val in = Tokenizer(Source.fromText("", text), None)
    try
      val all = Vector.newBuilder[String]
      in.advance()
      while in.current != Token.End do
        all += s"${in.current} ${in.text}"
        in.advance()
      Some(all.result())
    catch case _: SceneError => None

  test("texts have one digest if a tokenizer finds the same tokens in them, and another if not"):
    val random = Random(7)
    val pieces = Vector(" ", "\n", "\r\n", "\t", ",", "#", "\"", "[", "]", "a", "1", "a b")
    val digests = mutable.HashMap.empty[Vector[String], String]
    var repeated = 0
    for _ <- 0 until 20000 do
      val text = Seq.fill(random.nextInt(7))(pieces(random.nextInt(pieces.size))).mkString
      for all <- tokens(text) do
        val digest = TokenDigest.of(text)
        if digests.contains(all) then repeated += 1
        assert(digests.getOrElseUpdate(all, digest) == digest, text)
    assert(repeated > 1000 && digests.size > 900)
    assert(digests.values.toSet.size == digests.size)

  test("a comment may have quotes, and a string may have what begins a comment"):
    assert(TokenDigest.of("A # \"\nB") == TokenDigest.of("A B"))
    assert(TokenDigest.of("A \"x # y\" B") != TokenDigest.of("A \"x # z\" B"))
    assert(TokenDigest.of("A \"x \\\" # y\" B") != TokenDigest.of("A \"x \\\" # z\" B"))

  test("the digest of many pieces is that of the whole"):
    val text = "Shape \"sphere\" # a comment\n\"float radius\" [ 1.5 ]\n" * 2000
    val bytes = text.getBytes
    for size <- Vector(1, 7, 8191, 8192, 8193) do
      val digest = TokenDigest()
      for from <- bytes.indices by size do digest.add(bytes, from, size.min(bytes.length - from))
      assert(digest.result() == TokenDigest.of(text))

package candela.scenefile

import candela.io.{ContentDigest, Sha256}

import java.nio.charset.StandardCharsets.UTF_8

/** Digest of the tokens of pbrt files: comments, and what space lies between tokens, have no part
  * in it. A [[Tokenizer]] finds the same tokens.
  */
private[candela] final class TokenDigest extends ContentDigest:
  import TokenDigest.*

  private val sum = Sha256.Bytes()
  private val written = new Array[Byte](BufferSize)
  private var size = 0
  private var state = State.Blank

  def add(bytes: Array[Byte], from: Int, length: Int): Unit =
    var i = from
    while i < from + length do
      if size > BufferSize - 2 then flush()
      state = next(bytes(i))
      i += 1

  def result(): String =
    flush()
    sum.result()

  /** The state after a byte. */
  private def next(c: Byte): State = state match
    case State.Comment => if isBreak(c) then State.Blank else State.Comment
    case State.Escape => continueToken(c, State.Text)
    case State.Text =>
      continueToken(
        c,
        if c == '"' then State.Blank else if c == '\\' then State.Escape else State.Text
      )
    case _ =>
      c match
        case ' ' | '\t' | ',' | '\n' | '\r' => State.Blank
        case '#' => State.Comment
        case '[' | ']' => startToken(c, State.Blank)
        case '"' => startToken(c, State.Text)
        case _ if state == State.Word => continueToken(c, State.Word)
        case _ => startToken(c, State.Word)

  private def startToken(c: Byte, after: State): State =
    write(' ')
    write(c)
    after

  private def continueToken(c: Byte, after: State): State =
    write(c)
    // A string that is not closed ends with its line
    if isBreak(c) then State.Blank else after

  private def write(c: Byte): Unit =
    written(size) = c
    size += 1

  private def isBreak(c: Byte) = c == '\n' || c == '\r'

  private def flush(): Unit =
    sum.add(written, 0, size)
    size = 0

private[candela] object TokenDigest:
  def of(text: String): String =
    val digest = TokenDigest()
    val bytes = text.getBytes(UTF_8)
    digest.add(bytes, 0, bytes.length)
    digest.result()

  private val BufferSize = 1 << 13

  /** What the next byte continues. */
  private enum State:
    case Blank, Comment, Word, Text, Escape

package candela.fuzz

import java.nio.charset.StandardCharsets.ISO_8859_1
import scala.util.Random

/** Breaks files: each answer is one of the corpus with up to four things wrong. */
final class Mutator(corpus: Vector[Array[Byte]], random: Random):

  /** Damage that knows nothing of the format. */
  def bytes(): Array[Byte] = repeated(_ => anywhere)

  /** Damage to text, by words as well. */
  def text(): Array[Byte] = repeated(_ => if random.nextInt(3) == 0 then anywhere else words)

  /** Words changed for words of their kind: what comes out is still read as a scene, mostly. */
  def meaning(): Array[Byte] = repeated(_ => exchanged)

  private def repeated(damage: Int => Array[Byte] => Array[Byte]): Array[Byte] =
    (0 to random.nextInt(4)).foldLeft(one(corpus))((file, i) => damage(i)(file))

  private def one[A](choices: IndexedSeq[A]): A = choices(random.nextInt(choices.size))

  private def anywhere(file: Array[Byte]): Array[Byte] =
    // headers decide most: damage there as often as anywhere else
    val near = if random.nextBoolean() then file.length else file.length.min(300)
    val at = random.nextInt(near + 1)
    val length = random.nextInt(1 + random.nextInt(60)).min(file.length - at)
    random.nextInt(7) match
      case 0 => file.take(at)
      case 1 => file.take(at) ++ file.drop(at + length)
      case 2 => file.take(at + length) ++ file.drop(at)
      case 3 =>
        val other = one(corpus)
        file.take(at) ++ other.drop(random.nextInt(other.length + 1))
      case 4 => file.patch(at, Array.fill(length)(random.nextInt().toByte), length)
      case _ =>
        val flipped = file.clone
        for i <- flipped.indices.slice(at, at + 1 + random.nextInt(3)) do
          flipped(i) = one(Vector(0, -1, 127, -128, flipped(i) + 1, flipped(i) ^ 32)).toByte
        flipped

  private def words(file: Array[Byte]): Array[Byte] =
    val text = String(file, ISO_8859_1)
    val (from, until) = word(text)
    val replacement = random.nextInt(6) match
      case 0 => one(Mutator.Numbers)
      case 1 =>
        // these take the time of a thousand others
        one(if random.nextInt(200) == 0 then Mutator.Bombs else Mutator.Statements)
      case 2 => one(Mutator.Signs)
      case 3 => one(Mutator.Signs) * (1 + random.nextInt(3000))
      case 4 => ""
      case _ => text.substring(from, until) + " " + text.substring(from, until)
    text.patch(from, replacement, until - from).getBytes(ISO_8859_1)

  private def exchanged(file: Array[Byte]): Array[Byte] =
    val text = String(file, ISO_8859_1)
    val (from, until) = word(text)
    val old = text.substring(from, until)
    val other = String(one(corpus), ISO_8859_1)
    val replacement =
      if old.toDoubleOption.nonEmpty then one(Mutator.Numbers)
      else
        val likes = Iterator.continually(word(other)).take(30).map(other.substring(_, _))
        likes.find(w => w.headOption == old.headOption && w != old).getOrElse(old)
    text.patch(from, replacement, until - from).getBytes(ISO_8859_1)

  /** Where a word is: what is between blanks. */
  private def word(text: String): (Int, Int) =
    def isBlank(i: Int) = i < 0 || i >= text.length || text(i) <= ' '
    var from = random.nextInt(text.length + 1)
    while !isBlank(from - 1) do from -= 1
    var until = from
    while !isBlank(until) do until += 1
    (from, until)

private object Mutator:
  private def lines(text: String): Vector[String] =
    text.linesIterator.map(_.trim).filter(_.nonEmpty).toVector

  private val Numbers = lines("""
    nan
    NaN
    inf
    -inf
    1e400
    -1e400
    1e-400
    -0
    0
    -1
    1
    2
    0.5
    1e38
    -1e38
    1e-45
    2147483647
    2147483648
    -2147483648
    4294967296
    99999999999999999999
    1e9
    65536
    1000000
    100
    [
    ]
    [ ]
    [ nan ]
    [ 1 2 3 ]
    [ 1e400 0 -0 ]
    true
    "1"
    0x10
    1.2.3
    --1""")

  private val Statements = lines("""
    AttributeBegin
    AttributeEnd
    TransformBegin
    TransformEnd
    ObjectBegin "o"
    ObjectEnd
    ObjectInstance "o"
    WorldBegin
    WorldEnd
    Scale 0 0 0
    Scale 1e300 1e300 1e300
    Transform [ 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 ]
    Rotate 1e400 0 0 0
    LookAt 0 0 0 0 0 0 0 0 0
    Identity
    ReverseOrientation
    CoordSysTransform "nowhere"
    ActiveTransform EndTime
    Translate 1 2 3
    Shape "sphere"
    Attribute "shape" "float radius" 2
    Option "integer seed" 3
    Texture "t" "float" "scale"
    Material "matte"
    NamedMaterial "m"
    Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 7 ]
    Shape "loopsubdiv" "integer levels" 9 "point3 P" [ 0 0 0 ] "integer indices" [ 0 0 0 ]
    Include "a.pbrt"
    Include "self.pbrt"
    Include "noise.pbrt"
    Include "folder.pbrt"
    WorldEnd WorldEnd""") ++ Vector("Include \"\"", "Include \"\u0000\"")

  private val Bombs = lines("""
    Shape "plymesh" "string filename" "bomb.ply.gz"
    Import "bomb.pbrt"
    Include "bomb.pbrt"
    Include "deep-0.pbrt"""")

  private val Signs = "\"[]#\\\n\r \t\u0000\u00ff\u00c3\u0080-.e7".map(_.toString).toVector

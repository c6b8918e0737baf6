package candela.fuzz

import scala.util.Random

/** Values that nobody expects. */
private[fuzz] object Odd:
  private def words(text: String): Vector[String] = text.trim.split("\\s+").toVector

  val Ints: Vector[Int] =
    Vector(0, 1, 2, 3, -1, -2, 7, 16, 64, 1000, 65536, 1 << 30, Int.MaxValue, Int.MinValue) ++
      Vector(Int.MaxValue - 1)

  val Longs: Vector[Long] =
    Ints.map(_.toLong) ++ Vector(Long.MaxValue, Long.MinValue, 1L << 40, -(1L << 32))

  val Doubles: Vector[Double] =
    Vector(0.0, -0.0, -1.0, 1e300, 1e-320, Double.NaN, 1.0 / 0, -1.0 / 0)

  val Numbers: Vector[String] = words("""
    0 -0 1 -1 2 3 7 0.5 nan NaN inf Infinity -Infinity 1e400 1e-400 1e38 -1e38 1e308 1e-45
    2147483647 2147483648 -2147483648 9223372036854775807 99999999999999999999 0x10 1_000 1. .5
    +1 1d 1f ٣ ½ ∞ 1e 1e9 1e30 1000000""")

  private val Lists = words("""
    1,2 1,2,3,4 0,1,0,1 0,1,0,1,0,1 nan,nan,nan,nan -1,-1 0,0 3,3 4,4 1,0,1,0 0.5,0.5,0,1
    0,0.000001,0,1e-30 2147483647,2147483647 0,2147483647,0,2147483647 0,4,0,4 -1,2,-1,2 4,8,4,8
    0/1 1/0 0/2147483647 2147483646/2147483647 1/2 -1/2 1-3 3-1 1-2147483647 -5--1 1-1000001 0-0
    0x0 1x1 65536x65536 65536 x65536 30000x30000 16x16 x16 3x 99999x99999 4x-4 1e3x2
    2147483647x2147483647 1x2147483647 90s nans -1s 1e400h 0.000001s
    Infinitys 1e8s 1e9s clamp clamp: clamp:nan clamp:0 clamp:-1 clamp:1e38 clamp:1e-45
    clamp:Infinity none all auto on off true false statement type
    a=b a=point+ =x a= a=infinite,a=infinite
    bytes=1 bytes=nan bytes=1e9 time=none time=0s time=1ms time=1e300h depth=99999999999999999999
    pixels=0 triangles=0 files=0 depth=0 bytes=9999999999999999999999TiB bytes=1TiBB pixels=
    albedo normals,normals lights depth:half albedo:double :half ,albedo""")

  private val Texts = Vector(
    "",
    " ",
    "\u0000",
    "\u001b[31m",
    "\r\n",
    "\t",
    "ä",
    "\ud83d\ude00",
    "\ud800",
    "\u202e",
    "\u009b",
    "a" * 70000,
    "1" * 5000,
    "-",
    "--",
    "---",
    "-o",
    "--spp",
    "%d",
    "%s%n%99999d",
    "$x",
    "$$",
    ",",
    ",,,",
    "=",
    "==",
    ":",
    "/",
    "//",
    ".",
    "\\",
    "\"",
    "'",
    "*",
    "?",
    "[",
    "(",
    "${jndi:x}",
    "`x`"
  )

  /** A value, often of the kind that is wanted.
    *
    * @param wanted how the help calls it, as in `v2|v3|v4`
    */
  def text(wanted: String, random: Random): String =
    def one[A](all: IndexedSeq[A]) = all(random.nextInt(all.size))
    val own = wanted.split("[|\\[\\],:=]").toVector.filter(_.nonEmpty)
    random.nextInt(8) match
      case 0 | 1 if own.nonEmpty => one(own)
      case 2 if own.nonEmpty => one(own) + one(Texts)
      case 3 => one(Texts)
      case 4 | 5 => one(Lists)
      case 6 if random.nextBoolean() =>
        Vector.fill(1 + random.nextInt(5))(one(Numbers)).mkString(",")
      case _ => one(Numbers)

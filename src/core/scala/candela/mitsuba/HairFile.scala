package candela.mitsuba

import candela.base.Decimal
import candela.diagnostics.{Code, SourcePos}
import candela.io.{InputFile, IoReason}
import candela.math.{Transform, Vec3}
import candela.scenefile.{Param, ParamType}

import java.io.IOException
import java.nio.{BufferUnderflowException, ByteOrder}
import java.nio.charset.StandardCharsets.ISO_8859_1

import scala.collection.mutable.ArrayBuffer

/** Reads Mitsuba 0.6's files of hair: fibres of straight segments.
  *
  * Text has a vertex in each line, and lines without one between fibres. Binary files begin with
  * `BINARY_HAIR` and the number of vertices; an infinite number precedes each fibre but the first.
  */
private[mitsuba] object HairFile:
  type Fibre = Vector[Vec3]

  def read(file: InputFile, at: SourcePos): Vector[Fibre] =
    def fail(reason: String) =
      Values.fail(Code.DamagedMesh, at, s"can't read the hair `${file.path.getFileName}`: $reason")
    val fibres =
      try if isBinary(file) then binary(file, fail) else text(file)
      catch case e: IOException => fail(IoReason(e))
    if fibres.isEmpty then fail("it has no fibre of two vertices")
    fibres

  private val Mark = "BINARY_HAIR"
  private def isBinary(file: InputFile): Boolean =
    String(file.beginning(Mark.length), ISO_8859_1) == Mark

  private def binary(file: InputFile, fail: String => Nothing): Vector[Fibre] =
    val bytes = file.map().order(ByteOrder.LITTLE_ENDIAN)
    val builder = Builder()
    try
      bytes.position(Mark.length)
      val count = bytes.getInt & 0xffffffffL
      var i = 0L
      while i < count do
        val first = bytes.getFloat
        if first.isInfinite then builder.endFibre()
        val x = if first.isInfinite then bytes.getFloat else first
        val vertex = Vec3(x, bytes.getFloat, bytes.getFloat)
        if !isFinite(vertex) then fail(s"vertex ${i + 1} is not finite")
        builder.add(vertex)
        i += 1
    catch case _: BufferUnderflowException => fail("it ends too early")
    builder.result()

  private def text(file: InputFile): Vector[Fibre] =
    val builder = Builder()
    for line <- file.lines() do
      line.trim.split("\\s+").take(3).flatMap(Decimal.float) match
        case Array(x, y, z) if isFinite(Vec3(x, y, z)) => builder.add(Vec3(x, y, z))
        case _ => builder.endFibre()
    builder.result()

  private def isFinite(v: Vec3): Boolean =
    Seq(v.x, v.y, v.z).forall(java.lang.Float.isFinite(_))

  private final class Builder:
    private val fibres = Vector.newBuilder[Fibre]
    private val current = ArrayBuffer.empty[Vec3]

    def add(v: Vec3): Unit = if !current.lastOption.contains(v) then current += v
    def endFibre(): Unit =
      if current.size > 1 then fibres += current.toVector
      current.clear()
    def result(): Vector[Fibre] =
      endFibre()
      fibres.result()

/** Fibres as pbrt's curves. */
private[mitsuba] object HairFibres:

  /** Those that remain, spread evenly over the file.
    *
    * @param reduction part of the fibres that is left out
    */
  def reduced(fibres: Vector[HairFile.Fibre], reduction: Double): Vector[HairFile.Fibre] =
    def count(i: Int) = Math.floor(i * (1 - reduction) + 0.5)
    fibres.zipWithIndex.collect { case (f, i) if count(i + 1) > count(i) => f }

  /** In world space, without vertices at which it bends by less than an angle. */
  def placed(fibre: HairFile.Fibre, toWorld: Transform, minCosine: Float): HairFile.Fibre =
    val points = ArrayBuffer.empty[Vec3]
    for p <- fibre.map(toWorld.point(_)) do
      def isStraight =
        val (a, b) = (points(points.size - 2), points.last)
        (b - a).normalized.dot((p - b).normalized) > minCosine
      if !points.lastOption.contains(p) then
        if points.size > 1 && isStraight then points(points.size - 1) = p
        else points += p
    points.toVector

  /** Straight Bézier curves of degree 3. */
  def points(fibre: HairFile.Fibre, at: SourcePos): Param =
    val inner = fibre.zip(fibre.drop(1)).flatMap: (a, b) =>
      val step = (b - a) * (1f / 3)
      Vector(a + step, b - step, b)
    val numbers = (fibre.head +: inner).flatMap(p => Vector(p.x, p.y, p.z)).toArray
    Param.floats(ParamType.Point3, "P", at, numbers)

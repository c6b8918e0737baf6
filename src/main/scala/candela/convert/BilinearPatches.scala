package candela.convert

import candela.math.{lerp, Vec3}
import candela.scenefile.{Declaration, Param, ParamType}

/** Triangulates a v4 `bilinearmesh`: two triangles per planar patch, a grid per curved one. */
object BilinearPatches:

  def triangles(d: Declaration): Declaration =
    def floats(name: String) = d.param(name).fold(Array.emptyFloatArray)(_.floats)
    val (p, n, uv) = (floats("P"), floats("N"), floats("uv"))
    val indices = d.param("indices").fold(Array(0, 1, 2, 3))(_.ints)
    val patches = indices.grouped(4).filter(_.length == 4).toVector
    val steps = patches.map(c => if isFlat(c.map(vec(p, _))) then 1 else Fine)
    def interpolated(values: Array[Float], size: Int) =
      if values.isEmpty then Array.emptyFloatArray
      else
        patches.zip(steps).toArray.flatMap: (corners, count) =>
          for j <- 0 to count; i <- 0 to count; k <- 0 until size
          yield interpolate(
            corners.map(c => values(c * size + k)),
            i.toFloat / count,
            j.toFloat / count
          )
    val coordinates =
      if uv.nonEmpty then interpolated(uv, 2)
      else
        steps.toArray.flatMap: count =>
          for j <- 0 to count; i <- 0 to count; x <- Seq(i, j) yield x.toFloat / count
    val bases = steps.scanLeft(0)((sum, count) => sum + (count + 1) * (count + 1))
    val meshParams = Vector(
      list(d, ParamType.Point3, "P", interpolated(p, 3)),
      list(d, ParamType.Normal, "N", interpolated(n, 3)),
      list(d, ParamType.Point2, "uv", coordinates)
    ).flatten :+ Param(
      ParamType.Integer,
      "indices",
      d.pos,
      d.pos,
      ints = steps.zip(bases).toArray.flatMap((count, base) => squares(count).map(_ + base))
    )
    val remaining = d.params.filterNot(x => Set("P", "N", "uv", "indices")(x.name))
    d.copy(name = "trianglemesh", params = meshParams ++ remaining)

  private val Fine = 16

  private def vec(p: Array[Float], i: Int) = Vec3(p(3 * i), p(3 * i + 1), p(3 * i + 2))

  /** Bilinear interpolation of corners in the order (0, 0), (1, 0), (0, 1), (1, 1). */
  private def interpolate(c: Array[Float], u: Float, v: Float): Float =
    lerp(v, lerp(u, c(0), c(1)), lerp(u, c(2), c(3)))

  private def isFlat(c: Array[Vec3]): Boolean =
    val n = (c(1) - c(0)) cross (c(2) - c(0))
    Math.abs(n dot (c(3) - c(0))) <= 1e-5f * n.length * (c(3) - c(0)).length

  private def list(d: Declaration, t: ParamType, name: String, values: Array[Float]) =
    Option.when(values.nonEmpty)(Param(t, name, d.pos, d.pos, floats = values))

  private def squares(count: Int): Seq[Int] =
    for
      y <- 0 until count
      x <- 0 until count
      a = y * (count + 1) + x
      i <- Seq(a, a + 1, a + count + 2, a, a + count + 2, a + count + 1)
    yield i

package candela.build.shapes

import candela.base.loop
import candela.diagnostics.Code
import candela.build.recipe.*
import candela.shapes.{KnotVector, Nurbs}

/** Parameters of one direction of a NURBS surface. */
private[build] final class NurbsSide(
    letter: String,
    val count: Field[Int],
    val order: Field[Int],
    val knots: Field[Array[Float]],
    from: Field[Float],
    to: Field[Float]
):
  /** Returns the knot vector. Reports an invalid spline and returns None. */
  def read()(using site: Site): Option[KnotVector] =
    val (n, k, all) = (count(), order(), knots())
    if all.isEmpty || count.given_().isEmpty || order.given_().isEmpty then
      site.unusable(
        Code.MissingParameter,
        s"a \"nurbs\" needs `n$letter`, `${letter}order` and `${letter}knots`"
      )
      None
    else checked(n, k, all)

  private def checked(n: Int, k: Int, all: Array[Float])(using site: Site): Option[KnotVector] =
    val wrong =
      if k < 2 then Some(s"`${letter}order` must be at least 2, found $k")
      else if n < k then Some(s"`n$letter` must be at least `${letter}order`, $k, found $n")
      else if all.length != n + k then
        val sum = s"n$letter + ${letter}order = ${n + k}"
        Some(s"`${letter}knots` must have $sum knots, found ${all.length}")
      else if all.indices.drop(1).exists(i => !(all(i) >= all(i - 1))) then
        Some(s"`${letter}knots` must not decrease")
      else if !(all(k - 1) < all(n)) then Some(s"`${letter}knots` must span an interval")
      else None
    wrong.foreach(why => site.warn(Code.BrokenMesh, s"$why; the \"nurbs\" is ignored"))
    Option.when(wrong.isEmpty)(KnotVector(n, k, all.map(_.toDouble)))

  /** Parameter values of evaluation. */
  def parameters()(using site: Site): Array[Double] =
    val start = from.given_().getOrElse(knots()(order() - 1)).toDouble
    val end = to.given_().getOrElse(knots()(count())).toDouble
    Array.tabulate(NurbsRecipe.Dice)(i => start + (end - start) * i / (NurbsRecipe.Dice - 1))

object NurbsRecipe
    extends ShapeRecipe("nurbs", "rational B-spline surface, as 29 × 29 × 2 triangles", untilV3):
  private val u = side("u")
  private val v = side("v")
  private val points = numbers("P", "point3[]", "control points, in rows of constant v")
  private val weighted = numbers("Pw", "float[]", "control points with weights: x·w y·w z·w w")

  private def side(d: String): NurbsSide = NurbsSide(
    d,
    integer(
      s"n$d",
      s"number of control points along $d",
      shown = "none",
      range = Range.atLeast(2f).deferred
    )(0),
    integer(
      s"${d}order",
      s"order (degree + 1) along $d",
      shown = "none",
      range = Range.atLeast(2f).deferred
    )(0),
    numbers(s"${d}knots", "float[]", s"knots along $d"),
    float(s"${d}0", s"start of $d", shown = s"${d}knots[${d}order - 1]")(0f),
    float(s"${d}1", s"end of $d", shown = s"${d}knots[n$d]")(1f)
  )

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    for
      ku <- u.read()
      kv <- v.read()
      control <- homogeneous(ku.count, kv.count)
    yield
      val (us, vs) = (u.parameters().map(inside(ku)), v.parameters().map(inside(kv)))
      val surface = Nurbs(ku, kv, control)
      val n = Dice * Dice
      val (positions, normals) = (new Array[Float](3 * n), new Array[Float](3 * n))
      val uvs = new Array[Float](2 * n)
      loop(n): i =>
        val (s, t) = (us(i % Dice), vs(i / Dice))
        val evaluated = surface.at(s, t)
        val length = Math.sqrt(
          evaluated(3) * evaluated(3) + evaluated(4) * evaluated(4) + evaluated(5) * evaluated(5)
        )
        loop(3): k =>
          positions(3 * i + k) = evaluated(k).toFloat
          normals(3 * i + k) = if length > 0 then (evaluated(3 + k) / length).toFloat else 0f
        uvs(2 * i) = s.toFloat
        uvs(2 * i + 1) = t.toFloat
      MeshArrays.triangles(positions, normals, uvs, MeshArrays.grid(Dice, Dice))

  private def inside(k: KnotVector)(t: Double): Double =
    Math.max(k.knots(k.order - 1), Math.min(k.knots(k.count), t))

  private def homogeneous(nu: Int, nv: Int)(using site: Site): Option[Array[Double]] =
    val (p, pw) = (points(), weighted())
    val count = nu.toLong * nv
    if p.nonEmpty && p.length == 3 * count then
      Some(Array.tabulate(4 * nu * nv)(i => if i % 4 == 3 then 1.0 else p(i / 4 * 3 + i % 4)))
    else if p.isEmpty && pw.nonEmpty && pw.length == 4 * count then Some(pw.map(_.toDouble))
    else
      site.unusable(
        Code.BrokenMesh,
        s"`P` or `Pw` of a \"nurbs\" must have ${3 * count} or ${4 * count} numbers for $nu × " +
          s"$nv control points, found ${p.length} and ${pw.length}"
      )
      None

  /** Number of vertices along each direction, as in pbrt. */
  private[build] val Dice = 30

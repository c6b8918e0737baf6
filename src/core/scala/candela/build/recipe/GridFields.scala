package candela.build.recipe

import candela.diagnostics.Code
import candela.geometry.Bounds3
import candela.math.*
import candela.media.SampledGrid
import candela.scenefile.Dialect

/** Cells of a grid. */
trait HasCells extends Fields:
  private val sizes =
    Vector("x", "y", "z").map(axis => integer(s"n$axis", s"cells along $axis")(1))

  /** Their number along each axis; None, after an error, if there are not `channels` values for
    * each.
    */
  protected def cells(name: String, values: Array[Float], channels: Int)(using
      site: Site
  ): Option[(Int, Int, Int)] =
    val Vector(nx, ny, nz) = sizes.map(_()): @unchecked
    val wanted = sizes.map(_().toLong).product * channels
    if Seq(nx, ny, nz).exists(_ < 1) || wanted != values.length then
      val shape = (Seq(nx, ny, nz) ++ Option.when(channels > 1)(channels)).mkString("·")
      site.error(Code.ParameterCount, s"`$name` must have $shape numbers, found ${values.length}")
      None
    else Some((nx, ny, nz))

  /** One of the channels, within the limits. */
  protected def channel(values: Array[Float], c: Int, channels: Int): Array[Float] =
    Array.tabulate(values.length / channels): i =>
      val v = values(i * channels + c)
      if v > 0f && java.lang.Float.isFinite(v) then Math.min(v, SampledGrid.MaxValue) else 0f

private object HasBox:
  val Places: Range = Range(-1e15f, 1e15f).limited

/** Bounding box of a medium or texture, in its own space. */
trait HasBox extends Fields:
  private val first = point("p0", "corner of the box", range = HasBox.Places)(Vec3.Zero)
  private val second =
    point("p1", "opposite corner of the box", range = HasBox.Places)(Vec3(1f, 1f, 1f))

  /** Two opposite corners; if `sorted`, the minimum and the maximum. */
  protected def corners(sorted: Boolean)(using Site): (Vec3, Vec3) =
    val (a, b) = (first(), second())
    if sorted then
      val box = Bounds3.of(Seq(a, b))
      (box.min, box.max)
    else (a, b)

  protected def span(low: Position, high: Position): Vec3 =
    Vec3((high.x - low.x).toFloat, (high.y - low.y).toFloat, (high.z - low.z).toFloat)

  /** A corner, with the digits that Floats lack. */
  protected def corner(p: Vec3)(using site: Site): Position =
    def exact(x: Vec3 => Float, i: Int) =
      Vector("p0", "p1").flatMap(site.declaration.param).filter(_.floats.length == 3)
        .find(_.floats(i) == x(p)).fold(x(p).toDouble)(_.number(i))
    Position(exact(_.x, 0), exact(_.y, 1), exact(_.z, 2))

  /** Transform from world space to the unit cube. Warns and returns None if it is singular. */
  protected def toUnit()(using site: Site): Option[Transform] =
    // Swapped corners in pbrt-v3 reflect the grid
    val (a, b) = corners(sorted = site.dialect == Dialect.V4)
    val size = span(corner(a), corner(b))
    val scale = Transform.scale(size.x, size.y, size.z)
    val map =
      if site.toWorld.isFlat then None
      else
        scale.map: s =>
          (site.toWorld * corner(a).fromOrigin * s).inverse
    if map.isEmpty then site.warn(Code.NoVolume, "its box has no volume; it is ignored")
    map

package candela.mitsuba

import candela.base.loop
import candela.diagnostics.{Code, SourcePos}
import candela.color.Rgb
import candela.math.*
import candela.scenefile.{Param, ParamType}

/** Reads `gridvolume`s. */
private[mitsuba] final class Volumes(session: Session):

  /** @param limit of its values */
  def apply(limit: Float)(in: Properties): Option[PlacedGrid] =
    in.ignore("raw", "accel", "send_data")
    if in.word("filter_type", "trilinear", "trilinear", "nearest") == "nearest" then
      session.warn(
        Code.CorrectedValue,
        in.posOf("filter_type"),
        "a gridvolume is interpolated; using `trilinear`"
      )
    if in.word("wrap_mode", "clamp", "clamp", "repeat", "mirror") != "clamp" then
      session.warn(
        Code.CorrectedValue,
        in.posOf("wrap_mode"),
        "a gridvolume ends at its box; using `clamp`"
      )
    val toWorld = in.transform("to_world")
    val usesBox = in.flag("use_grid_bbox", false)
    val stated =
      for (a, b, c) <- in.triple("min"); (d, e, f) <- in.triple("max")
      yield Array(a, b, c, d, e, f).map(_.toFloat)
    for
      name <- in.text("filename").orElse:
        session.error(Code.MissingParameter, in.pos, "a gridvolume must have a `filename`")
        None
      path <- session.file(name, in.posOf("filename"), "skipped")
      file <- session.attempt(VolumeFile.read(path, in.posOf("filename")))
    yield
      val highest = file.values.max
      if file.lowest < 0f then corrected(in, file.lowest, "at least 0")
      if highest > limit then
        corrected(in, highest, s"at most ${limit.toInt}")
        loop(file.values.length)(i => file.values(i) = Math.min(limit, file.values(i)))
      val box =
        if in.plugin.isOld then beyond(stated.getOrElse(file.bounds), file.size)
        else if usesBox then file.bounds
        else Array(0f, 0f, 0f, 1f, 1f, 1f)
      PlacedGrid(file, toWorld, box)

  private def corrected(in: Properties, extreme: Float, range: String): Unit =
    session.warn(
      Code.CorrectedValue,
      in.pos,
      s"values of this volume must be $range, found $extreme; using the nearest that is"
    )

  /** The box of cells whose centres reach the border of another one, where Mitsuba 0.6 has the
    * outermost values.
    */
  private def beyond(bounds: Array[Float], size: Array[Int]): Array[Float] =
    Array.tabulate(6): i =>
      val n = size(i % 3)
      val halfCell = if n > 1 then 0.5f * (bounds(i % 3 + 3) - bounds(i % 3)) / (n - 1) else 0f
      if i < 3 then bounds(i) - halfCell else bounds(i) + halfCell

/** A grid with its place.
  *
  * @param box least and greatest corner, before `toWorld`
  */
private[mitsuba] final class PlacedGrid(
    val file: VolumeFile,
    val toWorld: Transform,
    val box: Array[Float]
):
  import file.*

  private val toGrid = toWorld.inverse

  /** Whether its edges are not along the world's axes. */
  def isTurned: Boolean =
    val m = toWorld.m
    val rows = Seq(0, 4, 8).map(row => Seq(m(row), m(row + 1), m(row + 2)).map(Math.abs).sorted)
    rows.exists(row => row(1) > 1e-6 * row(2))

  /** Absorption and scattering of each cell of this grid of extinction.
    *
    * @param albedo a grid, which is interpolated at the cells' centres, or one colour
    */
  def parted(albedo: Either[PlacedGrid, Rgb]): (Array[Float], Array[Float]) =
    parted((cell, centre) => (cellColor(cell), albedo.fold(_.color(centre()), identity)))

  /** Likewise, if this is a grid of albedos. */
  def sharing(sigmaT: Rgb): (Array[Float], Array[Float]) =
    parted((cell, _) => (sigmaT, cellColor(cell)))

  /** @param extinctionAndAlbedo of a cell, given its index and its centre */
  private def parted(extinctionAndAlbedo: (Int, () => Vec3) => (
      Rgb,
      Rgb
  )): (Array[Float], Array[Float]) =
    val absorbed, scattered = new Array[Float](3 * values.length / channels)
    loop(size(2)): k =>
      loop(size(1)): j =>
        loop(size(0)): i =>
          val cell = (k * size(1) + j) * size(0) + i
          val (sigmaT, albedo) = extinctionAndAlbedo(cell, () => centre(i, j, k))
          val sigmaS = sigmaT * albedo
          val sigmaA = sigmaT - sigmaS
          Seq(sigmaS -> scattered, sigmaA -> absorbed).foreach: (c, to) =>
            to(3 * cell) = Math.max(0f, c.r)
            to(3 * cell + 1) = Math.max(0f, c.g)
            to(3 * cell + 2) = Math.max(0f, c.b)
    (absorbed, scattered)

  /** The grid of albedos of this grid of extinction. */
  def albedoParams(albedo: PlacedGrid, share: Float, at: SourcePos): Seq[Param] =
    val matrix = for own <- ofUnit; target <- albedo.ofUnit yield target.inverse * own
    matrix.toSeq.flatMap: t =>
      Seq(
        Param.floats(ParamType.Rgb, "albedo", at, albedo.colors.map(_ * share)),
        Param(ParamType.Integer, "albedosize", at, at, ints = albedo.file.size),
        Param.floats(ParamType.Float, "albedoplace", at, Array.tabulate(16)(i => t.m(i).toFloat))
      )

  /** From the unit cube. */
  private def ofUnit: Option[Transform] =
    val sides = (0 until 3).map(i => (box(i + 3) - box(i)).toDouble)
    Transform.scale(sides(0), sides(1), sides(2)).map: size =>
      toWorld * Transform.translate(box(0), box(1), box(2)) * size

  /** Of each cell: its colour, three numbers. */
  def colors: Array[Float] =
    if channels == 3 then values else Array.tabulate(3 * values.length)(i => values(i / 3))

  /** Of each cell: its number, or the luminance of its colour. */
  def numbers: Array[Float] =
    if channels == 1 then values
    else Array.tabulate(values.length / 3)(cellColor(_).luminance)

  /** Cells and box, as parameters. */
  def params(at: SourcePos): Seq[Param] =
    Seq("nx", "ny", "nz").zip(size).map(Param.int(_, at, _)) ++ Seq(
      Param.floats(ParamType.Point3, "p0", at, box.take(3)),
      Param.floats(ParamType.Point3, "p1", at, box.drop(3))
    )

  private def centre(i: Int, j: Int, k: Int): Vec3 =
    def along(axis: Int, n: Int) = lerp((n + 0.5f) / size(axis), box(axis), box(axis + 3))
    toWorld.point(Vec3(along(0, i), along(1, j), along(2, k)))

  private def cellColor(cell: Int): Rgb =
    if channels == 1 then Rgb.gray(values(cell))
    else Rgb(values(3 * cell), values(3 * cell + 1), values(3 * cell + 2))

  /** The trilinear interpolation at a point in world space; beyond the box as at its border. */
  private def color(p: Vec3): Rgb =
    val q = toGrid.point(p)
    def cellAndWeight(axis: Int, x: Float): (Int, Float) =
      val length = box(axis + 3) - box(axis)
      val inUnit = if length > 0f then (x - box(axis)) / length else 0.5f
      val cells = clamp(inUnit * size(axis) - 0.5f, 0f, size(axis) - 1f)
      (cells.toInt, cells - cells.toInt)
    val ((i, x), (j, y), (k, z)) =
      (cellAndWeight(0, q.x), cellAndWeight(1, q.y), cellAndWeight(2, q.z))
    var sum = Rgb.Black
    loop(8): corner =>
      def neighbour(n: Int, axis: Int) =
        Math.min(n + (corner >> axis & 1), size(axis) - 1)
      def share(t: Float, axis: Int) = if (corner >> axis & 1) == 1 then t else 1f - t
      val cell = (neighbour(k, 2) * size(1) + neighbour(j, 1)) * size(0) + neighbour(i, 0)
      sum = sum + cellColor(cell) * (share(x, 0) * share(y, 1) * share(z, 2))
    sum

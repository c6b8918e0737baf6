package candela.build.media

import candela.diagnostics.{Code, Suggest}
import candela.io.{InputFile, IoReason}
import java.io.IOException
import candela.build.recipe.*
import candela.geometry.Bounds3
import candela.math.*
import candela.media.{Medium, SparseDensity, SparseGlow, SparseGrid, SparseMedium}
import candela.scenefile.Param

object NanoVdbRecipe
    extends MediumRecipe("nanovdb", "density grid from a NanoVDB file", onlyV4)
    with HasScale
    with HasTemperature:
  private val filename = string("filename", ".nvdb file", shown = "none")("")
  private val gridName = string("gridname", "name of the density grid")("density")
  private val temperatureName =
    string("temperaturename", "name of the temperature grid, if there is one")("temperature")
  private val emittedScale =
    float("Lescale", "scale of the emission", onlyV4, range = Coefficients)(1f)
  private val stored = Once[Option[Voxels]]()
  private val Ignored = "ignoring the medium"

  protected def create()(using site: Site): Option[Medium] =
    site.declaration.param("filename").filter(_ => filename().nonEmpty) match
      case None =>
        site.error(Code.MissingParameter, "a \"nanovdb\" medium needs `filename`")
        None
      case Some(p) =>
        val file = site.resources.file(p, site.declaration, site.problems, Ignored)
        file.flatMap(f => stored.of((f.path, gridName(), temperatureName()))(read(f, p))).flatMap(
          medium
        )

  private def medium(voxels: Voxels)(using site: Site): Option[Medium] =
    val (absorption, scattering) = coefficients()
    val toWorld = site.toWorld * voxels.fromUnit
    if toWorld.isFlat then
      site.warn(Code.NoVolume, "this medium has no volume; it is ignored")
      None
    else
      val light =
        for grid <- voxels.temperature if emittedScale() > 0f yield
          val (below, factor) = kelvins()
          val colors = Thermal.colors((grid.maximum - below) * factor)
          SparseGlow(grid, below, factor, colors, emittedScale())
      Some(SparseMedium(toWorld.inverse, voxels.density, absorption, scattering, light, phase()))

  /** What all colour bases share.
    *
    * @param fromUnit the unit cube to the medium's space
    */
  private final class Voxels(
      val density: SparseDensity,
      val temperature: Option[SparseGrid],
      val fromUnit: Transform
  )

  private def read(file: InputFile, p: Param)(using site: Site): Option[Voxels] =
    def refuse(why: String, help: Option[String] = None, of: Param = p) =
      site.problems.missing(
        Code.DamagedVolume,
        of.valuesAt,
        s"can't read `${filename()}`: $why",
        Ignored,
        help
      )
      None
    try
      NanoVdbFile.read(file, gridName()) match
        case Left(names) =>
          val available = names.distinct.sorted.mkString("`", "`, `", "`")
          val named = site.declaration.param("gridname")
          val help = Suggest.nearest(gridName(), names).map: n =>
            if named.isDefined then s"did you mean `$n`?" else s"\"string gridname\" \"$n\""
          refuse(s"it has no grid `${gridName()}`, only $available", help, named.getOrElse(p))
        case Right(grid) =>
          val temperature = NanoVdbFile.read(file, temperatureName()).toOption
          if temperature.isEmpty && temperatureName.given_().isDefined then
            site.warn(
              Code.DamagedVolume,
              s"`${filename()}` has no grid `${temperatureName()}`; it does not emit"
            )
          voxels(grid, temperature).orElse(refuse("its voxels have no volume"))
    catch
      case e: NanoVdbError => refuse(e.getMessage)
      case e: IOException => refuse(IoReason(e))

  /** The box of a grid, upright in the medium's space; beyond it, there is nothing. */
  private def voxels(grid: NanoVdbGrid, temperature: Option[NanoVdbGrid]): Option[Voxels] =
    val corners =
      for
        x <- Vector(grid.low(0), grid.high(0) + 1)
        y <- Vector(grid.low(1), grid.high(1) + 1)
        z <- Vector(grid.low(2), grid.high(2) + 1)
      yield grid.toIndex.inverse.position(Position(x, y, z))
    // Floats are coarse where a grid is many times its size from its origin
    val isFar = corners.head.reach >= 1024 * corners.map(_.distance(corners.head)).max
    val origin = if isFar then corners.head else Position.Origin
    def toLocal(p: Position) = Vec3(
      (p.x - origin.x).toFloat,
      (p.y - origin.y).toFloat,
      (p.z - origin.z).toFloat
    )
    val box = Bounds3.of(corners.map(toLocal))
    val (low, size) = (box.min, box.max - box.min)
    val fits = low.isFinite && size.isFinite
    for scale <- Transform.scale(size.x, size.y, size.z) if fits yield
      val fromUnit = origin.fromOrigin * Transform.translate(low.x, low.y, low.z) * scale
      val Vector(nx, ny, nz) = grid.low.zip(grid.high).map((a, b) => b - a + 1): @unchecked
      def mapped(g: NanoVdbGrid) = SparseGrid(g.tree, g.toIndex * fromUnit)
      Voxels(SparseDensity(mapped(grid), nx, ny, nz), temperature.map(mapped), fromUnit)

package candela.cameras

import java.nio.file.{Files, Path}

/** Lenses to test with; lengths in metres. */
object Lenses:

  /** The double Gauss lens of the scenes, read here without the reader of the bridge. */
  def doubleGauss(stop: Double = 17.1): LensSystem =
    val text = Files.readString(Path.of("scenes", "lenses", "double-gauss-50mm.dat"))
    val rows = text.linesIterator.filterNot(_.startsWith("#")).map(_.trim.split("\\s+"))
    LensSystem(rows.map(_.map(_.toDouble)).map { row =>
      val diameter = if row(0) == 0 then stop else row(3)
      LensSurface(row(0) / 1000, row(1) / 1000, row(2), diameter / 2000)
    }.toVector)

  /** Equally curved on both sides, with a stop on the side of the film.
    *
    * @param filmDistance from the stop
    */
  def biconvex(
      radius: Double,
      thickness: Double,
      eta: Double,
      filmDistance: Double,
      shape: Option[StopShape] = None
  ): LensSystem = LensSystem(
    Vector(
      LensSurface(radius, thickness, eta, 0.02),
      LensSurface(-radius, 0.002, 1, 0.02),
      LensSurface(0, filmDistance, 0, 0.005)
    ),
    shape
  )

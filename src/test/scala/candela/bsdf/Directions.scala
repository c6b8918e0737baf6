package candela.bsdf

import candela.math.*
import java.util.SplittableRandom

/** Directions to try BSDFs with. */
object Directions:

  /** From the angle to +z and the azimuth, both in degrees. */
  def at(theta: Double, phi: Double): Vec3 =
    val (t, p) = (Math.toRadians(theta), Math.toRadians(phi))
    Vec3(
      (Math.sin(t) * Math.cos(p)).toFloat,
      (Math.sin(t) * Math.sin(p)).toFloat,
      Math.cos(t).toFloat
    )

  /** Above and below the surface, from the normal to nearly grazing. */
  val few: Vector[Vec3] =
    Vector(at(0, 0), at(30, 45), at(60, 200), at(80, 95), at(130, 300), at(165, 10))

  /** Uniform on the sphere. */
  def uniform(random: SplittableRandom): Vec3 =
    val z = 2 * random.nextDouble() - 1
    at(Math.toDegrees(Math.acos(z)), 360 * random.nextDouble())

  /** Anywhere, often within a millionth of the horizon or the axis, sometimes exactly there. */
  def awkward(random: SplittableRandom): Vec3 =
    val small = Math.pow(10, -6 * random.nextDouble())
    val sign = if random.nextBoolean() then 1 else -1
    val z = random.nextInt(8) match
      case 0 => 0.0
      case 1 => 1.0
      case 2 | 3 | 4 => small
      case 5 => 1 - small
      case _ => random.nextDouble()
    val phi = if random.nextInt(4) == 0 then 0.0 else 2 * Math.PI * random.nextDouble()
    val r = Math.sqrt(1 - z * z)
    Vec3((r * Math.cos(phi)).toFloat, (r * Math.sin(phi)).toFloat, (sign * z).toFloat)

  /** ∫ g over the sphere of directions, cell by cell: `rows` bands of equal angle times `columns`
    * sectors, each by one random point in each of `fine`² parts. (A fixed grid would be partial
    * where `g` jumps at a parallel, as refraction by rough surfaces does.)
    */
  def integrals(rows: Int, columns: Int, fine: Int)(g: Vec3 => Double): Array[Double] =
    val random = SplittableRandom(11)
    val cells = new Array[Double](rows * columns)
    val (bands, sectors) = (rows * fine, columns * fine)
    val (height, width) = (Math.PI / bands, 2 * Math.PI / sectors)
    for i <- 0 until bands; j <- 0 until sectors do
      val theta = (i + random.nextDouble()) * height
      val phi = (j + random.nextDouble()) * width
      val r = Math.sin(theta)
      val w = Vec3(
        (r * Math.cos(phi)).toFloat,
        (r * Math.sin(phi)).toFloat,
        Math.cos(theta).toFloat
      )
      cells(i / fine * columns + j / fine) += g(w) * r * height * width
    cells

  /** ∫ g over the hemisphere about +z, by a grid of 2¹⁸ points; good to a thousandth. */
  def overHemisphere(g: Vec3 => Double): Double =
    integrals(1, 1, fine = 512)(w => if w.z > 0f then g(w) else 0.0).sum

  /** The cell of `integrals` that holds `w`. */
  def cell(rows: Int, columns: Int)(w: Vec3): Int =
    val row = Math.min((Math.atan2(Math.hypot(w.x, w.y), w.z) / Math.PI * rows).toInt, rows - 1)
    val turn = Math.atan2(w.y, w.x) / (2 * Math.PI)
    val column = Math.min(((if turn < 0 then turn + 1 else turn) * columns).toInt, columns - 1)
    row * columns + column

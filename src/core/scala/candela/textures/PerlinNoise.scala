package candela.textures

import candela.math.*

/** Gradient noise: 0 at all integer points, smooth between them, approximately in [−1, 1].
  *
  * Source: Perlin, "Improving Noise", SIGGRAPH 2002, with the permutation of his reference
  * implementation. Of its 16 gradients, 12 of them distinct, the last four are in pbrt's order.
  */
object PerlinNoise:
  /** Along each axis. */
  val Period = 256.0

  def apply(x: Float, y: Float, z: Float): Float =
    val x0 = floor(x)
    val y0 = floor(y)
    val z0 = floor(z)
    val dx = x - x0
    val dy = y - y0
    val dz = z - z0
    val ix = x0.toInt & 255
    val iy = y0.toInt & 255
    val iz = z0.toInt & 255
    val wx = fade(dx)
    val wy = fade(dy)
    val z0Value = lerp(
      wy,
      lerp(wx, slope(ix, iy, iz, dx, dy, dz), slope(ix + 1, iy, iz, dx - 1f, dy, dz)),
      lerp(
        wx,
        slope(ix, iy + 1, iz, dx, dy - 1f, dz),
        slope(ix + 1, iy + 1, iz, dx - 1f, dy - 1f, dz)
      )
    )
    val z1Value = lerp(
      wy,
      lerp(
        wx,
        slope(ix, iy, iz + 1, dx, dy, dz - 1f),
        slope(ix + 1, iy, iz + 1, dx - 1f, dy, dz - 1f)
      ),
      lerp(
        wx,
        slope(ix, iy + 1, iz + 1, dx, dy - 1f, dz - 1f),
        slope(ix + 1, iy + 1, iz + 1, dx - 1f, dy - 1f, dz - 1f)
      )
    )
    lerp(fade(dz), z0Value, z1Value)

  def apply(p: Vec3): Float = apply(p.x, p.y, p.z)

  /** Evaluates the plane halfway between lattice points. */
  def apply(x: Float, y: Float): Float = apply(x, y, 0.5f)

  private def floor(x: Float): Float = Math.floor(x.toDouble).toFloat

  private def fade(t: Float): Float = t * t * t * (t * (t * 6f - 15f) + 10f)

  /** Dot product of the lattice point's gradient and the offset from it. */
  private def slope(x: Int, y: Int, z: Int, dx: Float, dy: Float, dz: Float): Float =
    val hash = permutation(permutation(permutation(x) + y) + z) & 15
    val isFlat = hash == 12 || hash == 13
    val u = if hash < 8 || isFlat then dx else dy
    val v = if hash < 4 || isFlat then dy else dz
    (if (hash & 1) == 0 then u else -u) + (if (hash & 2) == 0 then v else -v)

  private val bytePermutation = Array(
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69,
    142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252,
    219, 203, 117, 35, 11, 32, 57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168,
    68, 175, 74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211,
    133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25, 63, 161, 1, 216, 80,
    73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130, 116, 188, 159, 86, 164, 100,
    109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82,
    85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119, 248,
    152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98,
    108, 110, 79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193, 238,
    210, 144, 12, 191, 179, 162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31,
    181, 199, 106, 157, 184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205,
    93, 222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180
  )

  /** Doubled, for lookups with the sum of two bytes. */
  private val permutation: Array[Int] =
    bytePermutation ++ bytePermutation ++ Array(bytePermutation(0))

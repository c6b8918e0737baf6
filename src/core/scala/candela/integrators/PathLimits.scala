package candela.integrators

/** Limits of a path tracer's paths.
  *
  * @param maxDepth          scattering events of a path, at most
  * @param rouletteDepth     the first scattering event after which Russian roulette may end a path.
  *                          Guided vertices whose region knows the expected light ignore it
  * @param rouletteThreshold throughput below which it may
  * @param seesThrough       does light sampling alone find light straight through the boundary of a
  *                          subsurface medium? So in pbrt-v3; v4 weights it against BSDF sampling,
  *                          which does not find it, and loses that part
  */
final case class PathLimits(
    maxDepth: Int,
    rouletteDepth: Int,
    rouletteThreshold: Float = 1f,
    seesThrough: Boolean = false
)

package candela.bsdf.layered

import java.util.SplittableRandom

/** A direction in Double. */
final case class Way(x: Double, y: Double, z: Double):
  def +(o: Way): Way = Way(x + o.x, y + o.y, z + o.z)
  def *(s: Double): Way = Way(x * s, y * s, z * s)
  def dot(o: Way): Double = x * o.x + y * o.y + z * o.z
  def cross(o: Way): Way = Way(y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x)
  def unit: Way = this * (1 / Math.sqrt(this dot this))
  def flipped: Way = Way(x, y, -z)

/** Light that walks at random between a rough coat and a diffuse base: what [[CoatedDiffuse]]
  * claims to be the mean of. Shares no code with it: in Double, with the sampling of Heitz
  * ("Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018) and the textbook's
  * tangents.
  *
  * @param alphaX   roughness; 0 in both directions is smooth
  * @param maxDepth events below the coat, base and coat in turn
  */
final class LayerWalk(
    alphaX: Double,
    alphaY: Double,
    eta: Double,
    thickness: Double,
    albedo: Double,
    maxDepth: Int,
    random: SplittableRandom
):
  private def isSmooth = alphaX == 0 && alphaY == 0

  var weight: Double = 0
  var direction: Way = Way(0, 0, 1)
  var leftAtTop: Boolean = false

  /** Starts from `wo` above; afterwards `weight` is 0 if nothing came out. */
  def walk(wo: Way): Unit =
    weight = 1
    leftAtTop = false
    if crosses(wo, eta) then
      // `direction` points down now.
      var depth = 0
      var inside = true
      while inside && depth < maxDepth && weight > 0 do
        weight *= Math.exp(-thickness / Math.abs(direction.z))
        if depth % 2 == 0 then
          weight *= albedo
          direction = cosine()
        else if crosses(Way(-direction.x, -direction.y, direction.z), 1 / eta) then
          direction = direction.flipped
          inside = false
        else direction = direction.flipped
        depth += 1
      if inside then weight = 0
    else leftAtTop = true

  /** The fraction of the power from `wo` that arrives at the base, as one random sample. */
  def arriving(wo: Way): Double =
    weight = 1
    if crosses(wo, eta) then weight * Math.exp(-thickness / Math.abs(direction.z)) else 0

  /** The fraction of what the base sends up that comes back, as one random sample. */
  def returning(): Double =
    val up = cosine()
    weight = Math.exp(-thickness / up.z)
    // Seen from inside, the coat lies below.
    if crosses(up, 1 / eta) then 0 else weight * Math.exp(-thickness / Math.abs(direction.z))

  /** Meets the coat from the side on which `w` has z > 0, beyond which the relative index is `n`.
    * Sets `direction`: down if it returns true, up if it was reflected.
    */
  private def crosses(w: Way, n: Double): Boolean =
    val m = if isSmooth then Way(0, 0, 1) else visibleNormal(w)
    val cosI = w dot m
    val sin2T = (1 - cosI * cosI) / (n * n)
    val reflected = if sin2T >= 1 then 1 else fresnel(cosI, Math.sqrt(1 - sin2T), n)
    val refracts = random.nextDouble() >= reflected
    direction =
      if refracts then w * (-1 / n) + m * (cosI / n - Math.sqrt(1 - sin2T))
      else m * (2 * cosI) + w * -1
    val wrongSide = if refracts then direction.z >= 0 else direction.z <= 0
    if wrongSide then weight = 0
    else if !isSmooth then weight *= (1 + lambda(w)) / (1 + lambda(w) + lambda(direction))
    refracts

  private def fresnel(cosI: Double, cosT: Double, n: Double): Double =
    val s = (cosI - n * cosT) / (cosI + n * cosT)
    val p = (n * cosI - cosT) / (n * cosI + cosT)
    (s * s + p * p) / 2

  private def lambda(w: Way): Double =
    val tan2 = (1 - w.z * w.z) / (w.z * w.z)
    val r2 = w.x * w.x + w.y * w.y
    val alpha2 =
      if r2 == 0 then 0
      else (w.x * w.x * alphaX * alphaX + w.y * w.y * alphaY * alphaY) / r2
    (Math.sqrt(1 + alpha2 * tan2) - 1) / 2

  private def visibleNormal(w: Way): Way =
    val v = Way(alphaX * w.x, alphaY * w.y, w.z).unit
    val t1 = if v.z < 0.9999999 then (Way(0, 0, 1) cross v).unit else Way(1, 0, 0)
    val t2 = v cross t1
    val r = Math.sqrt(random.nextDouble())
    val phi = 2 * Math.PI * random.nextDouble()
    val a = r * Math.cos(phi)
    val s = (1 + v.z) / 2
    val b = (1 - s) * Math.sqrt(1 - a * a) + s * r * Math.sin(phi)
    val n = t1 * a + t2 * b + v * Math.sqrt(Math.max(0, 1 - a * a - b * b))
    Way(alphaX * n.x, alphaY * n.y, Math.max(1e-12, n.z)).unit

  private def cosine(): Way =
    val r2 = random.nextDouble()
    val phi = 2 * Math.PI * random.nextDouble()
    val r = Math.sqrt(r2)
    Way(r * Math.cos(phi), r * Math.sin(phi), Math.sqrt(1 - r2))

package candela.media

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*

/** What a medium does to a ray, as means of many tries. */
object Tracking:

  /** @param passed    what remains of light that the medium lets through
    * @param scattered what goes on in other directions
    * @param glow      what it emits
    */
  final case class Means(passed: Rgb, scattered: Rgb, glow: Rgb, dimmed: Rgb)

  private final class Sum:
    private var r, g, b = 0.0
    def add(c: Rgb): Unit =
      r += c.r
      g += c.g
      b += c.b
    def mean(n: Int): Rgb = Rgb((r / n).toFloat, (g / n).toFloat, (b / n).toFloat)

  /** The ray from `origin` along `direction` (of any length) to parameter `end`, `n` times. */
  def means(medium: Medium, origin: Vec3, direction: Vec3, end: Float, n: Int): Means =
    val work = MediumWork()
    val ray = Ray()
    val (passed, scattered, glow, dimmed) = (Sum(), Sum(), Sum(), Sum())
    work.random.seed(0.25f, 0.5f)
    for i <- 0 until n do
      work.start(i % 3)
      ray.set(origin, direction, end)
      val t = medium.follow(ray, work.random.next(), emits = true, work)
      require(t == -1f || (t >= 0f && t <= end), s"scattered at $t")
      (if t >= 0f then scattered else passed).add(work.weights.throughput)
      glow.add(Rgb(work.glowR, work.glowG, work.glowB))
      work.shadow.start(i % 3, 1f)
      medium.attenuate(ray, work)
      if !work.shadow.isDead then
        dimmed.add(work.shadow.throughput * (1f / work.shadow.lightRatio))
    Means(passed.mean(n), scattered.mean(n), glow.mean(n), dimmed.mean(n))

  def isNear(a: Rgb, b: Rgb, tolerance: Float): Boolean =
    Seq((a.r, b.r), (a.g, b.g), (a.b, b.b)).forall((x, y) => Math.abs(x - y) <= tolerance)

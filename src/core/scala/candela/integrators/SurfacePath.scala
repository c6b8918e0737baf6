package candela.integrators

import candela.color.{MutableRgb, Rgb}

/** What a path between surfaces carries: one density for all colours. Mutable. */
final class SurfacePath extends PathState:
  private val beta = MutableRgb()
  private var alone = false

  /** Solid-angle density of the current direction; 0 if light sampling does not compete with it;
    * [[SurfacePath.Uncounted]] if what it meets counts nothing.
    */
  private var directionPdf = 0f

  def throughput: Rgb = beta.toRgb
  def scale(factor: Rgb): Unit = beta.scale(factor)
  def scale(factor: Float): Unit = beta.scale(factor)
  def absorb(): Unit = beta.set(Rgb.Black)
  def isDead: Boolean = beta.isBlack
  def largest: Float = beta.largest
  def carried(radiance: Rgb, weight: Float): Rgb = beta.toRgb * radiance * weight

  def addTo(sum: MutableRgb, radiance: Rgb, weight: Float): Unit =
    sum.addProduct(beta, radiance, weight)

  /** Adds β · L. */
  def addTo(sum: MutableRgb, radiance: MutableRgb): Unit = sum.addProduct(beta, radiance)

  def competes: Boolean = directionPdf != 0f

  def emissionWeight(choice: Float, pdf: Float): Float =
    if directionPdf > 0f then LightTransport.powerHeuristic(directionPdf, choice * pdf) else 0f

  protected def turn(pdf: Float): Unit = directionPdf = pdf

  /** Light sampling does not find what is behind an interface that the path passes. If light
    * sampling competed so far, either the path alone finds it from here on, or nobody does.
    */
  def leaveLightSampling(isLost: Boolean): Unit =
    if directionPdf > 0f then directionPdf = if isLost then SurfacePath.Uncounted else 0f

  def isAlone: Boolean = alone

  def keepHero(): Unit =
    alone = true
    beta.scale(LightTransport.Hero)

  override def start(): Unit =
    super.start()
    beta.set(Rgb.White)
    alone = false
    directionPdf = 0f

  def another(): SurfacePath = SurfacePath()

  override def set(from: PathState): Unit =
    super.set(from)
    val same = from.asInstanceOf[SurfacePath]
    beta.set(same.throughput)
    alone = same.alone
    directionPdf = same.directionPdf

private object SurfacePath:
  inline val Uncounted = -1f

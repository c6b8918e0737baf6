package candela.bdpt

import candela.cameras.{Camera, FilmPlace}
import candela.color.Rgb
import candela.film.Splats
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.integrators.LightConnection
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Light tracing: connects the vertices of light subpaths to the camera. Mutable, one per worker.
  *
  * @param imageCamera if it can't project points to the film, nothing is connected
  * @param splats receives what arrives
  * @param media  through which light goes to the camera, if any
  * @param observer  told of all that arrives, if anybody
  */
private[candela] final class CameraConnection(
    scene: Scene,
    imageCamera: Camera,
    splats: Splats,
    media: PathMedia | Null = null,
    observer: SplatObserver | Null = null
):
  private val camera: Camera | Null = if imageCamera.isTraceable then imageCamera else null
  private val filmPoint = FilmPlace()
  private val shadowRay = Ray()
  private val shadowHit = Hit()

  var raysTraced: Long = 0L

  /** Area pdf of camera rays at `p`, from `eye`; 0 if the camera can't be connected to. */
  def density(eye: Vec3, p: Vec3): Float =
    val sensor = camera
    if sensor == null then 0f else sensor.density(eye, p)

  /** Starts a new sample. */
  def startSample(time: Float): Unit =
    shadowRay.time = time
    splats.countSample()

  /** Connects all vertices.
    *
    * @param isWeighted against the other strategies of [[BidirectionalPathTracer]]; else light
    *                   tracing is the only one
    * @param perSample  such light paths per camera sample
    */
  def connect(
      paths: LightVertices,
      isWeighted: Boolean,
      sampler: Sampler,
      perSample: Float = 1f
  ): Unit =
    val sensor = camera
    if sensor != null && paths.count > 0 then
      sampler.next2D()
      val lensU = sampler.x
      val lensV = sampler.y
      var i = 0
      while i < paths.count do
        val lit = paths(i)
        if sensor.project(lit.point.p, lensU, lensV, filmPoint) then
          val toCamera = filmPoint.direction
          val f = if lit.isReachable(toCamera) then lit.sent(toCamera) else Rgb.Black
          if !f.isBlack then
            val density = filmPoint.density / perSample
            val arriving = density * lit.cosine(toCamera)
            val misRatios =
              if !isWeighted then 0.0
              else lit.weights.sum(arriving.toDouble, lit.reversePdf(toCamera).toDouble)
            val weight = (density * lit.sentCosine(toCamera) / (1 + misRatios)).toFloat
            val contribution = lit.throughput * f * weight
            val pathMedia = media
            if !contribution.isBlack then
              val light =
                if pathMedia != null then
                  contribution * pathMedia.toCamera(lit, toCamera, filmPoint.eye)
                else if isClear(lit.point, toCamera, filmPoint.eye) then contribution
                else Rgb.Black
              if !light.isBlack then
                splats.add(filmPoint.x, filmPoint.y, light, paths.group)
                val sink = observer
                if sink != null then
                  sink.observe(filmPoint.x, filmPoint.y, light, misRatios, lit.edges)
        i += 1

  private def isClear(from: ShadingPoint, towards: Vec3, end: Vec3): Boolean =
    val origin = from.offsetOrigin(towards)
    shadowRay.set(origin, end - origin, LightConnection.ShadowEnd)
    raysTraced += 1
    !scene.isOccluded(shadowRay, shadowHit)

/** Is told of light that light paths bring to the camera. */
private[candela] trait SplatObserver:
  /** @param light  weighted
    * @param misRatios as in the weight 1 / (1 + others)
    * @param edges     of the light path, without the connection
    */
  def observe(x: Float, y: Float, light: Rgb, misRatios: Double, edges: Int): Unit

package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.lights.{EnvironmentLight, SurfaceLight}
import candela.math.Vec3
import candela.sampling.Sampler

import scala.annotation.unused

/** What may be added to the steps of [[PathTracer]] and [[VolumePathTracer]], in their order: here
  * nothing. A scene that needs more has a [[PathTechniques]].
  */
class PathExtension:
  /** A path begins along the camera's ray. */
  def startPath(sampler: Sampler): Unit = ()

  /** The ray was traced to the next surface. */
  def travel(sampler: Sampler): Unit = ()

  /** Adds what photons scatter to the path along the ray. True if they bring all light of the
    * medium: the path is then attenuated up to the surface, and no distance is sampled.
    */
  def gatherInMedium(medium: Int): Boolean = false

  /** Share of the light just met that the path keeps: its MIS weight against light paths; 0 if
    * photons bring the light, or the emitter is hidden. The weight against light sampling is apart.
    */
  def emissionFactor(index: Int, light: EnvironmentLight): Float = 1f
  def emissionFactor(index: Int, light: SurfaceLight): Float = 1f

  /** The path has met light: of one of the environments, of a surface. Of media it is the sum so
    * far.
    */
  def meetEnvironment(light: Int, Le: Rgb): Unit = ()
  def meetSurface(light: Int, Le: Rgb, weight: Float): Unit = ()
  def meetMedia(sum: Rgb): Unit = ()

  /** Does the path see through the emitter that it has met? */
  def isHidden: Boolean = false

  /** The path has come to a scattering event. On a surface the BSDF is known.
    *
    * @param isGuided may the direction be guided?
    */
  def arrive(isGuided: Boolean = true): Unit = ()
  def arriveInMedium(p: Vec3, wo: Vec3, medium: Int): Unit = ()

  /** Does the path take the light sample of the connection itself? False: photons bring its light.
    */
  def takesLightSample: Boolean = true

  /** Solid-angle density with which the path takes the direction of the light sample.
    *
    * @param pdf of the BSDF or phase function
    */
  def directionPdf(@unused localWi: Vec3, pdf: Float): Float = pdf

  /** Factor of the light sample at a surface. */
  def sampleFactor(localWi: Vec3): Float = 1f

  /** The path carries the connection's `arrived` of the light sample. */
  def recordSample(): Unit = ()

  /** Adds caustics that the vertex scatters to the path. */
  def addCaustics(): Unit = ()

  /** Samples the next direction in place of the BSDF or phase function; false: it doesn't. */
  def sampleDirectionInstead(sampler: Sampler): Boolean = false

  /** Moves the vertex to where light that was refracted into the surface emerges, as part of the
    * same scattering event; false: none does.
    */
  def moveToExit(sampler: Sampler): Boolean = false

  /** The path is about to leave the vertex.
    *
    * @param pdf of the phase function, for the direction
    */
  def leaveVertex(): Unit = ()
  def leaveInMedium(pdf: Float): Unit = ()

  /** The throughput by which Russian roulette decides.
    *
    * @param rrBeta largest of the path's colours, without the radiance scaling of refraction
    */
  def rouletteThroughput(rrBeta: Float): Float = rrBeta

  /** Goes on with another branch of the path; false: there is none. */
  def nextBranch(sampler: Sampler): Boolean = false

  /** The light of the last path, divided; null: the scene doesn't ask for it. */
  def lightParts: LightParts | Null = null

  def raysTraced: Long = 0L

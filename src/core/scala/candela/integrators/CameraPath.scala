package candela.integrators

import candela.film.LightParts
import candela.scene.Scene

/** A path from the camera, as far as a [[CameraPathIntegrator]] reports it. */
trait CameraPath:
  /** The last vertex on a surface. */
  def vertex: SurfaceVertex

  /** The light found so far, divided; null: the scene doesn't ask for it. */
  def parts: LightParts | Null
  def raysTraced: Long

/** Base of integrators that follow one unidirectional path per sample. */
abstract class CameraPathIntegrator(scene: Scene) extends SceneIntegrator(scene):
  protected def walk: CameraPath
  final def raysTraced: Long = walk.raysTraced
  override final def lastMaterial: Int = walk.vertex.at.material
  override final def lightParts: LightParts | Null = walk.parts

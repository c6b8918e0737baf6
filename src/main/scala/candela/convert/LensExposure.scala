package candela.convert

import candela.build.SceneBuilder
import candela.cameras.RealisticCamera
import candela.diagnostics.SceneError
import candela.math.Transform
import candela.scenefile.{AnimatedTransform, SceneDescription}

/** The light that reaches the film of v3's lens systems, relative to v4's exposure of a second. */
private[convert] object LensExposure:

  /** 1 for other cameras. */
  def of(scene: SceneDescription): Float =
    val identity = AnimatedTransform(Transform.Identity, Transform.Identity)
    // The lens depends on the film's size
    val alone = SceneDescription(
      scene.dialect,
      scene.camera.filter(_.name == "realistic"),
      worldToCamera = identity,
      film = scene.film,
      folder = scene.folder
    )
    if alone.camera.isEmpty then 1f
    else
      try
        SceneBuilder.build(alone)._1.camera match
          case lens: RealisticCamera if lens.relativeGain > 0 => lens.relativeGain.toFloat
          case _ => 1f
      catch case _: SceneError => 1f // told where the scene is rendered

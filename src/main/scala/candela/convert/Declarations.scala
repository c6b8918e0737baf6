package candela.convert

import scala.collection.mutable

import candela.scenefile.{Declaration, MaterialRef, SceneDescription, ShapeDescription}

/** Walks over a description. */
object Declarations:

  /** The scene with `change` applied to every declaration; what several shapes share is changed
    * once, and still shared.
    */
  def map(scene: SceneDescription)(change: Declaration => Declaration): SceneDescription =
    val materials = mutable.HashMap.empty[Declaration, Declaration]
    def shared(d: Declaration) = materials.getOrElseUpdate(d, change(d))
    def shape(s: ShapeDescription) = s.copy(
      shape = change(s.shape),
      material = s.material match
        case MaterialRef.Inline(d) => MaterialRef.Inline(shared(d))
        case other => other
      ,
      areaLight = s.areaLight.map(shared)
    )
    scene.copy(
      camera = scene.camera.map(change),
      film = scene.film.map(change),
      sampler = scene.sampler.map(change),
      filter = scene.filter.map(change),
      integrator = scene.integrator.map(change),
      accelerator = scene.accelerator.map(change),
      renderer = scene.renderer.map(change),
      volumeIntegrator = scene.volumeIntegrator.map(change),
      textures = scene.textures.map(t => t.copy(texture = change(t.texture))),
      namedMaterials = scene.namedMaterials.map((name, d) => (name, change(d))),
      lights = scene.lights.map(l => l.copy(light = change(l.light))),
      shapes = scene.shapes.map(shape),
      objects = scene.objects.map((name, shapes) => name -> shapes.map(shape)),
      media = scene.media.map(m => m.copy(medium = change(m.medium))),
      volumes = scene.volumes.map(v => v.copy(light = change(v.light)))
    )

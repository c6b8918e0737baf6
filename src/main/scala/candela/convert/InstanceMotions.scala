package candela.convert

import candela.math.{Transform, Vec3}
import candela.scenefile.{AnimatedTransform, Param, RenderingOrigin, SceneDescription}

/** Keeps the motions of instances. pbrt-v2 and v3 take their translations relative to the world's
  * origin, v4 relative to the camera, unless it renders in world space.
  */
private[convert] object InstanceMotions:

  /** Before the conversion from v4. */
  def fromV4(scene: SceneDescription): SceneDescription =
    if !moves(scene) then scene else relativeTo(RenderingOrigin.of(scene), scene)

  /** After the conversion to v4. */
  def toV4(scene: SceneDescription): SceneDescription =
    scene.instances.find(_.instanceToWorld.isAnimated).fold(scene): first =>
      val space = Param.string(RenderingOrigin.Option, first.pos, RenderingOrigin.World)
      scene.copy(options = scene.options :+ space)

  private def moves(scene: SceneDescription) = scene.instances.exists(_.instanceToWorld.isAnimated)

  /** Moves the objects there and the instances back: both are the same transform together, and the
    * instances' translations are those of the point.
    */
  private def relativeTo(origin: Vec3, scene: SceneDescription): SceneDescription =
    val moved = scene.instances.filter(_.instanceToWorld.isAnimated).map(_.name).toSet
    val instanceShift = Transform.translate(origin.x, origin.y, origin.z)
    val objectShift = instanceShift.inverse
    def mapTransforms(t: AnimatedTransform, f: Transform => Transform) =
      AnimatedTransform(f(t.start), f(t.end))
    scene.copy(
      objects = scene.objects.map: (name, shapes) =>
        if !moved(name) then name -> shapes
        else
          name -> shapes.map(s =>
            s.copy(objectToWorld = mapTransforms(s.objectToWorld, objectShift * _))
          )
      ,
      instances = scene.instances.changed: i =>
        if !moved(i.name) then i
        else i.copy(instanceToWorld = mapTransforms(i.instanceToWorld, _ * instanceShift))
    )

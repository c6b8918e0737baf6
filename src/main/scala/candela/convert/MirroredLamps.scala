package candela.convert

import candela.math.Transform
import candela.scenefile.{AnimatedTransform, ShapeDescription}

/** Mirrored spheres and disks of Mitsuba that emit: pbrt shows one side of them, and lights the
  * other. Upside down, they are the same surfaces by transforms that mirror nothing.
  */
private[convert] object MirroredLamps:
  private val UpsideDown = Transform.scale(1, 1, -1).get

  def unmirrored(s: ShapeDescription): ShapeDescription =
    val t = s.objectToWorld
    val isMirrored = s.areaLight.nonEmpty && !t.isAnimated && t.start.swapsHandedness
    def turned = s.copy(objectToWorld =
      AnimatedTransform(t.start * UpsideDown, t.start * UpsideDown)
    )
    s.shape.name match
      case "sphere" if isMirrored => turned.copy(reverseOrientation = !s.reverseOrientation)
      // Its normal turns, too
      case "disk" if isMirrored => turned
      case _ => s

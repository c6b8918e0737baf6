package candela.convert

import candela.math.Transform
import candela.scenefile.{AnimatedTransform, ShapeDescription}

/** Shapes that emit, where programs show them otherwise though all have them. */
private[convert] object EmittingShapes:
  private val UpsideDown = Transform.scale(1, 1, -1).get
  private val Quadrics = Set("sphere", "disk", "cylinder")

  /** Whether its transform mirrors it. pbrt places shapes that move by instances, which mirror no
    * shape.
    */
  def isMirrored(s: ShapeDescription): Boolean =
    !s.objectToWorld.isAnimated && s.objectToWorld.start.swapsHandedness

  /** Mirrored spheres and disks of Mitsuba that emit: pbrt shows one side of them, and lights the
    * other. Upside down, they are the same surfaces by transforms that mirror nothing.
    */
  def unmirrored(s: ShapeDescription): ShapeDescription =
    def turned =
      val t = s.objectToWorld.start * UpsideDown
      s.copy(objectToWorld = AnimatedTransform(t, t))
    if s.areaLight.isEmpty || !isMirrored(s) then s
    else
      s.shape.name match
        case "sphere" => turned.copy(reverseOrientation = !s.reverseOrientation)
        // Its normal turns, too
        case "disk" => turned
        case _ => s

  /** What pbrt-v3 and v4 show otherwise. */
  def loss(s: ShapeDescription): Option[String] =
    val isTwoSided = s.areaLight.flatMap(_.param("twosided")).exists(_.bools.contains(true))
    if s.areaLight.isEmpty || isTwoSided then None
    else if isMirrored(s) && Quadrics(s.shape.name) then
      Some("a mirrored quadric that emits is seen on one side, and lights the other; pbrt-v3 and " +
        "v4 mix the two otherwise")
    else if s.shape.name == "loopsubdiv" then
      Some("light of the back of a coarse \"loopsubdiv\" shows at its silhouettes in v4 only")
    else None

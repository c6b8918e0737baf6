package candela.geometry

/** The closest hit found so far; mutable, one per worker. Its distance is the ray's `tMax`. */
final class Hit:
  /** Primitive number in the accelerator; −1 if nothing was hit. */
  var primitive: Int = -1

  /** Primitive of the object, if `primitive` is an instance. */
  var inner: Int = -1

  /** Barycentric weights of a triangle's second and third vertex; free for use by other shapes.
    * Double, because Float weights of a plane 1e6 wide resolve no finer than 0.06.
    */
  var u, v: Double = 0.0

  private var point: Option[ShadingPoint] = None

  /** Scratch memory for an accelerator's alpha test; created on first use. */
  def work: ShadingPoint =
    if point.isEmpty then point = Some(ShadingPoint())
    point.get

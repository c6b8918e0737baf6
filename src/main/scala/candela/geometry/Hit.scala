package candela.geometry

/** The closest hit found so far; mutable, one per worker. Its distance is the ray's `tMax`. */
final class Hit:
  /** Which primitive, as the accelerator numbers them; −1: none. */
  var primitive: Int = -1

  /** If that is an instance: which primitive of its object. */
  var inner: Int = -1

  /** For a triangle the barycentric weights of its second and third vertex; shapes use them freely.
    * Double, because Float weights of a plane 1e6 wide are no finer than 0.06.
    */
  var u, v: Double = 0.0

  private var point: Option[ShadingPoint] = None

  /** Where an accelerator may look at a surface more closely; made when it is first asked for. */
  def work: ShadingPoint =
    if point.isEmpty then point = Some(ShadingPoint())
    point.get

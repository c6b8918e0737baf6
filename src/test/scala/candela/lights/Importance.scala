package candela.lights

import candela.math.Vec3

extension (bounds: LightBounds)
  /** Importance of these lights alone at `p` with normal `n`. */
  def importance(p: Vec3, n: Vec3): Float = LightNodes(Array(bounds)).importance(0, p, n)

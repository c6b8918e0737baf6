package candela.shapes

/** How a curve fills its width. */
enum CurveKind:
  /** A strip that faces every ray. */
  case Flat

  /** The same strip, with the normals of a round hair. */
  case Cylinder

  /** A strip that faces where its normals point. */
  case Ribbon

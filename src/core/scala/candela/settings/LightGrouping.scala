package candela.settings

/** How the layer `lights` groups the lights of a scene. pbrt's lights have no names: those of their
  * statements are made of type and line, such as `point_12`.
  */
enum LightGrouping:
  /** One group for each statement; an area light statement may have many shapes. */
  case Statements

  /** One group for each type. */
  case Types

  /** Groups with these names and statements or types; other lights are in the group `default`. */
  case Named(groups: Vector[(String, Vector[String])])

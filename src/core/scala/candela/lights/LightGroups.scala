package candela.lights

/** Named groups of the lights of a scene; each light is in one. An integrator may tell light
  * apart by other groups, in which no lights are.
  *
  * @param of      index of the group of each light
  * @param ofMedia index of the group of emissive media; −1: there are none
  */
final class LightGroups(val names: Vector[String], of: Array[Int], val ofMedia: Int):
  def apply(light: Int): Int = of(light)

  /** All of it, in words. */
  def describe: Iterator[String] =
    names.iterator ++ Iterator(of.mkString(" "), ofMedia.toString)

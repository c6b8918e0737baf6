package candela.film

/** What an image can hold beside its colours, of the first surface that each camera ray meets.
  *
  * @param word     by which people ask for it
  * @param channels names as pbrt-v4 has them, or customary ones where it has none
  * @param meaning  one line for the help
  */
enum Layer(val word: String, val channels: Vector[String], val meaning: String):
  case Albedo extends Layer("albedo", Layer.rgb("Albedo"), "part of the light that is scattered")
  case Position extends Layer("position", Layer.xyz("P"), "where it is")
  case Gradient
      extends Layer("gradient", Vector("dzdx", "dzdy"), "change of z to the next sample")
  case Normal extends Layer("normal", Layer.xyz("N"), "normal of the surface")
  case ShadingNormal extends Layer("shadingnormal", Layer.xyz("Ns"), "normal that shades it")
  case Uv extends Layer("uv", Vector("u", "v"), "its parameters")
  case Variance extends Layer("variance", Layer.rgb("Variance"), "variance of the samples")
  case RelativeVariance
      extends Layer("relativevariance", Layer.rgb("RelativeVariance"), "variance over the mean")
  case Depth extends Layer("depth", Vector("Z"), "distance along the ray")
  case Samples extends Layer("samples", Vector("samples"), "how many samples there are")

object Layer:
  /** Those of pbrt-v4's film "gbuffer". */
  val gbuffer: Vector[Layer] = values.toVector.filterNot(Set(Depth, Samples))

  private def rgb(name: String) = Vector("R", "G", "B").map(c => s"$name.$c")
  private def xyz(name: String) = Vector("X", "Y", "Z").map(c => s"$name.$c")

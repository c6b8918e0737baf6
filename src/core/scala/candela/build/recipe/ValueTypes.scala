package candela.build.recipe

import candela.scenefile.{Dialect, Param, ParamType}

/** Which types of a scene file a parameter takes. pbrt looks for values under name and type
  * together, so that one of another type is as good as not there.
  */
private[build] object ValueTypes:
  import ParamType.*

  private val Spectra = Set(Rgb, Xyz, Blackbody, Spectrum)

  /** The type that a [[Field]] declares, without the number of its values. */
  def plain(typeName: String): String = typeName.takeWhile(_ != '[')

  /** @param plainType see [[plain]] */
  def accepts(plainType: String, name: String, p: Param, dialect: Dialect): Boolean =
    val given_ = p.paramType
    plainType match
      case "float" => given_ == Float || (name == "splitdepth" && given_ == Integer)
      case "integer" => given_ == Integer
      case "bool" => given_ == Bool
      case "string" => given_ == String
      case "point3" => given_ == Point3
      case "vector3" => given_ == Vector3
      case "normal" => given_ == Normal
      case "point2" =>
        dialect match
          case Dialect.V2 => given_ == Float
          case Dialect.V3 => given_ == Point2 || given_ == Float
          case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf => given_ == Point2
      case "float texture" => given_ == Float || given_ == Texture
      case "spectrum texture" => given_ == Texture || Spectra(given_)
      // pbrt-v4's indices of refraction may be plain numbers
      case "spectrum" => Spectra(given_) || (given_ == Float && Indices(name))
      case "rgb" => Spectra(given_)
      case _ => true

  private val Indices = Set("eta", "interface.eta")

  /** An example of what to write. */
  def example(typeName: String, p: Param): Option[String] =
    val (plainType, name) = (ValueTypes.plain(typeName), p.name)
    def numbers = p.floats ++ p.ints.map(_.toFloat)
    def text(values: Array[Float]) = values.map(DefaultText.number).mkString("[ ", " ", " ]")
    def firstNumber = numbers.headOption.map(DefaultText.number)
    plainType match
      case "spectrum" | "spectrum texture" | "rgb" =>
        val color = numbers match
          case Array(x) => Array(x, x, x)
          case Array(r, g, b) => Array(r, g, b)
          case _ => Array(0.5f, 0.5f, 0.5f)
        Some(s"write \"rgb $name\" ${text(color)}")
      case "float" | "float texture" =>
        Some(s"write \"float $name\"" + firstNumber.fold("")(x => s" $x"))
      case "integer" =>
        Some(s"write \"integer $name\"" + p.floats.headOption.fold("")(x => s" ${x.toInt}"))
      case _ => Some(s"write \"$plainType $name\"")

package candela.scenefile

/** What a statement can give a name to, for others to use. */
enum NameKind:
  case Texture, Material, Object, Medium

object NameKind:

  /** What a statement may have named that could not be read; of another file nobody knows. */
  def madeBy(directive: String): Set[NameKind] = directive match
    case "Texture" => Set(Texture)
    case "MakeNamedMaterial" => Set(Material)
    case "MakeNamedMedium" => Set(Medium)
    case "ObjectBegin" => Set(Object)
    case "Include" | "Import" => values.toSet
    case _ => Set.empty

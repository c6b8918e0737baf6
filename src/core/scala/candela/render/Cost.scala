package candela.render

/** Kinds of data that take memory and time. */
enum CostKind(val word: String):
  /** Of the scene file, kept with it. */
  case Statements extends CostKind("statements")

  /** Their vertices, normals and coordinates. */
  case Triangles extends CostKind("triangles")
  case Shapes extends CostKind("other shapes")
  case Instances extends CostKind("instances")
  case Hierarchies extends CostKind("hierarchies")

  /** Images, unless of lights. */
  case Textures extends CostKind("textures")
  case Materials extends CostKind("materials")

  /** Their images and tables, too. */
  case Lights extends CostKind("lights")
  case Media extends CostKind("media")

  /** All sums of the pixels that are rendered, and the image. */
  case Film extends CostKind("film")
  case Guiding extends CostKind("guiding")

/** @param bytes   in memory, estimated
  * @param seconds of the time that it has taken so far
  * @param isMost  whether the bytes are a limit, which few renderings reach
  */
final case class Cost(
    kind: CostKind,
    bytes: Long,
    seconds: Double = 0,
    isMost: Boolean = false
)

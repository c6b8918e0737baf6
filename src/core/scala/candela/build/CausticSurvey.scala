package candela.build

import candela.scenefile.Declaration

/** What `--explain` says of caustics: which surfaces cast them, and which emitters send the light.
  *
  * @param casters  shapes of each material that casts caustics, by the material's name
  * @param emitters that light paths can begin at
  * @param named    materials by name
  */
private[build] final class CausticSurvey(
    casters: Vector[(String, Int)],
    emitters: Vector[SampledLight],
    named: Map[String, Declaration]
):
  import CausticSurvey.*

  def features: Vector[(String, String)] =
    if casters.isEmpty then Vector.empty
    else Vector("casters" -> shortened(surfaces, "materials"), "their lights" -> lights)

  private def surfaces: Vector[String] =
    // Most shapes first; sorting keeps the order of the scene file among equals
    val sums = casters.map(_._1).distinct.map: name =>
      name -> casters.collect { case (`name`, shapes) => shapes }.sum
    for (name, shapes) <- sums.sortBy(-_._2) yield
      val material = named.get(name).fold(name)(d => s"\"$name\" (${StatementName(d)})")
      s"$material on ${if shapes == 1 then "1 shape" else s"$shapes shapes"}"

  private def lights: String =
    val statements = emitters.map(l => StatementName(l.statement) -> l.light.isDelta).distinct
    if statements.isEmpty then "none"
    else
      shortened(
        statements.map((name, isDelta) => if isDelta then s"$name (delta light)" else name),
        "lights"
      )

private[build] object CausticSurvey:
  private val MaxListed = 3

  /** @param shapeMaterials   material of each shape
    * @param lights of the scene
    */
  def apply(
      context: BuildContext,
      materials: MaterialTable,
      shapeMaterials: Iterator[Int],
      lights: Vector[SampledLight]
  ): CausticSurvey =
    val shapes = new Array[Int](materials.materials.length)
    shapeMaterials.foreach(shapes(_) += 1)
    val names = materials.names
    new CausticSurvey(
      names.indices.toVector
        .filter(i => materials.ofScene.isCaster(i) && shapes(i) > 0)
        .map(i => names(i) -> shapes(i)),
      lights.filter(_.light.isCausticSource),
      context.description.namedMaterials.toMap
    )

  private def shortened(all: Vector[String], what: String): String =
    if all.size <= MaxListed then all.mkString(", ")
    else s"${all.take(MaxListed).mkString(", ")} and ${all.size - MaxListed} more $what"

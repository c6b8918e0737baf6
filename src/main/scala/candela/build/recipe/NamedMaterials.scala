package candela.build.recipe

import scala.collection.mutable

import candela.base.{SourcePos, Suggest}
import candela.bsdf.Material
import candela.scenefile.NameKind

/** Materials by the names that `MakeNamedMaterial` gave them, each made when it is first asked
  * for.
  */
final class NamedMaterials:
  private val recipes = mutable.LinkedHashMap.empty[String, () => Material]
  private val made = mutable.HashMap.empty[String, Material]
  private val open = mutable.HashSet.empty[String]

  def define(name: String, make: () => Material): Unit = recipes(name) = make

  /** The material of that name. An unknown one is missing; one that is made of itself is an
    * error.
    */
  def apply(name: String, at: SourcePos, resources: Resources, problems: Findings): Material =
    if open(name) then
      problems.error(at, s"material `$name` is made of itself")
      StandIns.material(resources.basis)
    else
      made.getOrElseUpdate(
        name,
        recipes.get(name) match
          case Some(make) =>
            open += name
            try make()
            finally open -= name
          case None =>
            problems.unnamed(
              NameKind.Material,
              at,
              s"no material is named `$name`",
              StandIns.MagentaSurface,
              Suggest.help(name, recipes.keys)
            )
            StandIns.material(resources.basis)
      )

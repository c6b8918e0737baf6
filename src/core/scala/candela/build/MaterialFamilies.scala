package candela.build

import scala.collection.mutable

import candela.bsdf.Material
import candela.build.materials.{Materials, TintedRecipe}
import candela.scenefile.Declaration

/** Materials whose statements differ in a colour alone: the first of a family is built from its
  * statement, the others from what is read of it and their colours.
  *
  * Only what was built without a word has a family, so that each statement gets its own message.
  *
  * @param count of materials
  */
private[build] final class MaterialFamilies(count: Int):
  import MaterialFamilies.*

  private val ofMaterial = new Array[Family | Null](count)

  /** Builds materials by index in the plain basis, and finds their families. */
  def plainBuilder(context: BuildContext): (Int, Declaration) => Material =
    val latest = mutable.HashMap.empty[String, Family]
    val byKind = mutable.HashMap.empty[Int, Family]
    val familyBuilder = this.familyBuilder(context)
    // Most are of the family of the one before; others take turns
    def familyOf(d: Declaration): Option[Family] = latest.get(d.name).flatMap: last =>
      if last.contains(d) then Some(last) else byKind.get(last.kindOf(d)).filter(_.contains(d))
    (index, d) =>
      familyOf(d) match
        case Some(family) =>
          context.resources.allowance.checkTime(Some(d.pos))
          ofMaterial(index) = family
          latest(d.name) = family
          familyBuilder(index, d)
        case None =>
          val reports = context.problems.reported
          val material = Materials.build(context.site(d))
          if context.problems.reported == reports then
            for case recipe: TintedRecipe <- Materials.all.lookUp(d.name, context.site(d).dialect)
            do
              val family = Family(recipe, d)
              latest(d.name) = family
              byKind(family.kindOf(d)) = family
          material

  /** As above, in any basis, once the families are known. */
  def familyBuilder(context: BuildContext): (Int, Declaration) => Material =
    val makers = mutable.HashMap.empty[Family, Declaration => Material]
    (index, d) =>
      val family = ofMaterial(index)
      if family == null then Materials.build(context.site(d))
      else makers.getOrElseUpdate(family, family.makerIn(context))(d)

private[build] object MaterialFamilies:
  private final class Family(recipe: TintedRecipe, first: Declaration):
    def contains(d: Declaration): Boolean = recipe.isAlike(first, d)
    def kindOf(d: Declaration): Int = recipe.kindOf(d)

    def makerIn(context: BuildContext): Declaration => Material =
      val build = recipe.family(context.site(first))
      d => build(context.site(d))

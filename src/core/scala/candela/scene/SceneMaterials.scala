package candela.scene

import java.util.concurrent.atomic.AtomicReferenceArray

import candela.bsdf.Material

/** The materials of a scene, by index. Safe for threads.
  *
  * Those of a set of wavelengths are made when a ray first meets them: a scene has up to 512 sets,
  * and most sets meet few of many materials. If they become too many, all of the set are forgotten,
  * to be made again where rays meet them again.
  *
  * @param kinds        what all sets share
  * @param isDispersive whether any surface is dispersive
  * @param most         number of materials kept
  * @param maker        makes materials by index, all alike; forgotten with what it made
  */
final class SceneMaterials private (
    kinds: SceneMaterials.Kinds,
    val isDispersive: Boolean,
    most: Int,
    maker: () => Int => Material
):
  import SceneMaterials.*

  // Pages are made when a material of theirs is
  private val pages = new Array[AtomicReferenceArray[Material]]((kinds.count + Page - 1) / Page)
  private var make: (Int => Material) | Null = null
  private var kept = 0

  def apply(index: Int): Material =
    val page = pages(index / Page)
    val made = if page == null then null else page.getAcquire(index % Page)
    if made != null then made else fresh(index)

  private def fresh(index: Int): Material = synchronized:
    val page = pages(index / Page)
    val made = if page == null then null else page.get(index % Page)
    if made != null then made
    else
      if kept == most then forget()
      kept += 1
      val material = theMaker()(index).met
      if pages(index / Page) == null then pages(index / Page) = AtomicReferenceArray(Page)
      pages(index / Page).setRelease(index % Page, material)
      material

  private def theMaker(): Int => Material =
    val now = make
    if now != null then now
    else
      val other = maker()
      make = other
      other

  private def forget(): Unit =
    java.util.Arrays.fill(pages.asInstanceOf[Array[AnyRef | Null]], null)
    make = null
    kept = 0

  def isInterface(index: Int): Boolean = kinds.interfaces(index)
  def hasInterfaces: Boolean = kinds.hasInterfaces
  def isPane(index: Int): Boolean = kinds.panes(index)
  def hasPanes: Boolean = kinds.hasPanes
  def isSubsurface(index: Int): Boolean = kinds.all(index).isSubsurface
  def hasSubsurface: Boolean = kinds.hasSubsurface

  /** One material may have several indices. */
  def isSame(a: Int, b: Int): Boolean = kinds.all(a) eq kinds.all(b)

  /** The materials of another colour basis, in the same order. */
  def in(isDispersive: Boolean, most: Int)(maker: () => Int => Material): SceneMaterials =
    new SceneMaterials(kinds, isDispersive, most, maker)

object SceneMaterials:
  private inline val Page = 64

  def apply(all: Array[Material]): SceneMaterials =
    new SceneMaterials(Kinds(all), all.exists(_.isDispersive), Int.MaxValue, () => all(_))

  /** What is known of materials beforehand, and does not depend on the colour basis. */
  private final class Kinds(val all: Array[Material]):
    def count: Int = all.length
    val interfaces: Array[Boolean] = all.map(_.isInterface)
    val hasInterfaces: Boolean = interfaces.contains(true)
    val panes: Array[Boolean] = all.map(_.isPane)
    val hasPanes: Boolean = panes.contains(true)
    val hasSubsurface: Boolean = all.exists(_.isSubsurface)

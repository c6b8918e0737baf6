package candela.scene

import candela.base.loop
import java.lang.invoke.VarHandle

import candela.bsdf.Material

/** The materials of a scene, by index. Safe for threads.
  *
  * Those of a set of wavelengths are made when a ray first meets them: a scene has up to 512 sets,
  * and most sets meet few of many materials. If they become too many, all of the set are forgotten,
  * to be made again where rays meet them again.
  *
  * @param kinds        what all sets share
  * @param isDispersive whether any surface is dispersive
  * @param maxCached    number of materials kept
  * @param maker        makes materials by index, all alike; forgotten with what it made
  */
final class SceneMaterials private (
    kinds: SceneMaterials.Kinds,
    val isDispersive: Boolean,
    maxCached: Int,
    maker: () => Int => Material
):
  import SceneMaterials.*

  // Pages are made when a material of theirs is. What is there is read without a lock: it is
  // stored behind a fence, and loads that depend on one another keep their order
  private val pages = new Array[Array[Material | Null] | Null](kinds.count / Page + 1)
  private var factory: (Int => Material) | Null = null
  private var cachedCount = 0

  def apply(index: Int): Material =
    val cached = lookUp(index)
    if cached != null then cached else fresh(index)

  private def lookUp(index: Int): Material | Null =
    val page = pages(index >>> PageBits)
    if page == null then null else page(index & (Page - 1))

  private def fresh(index: Int): Material = synchronized:
    val cached = lookUp(index)
    if cached != null then cached
    else
      if cachedCount == maxCached then forget()
      cachedCount += 1
      val material = theMaker()(index).resolved
      val page = pageOf(index)
      VarHandle.releaseFence()
      page(index & (Page - 1)) = material
      material

  private def pageOf(index: Int): Array[Material | Null] =
    val existing = pages(index >>> PageBits)
    if existing != null then existing
    else
      val page = new Array[Material | Null](Page)
      VarHandle.releaseFence()
      pages(index >>> PageBits) = page
      page

  private def theMaker(): Int => Material =
    val existing = factory
    if existing != null then existing
    else
      val created = maker()
      factory = created
      created

  private def forget(): Unit =
    loop(pages.length)(i => pages(i) = null)
    factory = null
    cachedCount = 0

  /** Which are interfaces, and which are thin dielectrics. */
  private[scene] def interfaces: Array[Boolean] = kinds.interfaces
  private[scene] def panes: Array[Boolean] = kinds.panes

  /** Which cast caustics. */
  private[scene] def casters: Array[Boolean] = kinds.casters

  /** The surfaces that do; made once for all colour bases of a scene. */
  private[scene] def castersAmong(surfaces: Surfaces, instanced: Instanced): Casters =
    kinds.castersAmong(surfaces, instanced)
  def hasInterfaces: Boolean = kinds.hasInterfaces
  def hasPanes: Boolean = kinds.hasPanes
  def hasCasters: Boolean = kinds.casters.contains(true)
  def isCaster(index: Int): Boolean = kinds.casters(index)
  def isSubsurface(index: Int): Boolean = kinds.materials(index).isSubsurface
  def hasSubsurface: Boolean = kinds.hasSubsurface

  /** One material may have several indices. */
  def isSame(a: Int, b: Int): Boolean = kinds.materials(a) eq kinds.materials(b)

  /** The materials of another colour basis, in the same order. */
  def inBasis(isDispersive: Boolean, maxCached: Int)(maker: () => Int => Material): SceneMaterials =
    new SceneMaterials(kinds, isDispersive, maxCached, maker)

object SceneMaterials:
  private inline val PageBits = 6
  private inline val Page = 64

  def apply(all: Array[Material]): SceneMaterials =
    new SceneMaterials(Kinds(all), all.exists(_.isDispersive), Int.MaxValue, () => all(_))

  /** What is known of materials beforehand, and does not depend on the colour basis. */
  private final class Kinds(val materials: Array[Material]):
    def count: Int = materials.length
    val interfaces: Array[Boolean] = materials.map(_.isInterface)
    val panes: Array[Boolean] = materials.map(_.isPane)

    // Paths leave a surface that light travels beneath elsewhere
    val casters: Array[Boolean] = materials.map(m => m.isCaster && !m.isSubsurface)
    private var castersMade: Casters | Null = null

    def castersAmong(surfaces: Surfaces, instanced: Instanced): Casters = synchronized:
      val existing = castersMade
      if existing != null then existing
      else
        val fresh = Casters(surfaces, instanced, casters)
        castersMade = fresh
        fresh
    val hasInterfaces: Boolean = interfaces.contains(true)
    val hasPanes: Boolean = panes.contains(true)
    val hasSubsurface: Boolean = materials.exists(_.isSubsurface)

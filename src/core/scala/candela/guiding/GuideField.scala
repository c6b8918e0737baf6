package candela.guiding

import candela.base.loop
import candela.io.{CheckedInput, CheckedOutput}
import candela.math.*

/** What earlier passes have learnt. Space is divided into regions, separately for each side that a
  * surface may face (±x, ±y, ±z: its normal's largest component) and for events in media; each has
  * a mixture of lobes. A lobe is a von Mises-Fisher distribution around the direction to a point:
  * neighbouring places see it in different directions. Immutable; shared by all workers.
  *
  * Source: Ruppert, Herholz, Lensch, "Robust Fitting of Parallax-Aware Mixtures for Path Guiding",
  * SIGGRAPH 2020.
  *
  * @param axis    of each node of space that is divided: 0, 1 or 2; the first seven are the roots
  * @param split   where it is divided
  * @param below   first of its two children, which follow each other; of a leaf −1 − its region
  * @param bsdfProbabilities that directions are sampled from the BSDF, of each region
  *                instead; 1: it is not guided
  * @param centres of each region: three coordinates
  * @param lobes   [[GuideField.Lobes]] of each region, heavy ones first, with [[GuideField.Size]]
  *                numbers each: the direction to the point as seen from the centre of the region
  *                (three numbers), one over its distance, the concentration, the weight; then,
  *                leaving light lobes out, the weight times the factor that normalises the lobe,
  *                and the sum of weights up to this lobe. Without light all are zero
  * @param splittingFactors of each region, the number of branches in which a path goes on from an
  *                event there, in units of its throughput over what such paths find; 0: not known
  * @param measurements of each region, the mean light of paths whose first event is there, over
  *                their throughput before
  */
final class GuideField private[guiding] (
    val axis: Array[Int],
    val split: Array[Float],
    val below: Array[Int],
    val bsdfProbabilities: Array[Float],
    val centres: Array[Float],
    val lobes: Array[Float],
    val splittingFactors: Array[Float],
    val measurements: Array[Float]
):
  import GuideField.*

  private val tree = RegionTree(axis, split, below)

  def regions: Int = bsdfProbabilities.length

  /** Of each region, the lobes that are not too light to be used; none without light. */
  private[guiding] val lobeCounts: Array[Int] =
    Array.tabulate(regions): region =>
      (0 until Lobes).count(k => lobes((region * Lobes + k) * Size + Factor) > 0f)

  /** Are there regions that guide? */
  val guides: Boolean = bsdfProbabilities.exists(_ < 1f)

  /** The region of the point whose coordinates begin at `p(at)`, on a surface that faces this side;
    * points outside belong to the nearest.
    */
  private[guiding] def region(side: Int, p: Array[Float], at: Int): Int = tree.region(side, p, at)

  /** Was light found there? */
  def isFitted(region: Int): Boolean = lobeCounts(region) > 0

  private[guiding] def save(to: CheckedOutput): Unit =
    for all <- Vector(axis, below) do
      to.int(all.length)
      loop(all.length)(i => to.int(all(i)))
    for all <- Vector(split, bsdfProbabilities, centres, lobes, splittingFactors, measurements) do
      to.int(all.length)
      loop(all.length)(i => to.float(all(i)))

object GuideField:
  /** Lobes of a region. */
  inline val Lobes = 16

  /** Numbers of a lobe, and the places of some. */
  inline val Size = 8
  private[guiding] inline val Nearness = 3
  private[guiding] inline val Kappa = 4
  private[guiding] inline val Weight = 5
  private[guiding] inline val Factor = 6
  private[guiding] inline val End = 7

  /** Number of the side that a surface with this normal faces. */
  def side(n: Vec3): Int =
    val x = Math.abs(n.x)
    val y = Math.abs(n.y)
    val z = Math.abs(n.z)
    if x >= y && x >= z then if n.x > 0f then 0 else 1
    else if y >= z then if n.y > 0f then 2 else 3
    else if n.z > 0f then 4
    else 5

  /** Number of the side of all scattering events in media. */
  inline val Medium = 6

  private[guiding] inline val Sides = 7

  /** One region for each side, unguided. */
  val Start: GuideField = GuideField(
    new Array[Int](Sides),
    new Array[Float](Sides),
    Array.tabulate(Sides)(-1 - _),
    Array.fill(Sides)(1f),
    new Array[Float](3 * Sides),
    new Array[Float](Sides * Lobes * Size),
    new Array[Float](Sides),
    new Array[Float](Sides)
  )

  private[guiding] def load(from: CheckedInput): GuideField =
    def ints() = Array.fill(from.count(bytes = 4))(from.int())
    def floats() = Array.fill(from.count(bytes = 4))(from.float())
    val (axis, below) = (ints(), ints())
    val (split, bsdfProbabilities, centres, lobes) = (floats(), floats(), floats(), floats())
    val (splittingFactors, measurements) = (floats(), floats())
    val (nodes, regions) = (axis.length, bsdfProbabilities.length)
    def isLeaf(node: Int) = below(node) < 0 && -1 - below(node) < regions
    // Children follow their parent, so every way down has an end
    def isDivided(node: Int) =
      below(node) > node && below(node) < nodes - 1 && axis(node) >= 0 && axis(node) <= 2
    require(
      nodes >= Sides && split.length == nodes && below.length == nodes &&
        centres.length == 3 * regions && lobes.length == regions * Lobes * Size &&
        splittingFactors.length == regions && measurements.length == regions &&
        (0 until nodes).forall(node => isLeaf(node) || isDivided(node)),
      "its guiding field has no such regions"
    )
    GuideField(
      axis, split, below, bsdfProbabilities, centres, lobes, splittingFactors, measurements
    )

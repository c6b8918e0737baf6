package candela.guiding

/** Where photons came from that casters of caustics have scattered: directions that bring light
  * which paths would find by chance alone. Space is divided into regions of some photons each, for
  * which lobes stand around the directions that they came from. Its direction changes from place to
  * place as that of its light path did, if the path was started a little aside. Immutable; shared
  * by all workers.
  *
  * Sources: Jensen, "Importance Driven Path Tracing using the Photon Map", EGWR 1995; for the
  * change of directions Schjøth, Frisvad, Erleben, Sporring, "Photon Differentials", GRAPHITE 2007.
  *
  * @param tree   of regions
  * @param starts of each region, its first lobe; one more is the end of the last
  * @param data   [[PhotonField.Size]] numbers of each lobe: position of its photon, direction (a
  *               unit vector away from the surface), the nine numbers of the derivative of the
  *               direction by position, row by row; the sharpness, the weight times the factor that
  *               normalises the lobe, and the sum of weights of the region up to this one, which
  *               ends with one
  */
final class PhotonField private[guiding] (
    tree: RegionTree,
    starts: Array[Int],
    private[guiding] val data: Array[Float]
):
  import PhotonField.*

  /** Lobes in all. */
  def count: Int = data.length / Size

  /** Regions that have photons. */
  def regions: Int = (1 until starts.length).count(i => starts(i) > starts(i - 1))

  private[guiding] def region(side: Int, p: Array[Float]): Int = tree.region(side, p, 0)

  private[guiding] def begin(region: Int): Int = starts(region)
  private[guiding] def end(region: Int): Int = starts(region + 1)

object PhotonField:
  /** Numbers of a lobe, and the places of some. */
  private[guiding] inline val Size = 18
  private[guiding] inline val Direction = 3
  private[guiding] inline val Change = 6
  private[guiding] inline val Sharpness = 15
  private[guiding] inline val Factor = 16
  private[guiding] inline val End = 17

  /** Probability of a direction that photons came from, where there are any. */
  inline val Share = 0.5f

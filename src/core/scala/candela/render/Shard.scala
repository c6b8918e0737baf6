package candela.render

/** Part `index` of `count` of a rendering's samples; the parts together are the rendering. */
final case class Shard(index: Int, count: Int):
  require(count >= 1 && index >= 0 && index < count, s"shard $index of $count")

  def isWhole: Boolean = count == 1

  /** Whether it has this sample of a tile: of every pixel its part, and equal work, even if there
    * are more shards than samples.
    */
  private[render] def takesTile(tile: Int, sample: Int): Boolean =
    count == 1 || (tile.toLong + sample) % count == index

  /** As a share of the passes, whose preparation is then divided, too. */
  private[render] def takesPass(sample: Int): Boolean = sample % count == index

  private[render] def takesChain(chain: Int): Boolean = chain % count == index

object Shard:
  val Whole: Shard = Shard(0, 1)

package candela.render

/** How a plan is rendered; the image is the same, as far as the rendering gets.
  *
  * @param threads      at least 1
  * @param listener     follows the rendering, in the caller's thread
  * @param shard        part of the samples to take
  * @param checkpointer saves the state of the rendering
  * @param rule         stops the rendering before its planned samples are taken
  */
final case class RenderControl(
    threads: Int = 1,
    cancellation: Cancellation = Cancellation(),
    listener: RenderListener = RenderListener.Silent,
    shard: Shard = Shard.Whole,
    checkpointer: Option[Checkpointer] = None,
    rule: StoppingRule = StoppingRule.Never
):
  require(threads >= 1, s"`threads` must be at least 1, found $threads")

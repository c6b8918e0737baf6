package candela.guiding

/** Whether paths learn where light comes from: where that was measured to pay, wherever light was
  * found, or not at all.
  */
enum GuidingMode:
  case Auto, On, Off

/** How much is learnt, and what for.
  *
  * @param adapts    is a region guided only where that was measured to pay? Else as soon as light
  *                  was found there
  * @param weighs    do samples of later passes count more if they vary less? Else all count alike
  * @param perRegion records beyond which a region is divided, in units of the root of all
  * @param records   of one pass, about: of more events, a part is recorded
  */
final case class GuideSettings(
    adapts: Boolean,
    weighs: Boolean = true,
    perRegion: Double = 2.0,
    records: Int = 1 << 20
)

package candela.guiding

/** Whether paths are guided: where this was measured to reduce noise, wherever light was found, or
  * not at all.
  */
enum GuidingMode:
  case Auto, On, Off

/** How much is learnt, and what for.
  *
  * @param adapts    is a region guided only where that was measured to pay? Else as soon as light
  *                  was found there
  * @param learnsOn  does learning not depend on the number of samples?
  * @param weighs    do samples of later passes count more if they vary less? Else all count alike
  * @param perRegion records beyond which a region is divided, in units of the root of all
  * @param records   of one pass, about: of more events, a part is recorded
  */
final case class GuideSettings(
    adapts: Boolean,
    learnsOn: Boolean = false,
    weighs: Boolean = true,
    perRegion: Double = 2.0,
    records: Int = 1 << 20
)

object GuideSettings:
  /** None: nothing is learnt.
    *
    * @param endsOpen can samples be added? `Auto` then learns until a pass brings no more
    */
  def of(mode: GuidingMode, endsOpen: Boolean): Option[GuideSettings] = mode match
    case GuidingMode.Off => None
    case GuidingMode.Auto => Some(GuideSettings(adapts = true, learnsOn = endsOpen))
    case GuidingMode.On => Some(GuideSettings(adapts = false))

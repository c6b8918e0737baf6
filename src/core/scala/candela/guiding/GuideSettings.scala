package candela.guiding

/** Whether paths learn where light comes from: where that was measured to pay, likewise and for a
  * rendering of any length, wherever light was found, or not at all. Two more modes use one
  * technique alone of what was learnt, to compare them: directions, or roulette and splitting.
  */
enum GuidingMode:
  case Auto, Progressive, On, Off, Directions, Splitting

/** How much is learnt, and what for.
  *
  * @param adapts    is a region guided only where that was measured to pay? Else as soon as light
  *                  was found there
  * @param learnsOn  does learning not depend on the number of samples?
  * @param directs   are directions taken from what was learnt?
  * @param divides   does it decide in how many branches paths go on, if in any?
  * @param weighs    do samples of later passes count more if they vary less? Else all count alike
  * @param perRegion records beyond which a region is divided, in units of the root of all
  * @param records   of one pass, about: of more events, a part is recorded
  */
final case class GuideSettings(
    adapts: Boolean,
    learnsOn: Boolean = false,
    directs: Boolean = true,
    divides: Boolean = true,
    weighs: Boolean = true,
    perRegion: Double = 2.0,
    records: Int = 1 << 20
)

object GuideSettings:
  /** None: nothing is learnt. */
  def of(mode: GuidingMode): Option[GuideSettings] = mode match
    case GuidingMode.Off => None
    case GuidingMode.Auto => Some(GuideSettings(adapts = true))
    case GuidingMode.Progressive => Some(GuideSettings(adapts = true, learnsOn = true))
    case GuidingMode.On => Some(GuideSettings(adapts = false))
    case GuidingMode.Directions => Some(GuideSettings(adapts = false, divides = false))
    case GuidingMode.Splitting => Some(GuideSettings(adapts = false, directs = false))

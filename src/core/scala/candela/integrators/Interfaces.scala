package candela.integrators

/** What surfaces that paths pass unscattered are to light sampling: interfaces of media, and the
  * openings of [[candela.scene.Surfaces veils]].
  */
enum Interfaces:
  /** Light samples pass them, too, and go on competing with the path. */
  case Open

  /** They stop light samples, which go on competing with the path nevertheless: most light from
    * behind is lost.
    */
  case Weighed

  /** They stop light samples; the path alone finds all light behind them, if it can. */
  case Closed

  /** They stop light samples, and what a scattered path finds behind them is lost, too. */
  case Lossy

  def stopsLight: Boolean = this != Open

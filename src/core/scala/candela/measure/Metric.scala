package candela.measure

import java.util.Locale

/** Image error metrics; docs/METRICS.md has definitions and sources.
  *
  * @param word name on the command line and in files
  * @param title display name
  */
enum Metric(val word: String, val title: String):
  case Mse extends Metric("mse", "MSE")
  case Rmse extends Metric("rmse", "RMSE")
  case Mae extends Metric("mae", "MAE")
  case RelativeMse extends Metric("relmse", "relative MSE")
  case Psnr extends Metric("psnr", "PSNR")
  case Flip extends Metric("flip", "FLIP")

  /** PSNR applies to whole images only, and larger is better. */
  def hasMap: Boolean = this != Psnr

object Metric:
  def named(word: String): Option[Metric] =
    Metric.values.find(_.word == word.toLowerCase(Locale.ROOT))

package candela.report

/** A logarithmic axis from `low` to `high`, which is drawn from `start` to `end` pixels. */
private[report] final class LogAxis(low: Double, high: Double, start: Double, end: Double):

  def at(value: Double): Double =
    val part = (Math.log(value) - Math.log(low)) / (Math.log(high) - Math.log(low))
    start + part * (end - start)

  /** Powers of ten; on a short axis also some of their multiples. */
  def ticks: Vector[Double] =
    val decades = Math.log10(high / low)
    val steps =
      if decades < 0.8 then Vector(1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)
      else if decades < 2.2 then Vector(1.0, 2.0, 5.0)
      else Vector(1.0)
    for
      exponent <- (Math.floor(Math.log10(low)).toInt to Math.ceil(Math.log10(high)).toInt).toVector
      step <- steps
      value = step * Math.pow(10, exponent)
      if value >= low * 0.9999 && value <= high * 1.0001
    yield value

private[report] object LogAxis:

  /** Some room beyond the outermost values; an axis of at least a half decade. */
  def around(values: Vector[Double], start: Double, end: Double): LogAxis =
    val logs = values.filter(_ > 0).map(Math.log10)
    val (least, most) = if logs.isEmpty then (0.0, 1.0) else (logs.min, logs.max)
    val middle = (least + most) / 2
    val half = Math.max(0.25, (most - least) / 2 * 1.08)
    LogAxis(Math.pow(10, middle - half), Math.pow(10, middle + half), start, end)

package candela.bidirectional

import candela.color.Rgb
import candela.film.{Splats, View}

/** All the light that one point of [[PrimarySamples]] brings, wherever on the film. Mutable. */
private[bidirectional] final class Contribution(view: View) extends Splats:
  import Contribution.*
  private var data = new Array[Float](4 * Numbers)
  private var count = 0

  /** How bright it is in sum: what chains walk in proportion to. */
  var strength = 0f

  def clear(): Unit =
    count = 0
    strength = 0f

  /** Nothing is counted here. */
  def begin(): Unit = ()

  def add(x: Float, y: Float, light: Rgb): Unit =
    if x >= view.x0 && x < view.x1 && y >= view.y0 && y < view.y1 then
      val weight = Math.abs(light.luminance)
      if weight > 0f && weight < Float.PositiveInfinity then
        if (count + 1) * Numbers > data.length then
          data = java.util.Arrays.copyOf(data, 2 * data.length)
        val at = count * Numbers
        data(at) = x
        data(at + 1) = y
        data(at + 2) = light.r
        data(at + 3) = light.g
        data(at + 4) = light.b
        count += 1
        strength += weight

  /** Each becomes what the other was. */
  def exchange(other: Contribution): Unit =
    val (hisData, hisCount, hisStrength) = (other.data, other.count, other.strength)
    other.data = data
    other.count = count
    other.strength = strength
    data = hisData
    count = hisCount
    strength = hisStrength

  /** Hands all of it on, times `weight`. */
  def addTo(splats: Splats, weight: Float): Unit =
    var at = 0
    while at < count * Numbers do
      splats.add(data(at), data(at + 1), Rgb(data(at + 2), data(at + 3), data(at + 4)) * weight)
      at += Numbers

private object Contribution:
  /** Of each place. */
  inline val Numbers = 5

package candela.mitsuba

import candela.math.Vec3

/** A time by the clock of a place, and the place.
  *
  * @param hour      by the clock, with its fraction
  * @param timezone  hours ahead of universal time
  * @param latitude  degrees, positive to the north
  * @param longitude degrees, positive to the east
  */
final case class PlaceAndTime(
    year: Int,
    month: Int,
    day: Int,
    hour: Double,
    timezone: Double,
    latitude: Double,
    longitude: Double
)

/** Where the sun is seen.
  *
  * Source: Blanco-Muriel, Alarcón-Padilla, López-Moratalla, Lara-Coira, "Computing the Solar
  * Vector", Solar Energy 70(5), 2001.
  */
object SunPosition:

  /** Unit vector towards the sun: +z is the zenith, +x and azimuths as in Mitsuba. */
  def apply(t: PlaceAndTime): Vec3 =
    val universal = t.hour - t.timezone
    val days = sinceNoonOf2000(t, universal)
    val node = 2.1429 - 0.0010394594 * days
    val longitude = 4.8950630 + 0.017202791698 * days
    val anomaly = 6.2400600 + 0.0172019699 * days
    val ecliptic = longitude + 0.03341607 * Math.sin(anomaly) + 0.00034894 * Math.sin(2 * anomaly) -
      0.0001134 - 0.0000203 * Math.sin(node)
    val tilt = 0.4090928 - 6.2140e-9 * days + 0.0000396 * Math.cos(node)
    val ascension = Math.atan2(Math.cos(tilt) * Math.sin(ecliptic), Math.cos(ecliptic))
    val declination = Math.asin(Math.sin(tilt) * Math.sin(ecliptic))
    val sidereal = 6.6974243242 + 0.0657098283 * days + universal
    val hourAngle = Math.toRadians(15 * sidereal + t.longitude) - ascension
    val latitude = Math.toRadians(t.latitude)
    val zenith = Math.acos(
      Math.cos(latitude) * Math.cos(hourAngle) * Math.cos(declination) +
        Math.sin(declination) * Math.sin(latitude)
    )
    val azimuth = Math.atan2(
      -Math.sin(hourAngle),
      Math.tan(declination) * Math.cos(latitude) - Math.sin(latitude) * Math.cos(hourAngle)
    ) - Math.PI
    val apparentZenith = zenith + EarthRadius / SunDistance * Math.sin(zenith)
    Vec3(
      (Math.sin(apparentZenith) * Math.cos(azimuth)).toFloat,
      (Math.sin(apparentZenith) * Math.sin(azimuth)).toFloat,
      Math.cos(apparentZenith).toFloat
    )

  private val EarthRadius = 6371.01 // km
  private val SunDistance = 149597890.0

  /** Days since the noon of 1 January 2000 in universal time, to a quarter of a day: Mitsuba
    * computes the Julian date in single precision, which moves the sun by up to 0.12°.
    */
  private def sinceNoonOf2000(t: PlaceAndTime, universal: Double): Double =
    val julian = days(t) - 0.5f + universal.toFloat / 24f
    (julian - 2451545f).toDouble

  /** The Julian day of a date, which begins at its noon. */
  def days(t: PlaceAndTime): Int =
    val early = (t.month - 14) / 12
    (1461 * (t.year + 4800 + early)) / 4 + (367 * (t.month - 2 - 12 * early)) / 12 -
      (3 * ((t.year + 4900 + early) / 100)) / 4 + t.day - 32075

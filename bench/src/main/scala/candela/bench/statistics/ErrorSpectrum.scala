package candela.bench.statistics

import candela.base.loop

/** Power of an image's error by spatial frequency, averaged over all directions and channels. White
  * noise has the same power at all frequencies: its mean square. Errors that neighbouring pixels
  * share have more at low frequencies, those that they avoid less.
  *
  * After Celarek, Jakob, Wimmer, Lehtinen, "Quantifying the Error of Light Transport Algorithms",
  * Computer Graphics Forum 38(4), 2019, §4; there of absolute errors.
  *
  * @param frequencies in cycles per pixel, rising: the means of bands a third of an octave wide.
  *   The first is 0, where the power is that of the mean error.
  * @param powers of these bands
  * @param counts of the frequencies in each band: the mean of the powers, weighted by them, is the
  *   mean square
  */
final case class ErrorSpectrum(
    frequencies: Vector[Double],
    powers: Vector[Double],
    counts: Vector[Int]
):
  def *(factor: Double): ErrorSpectrum = copy(powers = powers.map(_ * factor))

/** A band of the error spectrum ensemble: over seeds, mean and standard deviation of its power; the
  * latter is NaN for one seed.
  */
final case class SpectrumBand(frequency: Double, power: Double, deviation: Double)

object ErrorSpectrum:
  private val BandsPerOctave = 3

  /** @param planes of the error, one for each channel, in row order */
  def of(planes: Vector[Array[Double]], width: Int, height: Int): ErrorSpectrum =
    val power = new Array[Double](width * height)
    val (rows, columns) = (Fourier(width), Fourier(height))
    for plane <- planes do
      val re = plane.clone
      val im = new Array[Double](re.length)
      loop(height)(y => rows.transform(re, im, y * width, 1))
      loop(width)(x => columns.transform(re, im, x, width))
      loop(re.length): i =>
        power(i) += (re(i) * re(i) + im(i) * im(i)) / (re.length.toDouble * planes.size)
    banded(power, width, height)

  /** Mean and deviation of each band over the spectra of several seeds, 0 left out. */
  def ensemble(spectra: Vector[ErrorSpectrum]): Vector[SpectrumBand] =
    val frequencies = spectra.headOption.fold(Vector.empty)(_.frequencies)
    frequencies.indices.drop(1).toVector.map: band =>
      val powers = spectra.map(_.powers(band))
      SpectrumBand(frequencies(band), powers.sum / powers.size, Statistics.deviation(powers))

  private def banded(power: Array[Double], width: Int, height: Int): ErrorSpectrum =
    val last = BandsPerOctave * 31
    val sums, frequencies = new Array[Double](last + 1)
    val counts = new Array[Int](last + 1)
    loop(height): y =>
      loop(width): x =>
        val fx = Math.min(x, width - x) / width.toDouble
        val fy = Math.min(y, height - y) / height.toDouble
        val f = Math.hypot(fx, fy)
        // The diagonal's end, √½, is the end of the highest band.
        val band =
          if f == 0 then last
          else
            Math.max(
              0,
              Math.floor(BandsPerOctave * Math.log(Math.sqrt(0.5) / f) / Math.log(2)).toInt
            )
        sums(band) += power(y * width + x)
        frequencies(band) += f
        counts(band) += 1
    val bands = (last to 0 by -1).toVector.filter(counts(_) > 0)
    ErrorSpectrum(
      bands.map(b => frequencies(b) / counts(b)),
      bands.map(b => sums(b) / counts(b)),
      bands.map(counts(_))
    )

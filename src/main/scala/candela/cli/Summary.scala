package candela.cli

import candela.render.{Refused, Rendering}

import java.nio.file.Path

/** The lines at the end of a rendering. */
object Summary:

  /** `wrote x.exr, x.png  256x256, 64 spp, 3.2 s, 1.31 M samples/s, 5.20 M rays/s`; or what there
    * is of an interrupted one.
    *
    * @param standIns how much is missing and was replaced
    */
  def result(written: Vector[Path], r: Rendering, standIns: Int = 0): String =
    val missing = if standIns > 0 then s", ${Figures.count(standIns, "stand-in")}" else ""
    val names = written.mkString(", ")
    if r.isComplete then
      val rates = s"${rate(r.samplesTaken, r)} samples/s, ${rate(r.rays, r)} rays/s"
      val size = s"${r.film.width}x${r.film.height}"
      s"wrote $names  $size, ${r.samplesDone} spp, ${Figures.duration(r.seconds)}, $rates$missing"
    else
      val done = if r.samplesDone == 0 then "less than 1" else r.samplesDone.toString
      s"interrupted: wrote $names with $done of ${r.samplesPerPixel} samples per pixel$missing"

  def phases(loaded: LoadedScene, rendering: Rendering, writeSeconds: Double): String =
    Vector(
      "parse" -> loaded.parseSeconds,
      "build" -> loaded.buildSeconds,
      "render" -> rendering.seconds,
      "write" -> writeSeconds
    ).map((phase, seconds) => s"$phase ${Figures.duration(seconds)}").mkString(", ")

  def refused(r: Refused): String =
    val material = if r.material < 0 then "" else s", material ${r.material}"
    s"warning: ${Figures.count(r.count, "sample")} left out for being infinite or no number, " +
      s"the first at pixel (${r.x}, ${r.y}), sample ${r.sample}$material; to see its path, add " +
      s"--pixel ${r.x},${r.y} --sample ${r.sample} --debug"

  private def rate(count: Long, r: Rendering): String =
    Figures.metric(count / Math.max(r.seconds, 1e-9))

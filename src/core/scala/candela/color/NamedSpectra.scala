package candela.color

import java.util.concurrent.ConcurrentHashMap

/** Spectra known by name, as in pbrt-v4, each tabulated in a file that cites its source.
  *
  * Illuminants have relative power only. Two differ from pbrt-v4's tables, which do not have the
  * published chromaticities: `stdillum-D50` by up to 14 % beyond 560 nm, `stdillum-F10` at 605 nm.
  */
object NamedSpectra:

  /** How pbrt-v4's image differs, if its table of a spectrum is a wrong one. */
  def difference(name: String): Option[String] = Option.when(name == "stdillum-D50"):
    s"pbrt-v4's table of `$name` is not the published one, which is used here; light of it has 8 " +
      "% more red here"

  /** Place of a spectrum: a file and a column after that of wavelengths. */
  private final class Place(val file: String, val column: Int = 1)

  private val locations: Vector[(String, Place)] =
    val metals = Vector("Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2")
      .flatMap(m => Vector(s"metal-$m-eta", s"metal-$m-k"))
    val glasses = Vector("BK7", "BAF10", "FK51A", "LASF9", "F5", "F10", "F11").map(g => s"glass-$g")
    val fluorescent = (1 to 12).map(i => s"stdillum-F$i" -> Place("fluorescent", i))
    val channels = Vector("r", "g", "b").zipWithIndex
    val sensors = CameraSensor.names.flatMap: sensor =>
      channels.map((c, i) => s"${sensor}_$c" -> Place(CameraSensor.file(sensor), i + 1))
    (metals ++ glasses).map(name => name -> Place(name)) ++
      Vector("A", "D50", "D65").map(name => s"stdillum-$name" -> Place(name)) ++ fluorescent ++
      Vector("illum-acesD60" -> Place("acesD60")) ++ sensors

  val names: Vector[String] = locations.map(_._1)

  /** The names, with long families in short. */
  def inWords: String =
    val short =
      names.filterNot(n => byName(n).file == "fluorescent" || byName(n).file.startsWith("camera"))
    short.sorted.mkString("", ", ", ", stdillum-F1 to -F12, sensors' curves such as canon_eos_5d_r")

  private val byName = locations.toMap

  /** Those read so far: each set of wavelengths asks anew. */
  private val read = ConcurrentHashMap[String, Spectrum]()

  /** The tabulated function, constant outside its range. */
  def apply(name: String): Option[Spectrum] = byName.get(name).map: location =>
    read.computeIfAbsent(
      name,
      _ =>
        val rows = Colorimetry.table(location.file)
        Spectrum(rows.map(_(0)), rows.map(_(location.column)))
    )

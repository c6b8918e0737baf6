package candela.mitsuba

import candela.diagnostics.{Code, Suggest}
import candela.color.Rgb

import java.util.Locale

/** Materials that Mitsuba knows by name. */
object Indices:

  /** Indices of refraction. */
  private val dielectrics: Map[String, Double] = Map(
    "vacuum" -> 1.0,
    "helium" -> 1.000036,
    "hydrogen" -> 1.000132,
    "air" -> 1.000277,
    "carbon dioxide" -> 1.00045,
    "water" -> 1.333,
    "acetone" -> 1.36,
    "ethanol" -> 1.361,
    "carbon tetrachloride" -> 1.461,
    "glycerol" -> 1.4729,
    "benzene" -> 1.501,
    "silicone oil" -> 1.52045,
    "bromine" -> 1.661,
    "water ice" -> 1.31,
    "fused quartz" -> 1.458,
    "pyrex" -> 1.47,
    "acrylic glass" -> 1.49,
    "polypropylene" -> 1.49,
    "bk7" -> 1.5046,
    "sodium chloride" -> 1.544,
    "amber" -> 1.55,
    "pet" -> 1.575,
    "diamond" -> 2.419
  )

  /** Index and absorption of metals, as colours: red, green and blue of both. As Mitsuba's RGB
    * variants compute them from measured spectra.
    */
  private val metals: Map[String, (Rgb, Rgb)] =
    val lines = """
      a-C 2.94405 2.22714 1.96816 .887465 .799299 .81529
      Ag .155276 .116728 .138388 4.82835 3.12222 2.1469
      Al 1.6575 .880405 .521244 9.22381 6.2695 4.837
      AlAs 3.6053 3.23294 2.21632 .000679437 0 .00751271
      Au .143036 .375307 1.44205 3.983 2.38556 1.60336
      Be 4.18501 3.18503 2.78406 3.83547 3.01012 2.86899
      Cr 4.36967 2.91651 1.6549 5.20655 4.23131 3.7547
      CsI 2.1449 1.70232 1.66243 0 0 0
      Cu .201005 .92375 1.10222 3.91326 2.45305 2.14209
      Cu2O 3.55177 2.94987 2.75188 .114207 .193897 .606134
      CuO 3.24754 2.44781 2.21022 .52109 .570031 .722179
      d-C 2.70872 2.31883 2.2289 0 0 0
      Hg 2.39894 1.44003 .90957 6.32759 4.37192 3.42176
      HgTe 4.77904 3.2312 2.6599 1.63161 1.58081 1.72929
      Ir 3.0863 2.08219 1.61791 5.59215 4.06709 3.26731
      K .0640432 .0464098 .0381849 2.1042 1.34894 .913126
      Li .265791 .195618 .220949 3.54015 2.31112 1.66861
      MgO 2.08958 1.65072 1.59488 0 0 0
      Mo 4.48397 3.52513 2.77631 4.11144 3.42083 3.15061
      Na .0602694 .0561409 .0619884 3.17927 2.11249 1.57904
      Nb 3.42007 2.79009 2.39563 3.44139 2.73767 2.57975
      Ni 2.3673 1.66337 1.46708 4.49881 3.05015 2.34544
      Rh 2.58579 1.86022 1.55426 6.78226 4.70299 3.97607
      Se 4.05831 2.84294 2.82085 .75405 .638444 .521808
      SiC 3.17234 2.52597 2.47937 0 0 .0000101925
      SnTe 4.52425 1.98164 1.28159 0 0 0
      Ta 2.06272 2.39294 2.62793 2.40836 1.74149 1.94703
      Te 7.39023 4.4821 2.63711 3.25602 3.52706 3.29205
      ThF4 1.83071 1.44223 1.38765 0 0 0
      TiC 3.70053 2.83742 2.58229 3.26564 2.35159 2.17279
      TiN 1.64845 1.15052 1.37982 3.36833 1.9435 1.10207
      TiO2 3.45661 2.80174 2.90517 .000105265 0 .000652887
      V 4.27758 3.51295 2.76107 3.4913 2.88945 3.11152
      VC 3.65757 2.75274 2.53267 3.0683 2.19869 1.96319
      VN 2.8656 2.11919 1.94009 3.03224 2.05612 1.61631
      W 4.37082 3.30025 2.99841 3.50064 2.60487 2.27323"""
    lines.linesIterator.map(_.trim.split(' ')).filter(_.length == 7).map: row =>
      val x = row.drop(1).map(_.toFloat)
      row(0) -> (Rgb(x(0), x(1), x(2)), Rgb(x(3), x(4), x(5)))
    .toMap

  /** Index of refraction and absorption; copper's if unknown. */
  def metal(name: String, in: Properties): (Rgb, Rgb) =
    metals.getOrElse(
      name.stripSuffix("_palik"), {
        val help = Suggest.help(name, metals.keys)
        in.session.error(Code.UnknownType, in.posOf("material"), s"unknown metal `$name`", help)
        metals("Cu")
      }
    )

  /** A property that is a number or the name of a material. */
  def index(in: Properties, name: String, default: String): Double =
    in.note(name, "float, string", default)
    in.property(name).map(_.value) match
      case Some(Value.Text(material)) =>
        dielectrics.getOrElse(
          material.toLowerCase(Locale.ROOT), {
            val help = Suggest.help(material, dielectrics.keys)
            in.session.error(
              Code.UnknownType,
              in.posOf(name),
              s"unknown dielectric `$material`",
              help
            )
            1.5
          }
        )
      case Some(_) =>
        val number = in.number(name, dielectrics(default))
        if number <= 0 then
          val message = s"`$name` must be above 0, found $number"
          in.session.error(Code.ParameterValue, in.posOf(name), message)
        number
      case None => dielectrics(default)

  /** Index of the inside relative to the outside. */
  def relative(in: Properties, inside: String): Double =
    index(in, "int_ior", inside) / index(in, "ext_ior", "air")

package candela.mitsuba

import candela.color.Rgb
import candela.diagnostics.{Code, Suggest}

import java.util.Locale

/** Coefficients of a medium, in 1 / scene unit, and its index of refraction. */
private[mitsuba] final case class Coefficients(sigmaA: Rgb, sigmaS: Rgb, eta: Double):
  def *(scale: Float): Coefficients = copy(sigmaA = sigmaA * scale, sigmaS = sigmaS * scale)

/** Media that Mitsuba 0.6 knows by name. */
private[mitsuba] object Presets:

  /** @param g asymmetry, by which 0.6 reduces scattering that it then takes for isotropic */
  private final case class Measured(sigmaS: Rgb, sigmaA: Rgb, g: Rgb, eta: Double)

  /** Scattering and absorption, in 1/mm: red, green and blue.
    *
    * Source: Jensen et al., "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001.
    */
  private val reduced = """
      Apple: 2.29 2.39 1.97 0.003 0.0034 0.046
      Chicken1: 0.15 0.21 0.38 0.0015 0.077 0.19
      Chicken2: 0.19 0.25 0.32 0.0018 0.088 0.2
      Cream: 7.38 5.47 3.15 0.0002 0.0028 0.0163
      Ketchup: 0.18 0.07 0.03 0.061 0.97 1.45
      Marble: 2.19 2.62 3 0.0021 0.0041 0.0071
      Potato: 0.68 0.7 0.55 0.0024 0.009 0.12
      Skimmilk: 0.7 1.22 1.9 0.0014 0.0025 0.0142
      Skin1: 0.74 0.88 1.01 0.032 0.17 0.48
      Skin2: 1.09 1.59 1.79 0.013 0.07 0.145
      Spectralon: 11.6 20.4 14.9 0 0 0
      Wholemilk: 2.55 3.21 3.77 0.0011 0.0024 0.014"""

  /** Likewise, and asymmetry.
    *
    * Source: Narasimhan et al., "Acquiring Scattering Properties of Participating Media by
    * Dilution", SIGGRAPH 2006.
    */
  private val diluted =
    """
      Lowfat Milk: 13.1157 15.4445 17.9572 0.00287 0.00575 0.0115 0.932 0.902 0.859
      Reduced Milk: 13.7335 15.6003 17.8007 0.00256 0.00511 0.01278 0.819 0.797 0.746
      Regular Milk: 18.2052 20.3826 22.3698 0.00153 0.0046 0.01993 0.75 0.714 0.681
      Espresso: 7.78262 8.1305 8.53875 4.79838 6.57512 8.84925 0.907 0.896 0.88
      Mint Mocha Coffee: 3.51133 4.14383 5.59667 3.772 5.82283 7.82 0.91 0.907 0.914
      Lowfat Soy Milk: 2.03838 2.32875 3.90281 0.00144 0.00719 0.03594 0.85 0.853 0.842
      Regular Soy Milk: 4.66325 5.20183 8.74575 0.00192 0.00958 0.06517 0.873 0.858 0.832
      Lowfat Chocolate Milk: 9.8371 11.4954 13.1629 0.0115 0.0368 0.1564 0.934 0.927 0.916
      Regular Chocolate Milk: 10.5685 13.1416 15.2202 0.01006 0.04313 0.14375 0.862 0.838 0.806
      Coke: 0.00254 0.00299 0 0.10014 0.16503 0.2468 0.965 0.972 0
      Pepsi: 0.00083 0.00203 0 0.09164 0.14158 0.20729 0.926 0.979 0
      Sprite: 0.00011 0.00014 0.00014 0.00189 0.00183 0.002 0.943 0.953 0.952
      Gatorade: 0.03668 0.04488 0.05742 0.02479 0.01929 0.00888 0.933 0.933 0.935
      Chardonnay: 0.00021 0.00033 0.00048 0.01078 0.01186 0.024 0.914 0.958 0.975
      White Zinfandel: 0.00022 0.00033 0.00046 0.01207 0.01618 0.01984 0.919 0.943 0.972
      Merlot: 0.00081 0 0 0.11632 0.25191 0.29434 0.974 0 0
      Budweiser Beder: 0.00029 0.00055 0.00059 0.01149 0.02491 0.05779 0.917 0.956 0.982
      Coors Light Beer: 0.00062 0.00127 0 0.00616 0.01398 0.03498 0.918 0.966 0
      Clorox: 0.02731 0.03302 0.03695 0.00335 0.01489 0.0263 0.912 0.905 0.892
      Apple Juice: 0.00257 0.00311 0.00413 0.01296 0.02374 0.05218 0.947 0.949 0.945
      Cranberry Juice: 0.00196 0.00238 0.00301 0.03944 0.09422 0.12426 0.947 0.951 0.974
      Grape Juice: 0.00138 0 0 0.10404 0.23958 0.29325 0.961 0 0
      Ruby Grapefruit Juice: 0.15496 0.15391 0.15995 0.08587 0.18314 0.25262 0.929 0.929 0.931
      White Grapefruit Juice: 0.50499 0.52742 0.75282 0.0138 0.01883 0.05678 0.548 0.545 0.565
      Shampoo: 0.00797 0.00874 0.01127 0.01411 0.04569 0.06172 0.91 0.905 0.92
      Strawberry Shampoo: 0.00215 0.00245 0.00253 0.01449 0.05796 0.07582 0.927 0.935 0.994
      Head & Shoulders Shampoo: 0.26747 0.27696 0.29574 0.08462 0.15688 0.20365 0.911 0.896 0.884
      Lemon Tea Powder: 0.74489 0.83823 1.00158 2.42881 4.57573 7.2127 0.946 0.946 0.949
      Orange Juice Powder: 0.00193 0.00213 0.00226 0.00145 0.00344 0.00786 0.919 0.918 0.922
      Pink Lemonade Powder: 0.00123 0.00133 0.00131 0.00116 0.00237 0.0032 0.902 0.902 0.904
      Cappuccino Powder: 12.2094 16.4659 29.2727 35.8441 49.547 61.0844 0.849 0.843 0.926
      Salt Powder: 0.13805 0.15677 0.17865 0.28415 0.3257 0.34148 0.802 0.793 0.821
      Sugar Powder: 0.00282 0.00315 0.00393 0.01264 0.03105 0.05012 0.921 0.919 0.931
      Suisse Mocha Powder: 30.0848 33.4452 38.7191 17.502 27.0044 35.4334 0.907 0.894 0.888
      Pacific Ocean Surface Water: .0018 .00183 .00228 .03184 .03132 .03015 .902 .825 .914"""

  private val measured: Map[String, Measured] =
    (rows(reduced, 1.3) ++ rows(diluted, 1.33)).toMap

  private def rows(text: String, eta: Double): Iterator[(String, Measured)] =
    for case Array(name, numbers) <- text.linesIterator.map(_.trim.split(": ")) yield
      val x = numbers.split(' ').map(_.toFloat)
      def triple(i: Int) = if i < x.length then Rgb(x(i), x(i + 1), x(i + 2)) else Rgb.Black
      // Marble is denser
      name.toLowerCase(Locale.ROOT) ->
        Measured(triple(0), triple(3), triple(6), if name == "Marble" then 1.5 else eta)

  /** In 0.6, the unit of media is a hundredth of that of the measurements. */
  private val PerUnit = 100f

  /** The medium that an object describes: by name, by absorption and scattering, or by extinction
    * and albedo. Scattering is reduced by `g`.
    */
  def coefficients(in: Properties, colors: Colors): Coefficients =
    val name = in.text("material", "skin1")
    val preset = measured.getOrElse(
      // 0.6 misspells one
      name.toLowerCase(Locale.ROOT).replace("budweiser beer", "budweiser beder"), {
        in.session.error(
          Code.UnknownType,
          in.posOf("material"),
          s"unknown medium `$name`",
          Suggest.help(name, measured.keys)
        )
        measured("skin1")
      }
    )
    val (s, a) = (preset.sigmaS * PerUnit, preset.sigmaA * PerUnit)
    def given_(name: String, default: Rgb) = colors.fixed(in, name, default, Role.Unbounded)
    val (sigmaS, sigmaA) =
      if in.contains("sigma_t") || in.contains("albedo") then
        val sigmaT = given_("sigma_t", s + a)
        val scattering = sigmaT * given_("albedo", s / (s + a))
        (scattering, sigmaT - scattering)
      else (given_("sigma_s", s), given_("sigma_a", a))
    val isNamed = Seq("sigma_s", "sigma_a", "sigma_t", "albedo").forall(!in.contains(_))
    val g = given_("g", if isNamed then preset.g else Rgb.Black)
    val eta =
      if in.contains("int_ior") || in.contains("ext_ior") then Indices.relative(in, "bk7")
      else preset.eta
    Coefficients(sigmaA, sigmaS * (Rgb.White - g), eta) * in.number("scale", 1).toFloat

package candela.settings

/** What paths carry: three numbers, or light at three wavelengths; the scene decides if `Auto`. */
enum ColorMode:
  case Auto, Rgb, Spectral

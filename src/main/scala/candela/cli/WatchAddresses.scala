package candela.cli

import candela.watch.WatchAddress

/** The value of `--watch`: `8642`, `192.168.0.7:8642`, `[::1]:8642`. */
private[cli] object WatchAddresses:

  def parse(text: String): Option[WatchAddress] =
    text match
      case s"[$host]:$digits" => port(digits).map(p => WatchAddress(Some(host), Some(p)))
      case s"$host:$digits" if host.nonEmpty && !host.contains(':') =>
        port(digits).map(p => WatchAddress(Some(host), Some(p)))
      case digits => port(digits).map(p => WatchAddress(None, Some(p)))

  /** Whether a word of the command line is one, rather than a scene. */
  def isOne(text: String): Boolean = parse(text).isDefined

  private def port(digits: String): Option[Int] =
    digits.toIntOption.filter(p => p >= 0 && p < 65536)

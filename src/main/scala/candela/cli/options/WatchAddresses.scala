package candela.cli.options

import candela.job.SceneFormat
import candela.watch.{TevDisplay, WatchAddress}

import java.nio.file.{Files, Path}

import scala.util.Try

/** The value of `--watch`: `8642`, `192.168.0.7:8642`, `[::1]:8642`. */
private[cli] object WatchAddresses:

  def parse(text: String): Option[WatchAddress] =
    text match
      case s"[$host]:$digits" => port(digits).map(p => WatchAddress(Some(host), Some(p)))
      case s"$host:$digits" if host.nonEmpty && !host.contains(':') =>
        port(digits).map(p => WatchAddress(Some(host), Some(p)))
      case digits => port(digits).map(p => WatchAddress(None, Some(p)))

  /** The value of `--display-server`: `localhost:14158`, or a host only. */
  def display(text: String): Option[(String, Int)] =
    parse(text) match
      case Some(WatchAddress(Some(host), Some(port))) => Some((host, port))
      case None if text.nonEmpty && !text.contains(':') => Some((text, TevDisplay.DefaultPort))
      case _ => None

  /** Whether a word of the command line is one, or a wrong one: neither a scene nor an option. */
  def isOne(text: String): Boolean =
    def isScene = Try(Path.of(text)).toOption.exists: file =>
      SceneFormat.named(file).isDefined || Files.exists(file)
    parse(text).isDefined || (text.nonEmpty && !text.startsWith("-") && !isScene)

  private def port(digits: String): Option[Int] =
    digits.toIntOption.filter(p => p >= 0 && p < 65536)

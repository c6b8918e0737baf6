package candela.watch

import java.net.{Inet6Address, InetAddress, NetworkInterface}
import java.security.SecureRandom
import java.util.{HexFormat, Locale}

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** Who may look at a page: on a loopback address every program of this machine, elsewhere those who
  * know the token in the link.
  */
final class Access(address: InetAddress, val port: Int):
  private val token: Option[String] =
    Option.when(!address.isLoopbackAddress):
      val bytes = new Array[Byte](16)
      SecureRandom().nextBytes(bytes)
      HexFormat.of.formatHex(bytes)

  /** Path under which everything lies, from slash to slash. */
  val root: String = token.fold("/")(t => s"/$t/")

  val link: String =
    val reachable = if address.isAnyLocalAddress then Access.ownAddress else address
    s"http://${Access.written(reachable)}:$port$root"

  /** Whether a request may be answered. Pages of other servers can't know the token; without one,
    * they are recognised by the names that their requests give.
    *
    * @param host   the request's header `Host`
    * @param origin its header `Origin`, if there is one
    */
  def allows(host: Option[String], origin: Option[String]): Boolean =
    token.isDefined ||
      (host.exists(Access.isLoopback) &&
        origin.forall(o => host.exists(h => o.equalsIgnoreCase(s"http://$h"))))

private object Access:

  /** Whether it names this machine, with any port, as behind a tunnel. Any other name is an attempt
    * to make a browser mistake another server's page for one of this machine. Addresses are safe:
    * nobody else can be at them.
    */
  private def isLoopback(host: String): Boolean =
    host.toLowerCase(Locale.ROOT).replaceFirst(":\\d+$", "") match
      case "localhost" => true
      case s"[$literal]" if literal.contains(':') =>
        // With a colon, it is never looked up as a name.
        Try(InetAddress.getByName(literal)).toOption.exists(_.isLoopbackAddress)
      case name => name.matches("127(\\.\\d{1,3}){3}")

  /** An address at which other machines may reach this one, if there is one. */
  private def ownAddress: InetAddress =
    val candidates =
      for
        network <- Try(NetworkInterface.networkInterfaces.iterator.asScala.toVector)
          .getOrElse(Vector.empty).sortBy(_.getIndex)
        if Try(network.isUp && !network.isLoopback).getOrElse(false)
        address <- network.inetAddresses.iterator.asScala
        if !address.isLinkLocalAddress
      yield address
    candidates.find(!_.isInstanceOf[Inet6Address]).orElse(candidates.headOption)
      .getOrElse(InetAddress.getLoopbackAddress)

  /** As part of a link: `127.0.0.1`, `[fe80::1%25eth0]` (RFC 5952, RFC 6874). */
  private[watch] def written(address: InetAddress): String =
    val text = address.getHostAddress
    if !text.contains(':') then text
    else
      val zeros = raw"\b0(?::0)+\b".r.findAllMatchIn(text).toVector
      val short = zeros.maxByOption(_.matched.length).fold(text): run =>
        s"${run.before.toString.stripSuffix(":")}::${run.after.toString.stripPrefix(":")}"
      s"[${short.replace("%", "%25")}]"

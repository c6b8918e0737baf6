package candela.watch

import java.net.InetAddress
import java.security.SecureRandom
import java.util.HexFormat

/** Who may look at a page: on the loopback address every program of this machine, elsewhere those
  * who know the token in the link.
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
    val host =
      if address.isAnyLocalAddress then InetAddress.getLocalHost.getHostName
      else if address.getHostAddress.contains(':') then s"[${address.getHostAddress}]"
      else address.getHostAddress
    s"http://$host:$port$root"

  /** Whether a request may be answered. Pages of other servers can't know the token; without one,
    * they are recognised by the names that their requests give.
    *
    * @param host   the request's header `Host`
    * @param origin its header `Origin`, if there is one
    */
  def allows(host: Option[String], origin: Option[String]): Boolean =
    token.isDefined ||
      (host.exists(h => Access.Loopback(h.stripSuffix(s":$port"))) &&
        origin.forall(o => host.exists(h => o == s"http://$h")))

object Access:
  /** Names of this machine. Any other is an attempt to make a browser mistake one for it. */
  private val Loopback = Set("localhost", "127.0.0.1", "[::1]")

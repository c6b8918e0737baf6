package candela.watch

import org.scalatest.funsuite.AnyFunSuite

import java.net.InetAddress

class AccessSuite extends AnyFunSuite:
  private def at(address: String) = Access(InetAddress.getByName(address), 8642)

  test("a page of this machine is answered by all of its names, also behind a tunnel"):
    val access = at("127.0.0.5")
    for
      name <-
        Vector("localhost", "LocalHost", "127.0.0.1", "127.0.0.5", "[::1]", "[0:0:0:0:0:0:0:1]")
      port <- Vector("", ":8642", ":9000")
    do
      val host = s"$name$port"
      assert(access.allows(Some(host), None), host)
      assert(access.allows(Some(host), Some(s"http://$host")), host)
      assert(!access.allows(Some(host), Some("http://example.com")), host)
      assert(!access.allows(Some(host), Some("null")), host)

  test("other names are attempts to make a browser mistake a page for another one's"):
    val names =
      Vector("example.com", "127.0.0.1.example.com", "localhost.example.com", "10.0.0.1") ++
        Vector("[::2]", "[example.com:1]", "127.0.0", "", "example.com:127.0.0.1")
    for name <- names do assert(!at("127.0.0.1").allows(Some(name), None), name)
    assert(!at("127.0.0.1").allows(None, None))

  test("links have the short form of addresses, which browsers use"):
    def link(address: String) = at(address).link
    assert(link("127.1.2.3") == "http://127.1.2.3:8642/")
    assert(link("::1") == "http://[::1]:8642/")
    def written(address: String) = Access.written(InetAddress.getByName(address))
    assert(written("2001:db8:0:0:1:0:0:0") == "[2001:db8:0:0:1::]")
    assert(written("2001:db8::10:0:2") == "[2001:db8::10:0:2]")
    assert(written("1:2:3:4:5:6:7:8") == "[1:2:3:4:5:6:7:8]")
    assert(written("::") == "[::]")
    assert(link("10.1.2.3").matches("http://10\\.1\\.2\\.3:8642/[0-9a-f]{32}/"))

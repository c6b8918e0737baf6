import java.io.IOException;
import java.io.InputStream;
import java.net.InetSocketAddress;
import java.net.ProxySelector;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.security.MessageDigest;
import java.time.Duration;
import java.util.HexFormat;

/** What curl, wget and sha256sum do, for machines that have none of them; Java runs this file as it
  * is.
  *
  * <p>`get URL FILE` fetches; `sha256 FILE` prints a sum; `keep URL SUM FILE` makes sure that the
  * file is there and has the sum, and fetches it if not.
  */
class Fetch {
  public static void main(String[] args) throws Exception {
    try {
      switch (args[0]) {
        case "get" -> get(URI.create(args[1]), Path.of(args[2]));
        case "sha256" -> System.out.println(sha256(Path.of(args[1])));
        case "keep" -> keep(URI.create(args[1]), args[2], Path.of(args[3]));
        default -> throw new IOException("no command " + args[0]);
      }
    } catch (IOException e) {
      System.err.println("sbt: " + (e.getMessage() == null ? e : e.getMessage()));
      System.exit(1);
    }
  }

  static void keep(URI from, String sum, Path to) throws Exception {
    if (Files.exists(to) && sha256(to).equals(sum)) return;
    System.err.println("sbt: fetching " + from);
    Files.createDirectories(to.getParent());
    Path part = Files.createTempFile(to.getParent(), "launcher", ".part");
    try {
      get(from, part);
      String found = sha256(part);
      if (!found.equals(sum))
        throw new IOException("the file from " + from + " is not the expected one: SHA-256 should be "
            + sum + ", found " + found);
      // One step, so that two first starts at once do no harm
      Files.move(part, to, StandardCopyOption.REPLACE_EXISTING);
    } finally {
      Files.deleteIfExists(part);
    }
  }

  static void get(URI from, Path to) throws Exception {
    var builder = HttpClient.newBuilder()
        .followRedirects(HttpClient.Redirect.NORMAL)
        .connectTimeout(Duration.ofSeconds(20));
    String proxy = System.getenv("https_proxy");
    if (proxy == null) proxy = System.getenv("HTTPS_PROXY");
    if (System.getProperty("https.proxyHost") == null && proxy != null && !proxy.isBlank()) {
      URI at = URI.create(proxy.contains("://") ? proxy : "http://" + proxy);
      int port = at.getPort() < 0 ? 80 : at.getPort();
      builder.proxy(ProxySelector.of(new InetSocketAddress(at.getHost(), port)));
    } else builder.proxy(ProxySelector.getDefault());
    var answer = builder.build()
        .send(HttpRequest.newBuilder(from).build(), HttpResponse.BodyHandlers.ofFile(to));
    if (answer.statusCode() != 200) throw new IOException(from + " answered " + answer.statusCode());
  }

  static String sha256(Path file) throws Exception {
    var digest = MessageDigest.getInstance("SHA-256");
    try (InputStream in = Files.newInputStream(file)) {
      byte[] buffer = new byte[1 << 16];
      for (int n = in.read(buffer); n >= 0; n = in.read(buffer)) digest.update(buffer, 0, n);
    }
    return HexFormat.of().formatHex(digest.digest());
  }
}

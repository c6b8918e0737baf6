import java.io.File;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/**
 * How long a render takes that is next to none: 64 x 64 pixels with one sample each, start-up
 * included, of the staged program and of pbrt where PBRT_V3 and PBRT_V4 say that it is.
 *
 *   ./sbt stage && java jmh/StartUp.java [runs, otherwise 20] [JDK's folder...]
 *
 * The programs take turns, and all run once before, unmeasured. With JDKs, each is measured by
 * itself; otherwise the one that the launcher chooses.
 */
class StartUp {
  public static void main(String[] args) throws Exception {
    int runs = args.length > 0 ? Integer.parseInt(args[0]) : 20;
    Path image = Files.createTempDirectory("start-up").resolve("image.exr");
    String out = "--outfile=" + image;
    String candela = Path.of("target/universal/stage/bin/candela").toAbsolutePath().toString();
    String v3 = Path.of("bench/scenes/start-up.v3.pbrt").toAbsolutePath().toString();
    String v4 = Path.of("bench/scenes/start-up.v4.pbrt").toAbsolutePath().toString();

    Map<String, ProcessBuilder> programs = new LinkedHashMap<>();
    List<String> jdks = new ArrayList<>(Arrays.asList(args));
    if (!jdks.isEmpty()) jdks.remove(0);
    if (jdks.isEmpty()) jdks.add("");
    for (String jdk : jdks) {
      for (String archive : List.of("", "none")) {
        String words = (jdk.isEmpty() ? "" : ", " + new File(jdk).getName())
            + (archive.isEmpty() ? "" : ", no archive of classes");
        for (String scene : List.of(v3, v4)) {
          var program = program(candela, scene, out, "--quiet");
          if (!jdk.isEmpty()) program.environment().put("CANDELA_JAVA", jdk);
          if (!archive.isEmpty()) program.environment().put("CANDELA_ARCHIVE", archive);
          programs.put("Candela, " + (scene.equals(v3) ? "v3" : "v4") + " scene" + words, program);
        }
        if (archive.isEmpty()) {
          var make = program(candela);
          if (!jdk.isEmpty()) make.environment().put("CANDELA_JAVA", jdk);
          make.environment().put("CANDELA_ARCHIVE", "make");
          make.start().waitFor();
        }
      }
    }
    String pbrt3 = System.getenv("PBRT_V3");
    String pbrt4 = System.getenv("PBRT_V4");
    if (pbrt3 != null) programs.put("pbrt-v3", program(pbrt3, "--quiet", out, v3));
    if (pbrt4 != null) programs.put("pbrt-v4", program(pbrt4, "--quiet", out, v4));

    Map<String, List<Double>> seconds = new LinkedHashMap<>();
    for (int run = 0; run <= runs; run++) {
      for (var entry : programs.entrySet()) {
        long begin = System.nanoTime();
        int code = entry.getValue().start().waitFor();
        double time = (System.nanoTime() - begin) * 1e-9;
        if (code != 0) throw new IllegalStateException(entry.getKey() + " ended with " + code);
        if (run > 0) seconds.computeIfAbsent(entry.getKey(), k -> new ArrayList<>()).add(time);
      }
    }
    System.out.println("| program | fastest (s) | median (s) | slowest (s) |");
    System.out.println("|---|---|---|---|");
    for (var entry : seconds.entrySet()) {
      var sorted = entry.getValue().stream().sorted().toList();
      int n = sorted.size();
      double median = (sorted.get((n - 1) / 2) + sorted.get(n / 2)) / 2;
      System.out.printf(Locale.ROOT, "| %s | %.3f | %.3f | %.3f |%n",
          entry.getKey(), sorted.get(0), median, sorted.get(n - 1));
    }
  }

  static ProcessBuilder program(String... words) {
    return new ProcessBuilder(words)
        .redirectOutput(ProcessBuilder.Redirect.DISCARD)
        .redirectError(ProcessBuilder.Redirect.DISCARD);
  }
}

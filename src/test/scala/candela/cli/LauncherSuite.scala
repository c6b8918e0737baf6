package candela.cli

import candela.testing.Eventually.eventually
import candela.testing.{StagedProgram, TempFolder}

import java.nio.file.attribute.FileTime
import java.nio.file.{Files, Path, StandardCopyOption}

import scala.util.Try

import org.scalatest.funsuite.AnyFunSuite

/** What `src/universal/bin/candela` does before Java runs. */
class LauncherSuite extends AnyFunSuite:
  private val None_ = "CANDELA_ARCHIVE" -> "none"
  private val Make = Map("CANDELA_ARCHIVE" -> "make")

  private def staged[A](body: StagedProgram => A): A =
    assume(Files.isExecutable(Path.of("/bin/sh")))
    TempFolder.use(folder => body(StagedProgram(folder)))

  private def javaOf(jdk: Path) = jdk.resolve("bin/java").toString

  test("the newest JDK is chosen, wherever it is, by number and not by alphabet"):
    staged: p =>
      val _ = p.jdk("91.0.2")
      val newest = p.jdk("101-ea")
      val atHome = p.jdk("99.1", in = "elsewhere")
      assert(p.run(env = Map(None_, "JAVA_HOME" -> atHome.toString)).code == 0)
      assert(p.starts.map(_.head) == Vector(javaOf(newest)))

  test("CANDELA_JAVA is used instead, be it a folder or its java"):
    staged: p =>
      val _ = p.jdk("101")
      val asked = p.jdk("17.0.1", in = "elsewhere")
      for given_ <- Seq(asked.toString, javaOf(asked)) do
        assert(p.run(env = Map(None_, "CANDELA_JAVA" -> given_)).code == 0)
      assert(p.starts.map(_.head) == Vector.fill(2)(javaOf(asked)))

  test("the runtime in the program's folder is used, unless a newer JDK has SIMD kernels, too"):
    staged: p =>
      val vectors = "java.base jdk.incubator.vector"
      val runtime = Files.move(p.jdk("98.0.1", in = "x", modules = vectors), p.runtime)
      def chosen =
        assert(p.run().code == 0)
        p.starts.last.head
      val _ = p.jdk("97", modules = vectors)
      val _ = p.jdk("98.0.9", modules = vectors)
      val _ = p.jdk("99")
      assert(chosen == runtime.toRealPath().resolve("bin/java").toString)
      val newer = p.jdk("100", modules = vectors)
      assert(chosen == javaOf(newer))

  test("a JDK that is too old or not there is a message and exit code 2, and nothing starts"):
    staged: p =>
      val old = p.jdk("11.0.9", in = "elsewhere")
      val tooOld = p.run(env = Map("CANDELA_JAVA" -> old.toString))
      assert(tooOld.code == 2)
      assert(
        tooOld.err ==
          "candela: CANDELA_JAVA must be JDK 17 or newer, found version 11.0.9\n"
      )
      val missing = p.run(env = Map("CANDELA_JAVA" -> "/no/jdk"))
      assert(missing.code == 2)
      assert(missing.err.startsWith("candela: CANDELA_JAVA must be a JDK, found /no/jdk"))
      assert(p.starts.isEmpty)

  test("each JDK gets the options that it knows"):
    staged: p =>
      for (version, options) <- Seq("17.0.1" -> "options", "25.0.1" -> "options-25") do
        val jdk = p.jdk(version, in = version)
        assert(p.run(env = Map(None_, "CANDELA_JAVA" -> jdk.toString)).code == 0)
        assert(p.starts.last(1) == s"@${p.lib.toRealPath().resolve(options)}")

  test("words reach the program as they are, behind JAVA_OPTS, and its exit code comes back"):
    staged: p =>
      val _ = p.jdk("99", java = "echo out; echo err >&2; exit 3")
      val ended = p.run(Seq("a b", "*", "$HOME", ""), Map(None_, "JAVA_OPTS" -> "-Xmx1g  -Da=*"))
      assert((ended.code, ended.out, ended.err) == (3, "out\n", "err\n"))
      val words = p.starts.head
      assert(words.drop(4).take(2) == Vector("-Xmx1g", "-Da=*"))
      val jar = p.lib.toRealPath().resolve("candela.jar").toString
      val rest = Vector("-cp", jar, "candela.cli.Main", "a b", "*", "$HOME", "")
      assert(words.drop(6).dropRight(1) == rest)

  test("a collector that is asked for replaces ours: Java refuses two"):
    staged: p =>
      val _ = p.jdk("99")
      val ours = "-XX:-UseParallelGC"
      for
        variable <- Seq("JAVA_OPTS", "JDK_JAVA_OPTIONS", "JAVA_TOOL_OPTIONS")
        collector <- Seq("G1", "Serial", "Z")
      do
        val options = s"-Da=b -XX:+Use${collector}GC"
        assert(p.run(env = Map(None_, variable -> options)).code == 0)
        val words = p.starts.last
        assert(words.contains(ours), options)
        if variable == "JAVA_OPTS" then
          assert(words.indexOf(ours) < words.indexOf(s"-XX:+Use${collector}GC")): Unit
      for options <- Seq("", "-XX:+UseParallelGC", "-XX:+UseGCOverheadLimit") do
        assert(p.run(env = Map(None_, "JAVA_OPTS" -> options)).code == 0)
        assert(!p.starts.last.contains(ours), options)

  test("names of files are UTF-8 where there is no locale; a locale stays as it is"):
    staged: p =>
      val _ = p.jdk("99", java = "printf %s \"${LC_ALL:-$LANG}\"")
      def locale(all: String, lang: String) =
        p.run(env = Map(None_, "LC_ALL" -> all, "LC_CTYPE" -> "", "LANG" -> lang)).out
      for (all, lang) <- Seq("C" -> "", "POSIX" -> "de_DE.UTF-8", "" -> "", "" -> "C") do
        assert(locale(all, lang) == "C.UTF-8")
      assert(locale("", "de_DE.ISO-8859-1") == "de_DE.ISO-8859-1")
      assert(locale("ja_JP.UTF-8", "C") == "ja_JP.UTF-8")

  test("with --spark and Spark, Spark's script starts the program; else the program does"):
    staged: p =>
      val jdk = p.jdk("99")
      val bin = Files.createDirectories(p.home.resolve("spark/bin"))
      val script = "#!/bin/sh\nprintf '%s\\n' \"$JAVA_HOME\" \"$@\"\n"
      val submit = Files.writeString(bin.resolve("spark-submit"), script)
      assert(submit.toFile.setExecutable(true))
      val words = Seq("a b.pbrt", "--spark", "spark://x:1", "--spp", "4")
      val env = Map(None_, "SPARK_HOME" -> bin.getParent.toString, "JAVA_OPTS" -> "-Da=b")
      assert(p.run(words, env).out.isEmpty && p.starts.size == 1)
      val jar = Files.writeString(p.lib.resolve("candela-spark.jar"), "jar")
      val started = p.run(words, env).out.linesIterator.toVector
      assert(started.take(3) == Vector(jdk.toString, "--master", "spark://x:1"))
      assert(
        started.drop(3).take(4) ==
          Vector("--class", "candela.cli.Main", "--driver-java-options", "-Xss4m -Da=b")
      )
      assert(started.drop(7) == jar.toRealPath().toString +: words)
      assert(p.run(Seq("--spp", "4"), env).out.isEmpty && p.starts.size == 2)
      assert(p.run(Seq("a.pbrt", "--spark", "sparc://x:1"), env).out.isEmpty && p.starts.size == 3)

  test("the program is told how people start it, which its benchmarks repeat"):
    staged: p =>
      val _ = p.jdk("99")
      assert(p.run(Seq("bench", "x.conf"), Map(None_)).code == 0)
      assert(p.starts.head.contains(s"-Dcandela.launcher=${p.launcher.toRealPath()}"))

  test("Java takes the launcher's place, so that signals reach it"):
    staged: p =>
      val _ = p.jdk("99")
      val ended = p.run()
      assert(p.starts.head.last == s"pid ${ended.pid}")

  test("it may be called through links, from a folder with spaces"):
    TempFolder.use: folder =>
      val p = StagedProgram(folder, "my stage")
      val _ = p.jdk("99")
      val link = Files.createSymbolicLink(folder.resolve("first link"), p.launcher)
      val relative = Files.createSymbolicLink(folder.resolve("second"), link.getFileName)
      assert(p.run(as = relative).code == 0)
      assert(p.starts.head.contains(p.lib.toRealPath().resolve("candela.jar").toString))

  test("an archive of classes is made when asked for, then used, and made anew with the jar"):
    staged: p =>
      val jdk = p.jdk("99")
      assert(p.run(env = Make).code == 0)
      val archive = p.lib.toRealPath().resolve(s"archives$jdk/99.aot")
      assert(p.archives(p.lib).map(_.toRealPath()) == Vector(archive))
      assert(p.starts.head.exists(_.endsWith("a.pbrt")))
      assert(p.run(Seq("x"), Map.empty).code == 0)
      assert(p.starts(1).contains(s"-XX:AOTCache=$archive"))
      assert(p.run(env = Make).code == 0 && p.starts.size == 2)
      val later = FileTime.fromMillis(Files.getLastModifiedTime(archive).toMillis + 5000)
      val _ = Files.setLastModifiedTime(p.lib.resolve("candela.jar"), later)
      assert(p.run(env = Make).code == 0 && p.starts.size == 3)

  test("the archive in a copy of the program's folder is made anew: Java would ignore it"):
    staged: p =>
      val _ = p.jdk("99")
      assert(p.run(env = Make).code == 0 && p.starts.size == 1)
      val jar = p.lib.resolve("candela.jar")
      val time = Files.getLastModifiedTime(jar)
      val copy = Files.copy(jar, p.lib.resolve("copy"))
      val _ = Files.move(copy, jar, StandardCopyOption.REPLACE_EXISTING)
      val _ = Files.setLastModifiedTime(jar, time)
      assert(p.run(env = Make).code == 0 && p.starts.size == 2)
      assert(p.run(env = Make).code == 0 && p.starts.size == 2)

  test("an archive that is cut or ends in zeros is not used, and is made anew"):
    staged: p =>
      val _ = p.jdk("99")
      assert(p.run(env = Make).code == 0)
      val archive = p.archives(p.lib).head
      val whole = Files.readAllBytes(archive)
      val half = whole.take(whole.length / 2)
      for damaged <- Seq(half, half.padTo(whole.length, 0.toByte)) do
        val _ = Files.write(archive, damaged)
        assert(p.run(env = Make).code == 0)
        assert(Files.readAllBytes(archive).sameElements(whole))
      assert(p.run(env = Map.empty).code == 0)
      assert(p.starts.last.exists(_.startsWith("-XX:AOTCache=")))

  test("each JDK has its archive, of the kind that it knows"):
    staged: p =>
      val older = p.jdk("17.0.1", in = "elsewhere")
      val _ = p.jdk("99")
      assert(p.run(env = Make).code == 0)
      assert(p.run(env = Make + ("CANDELA_JAVA" -> older.toString)).code == 0)
      assert(p.archives(p.lib).map(_.getFileName.toString).toSet == Set("99.aot", "17.0.1.jsa"))
      assert(p.run(env = Map("CANDELA_JAVA" -> older.toString)).code == 0)
      assert(p.starts.last.exists(_.startsWith("-XX:SharedArchiveFile=")))

  test("with the jar of Assimp, which changes the class path, the archive is another one"):
    staged: p =>
      val _ = p.jdk("99")
      assert(p.run(env = Make).code == 0)
      val _ = Files.writeString(p.lib.resolve("candela-assimp.jar"), "")
      assert(p.run(env = Make).code == 0)
      assert(p.archives(p.lib).map(_.getFileName.toString).toSet == Set("99.aot", "99-assimp.aot"))

  test("where the program's folder is read-only, the archive is in the user's cache"):
    staged: p =>
      val _ = p.jdk("99")
      val _ = Files.writeString(p.lib.resolve("archives"), "a file: nothing can be made in it")
      assert(p.run(env = Make).code == 0)
      val cached = p.archives(p.home.resolve(".cache/candela"))
      assert(cached.size == 1)
      assert(p.run(env = Map.empty).code == 0)
      assert(p.starts.last.contains(s"-XX:AOTCache=${cached.head}"))
      val other = Files.createDirectory(p.home.resolve("other"))
      assert(p.run(env = Make + ("XDG_CACHE_HOME" -> other.toString)).code == 0)
      assert(p.archives(other).size == 1)

  test("without any place for it the program runs all the same, and nothing is said"):
    staged: p =>
      val jdk = p.jdk("99")
      val _ = Files.writeString(p.lib.resolve("archives"), "")
      val ended = p.run(Seq("x"), Map("CANDELA_JAVA" -> jdk.toString), without = Set("HOME"))
      assert((ended.code, ended.out, ended.err) == (0, "", ""))
      assert(p.starts.map(_.contains("x")) == Vector(true))

  test("a Java that can't make an archive is asked once, not at every start"):
    staged: p =>
      val _ = p.jdk("99", java = "case $* in *start-up/a.pbrt*) rm -f archive; exit 1 ;; esac")
      val _ = p.run(env = Make)
      val _ = p.run(env = Make)
      val ended = p.run(env = Map.empty)
      assert((ended.code, ended.err) == (0, ""))
      assert(p.starts.size == 2)
      assert(!p.starts.last.exists(_.startsWith("-XX:")))

  test("of several first starts at once one makes the archive, the others don't wait for it"):
    staged: p =>
      val jdk = p.jdk("99")
      val go = jdk.resolve("go")
      val wait = s"until [ -e '$go' ]; do sleep 0.05; done"
      val _ = p.jdk("99", java = s"case $$* in *start-up/a.pbrt*) $wait ;; esac")
      val processes = Vector.fill(4)(p.start(env = Make))
      try eventually("end of the others")(Option.when(processes.count(_.isAlive) == 1)(()))
      finally Files.createFile(go): Unit
      assert(processes.map(p.ended(_).code) == Vector.fill(4)(0))
      assert(p.starts.size == 1)
      assert(p.archives(p.lib).size == 1)
      assert(TempFolder.names(p.archives(p.lib).head.getParent) == Set(
        "99.aot",
        "99.aot.of",
        "99.aot.sum"
      ))

  test("what a start left behind that was ended on its way is no hindrance"):
    staged: p =>
      val jdk = p.jdk("99")
      val folder = Files.createDirectories(Path.of(s"${p.lib.toRealPath()}/archives$jdk"))
      val dead = ProcessBuilder("/bin/sh", "-c", ":").start()
      val _ = dead.waitFor()
      val _ = Files.writeString(folder.resolve("99.aot.lock"), s"${dead.pid}\n")
      assert(p.run(env = Make).code == 0)
      assert(p.archives(p.lib).size == 1)

  test("after a first start the archive is made behind it, without a word"):
    staged: p =>
      val _ = p.jdk("99")
      val ended = p.run(Seq("x"), Map.empty)
      assert((ended.code, ended.out, ended.err) == (0, "", ""))
      // Until what it worked in is gone, too; files may go while they are listed
      def files = Try(TempFolder.names(p.archives(p.lib).head.getParent)).toOption
      eventually("archive")(files.filter(_ == Set("99.aot", "99.aot.of", "99.aot.sum")))
      assert(p.starts.map(_.exists(_.endsWith("a.pbrt"))) == Vector(false, true))
      assert(p.archives(p.lib).size == 1)

  test("Java is never asked for a module in incubation, about which it would warn"):
    staged: p =>
      val _ = p.jdk("99", modules = "java.base jdk.incubator.vector")
      assert(p.run(env = Make).code == 0)
      for words <- Seq(Seq("a.pbrt", "--spp", "9999"), Seq("a.pbrt", "b.pbrt")) do
        assert(p.run(words, Map.empty).code == 0)
      assert(p.starts.size == 3 && !p.starts.flatten.exists(_.contains("incubator")))

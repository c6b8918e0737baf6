package candela.cli

import candela.testing.TempFolder
import packaging.{
  Addon, Artifact, Distribution, Entry, Facts, JavaRuntime, Manifests, Platform, ProgramFiles,
  Revision,
  Wheel, ZipWriter
}

import java.net.URI
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.attribute.PosixFilePermission.OWNER_EXECUTE
import java.nio.file.{FileSystems, Files, Path}
import java.util.Base64
import java.util.zip.ZipFile

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

/** What `./sbt dist` makes. `packaging/check` unpacks and runs it. */
class DistributionSuite extends AnyFunSuite:
  private val facts = Facts("1.2.3", "1.2.3-SNAPSHOT", "https://example.org/candela")

  private val natives = Platform.all.map(p => s"lib/natives/${p.name}/library")
  private val program =
    val names =
      Vector("lib/candela.jar", "lib/candela-bench.jar", "lib/options", "bin/candela.bat",
        "powershell/candela.ps1", "share/man/man1/candela.1", "LICENSE") ++ natives
    names.map(name => Entry.text(name, s"text of $name")) :+
      Entry.text("bin/candela", "#!/bin/sh\n", isExecutable = true)

  private def texts(zip: Path): Map[String, String] = Using.resource(ZipFile(zip.toFile)): file =>
    file.entries.asScala.map(e =>
      e.getName -> String(file.getInputStream(e).readAllBytes(), UTF_8)
    ).toMap

  test("a zip file is the same bytes whatever the order of its entries; they come back"):
    TempFolder.use: folder =>
      val (a, b) = (folder.resolve("a.zip"), folder.resolve("b.zip"))
      ZipWriter.write(program, a)
      ZipWriter.write(program.reverse, b)
      assert(Files.mismatch(a, b) == -1)
      assert(texts(a) == program.map(e => e.name -> String(e.content.bytes, UTF_8)).toMap)

  test("what may be executed stays so, and nothing else is"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.zip")
      ZipWriter.write(program, file)
      val uri = URI.create(s"jar:${file.toUri}")
      val how = Map("enablePosixFileAttributes" -> true).asJava
      Using.resource(FileSystems.newFileSystem(uri, how)): zip =>
        for entry <- program do
          val found = Files.getPosixFilePermissions(zip.getPath(entry.name))
          assert(found.contains(OWNER_EXECUTE) == (entry.name == "bin/candela"), entry.name)

  test("each package has its platform's natives and launchers, and no other's"):
    for platform <- Platform.all do
      val names = ProgramFiles.of(platform, program, Nil).map(_.name).toSet
      assert(names.filter(_.startsWith("lib/natives")) ==
        Set(s"lib/natives/${platform.name}/library"))
      assert(names.contains("bin/candela") != platform.isWindows)
      assert(names.contains("bin/candela.bat") == platform.isWindows)
      assert(names.contains("powershell/candela.ps1") == platform.isWindows)
      assert(Vector("lib/candela.jar", "lib/candela-bench.jar", "LICENSE").forall(names))

  private val artifacts =
    for
      (platform, i) <- Platform.all.zipWithIndex
      hasRuntime <- Vector(false, true)
    yield
      val sum = s"%064x".format(2 * i + (if hasRuntime then 1 else 0) + 1)
      Artifact(facts.zip(platform, hasRuntime), platform, hasRuntime, sum, 1)

  private def manifest(name: String, from: Seq[Artifact] = artifacts): String =
    Manifests.all(facts, from, Seq("candela:candela_3:1.2.3"), Seq("-Xss4m")).toMap.apply(name)

  private val named =
    Vector("homebrew/candela.rb", "scoop/candela.json", "nix/candela.nix", "docker/Dockerfile")

  test("each address in a manifest is that of a file of the release, with its hash close by"):
    for name <- named do
      val text = manifest(name)
      val addresses = s"${facts.homepage}/releases/download/v1.2.3-SNAPSHOT/(\\S+?\\.zip)".r
        .findAllMatchIn(text).toVector
      assert(addresses.nonEmpty, name)
      for found <- addresses do
        val sum = artifacts.find(_.file == found.group(1)).fold(fail(found.group(1)))(_.sha256)
        val near = text.slice(found.start - 100, found.end + 100)
        assert(near.contains(sum), s"$name: ${found.group(1)}")

  test("manifests say the facts of the table"):
    for name <- named do
      val text = manifest(name)
      assert(text.contains(facts.version) && text.contains(facts.homepage), name)
    val scoop = ujson.read(manifest("scoop/candela.json"))
    assert(scoop("description").str == facts.description && scoop("license").str == facts.licence)
    assert(scoop("bin").str == "bin\\candela.bat" && scoop.obj.get("suggest").isEmpty)
    val bare = ujson.read(manifest("scoop/candela.json", artifacts.filterNot(_.hasRuntime)))
    assert(bare("architecture")("64bit")("url").str.endsWith("windows-x64-without-java.zip"))
    assert(bare.obj.contains("suggest"))
    val channel = ujson.read(manifest("coursier.json"))
    assert(channel("candela")("mainClass").str == "candela.cli.Main")

  test("what is not made yet has no hash that could be mistaken for one"):
    val sums = "\\b[0-9a-f]{64}\\b".r.findAllIn(manifest("nix/candela.nix", Nil)).toSet
    assert(sums == Set(Manifests.NoHash))

  test("a wheel has a line with the right hash for each of its files, and removes all it installs"):
    TempFolder.use: folder =>
      val platform = Platform.all.head
      val file = folder.resolve(facts.wheelFile(platform))
      assert(file.getFileName.toString ==
        "candela_renderer-1.2.3.dev0-py3-none-manylinux_2_28_x86_64.whl")
      val module = Vector(Entry.text("__init__.py", "\"\"\"Candela.\"\"\"\n"))
      Wheel.write(facts, platform, ProgramFiles.of(platform, program, Nil), module, file)
      val found = texts(file)
      val record = "candela_renderer-1.2.3.dev0.dist-info/RECORD"
      val lines = found(record).linesIterator.map(_.split(',').toVector).toVector
      assert(lines.map(_.head).toSet == found.keySet)
      for line <- lines if line.head != record do
        val sum = ZipWriter.digest(found(line.head).getBytes(UTF_8))
        val text = Base64.getUrlEncoder.withoutPadding.encodeToString(sum)
        assert(line(1) == s"sha256=$text", line.head)
      assert(found.contains("candela/program/bin/candela") && found.contains("candela/__init__.py"))
      // A file where the launcher would make a folder of archives: they go to the user's cache
      assert(found.contains("candela/program/lib/archives"))

  test("the add-on for Blender has this version, and the module that runs the program"):
    val module = ProgramFiles.module(Path.of("packaging", "python", "candela"))
    val sources = ProgramFiles.module(Path.of("packaging", "blender"))
    val entries = Addon.entries(facts, sources, module).map(e => e.name -> e).toMap
    def text(name: String) = String(entries(name).content.bytes, UTF_8)
    assert(text("blender_manifest.toml").linesIterator.contains("version = \"1.2.3-SNAPSHOT\""))
    assert(Vector("__init__.py", "engine.py", "candela/_session.py").forall(entries.contains))
    assert(facts.addonFile == "candela-blender-1.2.3-SNAPSHOT.zip")

  test("sources that git has archived know their commit, and whether they are a release"):
    TempFolder.use: folder =>
      val file = Files.createDirectory(folder.resolve("project")).resolve("commit")
      def revision(text: String) =
        val _ = Files.writeString(file, text)
        Revision.of(folder.toFile, "0.2.0")
      val hash = "0123456789abcdef0123456789abcdef01234567"
      assert(revision(s"$hash v0.3.0\n") == Revision("0.3.0", "0.3.0", hash.take(12)))
      assert(revision(s"$hash v0.1.0-5-g0123456\n") ==
        Revision("0.2.0", "0.2.0-SNAPSHOT", hash.take(12)))
      val unknown = Revision("0.2.0", "0.2.0-SNAPSHOT", "")
      assert(revision("$" + "Format:%H %(describe:tags,match=v*)$\n") == unknown)
      val _ = Files.delete(file)
      assert(Revision.of(folder.toFile, "0.2.0") == unknown)

  test("a JDK that nobody named makes the runtime only if it is new enough and has all modules"):
    TempFolder.use: folder =>
      def jdk(version: String, modules: Seq[String]): Path =
        val home = Files.createDirectories(folder.resolve(s"$version ${modules.size}"))
        val _ = Files.writeString(Files.createDirectory(home.resolve("bin")).resolve("jlink"), "")
        Files.writeString(
          home.resolve("release"),
          s"JAVA_VERSION=\"$version\"\nMODULES=\"${modules.mkString(" ")}\"\n"
        ).getParent
      val good = jdk("25.0.1", JavaRuntime.modules)
      val old = jdk("17.0.1", JavaRuntime.modules)
      val bare = jdk("25.0.1", JavaRuntime.modules.take(2))
      def chosen(own: Path, environment: (String, String)*) =
        JavaRuntime.jdk(environment.toMap, own, 25)
      assert(chosen(old, "JAVA_HOME" -> good.toString) == Right(good))
      assert(chosen(good, "JAVA_HOME" -> bare.toString) == Right(good))
      assert(chosen(old).isLeft && chosen(bare).isLeft)
      assert(chosen(good, "CANDELA_RUNTIME_JDK" -> old.toString) == Right(old))
      val refused = chosen(good, "CANDELA_RUNTIME_JDK" -> bare.toString)
      assert(refused.left.exists(_.contains("lacks java.management, ")))

  test("without a JDK for the runtime nothing is made, and the message says what to install"):
    TempFolder.use: folder =>
      val jdk = JavaRuntime.jdk(Map.empty, folder, 25)
      val dist = folder.resolve("dist")
      val plan = Distribution.Plan(facts, Nil, folder, folder, jdk, Nil, Nil, dist)
      val failure = intercept[RuntimeException](Distribution.make(plan, _ => ()))
      assert(failure.getMessage.contains("JDK 25") && failure.getMessage.contains("adoptium.net"))
      assert(!Files.exists(dist))

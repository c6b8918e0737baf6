package packaging

import java.nio.file.{Files, Path}

import scala.collection.mutable

/** Makes the files of a release. */
object Distribution {

  /** @param program   all files of the program, by their names
    * @param module    folder of the Python package
    * @param addon     folder of the add-on for Blender
    * @param jdk       makes the runtime; or why there is none
    * @param libraries the program's Maven modules, for Coursier
    * @param options   of the JVM, for Coursier
    * @param folder    for the files
    */
  final case class Plan(
      facts: Facts,
      program: Seq[(String, Path)],
      module: Path,
      addon: Path,
      jdk: Either[String, Path],
      libraries: Seq[String],
      options: Seq[String],
      folder: Path
  )

  /** Makes all packages of this system; what is in the folder is deleted.
    *
    * @throws RuntimeException before it makes any, if one of them can't be made
    */
  def make(plan: Plan, say: String => Unit): Unit = {
    import plan.{facts, folder}
    val here = Platform.here.getOrElse(sys.error(
      "no package is made for this system; `./sbt stage` makes a program for it"
    ))
    val jdk = plan.jdk.fold(why => sys.error(why), identity)
    delete(folder)
    Files.createDirectories(folder)
    val program = for ((name, path) <- plan.program if Files.isRegularFile(path))
      yield Entry.file(name, path, isExecutable = name == "bin/candela")
    def zip(platform: Platform, runtime: Option[Seq[Entry]]): Seq[Entry] = {
      val entries = ProgramFiles.of(platform, program, runtime.getOrElse(Nil))
      val file = folder.resolve(facts.zip(platform, runtime.isDefined))
      ZipWriter.write(entries.map(_.in(facts.folder)), file)
      entries
    }
    for (platform <- Platform.all) {
      zip(platform, None)
      val assimp = ProgramFiles.assimp(platform, program)
      ZipWriter.write(assimp, folder.resolve(facts.assimp(platform)))
    }
    val module = ProgramFiles.module(plan.module)
    val licence = program.filter(_.name == "LICENSE")
    val addon = Addon.entries(facts, ProgramFiles.module(plan.addon) ++ licence, module)
    ZipWriter.write(addon, folder.resolve(facts.addonFile))
    say(s"the Java runtime for ${here.name} is made by $jdk")
    val runtime = folder.resolve("runtime")
    try {
      JavaRuntime.make(jdk, runtime)
      val entries = zip(here, Some(ProgramFiles.runtime(runtime)))
      Wheel.write(facts, here, entries, module, folder.resolve(facts.wheelFile(here)))
    } finally delete(runtime)
    describe(plan, say)
  }

  /** Makes sums and manifests of the packages in the folder, wherever each was made. */
  def describe(plan: Plan, say: String => Unit): Unit = {
    import plan.{facts, folder}
    val made = mutable.ArrayBuffer.empty[Artifact]
    for {
      platform <- Platform.all
      (name, hasRuntime) <- Seq(
        facts.zip(platform, true) -> true,
        facts.zip(platform, false) -> false,
        facts.wheelFile(platform) -> true
      )
      path = folder.resolve(name) if Files.isRegularFile(path)
    } made += Artifact(name, platform, hasRuntime, ZipWriter.sha256(path), Files.size(path))
    val parts = (facts.addonFile +: Platform.all.map(facts.assimp(_))).map(folder.resolve(_))
      .filter(Files.isRegularFile(_))
    val sums = made.map(a => a.sha256 -> a.file) ++
      parts.map(path => ZipWriter.sha256(path) -> path.getFileName.toString)
    val texts = Manifests.all(facts, made.toSeq, plan.libraries, plan.options) :+
      ("SHA256SUMS" -> sums.map { case (sum, file) => s"$sum  $file\n" }.mkString)
    for ((name, text) <- texts) {
      val file = folder.resolve(name)
      Files.createDirectories(file.getParent)
      Files.writeString(file, text)
    }
    for (path <- parts) say("%6.1f MB  %s".format(Files.size(path) / 1e6, path.getFileName))
    for (a <- made) say("%6.1f MB  %s".format(a.size / 1e6, a.file))
  }

  private def delete(folder: Path): Unit = if (Files.exists(folder)) {
    val all = Files.walk(folder)
    try all.sorted(java.util.Comparator.reverseOrder[Path]).forEach(p => Files.delete(p))
    finally all.close()
  }
}

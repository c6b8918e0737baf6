import packaging.{Distribution, Facts, JavaRuntime, Revision}

/** The number of the next release. Sources of the tag `v0.1.0` are the release; all others are
  * `0.1.0-SNAPSHOT`.
  */
val nextRelease = "0.1.0"
val manifests = taskKey[Unit]("Makes sums and manifests of the packages in target/dist.")
val revision = settingKey[Revision]("Release, version and commit of these sources.")

ThisBuild / revision := Revision.of((ThisBuild / baseDirectory).value, nextRelease)
ThisBuild / scalaVersion := "3.3.7"
ThisBuild / version := revision.value.version
Publishing.ofBuild

val lwjgl = "3.4.3"
val spark = "4.2.0"
val lwjglModules = Seq("lwjgl", "lwjgl-tinyexr", "lwjgl-stb")

/** Releases whose promises the next one keeps. */
val released = Set.empty[String]

val lwjglNatives = Seq(
  "natives-linux",
  "natives-linux-arm64",
  "natives-macos",
  "natives-macos-arm64",
  "natives-windows",
  "natives-windows-arm64"
)

/** Of rendering: the share of memory that a heap may take. Rays allocate nothing, so a small young
  * generation is collected rarely; a large one would only be filled before it is, and takes its part
  * of a heap that is just large enough for a scene. Classes take more than the 21 MB at which the
  * whole heap would be collected, in the midst of building a scene.
  */
val memory = Seq(
  "-XX:MaxRAMPercentage=70",
  "-XX:MaxNewSize=32m",
  "-XX:MaxTenuringThreshold=0", // what lives through one collection is mostly the scene
  "-XX:MetaspaceSize=64m"
)

/** Large steps of guided paths that several others call: C2 compiles each once, not for each caller
  * again, which is a third of what `--guiding` adds to its work.
  */
val compiledApart = Seq(
  "GuidedScattering::scatterOnce",
  "Guidance::scatter",
  "Guidance::drawBsdf",
  "Guidance::drawField"
).map(code => s"-XX:CompileCommand=dontinline,candela.integrators.$code")

def mainOfProgram = "candela.cli.Main"

/** Options of every JVM of this build: the renderer's and the tests'. */
val jvmOptions = Seq(
  "-XX:+UseParallelGC", // throughput matters, pauses don't
  "-Xss4m", // deep BVHs and deeply nested includes
  "-Djava.awt.headless=true",
  "-Dfile.encoding=UTF-8", // the default from JDK 18 on
  "--enable-native-access=ALL-UNNAMED", // LWJGL
  // Loads the Vector API at run time: --add-modules prints a warning at every start.
  "--add-exports=java.base/jdk.internal.module=ALL-UNNAMED",
  // JDK 24 and later warn about Scala's lazy values; JDK 17 does not know the option against it.
  "-XX:+IgnoreUnrecognizedVMOptions",
  "--sun-misc-unsafe-memory-access=allow",
  // The SIMD kernel is a hundred times slower until it is compiled: compile it after a few calls of
  // its warm-up, ahead of other code, and let callers wait for it.
  "-XX:CompileCommand=quiet",
  "-XX:CompileCommand=CompileThresholdScaling,candela.accel.tracing.VectorKernel$::*,0.01",
  "-XX:CompileCommand=BackgroundCompilation,candela.accel.tracing.VectorKernel$::*,false"
) ++ compiledApart

/** The archive of JDK 25 has profiles of the small renderings by which it was made. Code that is
  * compiled by them renders up to a tenth slower.
  */
val withoutProfiles = Seq("-XX:+UnlockDiagnosticVMOptions", "-XX:-AOTReplayTraining")

/** Code that a render runs once, as it reads and builds its scene: C2 gives it up at once, and C1's
  * code stays. Compiled by C2, which takes longer than the work, it would delay the first image.
  * The inner loops of BVH construction are C2's, and all that rendering shares.
  */
val builtOnce = Seq(
  "scala.collection.*",
  "scala.Array$",
  "java.util.regex.*",
  "sun.nio.*",
  "jdk.internal.classfile.*",
  "candela.build.*",
  "candela.accel.building.BvhBuilder*",
  "candela.accel.building.BoxRecord*",
  "candela.accel.building.SharedCut*",
  "candela.accel.building.Subtree*",
  "candela.accel.building.Collapse*",
  "candela.accel.building.Wide*",
  "candela.textures.Pyramid*",
  "candela.textures.Texels*",
  "candela.color.Upsampling*",
  "candela.color.ColorError*",
  "candela.color.Colorimetry*",
  "candela.color.Wavelengths$*",
  "candela.color.Matrix3*",
  "candela.bsdf.layered.RoughCoat$*"
).map(code => s"-XX:CompileCommand=MaxNodeLimit,$code::*,1") // an option of JDK 22 and later

val testAll = taskKey[Unit]("Runs all tests.")
val testSlow = taskKey[Unit]("Runs the tests that `test` leaves out.")

/** Two tiers of tests: `test` runs all but those with ScalaTest's tag `Slow`, which `testSlow` runs;
  * `testAll` and `testOnly` run both.
  */
val tiers = Seq(
  Test / testListeners += new TestRecord(
    (ThisBuild / baseDirectory).value / "target" / "test-times.csv"
  ),
  Test / test / testOptions += Tests.Argument(TestFrameworks.ScalaTest, "-l", slowTag),
  testAll := (Test / testOnly).toTask(" *").value,
  testSlow := (Test / testOnly).toTask(s" * -- -n $slowTag").value
)

def slowTag = "org.scalatest.tags.Slow"

val compiled = Seq(
  scalacOptions ++= Seq("-encoding", "UTF-8"),
  scalacOptions ++= Seq("-deprecation", "-feature", "-Wunused:all", "-Wvalue-discard", "-Werror"),
  scalacOptions += "-java-output-version:17"
) ++ Publishing.ofModule

/** The renderer without the program: no command line, no pages. Its tests are among the root's. */
lazy val core: Project = (project in file("src/core"))
  .settings(
    name := "candela-core",
    description := "A physically based renderer for pbrt and Mitsuba scenes: the library",
    target := (ThisBuild / baseDirectory).value / "target" / "core",
    Compile / scalaSource := baseDirectory.value / "scala",
    Compile / javaSource := baseDirectory.value / "java",
    Compile / javacOptions ++= Seq("--release", "17"),
    Compile / resourceDirectory := baseDirectory.value / "resources",
    compiled,
    // Natives are for the platforms that the library's users choose
    libraryDependencies ++= lwjglModules.map("org.lwjgl" % _ % lwjgl) :+
      "org.apache.commons" % "commons-statistics-distribution" % "1.1",
    Compile / sourceGenerators += versionSource,

    // `sbt core/doc`: what users are promised.
    Compile / doc / tastyFiles ~= (_.filter(_.getParentFile.getName == "api")),
    Compile / doc / scalacOptions := Seq("-project", "Candela", "-project-version", version.value),

    // `sbt core/mimaReportBinaryIssues`: whether a release breaks what the one before promised.
    mimaPreviousArtifacts := released.map(organization.value %% moduleName.value % _),
    mimaBinaryIssueFilters += Promised.only
  )

/** The program: commands, pages, reports, converters. Its tests are among the root's. */
lazy val program: Project = (project in file("src/main"))
  .dependsOn(core)
  .settings(
    name := "candela",
    description := "A physically based renderer for pbrt and Mitsuba scenes: the program",
    target := (ThisBuild / baseDirectory).value / "target" / "main",
    Compile / scalaSource := baseDirectory.value / "scala",
    Compile / resourceDirectory := baseDirectory.value / "resources",
    compiled,
    Publishing.withoutDocumentation,
    libraryDependencies ++= Seq(
      "com.github.scopt" %% "scopt" % "4.1.0",
      "com.lihaoyi" %% "scalatags" % "0.13.1",
      "com.lihaoyi" %% "ujson" % "4.1.0"
    ) ++ lwjglModules.flatMap(module =>
      lwjglNatives.map(n => "org.lwjgl" % module % lwjgl % Runtime classifier n)
    ),
    Compile / mainClass := Some(mainOfProgram),
    Compile / resourceGenerators += versionFacts
  )

/** The commands that measure programs: `bench` and `robustness`. The program looks for them at run
  * time. The tests are among the root's.
  */
lazy val bench: Project = (project in file("bench"))
  .dependsOn(program)
  .settings(
    name := "candela-bench",
    description := "A physically based renderer for pbrt and Mitsuba scenes: benchmarks",
    target := (ThisBuild / baseDirectory).value / "target" / "bench",
    compiled,
    Publishing.withoutDocumentation,
    libraryDependencies += "com.typesafe" % "config" % "1.4.3"
  )

/** Readers of models, such as glTF, as scenes. The program looks for them at run time. The tests are
  * among the root's.
  */
lazy val models: Project = (project in file("models"))
  .dependsOn(core)
  .settings(
    name := "candela-models",
    description := "A physically based renderer for pbrt and Mitsuba scenes: models",
    target := (ThisBuild / baseDirectory).value / "target" / "models",
    compiled,
    Publishing.withoutDocumentation,
    libraryDependencies ++= Seq(
      "com.lihaoyi" %% "ujson" % "4.1.0",
      "com.twelvemonkeys.imageio" % "imageio-webp" % "3.12.0" % Runtime // found by javax.imageio
    )
  )

/** Reads models of further formats by Assimp, in native code. A part of its own: the program's packages
  * are without it. The tests are among the root's.
  */
lazy val assimp: Project = (project in file("assimp"))
  .dependsOn(models)
  .settings(
    name := "candela-assimp",
    description := "A physically based renderer for pbrt and Mitsuba scenes: models by Assimp",
    target := (ThisBuild / baseDirectory).value / "target" / "assimp",
    compiled,
    Publishing.withoutDocumentation,
    libraryDependencies += "org.lwjgl" % "lwjgl-assimp" % lwjgl,
    libraryDependencies ++=
      lwjglNatives.map(n => "org.lwjgl" % "lwjgl-assimp" % lwjgl % Runtime classifier n)
  )

/** What is run, staged, tested and distributed: the program with its benchmarks and models. */
lazy val root: Project = (project in file("."))
  .dependsOn(program, bench, models, assimp)
  .aggregate(core, program, bench, models, assimp, LocalProject("cluster"))
  .enablePlugins(UniversalPlugin)
  .settings(
    name := "candela-all",
    aggregate := false, // `run`, `stage`, … are the program's; but what follows is of all modules
    test / aggregate := true,
    testAll / aggregate := true,
    testSlow / aggregate := true,
    publish / aggregate := true,
    publishLocal / aggregate := true,
    publishM2 / aggregate := true,
    scalafmtAll / aggregate := true,
    scalafmtCheckAll / aggregate := true,
    compiled,
    Publishing.nothing,
    Compile / sources := Nil, // src/main is the program's
    Compile / unmanagedResources := Nil,
    libraryDependencies ++= Seq(
      "org.ow2.asm" % "asm" % "9.8" % Test,
      "org.scalatest" %% "scalatest" % "3.2.19" % Test,
      "org.scalacheck" %% "scalacheck" % "1.19.0" % Test,
      "org.scalatestplus" %% "scalacheck-1-18" % "3.2.19.0" % Test
    ),
    Compile / mainClass := Some(mainOfProgram),

    // `sbt run`: a separate JVM in the project folder, attached to the terminal.
    Compile / run / javaOptions ++= jvmOptions ++ memory,
    Compile / run / runner := new TerminalRun((Compile / run / forkOptions).value),

    // `sbt stage`: src/universal, the program's jar, native libraries, and the same JVM options.
    Universal / mappings ++= programFiles.value,
    stage := withArchive(stage.value, streams.value.log),

    // `sbt dist`: the files of a release, in target/dist.
    dist := {
      Distribution.make(packages.value, streams.value.log.info(_))
      target.value / "dist"
    },
    manifests := Distribution.describe(packages.value, streams.value.log.info(_)),

    // What makes the packages is tested, too.
    Test / unmanagedSources ++=
      Seq("Addon", "Distribution", "Facts", "JavaRuntime", "Manifests", "PlainLambdas",
        "ProgramFiles",
        "Revision", "Wheel", "ZipWriter")
        .map(name => (ThisBuild / baseDirectory).value / "project" / s"$name.scala"),

    // `sbt test`: a separate JVM, suites in parallel. The library's example is compiled, too.
    Test / unmanagedSourceDirectories += baseDirectory.value / "examples" / "scala" / "src",
    Test / fork := true,
    Test / testForkedParallel := true,
    Test / javaOptions ++= jvmOptions ++ Seq("-Xmx3g"),
    Test / test / testResultLogger := CountedTests((Test / test / testResultLogger).value),
    Test / testOnly / testResultLogger := CountedTests((Test / testOnly / testResultLogger).value),
    Test / testQuick / testResultLogger := CountedTests(
      (Test / testQuick / testResultLogger).value
    ),
    tiers
  )

/** Renders on Apache Spark. Neither depends on the other: the program looks for it at run time. */
lazy val cluster: Project = (project in file("cluster"))
  .dependsOn(core, root % "test->test")
  .settings(
    name := "candela-spark",
    description := "A physically based renderer for pbrt and Mitsuba scenes, on Apache Spark",
    compiled,
    Publishing.withoutDocumentation,
    libraryDependencies ++= Seq(
      ("org.apache.spark" %% "spark-core" % spark % Provided).cross(CrossVersion.for3Use2_13)
    ),
    excludeDependencies += ExclusionRule(
      "org.scala-lang.modules",
      "scala-xml_3"
    ), // Spark's is 2.13's
    sparkJar := {
      val own = (Runtime / fullClasspathAsJars).value
      val programs = (program / Runtime / fullClasspathAsJars).value ++
        (models / Runtime / fullClasspathAsJars).value
      val jars = (own ++ programs).map(_.data).distinct
      val jar = (root / target).value / "universal" / "stage" / "lib" / "candela-spark.jar"
      val make = FileFunction.cached(streams.value.cacheDirectory / "jar") { _ =>
        ProgramJar.write(jars, jar, Some("candela.cli.SparkMain"))
        Set(jar)
      }
      make(jars.toSet).head
    },
    Test / fork := true,
    Test / baseDirectory := (ThisBuild / baseDirectory).value,
    Test / javaOptions ++= jvmOptions ++
      Seq(s"-Dcandela.spark.jar=${sparkJar.value}", s"-Dcandela.spark.version=$spark"),
    Test / test / testResultLogger := CountedTests((Test / test / testResultLogger).value),
    Test / testOnly / testResultLogger := CountedTests((Test / testOnly / testResultLogger).value),
    tiers
  )

val sparkJar = taskKey[File]("Makes candela-spark.jar: the program and its Spark module.")

/** What measures parts of the program. Not part of `root`: `sbt test` does not compile it. */
lazy val jmh = (project in file("jmh"))
  .dependsOn(root)
  .enablePlugins(JmhPlugin)
  .settings(
    Publishing.nothing,
    scalacOptions ++= Seq("-encoding", "UTF-8", "-deprecation", "-Werror"),
    // `jmh/runMain`: JVM options like the renderer's, in the project folder; 10⁷ triangles fit.
    run / fork := true,
    run / baseDirectory := (ThisBuild / baseDirectory).value,
    run / javaHome := sys.env.get("CANDELA_JAVA").map(file),
    run / javaOptions ++= jvmOptions :+ "-Xmx2g"
  )

/** The site: the pages of this repository as static HTML, `./sbt site/run`. Not part of `root`. */
lazy val site = (project in file("site")).settings(
  Publishing.nothing,
  compiled,
  target := (ThisBuild / baseDirectory).value / "target" / "site-build",
  Compile / scalaSource := baseDirectory.value / "scala",
  Compile / resourceDirectory := baseDirectory.value / "resources",
  libraryDependencies ++= Seq("commonmark", "commonmark-ext-gfm-tables").map(module =>
    "org.commonmark" % module % "0.24.0"
  ),
  run / fork := true,
  run / baseDirectory := (ThisBuild / baseDirectory).value
)

/** Files that the launcher in src/universal/bin needs: the program's jar and that of its benchmarks,
  * the native libraries, and the JVM options.
  */
def programFiles = Def.task {
  val jars = (program / Runtime / fullClasspathAsJars).value.map(_.data)
  val benchJars = (bench / Runtime / fullClasspathAsJars).value.map(_.data).filterNot(jars.toSet)
  val modelJars = (models / Runtime / fullClasspathAsJars).value.map(_.data).filterNot(jars.toSet)
  val assimpJars = (assimp / Runtime / fullClasspathAsJars).value.map(_.data)
    .filterNot((jars ++ modelJars).toSet)
  val folder = target.value / "program"
  val options = jvmOptions ++ memory
  val ofNewest = options ++ withoutProfiles ++ builtOnce
  val make = FileFunction.cached(streams.value.cacheDirectory / "program") { _ =>
    IO.delete(folder)
    val (natives, classes) =
      (jars ++ assimpJars).partition(_.getName.contains("-natives-"))
    val (ofAssimp, ofProgram) = classes.partition(assimpJars.toSet)
    val jar = folder / "candela.jar"
    val modules = Seq(
      benchJars -> folder / "candela-bench.jar",
      modelJars -> folder / "candela-models.jar",
      ofAssimp -> folder / "candela-assimp.jar"
    )
    ProgramJar.write(ofProgram, jar, Some(mainOfProgram), modules.map(_._2.getName))
    for ((own, to) <- modules) ProgramJar.write(own, to)
    ProgramJar.unpackNatives(natives, folder / "natives").toSet ++ modules.map(_._2) + jar
  }
  val files = make((jars ++ benchJars ++ modelJars ++ assimpJars).toSet)
  def written(name: String, lines: Seq[String]) = {
    IO.write(folder / name, lines.mkString("", "\n", "\n"))
    folder / name
  }
  (files + written("options", options) + written("options-25", ofNewest)).toSeq
    .pair(Path.rebase(folder, "lib"))
}

/** Creates the class-data archive now, for the JDK that the launcher selects here; otherwise the
  * launcher creates it after the first run.
  */
def withArchive(folder: File, log: Logger): File = {
  val launcher = (folder / "bin" / "candela").getPath
  log.info("making the class archive, which takes half a minute of processor time ...")
  val made = scala.util.Try(sys.process.Process(Seq(launcher), None, "CANDELA_ARCHIVE" -> "make").!)
  if (!made.toOption.contains(0)) log.info("no class-data archive yet: a later start creates it")
  folder
}

/** What the packages of a release are made of. CANDELA_RUNTIME_JDK or JAVA_HOME makes the runtime. */
def packages = Def.task {
  val base = (ThisBuild / baseDirectory).value
  val files = (Universal / mappings).value.map { case (file, name) =>
    name.replace('\\', '/') -> file.toPath
  } ++ Seq(
    "LICENSE",
    "scenes/showcase.pbrt",
    "scenes/include/showcase-spiral.pbrt",
    "scenes/textures/dusk-equalarea.exr"
  ).map(name => name -> (base / name).toPath)
  val program = files ++ shared(files.toMap.apply("lib/candela.jar"), target.value / "share")
  Distribution.Plan(
    facts.value,
    program,
    (base / "packaging" / "python" / "candela").toPath,
    (base / "packaging" / "blender").toPath,
    JavaRuntime.jdk(sys.env, file(sys.props("java.home")).toPath, facts.value.bestJava),
    Seq("candela_3", "candela-bench_3", "candela-models_3").map(m =>
      s"${organization.value}:$m:${version.value}"
    ),
    jvmOptions ++ memory,
    (target.value / "dist").toPath
  )
}

/** Manual page and completions, as the program prints them. */
def shared(jar: java.nio.file.Path, folder: File): Seq[(String, java.nio.file.Path)] = {
  val java = (file(sys.props("java.home")) / "bin" / "java").getPath
  for {
    (name, words) <- Seq(
      "share/man/man1/candela.1" -> Seq("describe", "--man"),
      "share/bash-completion/completions/candela" -> Seq("completion", "bash"),
      "share/zsh/site-functions/_candela" -> Seq("completion", "zsh"),
      "share/fish/vendor_completions.d/candela.fish" -> Seq("completion", "fish")
    )
  } yield {
    val to = folder / name
    IO.createDirectory(to.getParentFile)
    val made = (sys.process.Process(Seq(java, "-jar", jar.toString) ++ words) #> to).!
    if (made != 0) sys.error(s"candela ${words.mkString(" ")} failed")
    name -> to.toPath
  }
}

/** The table of facts. CANDELA_HOMEPAGE is the project's address where a release is made. */
def facts = Def.setting {
  val revised = (ThisBuild / revision).value
  val known = (ThisBuild / homepage).value.fold("")(_.toString)
  Facts(revised.release, revised.version, sys.env.getOrElse("CANDELA_HOMEPAGE", known))
}

/** `candela.base.Version`: the release's number, for output files; those of all its snapshots are
  * the same.
  */
def versionSource = Def.task {
  val file = (Compile / sourceManaged).value / "candela" / "base" / "Version.scala"
  val release = (ThisBuild / revision).value.release
  val sources = (Compile / unmanagedSources).value ++ (Compile / unmanagedResources).value
  val text =
    s"""package candela.base
       |
       |/** Which program this is; build.sbt writes this file. */
       |object Version:
       |  /** The number of this release, or of the next one. */
       |  val current: String = "$release"
       |
       |  /** The same, with a digest of the sources: other builds may make other files. */
       |  val build: String = "$release-${digest(sources)}"
       |""".stripMargin
  if (!file.exists || IO.read(file) != text) IO.write(file, text)
  Seq(file)
}

/** Of the content of files, wherever they are, with the line ends of any system. */
def digest(files: Seq[File]): String = {
  val sums =
    files.filter(_.isFile).map(f => f.getName + Hash.toHex(Hash(IO.read(f).replace("\r", ""))))
  Hash.toHex(Hash(sums.sorted.mkString(" "))).take(12)
}

/** What `--version` says of the sources; a resource, so that no commit compiles anything anew. */
def versionFacts = Def.task {
  val file = (Compile / resourceManaged).value / "candela" / "build.properties"
  val of = Revision.of((ThisBuild / baseDirectory).value, nextRelease)
  val text = s"version=${of.version}\ncommit=${of.commit}\n"
  if (!file.exists || IO.read(file) != text) IO.write(file, text)
  Seq(file)
}

addCommandAlias("checkFormat", "scalafmtCheckAll; scalafmtSbtCheck")

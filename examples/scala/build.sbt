// `sbt "run ../scene.pbrt"`: a program that depends on the library.
scalaVersion := "3.3.7"
libraryDependencies += "io.github.candela-renderer" %% "candela-core" %
  sys.props.getOrElse("candela.version", "0.1.0-SNAPSHOT")
fork := true
run / javaOptions ++= Seq(
  "--add-exports=java.base/jdk.internal.module=ALL-UNNAMED", // SIMD
  "--sun-misc-unsafe-memory-access=allow", // JDK 24 and later warn about Scala's lazy values
  "-XX:+IgnoreUnrecognizedVMOptions" // JDK 17 does not know the option before
)

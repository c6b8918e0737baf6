ThisBuild / scalaVersion := "3.3.7"
ThisBuild / organization := "candela"
ThisBuild / version := "0.1.0"

val lwjgl = "3.4.3"
val lwjglNatives = Seq(
  "natives-linux",
  "natives-linux-arm64",
  "natives-macos",
  "natives-macos-arm64",
  "natives-windows",
  "natives-windows-arm64"
)

lazy val root = (project in file("."))
  .settings(
    name := "candela",
    scalacOptions ++= Seq(
      "-deprecation", "-feature", "-Wunused:all", "-Wvalue-discard", "-Werror",
      "-java-output-version:17"
    ),
    libraryDependencies ++= Seq(
      "com.github.scopt" %% "scopt" % "4.1.0",
      "org.lwjgl" % "lwjgl" % lwjgl,
      "org.lwjgl" % "lwjgl-tinyexr" % lwjgl,
      "org.lwjgl" % "lwjgl-stb" % lwjgl,
      "org.scalatest" %% "scalatest" % "3.2.19" % Test,
      "org.scalacheck" %% "scalacheck" % "1.19.0" % Test,
      "org.scalatestplus" %% "scalacheck-1-18" % "3.2.19.0" % Test
    ),
    libraryDependencies ++= lwjglNatives.flatMap(n =>
      Seq("lwjgl", "lwjgl-tinyexr", "lwjgl-stb").map(m => "org.lwjgl" % m % lwjgl classifier n)
    ),
    run / fork := true,
    run / connectInput := true,
    Test / fork := true
  )

addSbtPlugin("com.github.sbt" % "sbt-native-packager" % "1.11.7") // `stage`
addSbtPlugin("org.scalameta" % "sbt-scalafmt" % "2.6.2") // `scalafmtAll`, `scalafmtCheckAll`
addSbtPlugin("pl.project13.scala" % "sbt-jmh" % "0.4.8") // `jmh/Jmh/run`
addSbtPlugin("com.typesafe" % "sbt-mima-plugin" % "1.1.4") // `core/mimaReportBinaryIssues`
addSbtPlugin("com.github.sbt" % "sbt-pgp" % "2.3.1") // `publishSigned`

libraryDependencies += "org.ow2.asm" % "asm" % "9.8" // classes, for `stage`

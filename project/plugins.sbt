addSbtPlugin("com.github.sbt" % "sbt-native-packager" % "1.11.7") // `stage`
addSbtPlugin("org.scalameta" % "sbt-scalafmt" % "2.6.2") // `scalafmtAll`, `scalafmtCheckAll`
addSbtPlugin("pl.project13.scala" % "sbt-jmh" % "0.4.8") // `bench/Jmh/run`

libraryDependencies += "org.ow2.asm" % "asm" % "9.8" // classes, for `stage`

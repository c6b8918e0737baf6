import sbt.*
import sbt.Keys.*

/** What Maven repositories are told of the modules. */
object Publishing {
  private val home = "https://github.com/candela-renderer/candela"
  private val repository = "github.com/candela-renderer/candela.git"

  /** Of the whole build: `publishLocal` and `publishM2` need nothing else. A release is signed and
    * uploaded by `publishSigned` (with sbt-pgp) and `sonaRelease`.
    */
  val ofBuild: Seq[Setting[?]] = Seq(
    ThisBuild / organization := "io.github.candela-renderer",
    ThisBuild / organizationName := "Candela",
    ThisBuild / organizationHomepage := Some(url(home)),
    ThisBuild / homepage := Some(url(home)),
    ThisBuild / licenses := Seq(License.Apache2),
    ThisBuild / developers := List(Developer("candela", "The Candela developers", "", url(home))),
    ThisBuild / scmInfo := Some(ScmInfo(url(home), s"scm:git:https://$repository")),
    ThisBuild / versionScheme := Some("early-semver"),
    ThisBuild / publishMavenStyle := true,
    ThisBuild / pomIncludeRepository := (_ => false),
    ThisBuild / publishTo := {
      val snapshots = "https://central.sonatype.com/repository/maven-snapshots/"
      if (isSnapshot.value) Some("central-snapshots".at(snapshots)) else localStaging.value
    }
  )

  /** `publishM2` replaces what an earlier one has put there, as `publishLocal` does. */
  val ofModule: Seq[Setting[?]] =
    Seq(publishM2Configuration := publishM2Configuration.value.withOverwrite(true))

  /** The program is described by its pages; its documentation for programmers is empty. */
  val withoutDocumentation: Seq[Setting[?]] = Seq(Compile / doc / sources := Nil)

  val nothing: Seq[Setting[?]] = Seq(publish / skip := true)
}

package candela.suite

import candela.base.SceneError

import java.nio.file.Path

import scala.util.matching.Regex

/** A change to a scene's text before a program gets it, for what its command line can't say.
  *
  * @param replacement may name groups (`$1`) and `{spp}`, `{seed}`, `{threads}`
  */
final case class Edit(find: Regex, replacement: String)

/** A renderer, and how to start it.
  *
  * @param command  its words; `{scene}`, `{out}`, `{spp}`, `{seed}`, `{threads}` are filled in, and
  *                 `{candela}` is this program itself
  * @param kinds    which of a scene's files it reads, the first that there is
  * @param isSeeded whether another seed gives another image
  * @param needs    names of environment variables without which it can't be found
  * @param isThin   drawn dashed, beside another one of the same colour
  */
final case class Program(
    name: String,
    title: String,
    command: Vector[String],
    kinds: Vector[String],
    threads: Int,
    edits: Vector[Edit],
    isSeeded: Boolean,
    color: Int,
    isThin: Boolean,
    needs: Vector[String] = Vector.empty
)

/** A scene in the formats that there are of it, and the image that is right.
  *
  * @param files    by kind: `v2`, `v3`, `v4`, `mitsuba`, whatever the programs call it
  * @param work     instead of the suite's
  * @param target   the relative MSE to race to; else one is chosen that most programs reach
  * @param programs that render it, if not all
  * @param needs    names of environment variables without which it can't be found
  */
final case class SuiteScene(
    name: String,
    title: String,
    note: String,
    files: Map[String, Path],
    reference: Path,
    work: Option[Work],
    target: Option[Double],
    programs: Option[Vector[String]],
    needs: Vector[String]
)

/** How far to render: to these sample counts, or for about these times. */
enum Work:
  case Samples(counts: Vector[Int])
  case Seconds(budgets: Vector[Double])

/** What is to be measured.
  *
  * @param seeds   independent images for each sample count
  * @param timeout seconds after which a run is given up
  */
final case class Suite(
    title: String,
    programs: Vector[Program],
    scenes: Vector[SuiteScene],
    work: Work,
    seeds: Int,
    timeout: Double
):
  /** With only these programs and scenes, if any are named. */
  def only(programNames: Vector[String], sceneNames: Vector[String]): Suite =
    def check(asked: Vector[String], known: Vector[String], what: String): Unit =
      for name <- asked if !known.contains(name) do
        val message = s"the suite has no $what `$name`; it has ${known.mkString(", ")}"
        throw SceneError(candela.base.Problem.general(message))
    check(programNames, programs.map(_.name), "program")
    check(sceneNames, scenes.map(_.name), "scene")
    copy(
      programs = programs.filter(p => programNames.isEmpty || programNames.contains(p.name)),
      scenes = scenes.filter(s => sceneNames.isEmpty || sceneNames.contains(s.name))
    )

package candela.bench.suite

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import candela.bench.report.Growth

import java.nio.file.Path

import scala.util.matching.Regex

/** An edit of a scene's text, for what a program's command line can't set.
  *
  * @param replacement may contain groups (`$1`) and `{spp}`, `{seed}`, `{threads}`
  */
final case class Edit(find: Regex, replacement: String)

/** A renderer and its command.
  *
  * @param command words, with `{scene}`, `{out}`, `{spp}`, `{seed}`, `{threads}` substituted;
  *   `{candela}` is this program itself
  * @param kinds formats it reads, in order of preference
  * @param isSeeded whether another seed gives another image
  * @param needs environment variables that locate it
  * @param isThin whether its curve is dashed, beside another one of the same colour
  * @param layer layer of its images that is compared, instead of the colours
  * @param ownFamily name of its family; by default, programs of the same command are one
  * @param counterpart name of the program whose images have the same means: it isn't compared where
  *   they differ
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
    needs: Vector[String] = Vector.empty,
    layer: Option[String] = None,
    ownFamily: Option[String] = None,
    counterpart: Option[String] = None
):
  /** Variants of a program are a family: together they count once. */
  def family: String = ownFamily.orElse(command.headOption).getOrElse(name)

  /** This program itself, which can denoise. */
  def isSelf: Boolean = command.headOption.contains(Commands.Self)

  /** The same with denoised images. */
  def denoised: Program = copy(
    name = s"$name-denoised",
    title = s"$title, denoised",
    command = command :+ "--denoise",
    isThin = true,
    layer = Some("Denoised"),
    counterpart = None
  )

/** A scene in one or more formats, and its reference.
  *
  * @param files files by format: `v2`, `v3`, `v4`, `mitsuba`, or any name that programs use
  * @param work overrides the suite's
  * @param target relative MSE to reach; by default one that most programs reach
  * @param programs the programs that render it, by default all
  * @param needs environment variables that locate it
  * @param growth what it has more of than other scenes
  */
final case class SuiteScene(
    name: String,
    title: String,
    note: String,
    files: Map[String, Path],
    reference: Option[Path],
    work: Option[Work],
    target: Option[Double],
    programs: Option[Vector[String]],
    needs: Vector[String],
    growth: Option[Growth] = None
):
  def isFor(program: Program): Boolean = programs.forall(_.contains(program.name))

  /** The file that the program renders, if it does. */
  def file(program: Program): Option[Path] =
    if isFor(program) then program.kinds.flatMap(files.get).headOption else None

/** Amount of work: sample counts, or approximate render times in seconds. */
enum Work:
  case Samples(counts: Vector[Int])
  case Seconds(budgets: Vector[Double])

object Work:
  /** The first that is there more than once. */
  def repeated[A](all: Seq[A]): Option[A] = all.diff(all.distinct).headOption

/** A benchmark suite.
  *
  * @param seeds independent images per sample count
  * @param timeout time limit per run, in seconds
  */
final case class Suite(
    title: String,
    programs: Vector[Program],
    scenes: Vector[SuiteScene],
    work: Work,
    seeds: Int,
    timeout: Double
):
  /** One program of each family, the first among those that are `present`. */
  def voters(present: Program => Boolean): Vector[Program] =
    programs.filter(present).distinctBy(_.family)

  /** With each program that can denoise twice: without and with it. */
  def withDenoised: Suite =
    val able = programs.filter(_.isSelf).map(_.name).toSet
    copy(
      programs = programs.flatMap(p => if p.isSelf then Vector(p, p.denoised) else Vector(p)),
      scenes = scenes.map: scene =>
        scene.copy(programs = scene.programs.map: names =>
          names ++ names.filter(able).map(name => s"$name-denoised"))
    )

  /** Restricted to these programs and scenes; empty keeps all. */
  def restricted(programNames: Vector[String], sceneNames: Vector[String]): Suite =
    def check(requested: Vector[String], available: Vector[String], what: String): Unit =
      for name <- requested if !available.contains(name) do
        val message = s"unknown $what `$name`"
        throw SceneError(Problem.general(Code.SuiteFile, message, Suggest.help(name, available)))
    check(programNames, programs.map(_.name), "program")
    check(sceneNames, scenes.map(_.name), "scene")
    copy(
      programs = programs.filter(p => programNames.isEmpty || programNames.contains(p.name)),
      scenes = scenes.filter(s => sceneNames.isEmpty || sceneNames.contains(s.name))
    )

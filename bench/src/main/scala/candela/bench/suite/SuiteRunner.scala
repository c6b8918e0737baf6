package candela.bench.suite

import candela.diagnostics.Code
import candela.bench.report.BiasAgainst
import candela.bench.statistics.{Measurement, SeedNoise}
import candela.image.{Image, ImageError, ImageFiles}
import candela.measure.{BiasTest, ErrorLayer, Renderings, TileSums}

import java.nio.file.{Files, Path}

/** One image to render.
  *
  * @param step index of its sample count, from 0; or one of those below
  */
private[suite] final case class Job(entry: Entry, step: Int, samples: Int, seed: Int):
  /** Is it a point of the program's curve? */
  def isPoint: Boolean = step >= 0

  /** Is it the same point, whatever its sample count? */
  def isInPlaceOf(job: Job): Boolean = entry == job.entry && step == job.step && seed == job.seed

private[suite] object Job:
  val WarmUp = -1

  /** The first image: one sample per pixel. */
  val FirstImage = -2

/** A program and the scene file that it renders. */
private[suite] final case class Entry(program: Program, scene: SuiteScene, file: Path)

/** A sample count to render, and the seconds that it is for, if times were asked for. */
private[suite] final case class Step(samples: Int, budget: Option[Double])

/** What to render of an entry.
  *
  * @param curve foretells the times of the steps, if times were asked for
  */
private[suite] final case class Plan(entry: Entry, steps: Vector[Step], curve: Option[TimeCurve]):
  /** The sample count of a step, if it is one of this entry's. */
  def samples(step: Int): Option[Int] =
    // A count of its own for the first image, if one sample is none of the others
    if step == Job.FirstImage then Option.when(hasFirstImage)(1)
    else steps.lift(step).map(_.samples)

  def hasFirstImage: Boolean = !steps.exists(_.samples == 1)

/** Measurement of a job. */
private[suite] final case class Result(job: Job, measurement: Measurement)

/** Runs the programs of a suite on its scenes, taking turns.
  *
  * @param names file names in messages
  * @param log receives progress messages, one line each
  * @param isCancelled polled between runs
  */
final class SuiteRunner(
    suite: Suite,
    commands: Commands,
    scratch: Path,
    names: PublicNames,
    log: String => Unit,
    isCancelled: () => Boolean
):
  private val copies = SceneCopy(scratch)
  private val leftOut = Vector.newBuilder[(String, String)]
  private val pictures = scala.collection.mutable.Map.empty[Entry, (Job, Image)]
  private val tiles = scala.collection.mutable.Map.empty[Entry, Map[Job, TileSums]]
  private val shares = scala.collection.mutable.Map.empty[Entry, Vector[(Double, Double)]]
  private val witnesses = Witnesses(suite)
  private val judges = scala.collection.mutable.Map.empty[SuiteScene, Judge]

  private var waiting = Vector.empty[SuiteScene]
  private var forecast = Forecast(Vector.empty)

  /** Of the longest name of a run, in characters. */
  private var nameWidth = 0

  /** What could not be run, and why; and what has not been run yet. */
  def omissions: Vector[(String, String)] =
    val begun = pictures.keySet.map(_.scene)
    leftOut.result() ++ waiting.map: scene =>
      val part = if begun(scene) then "partly" else "not"
      scene.title -> s"$part rendered when this report was written"

  /** Image of the longest rendering with the first seed. */
  private[suite] def picture(entry: Entry): Image = pictures(entry)._2

  /** Whether the programs have the same expected image as the first one, by the images of their
    * longest renderings, where there are some seeds.
    */
  private[suite] def biases(entries: Vector[Entry]): Vector[BiasAgainst] =
    val sets = for entry <- entries; images <- longest(entry) yield entry.program.title -> images
    sets.headOption.toVector.flatMap: (first, truth) =>
      for (title, images) <- sets.tail; test <- tested(images, truth)
      yield BiasAgainst(title, first, test)

  private def longest(entry: Entry): Option[Vector[TileSums]] =
    val all = tiles.getOrElse(entry, Map.empty)
    val last = all.keys.maxByOption(_.samples)
    val images = all.collect { case (job, t) if last.exists(_.step == job.step) => t }.toVector
    Option.when(entry.program.isSeeded && images.sizeIs >= SeedNoise.Fewest)(images)

  /** None where images can't be compared, such as those of a program that ignores its seed. */
  private def tested(a: Vector[TileSums], b: Vector[TileSums]): Option[BiasTest] =
    try Some(BiasTest.of(Renderings.seeds(a), Renderings.seeds(b)))
    catch case _: ImageError => None

  /** What the scene's images were compared with, and the programs that made it. */
  private[suite] def reference(scene: SuiteScene): (Image, Vector[Program]) =
    (judges(scene).reference, judges(scene).voters)

  /** Share of the processors that other programs took during the runs, where the system tells. */
  private[suite] def otherShare(entry: Entry): Option[Double] =
    shares.get(entry).map(all => all.map((t, share) => t * share).sum / all.map(_._1).sum)

  /** @param afterScene receives the results so far after each scene */
  private[suite] def run(afterScene: Vector[Result] => Unit): Vector[Result] =
    val available = suite.scenes.filter(isThere)
    val programs = suite.programs.filter: program =>
      commands.missing(program).forall: why =>
        leaveOut(program.title, why)
        false
    val scenes = available.filter(isRead(_, programs))
    val plans = scenes.map(scene => scene -> programs.flatMap(entryOf(_, scene)))
    forecast = Forecast(plans.flatMap(_._2).flatMap(Forecast.runs(_, suite)))
    nameWidth = plans.flatMap(_._2).map(e => named(e, 1000).length).maxOption.getOrElse(0)
    waiting = scenes
    plans.foldLeft(Vector.empty[Result]): (previous, plan) =>
      val (scene, entries) = plan
      val all = previous ++ (if isCancelled() then Vector.empty else ofScene(scene, entries))
      if !isCancelled() then waiting = waiting.filterNot(_ == scene)
      if all.sizeIs > previous.size then afterScene(all)
      all

  private def ofScene(scene: SuiteScene, entries: Vector[Entry]): Vector[Result] =
    val judge = scene.reference.fold[Judge](SeedJudge(suite, scratch)): file =>
      ReferenceJudge(ErrorLayer.extract(ImageFiles.read(file)))
    judges(scene) = judge
    val plans = entries.flatMap(planned(_, judge))
    val times = turn(1, plans, judge)
    val settledPlans = plans.map(settled(_, times, judge))
    for seed <- 2 to suite.seeds do turn(seed, settledPlans, judge): Unit
    val refused = witnesses.refused()
    for (entry, why) <- refused do leaveOut(s"${entry.program.title} on ${scene.title}", why)
    judge.drop(refused.map(_._1).toSet)
    try judge.results
    catch
      case e: ImageError =>
        leaveOut(scene.title, e.getMessage)
        Vector.empty

  /** Renders all steps of all plans with one seed; returns their seconds. */
  private def turn(seed: Int, plans: Vector[Plan], judge: Judge): Vector[(Job, Double)] =
    for
      step <- Job.FirstImage +: plans.flatMap(_.steps.indices).distinct.sorted
      // Rotates the order, so that disturbances of the machine affect all programs alike.
      plan <- rotated(plans, seed + Math.max(0, step))
      samples <- plan.samples(step)
      job = Job(plan.entry, step, samples, seed)
      seconds <- measured(job, judge)
    yield job -> seconds

  /** Repeats renderings that took much more or less than their budget, once, with a sample count
    * from all times so far. Trials are too short for programs that begin to learn later.
    */
  private def settled(plan: Plan, times: Vector[(Job, Double)], judge: Judge): Plan =
    val entryTimes = times.filter((job, _) => job.isPoint && job.entry == plan.entry)
    plan.curve.fold(plan): trials =>
      val curve = entryTimes.foldLeft(trials)((all, run) => all.and(run._1.samples, run._2))
      val better =
        for
          (job, seconds) <- entryTimes
          budget <- plan.steps(job.step).budget if TimeCurve.isFar(seconds, budget)
          again = job.copy(samples = curve.samplesIn(budget)) if again.samples != job.samples
          _ = sayAgain(again, seconds, budget)
          _ <- measured(again, judge)
        yield again
      better.foldLeft(plan): (p, job) =>
        p.copy(steps = p.steps.updated(job.step, p.steps(job.step).copy(samples = job.samples)))

  private def sayAgain(job: Job, seconds: Double, budget: Double): Unit =
    val name = s"${job.entry.scene.title}, ${job.entry.program.title}"
    log(f"$name: $seconds%.2f s instead of $budget%.2f s; again with ${job.samples} spp")
    forecast.again(job)

  private def leaveOut(what: String, why: String): Unit =
    val publicly = names.of(why)
    log(s"skipped: $what: $publicly")
    leftOut += what -> publicly

  private def isThere(scene: SuiteScene): Boolean =
    val unset = scene.needs.filterNot(sys.env.contains)
    val reason =
      if unset.nonEmpty then Some(Commands.notSet(unset))
      else if scene.reference.exists(!Files.isRegularFile(_)) then
        scene.reference.map(f => s"no such reference: $f")
      else if scene.reference.isEmpty && suite.seeds < SeedNoise.Fewest then
        Some(s"without a reference, its noise takes at least ${SeedNoise.Fewest} seeds")
      else scene.files.values.find(!Files.isRegularFile(_)).map(f => s"no such file: $f")
    reason.foreach(leaveOut(scene.title, _))
    reason.isEmpty

  /** Whether one of these programs takes one of the scene's files. */
  private def isRead(scene: SuiteScene, programs: Vector[Program]): Boolean =
    val wanted = programs.filter(scene.isFor)
    val isRead = wanted.exists(_.kinds.exists(scene.files.contains))
    if wanted.nonEmpty && !isRead then
      val files = scene.files.keys.toVector.sorted.mkString(", ")
      val read = wanted.map(p => s"${p.title} reads ${p.kinds.mkString(", ")}").mkString("; ")
      leaveOut(scene.title, s"no program reads its files ($files); $read")
    isRead

  private def entryOf(program: Program, scene: SuiteScene): Option[Entry] =
    for
      f <- scene.file(program)
      useless = SceneCopy.useless(f, program.edits)
      _ = useless.foreach: edit =>
        leaveOut(s"${program.title} on ${scene.title}", s"edit matches nothing: `${edit.find}`")
      isFixed = !program.isSeeded && scene.reference.isEmpty
      _ = if isFixed then
        leaveOut(
          s"${program.title} on ${scene.title}",
          "it has no seeds: without a reference, its noise is unknown"
        )
      if useless.isEmpty && !isFixed
    yield Entry(program, scene, f)

  /** The sample counts to render, from warm-up runs. */
  private def planned(entry: Entry, judge: Judge): Option[Plan] =
    def seconds(samples: Int): Option[Double] =
      measured(Job(entry, Job.WarmUp, samples, 1), judge)
    val plan = entry.scene.work.getOrElse(suite.work) match
      case Work.Samples(counts) =>
        seconds(counts.head).map(_ => Plan(entry, counts.map(Step(_, None)), None))
      case Work.Seconds(budgets) =>
        TimeCurve.measured(budgets.max)(seconds).map: curve =>
          val steps = budgets.map(budget => Step(curve.samplesIn(budget), Some(budget)))
          Plan(entry, steps.distinctBy(_.samples), Some(curve))
    forecast.dropFrom(entry, plan.fold(0)(_.steps.size), plan.exists(_.hasFirstImage))
    plan

  private def rotated[A](items: Vector[A], by: Int): Vector[A] =
    if items.isEmpty then items
    else items.drop(by % items.size) ++ items.take(by % items.size)

  /** Renders and returns the seconds; the judge takes the image. */
  private def measured(job: Job, judge: Judge): Option[Double] =
    if isCancelled() then None else render(job, judge)

  private def render(job: Job, judge: Judge): Option[Double] =
    val out = scratch.resolve("out.exr")
    val name = named(job.entry, job.samples)
    val startTimes = ProcessorTimes.current
    val outcome = commands.run(words(job, out), out, suite.timeout)
    val share = startTimes.flatMap(_.othersSince)
    outcome match
      case Outcome.Cancelled => None
      case Outcome.Failed(why) =>
        forecast.ended(job, None)
        leaveOut(name, why)
        None
      case Outcome.Done(seconds, memory) =>
        try
          val image = layerImage(ImageFiles.read(out), job.entry.program)
          val error = judge.take(job, seconds, memory, image)
          val counted = if job.step == Job.WarmUp then "warm-up" else s"seed ${job.seed}"
          forecast.ended(job, Some(seconds))
          for s <- share if job.isPoint do
            shares(job.entry) = shares.getOrElse(job.entry, Vector.empty) :+ (seconds, s)
          val label = s"${name.padTo(nameWidth, ' ')}  ${counted.padTo(7, ' ')}"
          log(f"$label $seconds%7.2f s  $error  " + forecast.words)
          record(job, image)
          witnesses.take(job, image)
          Some(seconds)
        catch
          case e: ImageError =>
            forecast.ended(job, None)
            leaveOut(name, e.getMessage)
            None

  private def named(entry: Entry, samples: Int): String =
    s"${entry.scene.title}, ${entry.program.title}, $samples spp"

  private def layerImage(image: Image, program: Program): Image =
    program.layer.fold(image.toRgb): layer =>
      val channels = Image.RgbNames.map(c => s"$layer.$c")
      image.indicesOf(channels).map(image.selected(_).toRgb).getOrElse:
        throw ImageError(Code.ImageContents, s"the image has no layer `$layer`")

  private def record(job: Job, image: Image): Unit =
    val isBetter = pictures.get(job.entry).forall: (kept, _) =>
      job.samples > kept.samples || job.isInPlaceOf(kept)
    if job.isPoint && isBetter then pictures(job.entry) = (job, image)
    if job.isPoint then
      val retained = tiles.getOrElse(job.entry, Map.empty).filterNot((j, _) => j.isInPlaceOf(job))
      tiles(job.entry) = retained + (job -> TileSums.of(image))

  private[suite] def words(job: Job, out: Path): Vector[String] =
    val program = job.entry.program
    val values = Map(
      "spp" -> job.samples.toString,
      "seed" -> job.seed.toString,
      "threads" -> program.threads.toString
    )
    val scene = copies.of(job.entry.file, program.edits, Commands.filled(_, values))
    val files = Map("scene" -> scene.toAbsolutePath.toString, "out" -> out.toString)
    commands.words(program, values ++ files)

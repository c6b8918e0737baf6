package candela.cli.options

import scopt.OParser

/** Options of rendering on a cluster.
  *
  * @param master address of the cluster
  * @param shards number of parts, instead of the cluster's choice
  */
final case class ClusterOptions(master: Option[String] = None, shards: Option[Int] = None)

/** Rows of the option table. */
private[cli] object ClusterTable:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  val options: Vector[OParser[?, Options]] = Vector(
    opt[String]("spark").valueName("MASTER")
      .text(OptionText(
        "render on Apache Spark, e.g. spark://host:7077; needs Spark and candela-spark.jar",
        "[Clusters](CLUSTERS.md)."
      ))
      .action((m, o) => o.copy(cluster = o.cluster.copy(master = Some(m)))),
    opt[Int]("shards").valueName("N")
      .text("number of parts for --spark (default: four per processor of the cluster)")
      .validate(n => if n >= 1 then success else failure(s"--shards must be positive, found `$n`"))
      .action((n, o) => o.copy(cluster = o.cluster.copy(shards = Some(n))))
  )

  /** What is wrong with the options of `render`, if anything. */
  def problem(o: Options): Option[String] =
    val film = o.film
    val local = Vector(
      "checkpoint" -> film.checkpoint.isDefined,
      "shard" -> !film.shard.isWhole,
      "time" -> o.settings.goal.time.isDefined,
      "error" -> o.settings.goal.error.isDefined,
      "report" -> o.reports.nonEmpty,
      "watch" -> o.watch.isDefined,
      "display-server" -> o.displayServer.isDefined,
      "debug" -> o.debug,
      "pixelmaterial" -> o.pixelMaterial.isDefined,
      "write-partial-images" -> o.partialImages,
      "mse-reference-out" -> o.settings.output.errors.isDefined,
      "thumbnail" -> o.thumbnail.isDefined
    )
    if o.cluster.master.isEmpty then
      Option.when(o.cluster.shards.isDefined)("--shards needs --spark MASTER")
    else local.collectFirst { case (name, true) => s"--spark can't be combined with --$name" }

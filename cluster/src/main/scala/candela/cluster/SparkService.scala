package candela.cluster

import candela.job.{Cluster, ClusterFailure, ClusterService}

import org.apache.spark.{SparkConf, SparkContext}

import scala.util.control.NonFatal

/** Found by the program when `--spark` asks for it. */
final class SparkService extends ClusterService:

  def connect(master: String, note: String => Unit): Cluster =
    val conf = SparkService.configured(new SparkConf().setMaster(master))
    try SparkCluster(new SparkContext(conf), note)
    catch
      case NonFatal(e) =>
        throw ClusterFailure(s"can't reach Spark at `$master`: ${e.getMessage}", e)

object SparkService:

  /** Fills in what the user has not set. */
  def configured(conf: SparkConf): SparkConf =
    val options = Vector(
      "spark.app.name" -> "Candela",
      "spark.log.level" -> "WARN",
      // The last shards shall not wait for a slow machine.
      "spark.speculation" -> "true",
      "spark.speculation.quantile" -> "0.75",
      "spark.speculation.multiplier" -> "2",
      "spark.executor.heartbeatInterval" -> "2s", // carries the progress
      "spark.driver.maxResultSize" -> "0", // one film, as large as it is
      "spark.ui.enabled" -> "false",
      // As in build.sbt
      "spark.executor.extraJavaOptions" ->
        "-XX:+UseParallelGC -Xss4m --add-exports=java.base/jdk.internal.module=ALL-UNNAMED"
    )
    for (name, value) <- options do conf.setIfMissing(name, value): Unit
    conf

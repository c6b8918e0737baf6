package candela.cluster

import org.apache.spark.Success
import org.apache.spark.scheduler.*

import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.LongAdder

import scala.jdk.CollectionConverters.*

/** Observes tasks: what they have done until now, and what they sent. */
private final class Traffic extends SparkListener:
  // Values of the accumulators of running tasks, by accumulator and task
  private val values = ConcurrentHashMap[(Long, Long), Long]
  private val finished, failed, shuffled, results = LongAdder()

  def tasks: Long = finished.sum
  def failures: Long = failed.sum

  /** Bytes that tasks have read from others. */
  def exchanged: Long = shuffled.sum

  /** Bytes that tasks have sent to the driver. */
  def returned: Long = results.sum

  /** Sum over running tasks. */
  def running(accumulator: Long): Long =
    values.asScala.collect { case ((`accumulator`, _), value) => value }.sum

  override def onExecutorMetricsUpdate(update: SparkListenerExecutorMetricsUpdate): Unit =
    for (task, _, _, accumulators) <- update.accumUpdates; info <- accumulators do
      info.update match
        case Some(value: Long) => values.put((info.id, task), value): Unit
        case _ => ()

  override def onTaskEnd(end: SparkListenerTaskEnd): Unit =
    finished.increment()
    if end.reason != Success then failed.increment()
    values.keySet.removeIf(_._2 == end.taskInfo.taskId): Unit
    for metrics <- Option(end.taskMetrics) do
      shuffled.add(metrics.shuffleReadMetrics.totalBytesRead)
      results.add(metrics.resultSize)

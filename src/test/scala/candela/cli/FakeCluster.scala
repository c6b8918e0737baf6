package candela.cli

import candela.job.{Cluster, ClusterFailure, ClusterRun, ClusterService, ClusterWork, ShardRenderer}
import candela.render.{RenderControl, Shard}

import java.nio.file.{Files, Path}

/** A cluster within this process, by the name `fake`; `broken` can't be reached. */
final class FakeClusterService extends ClusterService:
  def connect(master: String, note: String => Unit): Cluster =
    if master != "fake" then throw ClusterFailure(s"can't reach `$master`\nstart it")
    FakeCluster()

final class FakeCluster extends Cluster:
  def summary: String = "fake"
  def close(): Unit = ()

  def submit(work: ClusterWork): ClusterRun = new ClusterRun:
    def isDone: Boolean = true
    def samples: Long = work.total
    def cancel(): Unit = ()

    /** Two films: the sum of all shards but the last, and the last. */
    def films(folder: Path): Vector[Path] =
      if work.scene.toString.contains("lost") then throw ClusterFailure("all machines are gone")
      val renderer = ShardRenderer(work.header, work.scene, threads = 1)
      val count = work.shards.getOrElse(3)
      val shards = Vector.tabulate(count): i =>
        val file = folder.resolve(s"$i.film")
        val _ = renderer.render(file, RenderControl(shard = Shard(i, count)))
        file
      val sum = folder.resolve("sum.film")
      val _ = renderer.merge(shards.init, sum)
      shards.init.foreach(Files.delete)
      if work.scene.toString.contains("partial") then Vector(sum) else Vector(sum, shards.last)

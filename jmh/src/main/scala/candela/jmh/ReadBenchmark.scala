package candela.jmh

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import candela.io.InputFile
import candela.build.shapes.{PlyFile, PlyMesh}
import candela.scenefile.{Parser, SceneDescription}

import org.openjdk.jmh.annotations.*

/** How fast scene files and meshes are read, in MB/s on one core: an operation is a file of 32 MB,
  * counted as 32.
  */
@State(Scope.Benchmark)
@BenchmarkMode(Array(Mode.Throughput))
@OutputTimeUnit(TimeUnit.SECONDS)
@Warmup(iterations = 3, time = 2)
@Measurement(iterations = 5, time = 2)
@Fork(value = 1, jvmArgsAppend = Array("-Xmx2g", "-XX:+UseParallelGC"))
class ReadBenchmark:
  @Param(Array("floats", "integers", "mixed", "statements"))
  var text: String = ""

  private var scene = Path.of("")
  private var packed = Path.of("")

  @Setup
  def write(): Unit =
    scene = MeshText.write(text, packed = false)
    packed = MeshText.write(text, packed = true)

  @TearDown
  def delete(): Unit = List(scene, packed).foreach(Files.delete(_))

  @Benchmark
  @OperationsPerInvocation(MeshText.Megabytes)
  def parse(): SceneDescription = Parser.parse(scene)

  @Benchmark
  @OperationsPerInvocation(MeshText.Megabytes)
  def parsePacked(): SceneDescription = Parser.parse(packed)

/** The same for PLY files. */
@State(Scope.Benchmark)
@BenchmarkMode(Array(Mode.Throughput))
@OutputTimeUnit(TimeUnit.SECONDS)
@Warmup(iterations = 3, time = 2)
@Measurement(iterations = 5, time = 2)
@Fork(value = 1, jvmArgsAppend = Array("-Xmx2g", "-XX:+UseParallelGC"))
class PlyBenchmark:
  @Param(Array("ascii", "binary_little_endian"))
  var format: String = ""

  private var mesh = Path.of("")

  @Setup
  def write(): Unit = mesh = MeshText.ply(format)

  @TearDown
  def delete(): Unit = Files.delete(mesh)

  @Benchmark
  @OperationsPerInvocation(MeshText.Megabytes)
  def read(): PlyMesh = PlyFile.read(InputFile.named(mesh))

package candela.cli

import candela.cli.options.{Command, CommandTable}
import candela.testing.TempFolder

import java.nio.file.attribute.PosixFilePermissions
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*

import org.scalatest.funsuite.AnyFunSuite

/** The templates of `deploy` fit the program. Their schemas are checked by `deploy/check.py`. */
class DeploySuite extends AnyFunSuite:
  private val folder = Path.of("deploy")
  private val templates =
    Vector("kubernetes.yaml", "openjd.yaml", "aws-batch-render.json", "aws-batch-merge.json")

  test("the options in the templates are known"):
    val known = Vector(Command.Render, Command.Merge).flatMap(CommandTable.of(_).names).toSet
    for file <- templates do
      val used = "--([a-z][a-z-]+)".r.findAllMatchIn(Files.readString(folder.resolve(file)))
      val names = used.map(_.group(1)).toSet
      assert(names.contains("outfile") && names.subsetOf(known), file)

  test("the entry point inserts the number of the task, and the names of the films"):
    TempFolder.use: temp =>
      val program = temp.resolve("candela")
      val _ = Files.writeString(program, "#!/bin/sh\nprintf '%s\\n' \"$@\"\n")
      val _ = Files.setPosixFilePermissions(program, PosixFilePermissions.fromString("rwx------"))
      for name <- Vector("0.film", "1.film") do
        val _ = Files.createFile(temp.resolve(name))
      def words(index: (String, String), args: String*): Vector[String] =
        val command = folder.resolve("entrypoint").toAbsolutePath.toString +: args
        val builder = ProcessBuilder(command.asJava)
        val environment = builder.environment
        val _ = environment.put("CANDELA", program.toString)
        val _ = environment.put(index(0), index(1))
        val out = String(builder.start().getInputStream.readAllBytes())
        out.linesIterator.toVector
      val shard = Vector("/a b/s.pbrt", "--shard", "{INDEX}/16", "--outfile", "/w/{INDEX}.film")
      for variable <- Vector("JOB_COMPLETION_INDEX", "AWS_BATCH_JOB_ARRAY_INDEX") do
        assert(
          words(variable -> "7", shard*) ==
            Vector("/a b/s.pbrt", "--shard", "7/16", "--outfile", "/w/7.film")
        )
      assert(
        words("X" -> "", "merge", s"$temp/*.film", "--outfile", "x.exr") ==
          Vector("merge", s"$temp/0.film", s"$temp/1.film", "--outfile", "x.exr")
      )

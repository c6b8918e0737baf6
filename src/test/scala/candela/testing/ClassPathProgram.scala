package candela.testing

import java.nio.file.{Files, Path}

/** The program as these tests have it, as a command that others may start. */
object ClassPathProgram:
  def in(folder: Path): Path =
    val java = ProcessHandle.current.info.command.orElse("java")
    val options = "-XX:+UseParallelGC -Xss4m -Xmx1g"
    val program = folder.resolve("candela")
    val classes = System.getProperty("java.class.path")
    Files.writeString(
      program,
      s"#!/bin/sh\nexec '$java' $options -cp '$classes' candela.cli.Main \"$$@\"\n"
    )
    assert(program.toFile.setExecutable(true))
    program

package candela.cli

import candela.testing.{ClassPathProgram, TempFolder}

import java.nio.file.Path

import scala.jdk.CollectionConverters.*
import scala.util.Try

import org.scalatest.funsuite.AnyFunSuite

/** The add-on for Blender, in a Python with PyPI's module `bpy`: `CANDELA_BPY` names it. */
class BlenderSuite extends AnyFunSuite:
  private val python = sys.env.getOrElse("CANDELA_BPY", "python3")

  test("the add-on's tests pass", org.scalatest.tagobjects.Slow):
    if Try(ProcessBuilder(python, "-c", "import bpy").start().waitFor()).toOption != Some(0) then
      cancel(s"$python has no bpy; CANDELA_BPY names a Python with `pip install bpy`")
    TempFolder.use: folder =>
      val test = Path.of("packaging", "test_blender.py").toString
      val builder = ProcessBuilder(python, test).redirectErrorStream(true)
      builder.environment.putAll(Map(
        "CANDELA_PROGRAM" -> ClassPathProgram.in(folder).toString,
        "PYTHONDONTWRITEBYTECODE" -> "1"
      ).asJava)
      val process = builder.start()
      process.getOutputStream.close()
      val printed = String(process.getInputStream.readAllBytes())
      assert(process.waitFor() == 0 && !printed.contains("skipped: "), printed)

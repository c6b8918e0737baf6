package candela.color

import candela.io.WholeFile
import java.nio.file.Path

/** Makes the resource of [[FitStarts]] anew: `./sbt "Test/runMain candela.color.FitStartsFile"`. */
object FitStartsFile:
  def main(args: Array[String]): Unit =
    val file = Path.of("src/core/resources" + FitStarts.Resource)
    WholeFile.write(file, FitStarts.resourceBytes)

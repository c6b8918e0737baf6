package candela.cli.files

import candela.cli.terminal.Report
import candela.diagnostics.{Code, Problem, Severity}
import candela.image.{Image, ImageFiles}

import java.nio.file.Path

/** Images that the user has named. */
private[cli] object InputImages:

  /** Warns of parts that are not read. */
  def read(path: Path, report: Report): Image =
    val image = ImageFiles.read(path)
    warn(path, report)
    image

  def warn(path: Path, report: Report): Unit =
    val problem = ImageFiles.partsRemark(path)
      .map(Problem(Code.ImageContents, Severity.Warning, None, _))
    report.warnings(problem.toVector, all = true)

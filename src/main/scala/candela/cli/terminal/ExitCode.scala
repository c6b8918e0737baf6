package candela.cli.terminal

/** Result of a run, from best to worst.
  *
  * @param number  the process's exit code
  * @param word    for the help
  * @param meaning for pages
  */
enum ExitCode(val number: Int, val word: String, val meaning: String):
  case Done extends ExitCode(0, "success", "success")

  /** A scene, image or folder is invalid; or a comparison exceeds its limit. */
  case BadInput extends ExitCode(
        1,
        "invalid input",
        "invalid input: a faulty scene or image, or `compare` exceeded a limit"
      )

  /** The command line is invalid. */
  case BadUsage extends ExitCode(2, "invalid usage", "invalid command line")

  /** An internal error. */
  case Bug
      extends ExitCode(3, "internal error", "internal error: a bug in Candela; please report it")

  /** Interrupted by Ctrl-C: 128 plus the number of SIGINT, the shell convention. */
  case Interrupted extends ExitCode(
        130,
        "interrupted",
        "interrupted by Ctrl-C, or by `stop` on the live page, or `--time` was over before " +
          "each pixel had a sample and an older image was kept; the partial image was " +
          "written, or nothing if the rendering had not begun, or Ctrl-C came twice"
      )

  def worseOf(other: ExitCode): ExitCode = if other.ordinal > ordinal then other else this

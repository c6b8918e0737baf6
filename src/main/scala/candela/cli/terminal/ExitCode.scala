package candela.cli.terminal

/** Result of a run, from best to worst; `number` is the process's exit code. */
enum ExitCode(val number: Int):
  case Done extends ExitCode(0)

  /** A scene, image or folder is invalid; or a comparison exceeds its limit. */
  case BadInput extends ExitCode(1)

  /** The command line is invalid. */
  case BadUsage extends ExitCode(2)

  /** An internal error. */
  case Bug extends ExitCode(3)

  /** Interrupted by Ctrl-C: 128 plus the number of SIGINT, the shell convention. */
  case Interrupted extends ExitCode(130)

  def worseOf(other: ExitCode): ExitCode = if other.ordinal > ordinal then other else this

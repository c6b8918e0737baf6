package candela.cli

/** How a run ended, from best to worst; `number` is what the shell sees. */
enum ExitCode(val number: Int):
  case Done extends ExitCode(0)

  /** A scene, an image or a folder is not as it should be; or a comparison is above its limit. */
  case BadInput extends ExitCode(1)

  /** The command line is not understood. */
  case BadUsage extends ExitCode(2)

  /** Candela itself is at fault. */
  case Bug extends ExitCode(3)

  /** Ended by Ctrl-C: 128 and the number of SIGINT, as shells have it. */
  case Interrupted extends ExitCode(130)

  def worseOf(other: ExitCode): ExitCode = if other.ordinal > ordinal then other else this

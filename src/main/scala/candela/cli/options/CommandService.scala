package candela.cli.options

import candela.base.Services
import candela.cli.terminal.{ExitCode, Report, Terminal}

/** A command that another module brings, looked up at run time. */
private[candela] abstract class CommandService:
  def row: CommandRow

  /** A remark for each option that can have no effect beside the others. */
  def idle: Options => Vector[String] = _ => Vector.empty

  def run(options: Options, terminal: Terminal, report: Report): ExitCode

private[candela] object CommandService:
  lazy val installed: Vector[CommandService] =
    Services.installed(classOf[CommandService]).toVector

  /** Whether it is a command of a module that is not installed. */
  def isMissing(command: Command): Boolean =
    command.module.isDefined && !installed.exists(_.row.command == command)

  /** Of a command that is not missing. */
  def of(command: Command): CommandService = installed.find(_.row.command == command).get

/** Options of a command that another module brings, which alone knows them. */
private[candela] trait ModuleOptions

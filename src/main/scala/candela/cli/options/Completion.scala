package candela.cli.options

import scopt.OptionDef

/** What makes shells complete the command lines of candela: commands, options, values and files, as
  * the option tables have them.
  */
private[cli] object Completion:

  /** For the pages: how it is switched on. */
  val Install: String =
    "bash: `eval \"$(candela completion bash)\"` in `~/.bashrc`; zsh: `source <(candela " +
      "completion zsh)` in `~/.zshrc`, behind `compinit`; fish: `candela completion fish > " +
      "~/.config/fish/completions/candela.fish`; PowerShell: `candela completion powershell | " +
      "Out-String | Invoke-Expression` in the profile."

  def of(shell: String): Option[Vector[String]] = shell match
    case "bash" => Some(BashCompletion.script)
    case "zsh" => Some(ZshCompletion.script)
    case "fish" => Some(FishCompletion.script)
    case "powershell" => Some(PowerShellCompletion.script)
    case _ => None

  /** An option of a command.
    *
    * @param names with dashes, the long one last
    * @param value what must follow it; None: nothing, or maybe something
    */
  final case class Known(
      names: Vector[String],
      text: String,
      value: Option[Words],
      valueName: String,
      isRepeated: Boolean
  )

  def options(row: CommandRow): Vector[Known] =
    row.options.map(entry) :+ Known(Vector("-h", "--help"), "print this help", None, "", false)

  private def entry(o: OptionDef[?, Options]): Known =
    val mayLack = o.valueName.exists(_.startsWith("["))
    Known(
      o.shortOpt.toVector.map(s => s"-$s") :+ s"--${o.name}",
      OptionText.short(o.desc),
      if mayLack then None else Words.of(o),
      o.valueName.getOrElse(""),
      o.getMaxOccurs > 1
    )

  def commands: Vector[CommandRow] = CommandTable.rows
  def commandWords: Vector[String] = commands.map(_.command.word)

  /** Words at the first place that are no commands of the table. */
  val extraWords: Vector[(String, String)] =
    Vector("help" -> "list the commands, or the options of one", "version" -> "print the version")

  /** All that may stand at the first place and is no file. */
  def firsts: Vector[String] = commandWords ++ extraWords.map(_._1)

  /** What stands behind a word at the first place, and is neither option nor value. */
  def arguments: Vector[(String, Words)] =
    commands.map(r => r.command.word -> r.takes.named) :+ ("help" -> Words.Of(commandWords))

/** Source: GNU, "Bash Reference Manual", "Programmable Completion". Also for bash 3.2. */
private object BashCompletion:
  import Completion.*

  def script: Vector[String] =
    Head.linesIterator.toVector ++ values ++ Middle.linesIterator.toVector ++
      commands.map(r => s"      ${r.command.word}) ${words(options(r).flatMap(_.names))} ;;") ++
      Next.linesIterator.toVector ++
      arguments.map((word, takes) => s"      $word) ${action(takes)} ;;") ++
      End.linesIterator

  /** Cases of what follows an option, one for those with the same words. */
  private def values: Vector[String] =
    val cases =
      for
        r <- commands; o <- options(r); value <- o.value.toVector; name <- o.names
      yield s"'${r.command.word} $name'" -> action(value)
    cases.map(_._2).distinct.map: action =>
      s"    ${cases.filter(_._2 == action).map(_._1).mkString("|")}) $action; return ;;"

  private def words(all: Vector[String]): String = s"_candela_words '${all.mkString(" ")}'"

  private def action(w: Words): String = w match
    case Words.Files(suffixes) => (Vector("_candela_files") ++ suffixes).mkString(" ")
    case Words.Folders => "_candela_folders"
    case Words.Of(all) => words(all)
    case Words.Listed(all) => s"_candela_listed '${all.mkString(" ")}'"
    case _ => ":"

  private val Head =
    s"""# Completion of candela for bash; made by: candela completion bash
       |_candela_words() { COMPREPLY=($$(compgen -W "$$1" -- "$$cur")); }
       |_candela_listed() {
       |  local before=
       |  case $$cur in *,*) before=$${cur%,*}, ;; esac
       |  COMPREPLY=($$(compgen -P "$$before" -W "$$1" -- "$${cur##*,}"))
       |  compopt -o nospace 2>/dev/null
       |}
       |_candela_folders() {
       |  local IFS=$$'\\n'
       |  compopt -o filenames 2>/dev/null
       |  COMPREPLY=($$(compgen -d -- "$$cur"))
       |}
       |_candela_files() {
       |  local IFS=$$'\\n' suffix
       |  compopt -o filenames 2>/dev/null
       |  if [ $$# = 0 ]; then
       |    COMPREPLY=($$(compgen -f -- "$$cur"))
       |  else
       |    COMPREPLY=($$(compgen -d -- "$$cur"))
       |    for suffix; do COMPREPLY+=($$(compgen -f -X "!*.$$suffix" -- "$$cur")); done
       |  fi
       |}
       |_candela() {
       |  local cur=$${COMP_WORDS[COMP_CWORD]} prev=$${COMP_WORDS[COMP_CWORD-1]} command=render
       |  COMPREPLY=()
       |  # bash splits words at =
       |  if [ "$$cur" = = ]; then cur=
       |  elif [ "$$prev" = = ]; then prev=$${COMP_WORDS[COMP_CWORD-2]}; fi
       |  if [ "$$COMP_CWORD" -gt 1 ]; then
       |    case $${COMP_WORDS[1]} in ${firsts.mkString("|")}) command=$${COMP_WORDS[1]} ;; esac
       |  fi
       |  case "$$command $$prev" in""".stripMargin

  private val Middle =
    """  esac
      |  if [ "${cur#-}" != "$cur" ]; then
      |    case $command in""".stripMargin

  private val Next =
    s"""    esac
       |  else
       |    case $$command in""".stripMargin

  private val End =
    s"""    esac
       |    if [ "$$COMP_CWORD" = 1 ]; then
       |      COMPREPLY+=($$(compgen -W '${firsts.mkString(" ")}' -- "$$cur"))
       |    fi
       |  fi
       |}
       |complete -F _candela candela""".stripMargin

/** Source: zsh's manual, zshcompsys(1), `_arguments`. */
private object ZshCompletion:
  import Completion.*

  def script: Vector[String] =
    Head.linesIterator.toVector ++
      (commands.map(r => r.command.word -> r.meaning) ++ extraWords).map: (word, meaning) =>
        s"    '$word:${quoted(meaning)}'"
      ++ Middle.linesIterator ++ commands.flatMap(arguments) ++ End.linesIterator

  private def arguments(r: CommandRow): Vector[String] =
    val optionLines = options(r).flatMap(option)
    s"    ${r.command.word}) _arguments -S \\" +:
      (optionLines :+ s"'*:${r.command.word}:${action(r.takes.named)}' ;;").map("      " + _)

  private def option(o: Known): Vector[String] =
    val value = o.value.fold("")(w => s":${inSpec(o.valueName)}:${action(w)}")
    val repeatMark = if o.isRepeated then "*" else ""
    val exclusions =
      if o.isRepeated || o.names.size < 2 then "" else o.names.mkString("(", " ", ")")
    o.names.map(n => s"'$exclusions$repeatMark$n[${inSpec(o.text)}]$value' \\")

  private def action(w: Words): String = w match
    case Words.Files(Vector()) => "_files"
    case Words.Files(suffixes) => s"_files -g \"*.(${suffixes.mkString("|")})(-.)\""
    case Words.Folders => "_files -/"
    case Words.Listed(all) if all.forall(!_.endsWith("=")) =>
      s"_values -s , name ${all.mkString(" ")}"
    case Words.Of(all) => all.mkString("(", " ", ")")
    case Words.Listed(all) => all.mkString("(", " ", ")")
    case _ => " "

  private def quoted(text: String): String = text.replace("'", "'\\''")

  private def inSpec(text: String): String =
    quoted(text.replace("\\", "\\\\").replaceAll("([\\[\\]:])", "\\\\$1"))

  private val Head =
    """#compdef candela
      |# Completion of candela for zsh; made by: candela completion zsh
      |_candela() {
      |  local command=render
      |  local -a commands
      |  commands=(""".stripMargin

  private def scenes = action(Words.scenes)

  private val Middle =
    s"""  )
       |  if (( CURRENT == 2 )) && [[ $$words[2] != -* ]]; then
       |    _describe -t commands command commands
       |    $scenes
       |    return
       |  fi
       |  if (( CURRENT > 2 )) && (( $${commands[(I)$$words[2]:*]} )); then
       |    command=$$words[2]
       |    shift words
       |    (( CURRENT-- ))
       |  fi
       |  case $$command in
       |    help) _arguments '1:command:(${commandWords.mkString(" ")})' ;;""".stripMargin

  private val End =
    """  esac
      |}
      |if [[ $funcstack[1] == _candela ]]; then _candela "$@"; else compdef _candela candela; fi"""
      .stripMargin

/** Source: fish's documentation, `complete`. */
private object FishCompletion:
  import Completion.*

  def script: Vector[String] =
    val first = commands.map(r => r.command.word -> r.meaning) ++ extraWords
    Head.linesIterator.toVector ++
      first.map((word, text) =>
        s"complete -c candela -n __candela_first -a $word -d ${quoted(text)}"
      ) ++
      arguments.map((word, takes) =>
        s"complete -c candela -n '__candela_is $word' -a ${given_(takes)}"
      ) ++
      commands.flatMap(r => options(r).map(option(r, _)))

  private def option(r: CommandRow, o: Known): String =
    val names = o.names.map: n =>
      if n.startsWith("--") then s"-l ${n.drop(2)}" else s"-s ${n.drop(1)}"
    val value = o.value.fold("")(w => s" -x -a ${given_(w)}")
    s"complete -c candela -n '__candela_is ${r.command.word}' ${names.mkString(" ")}$value " +
      s"-d ${quoted(o.text)}"

  /** The argument of `-a`. */
  private def given_(w: Words): String = w match
    case Words.Files(Vector()) => "'(__candela_files \".*\")'"
    case Words.Files(suffixes) =>
      s"'(__candela_files \".*(/|\\.(${suffixes.mkString("|").replace(".", "\\.")}))\")'"
    case Words.Folders => "'(__candela_files \".*/\")'"
    case Words.Of(all) => quoted(all.mkString(" "))
    case Words.Listed(all) => s"'(__candela_listed ${all.mkString(" ")})'"
    case _ => "''"

  private def quoted(text: String): String =
    s"'${text.replace("\\", "\\\\").replace("'", "\\'")}'"

  private val Head =
    s"""# Completion of candela for fish; made by: candela completion fish
       |function __candela_first
       |  test (count (commandline -opc)) -eq 1
       |end
       |function __candela_is -a command
       |  set -l words (commandline -opc)
       |  set -l found render
       |  if set -q words[2]; and contains -- $$words[2] ${firsts.mkString(" ")}
       |    set found $$words[2]
       |  end
       |  test $$found = $$command
       |end
       |function __candela_files -a pattern
       |  set -l token (commandline -ct)
       |  complete -C"__candela_no_command $$token" | string match -r -- "^$$pattern\\$$"
       |end
       |function __candela_listed
       |  set -l before (commandline -ct | string match -r -- '.*,')
       |  for word in $$argv
       |    echo "$$before$$word"
       |  end
       |end
       |complete -c candela -e
       |complete -c candela -f""".stripMargin

/** Source: Microsoft, "Register-ArgumentCompleter", PowerShell 5.1 and 7. */
private object PowerShellCompletion:
  import Completion.*

  def script: Vector[String] =
    Head.linesIterator.toVector ++
      commands.map: r =>
        s"    '${r.command.word}' = ${listed(options(r).flatMap(_.names))}"
      ++ Middle.linesIterator ++ values ++ End.linesIterator

  private def values: Vector[String] =
    for
      r <- commands; o <- options(r); words <- o.value.toVector.flatMap(given_); name <- o.names
    yield s"    '${r.command.word} $name' = ${listed(words)}"

  private def given_(w: Words): Option[Vector[String]] = w match
    case Words.Of(all) => Some(all)
    case Words.Listed(all) => Some(all)
    case _ => None

  private def listed(all: Vector[String]): String = all.map(w => s"'$w'").mkString("@(", ", ", ")")

  private val Head =
    """# Completion of candela for PowerShell; made by: candela completion powershell
      |Register-ArgumentCompleter -Native -CommandName candela, candela.bat -ScriptBlock {
      |  param($word, $ast, $position)
      |  $options = @{""".stripMargin

  private val Middle =
    """  }
      |  $values = @{""".stripMargin

  private val End =
    """  }
      |  $all = @($ast.CommandElements | ForEach-Object { "$_" })
      |  if ($word) { $all = @($all | Select-Object -SkipLast 1) }
      |  $command = 'render'
      |  if ($all.Count -gt 1 -and $options.ContainsKey($all[1])) { $command = $all[1] }
      |  $after = "$command $($all[-1])"
      |  if ($values.ContainsKey($after)) { $found = $values[$after] }
      |  elseif ($word.StartsWith('-')) { $found = $options[$command] }
      |  elseif ($all.Count -eq 1) { $found = $options.Keys | Sort-Object }
      |  # Without an answer PowerShell completes the names of files
      |  $found | Where-Object { $_ -like "$word*" } | ForEach-Object {
      |    [System.Management.Automation.CompletionResult]::new($_)
      |  }
      |}""".stripMargin

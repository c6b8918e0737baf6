package candela.scenefile

import candela.diagnostics.{Code, Problem, Severity}

/** Collects problems, up to a limit that bounds memory. */
final class Problems:
  private var collected = Vector.newBuilder[Problem]
  private var errorCount = 0
  private var warningCount = 0

  def errors: Int = errorCount

  /** Whether parsing should stop: with this many errors the file is no scene. */
  def isFull: Boolean = errorCount >= Problems.MaxErrors

  def clear(): Unit =
    collected = Vector.newBuilder[Problem]
    errorCount = 0
    warningCount = 0

  def add(problem: Problem): Unit =
    if problem.severity == Severity.Error then
      errorCount += 1
      if errorCount <= Problems.MaxErrors then collected += problem
    else
      warningCount += 1
      if warningCount <= Problems.MaxWarnings then collected += problem

  /** The problems in order of discovery, with a note about those omitted. */
  def result(): Vector[Problem] =
    val omitted = warningCount - Problems.MaxWarnings
    val stop = s"parsing stopped after ${Problems.MaxErrors} errors"
    collected.result() ++
      Option.when(isFull)(Problem.general(Code.TooManyProblems, stop)) ++
      Option.when(omitted > 0)(Problem(
        Code.TooManyProblems,
        Severity.Warning,
        None,
        s"$omitted more warnings omitted"
      ))

object Problems:
  /** Further ones get no help: it is looked for among thousands of names. */
  val MaxHelped = 200
  val MaxErrors = 1000
  val MaxWarnings = 10000

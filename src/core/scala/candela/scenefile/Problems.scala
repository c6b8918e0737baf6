package candela.scenefile

import candela.base.{Code, Problem, Severity}

/** Collects problems, up to a limit that bounds memory. */
final class Problems:
  private var collected = Vector.newBuilder[Problem]
  private var errorCount = 0
  private var warningCount = 0

  def errors: Int = errorCount

  /** Whether parsing should stop: with this many errors the file is no scene. */
  def isFull: Boolean = errorCount >= Problems.MostErrors

  def clear(): Unit =
    collected = Vector.newBuilder[Problem]
    errorCount = 0
    warningCount = 0

  def add(problem: Problem): Unit =
    if problem.severity == Severity.Error then
      errorCount += 1
      if errorCount <= Problems.MostErrors then collected += problem
    else
      warningCount += 1
      if warningCount <= Problems.MostWarnings then collected += problem

  /** The problems in order of discovery, with a note about those omitted. */
  def result(): Vector[Problem] =
    val left = warningCount - Problems.MostWarnings
    val stop = s"parsing stopped after ${Problems.MostErrors} errors"
    collected.result() ++
      Option.when(isFull)(Problem.general(Code.TooManyProblems, stop)) ++
      Option.when(left > 0)(Problem(
        Code.TooManyProblems,
        Severity.Warning,
        None,
        s"$left more warnings omitted"
      ))

object Problems:
  /** Further ones get no help: it is looked for among thousands of names. */
  val MostHelped = 200
  val MostErrors = 1000
  val MostWarnings = 10000

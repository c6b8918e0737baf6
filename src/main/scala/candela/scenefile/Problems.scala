package candela.scenefile

import candela.base.{Problem, Severity}

/** Collects problems, up to a number that fits the memory. */
final class Problems:
  private val collected = Vector.newBuilder[Problem]
  private var errorCount = 0
  private var warningCount = 0

  def errors: Int = errorCount

  /** Are there so many errors that this is no scene file at all? Then reading should stop. */
  def isFull: Boolean = errorCount >= Problems.MostErrors

  def add(problem: Problem): Unit =
    if problem.severity == Severity.Error then
      errorCount += 1
      if errorCount <= Problems.MostErrors then collected += problem
    else
      warningCount += 1
      if warningCount <= Problems.MostWarnings then collected += problem

  /** The problems in the order in which they were found, with a note if some are left out. */
  def result(): Vector[Problem] =
    val left = warningCount - Problems.MostWarnings
    val stop = s"reading stopped after ${Problems.MostErrors} errors"
    collected.result() ++
      Option.when(isFull)(Problem.general(stop)) ++
      Option.when(left > 0)(Problem(Severity.Warning, None, s"$left more warnings are not shown"))

object Problems:
  val MostErrors = 1000
  val MostWarnings = 10000

package candela.diagnostics

import java.util.Locale

/** Kinds of problems. Problems with one meaning and cure share a number, which is never reused.
  *
  * [[ProblemGuide]] explains them; `candela explain E0201` prints that, docs/PROBLEMS.md has all.
  *
  * @param number in groups: 1 command lines, 100 files and the machine, 200 statements, 300
  *   parameters, 400 types and names, 500 what is not supported, 600 what does nothing, 700 files
  *   that scenes name, 800 Mitsuba's, 900 conversion, 1000 saved renderings, 1100 images
  *   and errors, 1200 suites
  */
enum Code(val number: Int):
  case UnknownCommand extends Code(1)
  case UnknownOption extends Code(2)
  case OptionValue extends Code(3)
  case MissingArgument extends Code(4)
  case OptionConflict extends Code(5)
  case IdleOption extends Code(6)
  case UnknownEntry extends Code(7)
  case OptionMisfit extends Code(8)
  case MoreArguments extends Code(9)

  case NoSuchScene extends Code(101)
  case NoScene extends Code(102)
  case Unreadable extends Code(103)
  case NoSuchFile extends Code(104)
  case Unwritable extends Code(105)
  case UnknownFormat extends Code(106)
  case OutputConflict extends Code(107)
  case ImageName extends Code(108)
  case Sandboxed extends Code(109)
  case LimitExceeded extends Code(110)
  case OutOfMemory extends Code(111)
  case TooDeep extends Code(112)
  case TooLarge extends Code(113)
  case Interrupted extends Code(114)
  case MissingLibrary extends Code(115)
  case Internal extends Code(116)
  case Viewer extends Code(117)
  case Terminal extends Code(118)

  case UnknownDirective extends Code(201)
  case NoDirective extends Code(202)
  case Arguments extends Code(203)
  case Token extends Code(204)
  case OpenBlock extends Code(205)
  case WrongPlace extends Code(206)
  case NoWorld extends Code(207)
  case SeveralWorlds extends Code(208)
  case IncludeCircle extends Code(209)
  case Transform extends Code(210)
  case UnknownSystem extends Code(211)
  case TooManyProblems extends Code(212)
  case MixedDialects extends Code(213)

  case UnknownParameter extends Code(301)
  case ParameterType extends Code(302)
  case ParameterCount extends Code(303)
  case ParameterValue extends Code(304)
  case MissingParameter extends Code(305)
  case ExclusiveParameters extends Code(306)
  case ParameterSyntax extends Code(307)
  case IdleParameter extends Code(308)
  case CorrectedValue extends Code(309)

  case UnknownType extends Code(401)
  case OtherDialect extends Code(402)
  case Undefined extends Code(403)
  case Circle extends Code(404)
  case Redefined extends Code(405)
  case DefinedLater extends Code(406)

  case Unsupported extends Code(501)
  case IntegratorLacks extends Code(502)
  case NotAnimated extends Code(503)
  case AsInPbrt extends Code(504)
  case UnlikePbrt extends Code(505)

  case NoSurface extends Code(601)
  case BrokenMesh extends Code(602)
  case DarkScene extends Code(603)
  case DarkLight extends Code(604)
  case NoVolume extends Code(605)
  case EmptyView extends Code(606)

  case DamagedImage extends Code(701)
  case UnsupportedImage extends Code(702)
  case ImageContents extends Code(703)
  case CutImage extends Code(704)
  case DamagedMesh extends Code(705)
  case DamagedVolume extends Code(706)
  case SpectrumFile extends Code(707)
  case MeasuredFile extends Code(708)

  case MalformedXml extends Code(801)
  case UnknownElement extends Code(802)
  case SceneParameter extends Code(803)
  case Nesting extends Code(804)

  case Inexpressible extends Code(901)
  case UnconvertedImage extends Code(902)
  case SideFile extends Code(903)
  case NoConversion extends Code(904)
  case ShiftedColors extends Code(905)

  case DamagedFilm extends Code(1001)
  case OtherRendering extends Code(1002)
  case FilmInUse extends Code(1003)
  case NothingToAdd extends Code(1004)
  case IncompleteShards extends Code(1005)
  case FrameNames extends Code(1006)
  case Cluster extends Code(1007)

  case DifferentImages extends Code(1101)
  case NothingFinite extends Code(1102)
  case ImageEdit extends Code(1103)
  case MissedGoal extends Code(1104)
  case DiscardedSamples extends Code(1105)
  case Denoiser extends Code(1106)
  case EmptyImage extends Code(1107)

  case SuiteFile extends Code(1201)
  case NoProgram extends Code(1202)

  /** The number as printed: `E0201`. */
  def word: String = "E%04d".formatLocal(Locale.ROOT, number)

object Code:
  /** The code of a word such as `E0201`, `e201` or `201`. */
  def of(word: String): Option[Code] =
    val digits = word.trim.stripPrefix("E").stripPrefix("e")
    val number = Option.when(digits.nonEmpty && digits.forall(Character.isDigit))(digits)
    number.flatMap(_.toIntOption).flatMap(n => values.find(_.number == n))

package candela.mitsuba

import candela.diagnostics.{Code, Problem, Refusal, SceneError, SourcePos}
import candela.io.{InputFile, IoReason, Sha256}
import java.io.{
  BufferedInputStream, ByteArrayInputStream, InputStream, InputStreamReader, IOException, Reader
}
import java.nio.charset.{CharacterCodingException, Charset}
import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_16, UTF_8}
import javax.xml.stream.{Location, XMLInputFactory, XMLStreamException, XMLStreamReader}

import scala.collection.mutable.ArrayBuffer
import scala.util.Using

/** An XML element.
  *
  * @param pos        position of its start tag
  * @param formerName the attribute `name` of the file, if Mitsuba has renamed it
  * @param isOld      whether the file is one of Mitsuba 0.6
  */
final case class Element(
    tag: String,
    attributes: Map[String, String],
    children: Vector[Element],
    pos: SourcePos,
    formerName: Option[String] = None,
    isOld: Boolean = false
):
  def apply(attribute: String): Option[String] = attributes.get(attribute)

  /** SHA-256 of what it says: comments, space and the order of attributes have no part in it. */
  def digest: String = Sha256.ofLines(tokens)

  private def tokens: Iterator[String] =
    val named = attributes.toVector.sorted.iterator.map((name, value) => s"$name=$value")
    Iterator(s"<$tag") ++ named ++ children.iterator.flatMap(_.tokens) ++ Iterator(">")

/** Reads XML files. Document types, and thereby entities, are refused. */
object XmlFile:

  /** The root element.
    *
    * @param includedFrom the element that includes the file
    */
  def read(file: InputFile, includedFrom: Option[SourcePos]): Element =
    val root = read(file.toString, file.undigested(), includedFrom)
    if file.isRegular then file.note(root.digest)
    root

  /** The root element of a text. */
  def ofText(name: String, text: String): Element =
    read(name, ByteArrayInputStream(text.getBytes(UTF_8)), None)

  /** @param open its bytes */
  def read(name: String, open: => InputStream, includedFrom: Option[SourcePos]): Element =
    def sourcePos(l: Location) =
      SourcePos(name, l.getLineNumber.max(1), l.getColumnNumber.max(1), includedFrom)
    try
      Refusal.placed(SourcePos(name, 1, 1, includedFrom)):
        Using.resource(open): in =>
          val reader = factory.createXMLStreamReader(text(in))
          try Document(reader, sourcePos).root()
          finally reader.close()
    catch
      case e: XMLStreamException =>
        val position = Option(e.getLocation).fold(SourcePos(name, 1, 1, includedFrom))(sourcePos)
        throw SceneError(Problem.error(
          Code.MalformedXml,
          position,
          s"malformed XML: ${message(e)}"
        ))
      case e: SceneError => throw e
      // The JDK's parser has faults of its own with damaged document types
      case e: RuntimeException =>
        val position = SourcePos(name, 1, 1, includedFrom)
        throw SceneError(Problem.error(
          Code.MalformedXml,
          position,
          s"malformed XML: ${message(e)}"
        ))
      case e: IOException =>
        val message = s"can't read `$name`: ${IoReason(e)}"
        throw SceneError(Problem.error(Code.Unreadable, includedFrom, message, None))

  /** Decoded here, as the JDK's parser prints what it can't decode. The encoding is that of the
    * byte order mark or of the declaration, else UTF-8.
    */
  private def text(file: InputStream): Reader =
    val input = BufferedInputStream(file)
    input.mark(HeadSize)
    val head = input.readNBytes(HeadSize)
    input.reset()
    val marks = head.take(3).map(_ & 0xff).toVector
    val isUtf16 = marks.startsWith(Vector(0xfe, 0xff)) || marks.startsWith(Vector(0xff, 0xfe))
    if marks == Vector(0xef, 0xbb, 0xbf) then input.skipNBytes(3)
    val charset =
      if isUtf16 then UTF_16
      else
        val declared = Encoding.findFirstMatchIn(String(head, ISO_8859_1)).map(_.group(1))
        try declared.fold(UTF_8)(Charset.forName)
        catch
          case _: IllegalArgumentException =>
            throw XMLStreamException(s"unknown encoding ${declared.mkString}")
    InputStreamReader(input, charset.newDecoder)

  private val HeadSize = 200
  private val Encoding = """^(?:\u00EF\u00BB\u00BF)?<\?xml[^>]*encoding\s*=\s*["']([\w.:-]+)""".r

  private def factory: XMLInputFactory =
    val inputFactory = XMLInputFactory.newDefaultFactory()
    inputFactory.setProperty(XMLInputFactory.SUPPORT_DTD, false)
    inputFactory.setProperty(XMLInputFactory.IS_SUPPORTING_EXTERNAL_ENTITIES, false)
    inputFactory

  /** The parser repeats the position before its message, and names its own properties after it. */
  private def message(e: Exception): String = e match
    case x: XMLStreamException if x.getNestedException.isInstanceOf[CharacterCodingException] =>
      "the text is not of its encoding, which is UTF-8 unless the file declares another"
    case _ =>
      val description = Option(e.getMessage).getOrElse(e.toString)
      description.split(
        "Message: ",
        2
      ).last.linesIterator.nextOption.getOrElse("unreadable").trim match
        case Repeated(element, name) => s"<$element> has the attribute `$name` twice"
        case text => text

  /** What the JDK's parser says, without a text of its own. */
  private val Repeated = raw".*#AttributeNotUnique\?(.*)&(.*)".r

  /** More than any scene has; fewer than a stack has room for. */
  private val MaxDepth = 100

  private final class Document(reader: XMLStreamReader, sourcePos: Location => SourcePos):

    def root(): Element =
      var start = sourcePos(reader.getLocation)
      while reader.next() != START do start = sourcePos(reader.getLocation)
      val rootElement = element(start, 1)
      while reader.hasNext do
        val _ = reader.next()
      rootElement

    /** The current element. The position of an event is its end: that of a tag's start is the end
      * of the event before.
      */
    private def element(at: SourcePos, depth: Int): Element =
      if depth > MaxDepth then
        throw SceneError(Problem.error(
          Code.Circle,
          at,
          s"more than $MaxDepth elements within each other"
        ))
      val tag = reader.getLocalName
      val attributes = (0 until reader.getAttributeCount)
        .map(i => reader.getAttributeLocalName(i) -> reader.getAttributeValue(i)).toMap
      val children = ArrayBuffer.empty[Element]
      var eventStart = sourcePos(reader.getLocation)
      var event = reader.next()
      while event != END do
        if event == START then children += element(eventStart, depth + 1)
        else if event == ENTITY then
          val name = reader.getLocalName
          throw SceneError(Problem.error(
            Code.MalformedXml,
            eventStart,
            s"unknown entity `&$name;`"
          ))
        val end = sourcePos(reader.getLocation)
        // The parser knows that text ends once it has read the character after it
        eventStart = if event == TEXT then end.copy(column = (end.column - 1).max(1)) else end
        event = reader.next()
      Element(tag, attributes, children.toVector, at)

  private inline val START = javax.xml.stream.XMLStreamConstants.START_ELEMENT
  private inline val END = javax.xml.stream.XMLStreamConstants.END_ELEMENT
  private inline val TEXT = javax.xml.stream.XMLStreamConstants.CHARACTERS
  private inline val ENTITY = javax.xml.stream.XMLStreamConstants.ENTITY_REFERENCE

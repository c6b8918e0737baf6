package candela.render

import java.nio.ByteBuffer
import java.nio.file.{Files, Path}
import java.security.MessageDigest
import java.util.HexFormat

import scala.jdk.CollectionConverters.*

import candela.guiding.GuidingMode
import candela.image.Image

/** Digests of the reference scenes' images, whose full comparison with the reference has passed.
  *
  * An image depends on scene, seed and sample count alone, so equal digests mean that nothing has
  * changed what the full comparison has found. `reference-images/digests.csv` has a row for each
  * scene: its name, the digest of its image of [[SamplesPerPixel]] samples, and the commit on which
  * the comparison passed. [[RenewDigests]] renews it.
  */
object ImageDigests:
  val File: Path = ReferenceScenes.References.resolve("digests.csv")

  /** What to do where images have changed and are right. */
  val Renewal = "renew the digests by ./sbt \"Test/runMain candela.render.RenewDigests\""

  private val Seed = 1
  private val SamplesPerPixel = 4

  /** Guided paths learn before they are guided. */
  private val GuidedSamplesPerPixel = 16

  /** Half of SHA-256: no two images will ever share it by chance. */
  private val DigestBytes = 16

  final case class Row(scene: String, digest: String, commit: String):
    def line: String = s"\"$scene\",$digest,$commit"

  object Row:
    val Header = "scene,digest,commit"
    def of(line: String): Row =
      val Array(_, scene, rest) = line.split('"'): @unchecked
      val Array(_, digest, commit) = rest.split(','): @unchecked
      Row(scene, digest, commit)

  lazy val rows: Vector[Row] =
    if !Files.exists(File) then Vector.empty
    else Files.readAllLines(File).asScala.toVector.drop(1).map(Row.of)

  /** Digests by the scenes' names. */
  lazy val kept: Map[String, String] = rows.map(row => row.scene -> row.digest).toMap

  def of(scene: ReferenceScene): String =
    val samples =
      if scene.guiding == GuidingMode.Off then SamplesPerPixel else GuidedSamplesPerPixel
    of(ReferenceComparison.render(scene, scene.text, Seed, samples, threads = 1))

  /** Of size, names of channels and all bits. */
  def of(image: Image): String =
    val sha = MessageDigest.getInstance("SHA-256")
    sha.update(s"${image.width} ${image.height} ${image.channelNames.mkString(" ")}\n".getBytes)
    val bytes = ByteBuffer.allocate(4 * image.data.length)
    bytes.asFloatBuffer.put(image.data)
    sha.update(bytes)
    HexFormat.of.formatHex(sha.digest.take(DigestBytes))

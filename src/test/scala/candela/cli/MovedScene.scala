package candela.cli

import candela.testing.Eventually.eventually
import candela.testing.WebClient

import java.nio.file.{Files, Path}
import java.util.concurrent.atomic.AtomicReference

/** `candela move` of a small scene in a thread of its own, as its user starts it. */
final class MovedScene(
    folder: Path,
    samples: Int = 4,
    args: Seq[String] = Nil,
    address: String = "0"
):
  val scene: Path = Files.writeString(folder.resolve("scene.pbrt"), MovedScene.Text)
  val file: Path = folder.resolve("camera.pbrt")
  private val captured = Captured()
  private val code = AtomicReference[Option[Int]](None)
  private val words = Seq("move", s"$scene", "--spp", s"$samples", "--outfile", s"$file")

  private val thread = Thread: () =>
    code.set(Some(Main.run(words ++ Seq("--watch", address, "-j", "2") ++ args, captured.terminal)))
  thread.setDaemon(true)
  thread.start()

  def err: String = captured.err

  /** The page's address, once it is served. */
  lazy val link: String = eventually("link"):
    raw"move the camera at (http://\S+)\n".r.findFirstMatchIn(captured.err).map(_.group(1))

  def state: ujson.Value = ujson.read(WebClient.get(s"${link}state").text)
  def statements: String = state("camera")("statements").str

  def move(query: String): WebClient.Answer = WebClient.post(s"${link}camera?$query")

  /** Waits for the last picture of the camera as it is. */
  def refined(): Vector[Float] =
    eventually("picture")(Option.when(state("stage").str == "done")(()))
    floats(WebClient.get(s"${link}image?layer=color").body)

  /** What `candela render` makes of the scene with the camera that was written. */
  def rendered(): Vector[Float] =
    val image = folder.resolve("image.pfm")
    val words = Seq("render", s"$scene", "--camera", s"$file", "--spp", s"$samples")
    val (code, printed) = Captured.run(words ++ Seq("--outfile", s"$image", "--quiet")*)
    assert(code == 0, printed.err)
    candela.image.ImageFiles.read(image).data.toVector

  private def floats(bytes: Array[Byte]): Vector[Float] =
    val values = java.nio.ByteBuffer.wrap(bytes).order(java.nio.ByteOrder.LITTLE_ENDIAN)
    Vector.fill(bytes.length / 4)(values.getFloat)

  /** Ends it by the page's button; its exit code. */
  def end(): Int =
    val _ = WebClient.post(s"${link}end")
    thread.join(120_000)
    code.get.getOrElse(throw IllegalStateException("it doesn't end"))

object MovedScene:
  val Text: String =
    """Scale -1 1 1
      |LookAt 0 -7 3  0 0 1  0 0 1
      |Camera "perspective" "float fov" 30
      |Sampler "independent" "integer pixelsamples" 4
      |Film "rgb" "integer xresolution" 40 "integer yresolution" 30
      |WorldBegin
      |LightSource "infinite" "rgb L" [.5 .6 .7]
      |LightSource "point" "point3 from" [-3 -4 6] "rgb I" [30 30 20]
      |Texture "checks" "spectrum" "checkerboard" "float uscale" 8 "float vscale" 8
      |Material "diffuse" "texture reflectance" "checks"
      |Shape "disk" "float radius" 4
      |Material "diffuse" "rgb reflectance" [.8 .3 .2]
      |Translate 0 0 1 Shape "sphere" "float radius" 1
      |""".stripMargin

package candela.image

import candela.base.loop
import candela.diagnostics.Code
import org.lwjgl.system.JNI.*
import org.lwjgl.system.MemoryStack.stackPush
import org.lwjgl.system.libffi.LibFFI.*
import org.lwjgl.system.libffi.{FFICIF, FFIType}
import org.lwjgl.system.MemoryUtil

import java.nio.FloatBuffer

/** Denoises images by Intel's Open Image Denoise, version 2, which is loaded at run time.
  *
  * The order of calls is that of its documentation, §"Prefiltering": the auxiliary images are
  * denoised first, each by a filter of its own; then the colours with these, as noise-free.
  *
  * @param library its shared library
  */
final class Oidn private (library: NativeLibrary):
  import Oidn.*
  import library.function

  private val newDevice = function("oidnNewDevice")
  private val setDeviceInt = function("oidnSetDeviceInt")
  private val readDeviceInt = function("oidnGetDeviceInt")
  private val commitDevice = function("oidnCommitDevice")
  private val releaseDevice = function("oidnReleaseDevice")
  private val deviceError = function("oidnGetDeviceError")
  private val newFilter = function("oidnNewFilter")
  private val setImage = function("oidnSetSharedFilterImage")
  private val setBool = function("oidnSetFilterBool")
  private val commitFilter = function("oidnCommitFilter")
  private val executeFilter = function("oidnExecuteFilter")
  private val releaseFilter = function("oidnReleaseFilter")

  /** Where it was found. */
  def path: String = library.path

  /** Such as `2.3.0`. */
  def version: String = withDevice(1): device =>
    val number = withText("version")(invokePPI(device, _, readDeviceInt))
    s"${number / 10000}.${number / 100 % 100}.${number % 100}"

  /** The image without noise, but biased.
    *
    * @param color   linear R, G and B, of any range
    * @param albedo  in [0, 1], of the same size
    * @param normal  vectors of at most unit length, in any space; used only with an albedo
    * @param threads number of threads
    */
  def denoise(color: Image, albedo: Option[Image], normal: Option[Image], threads: Int): Image =
    val (width, height) = (color.width, color.height)
    withDevice(threads): device =>
      def inMemory(image: Image, change: Float => Float)(use: FloatBuffer => Unit): Unit =
        require(image.width == width && image.height == height && image.channels == 3)
        val memory = MemoryUtil.memAllocFloat(image.data.length)
        try
          memory.put(image.data.map(change)).flip()
          use(memory)
        finally MemoryUtil.memFree(memory)
      def run(inputs: (String, FloatBuffer)*)(output: FloatBuffer, flags: String*): Unit =
        val filter = withText("RT")(invokePPP(device, _, newFilter))
        try
          for (name, memory) <- inputs :+ ("output" -> output) do
            bind(filter, name, memory, width, height)
          for flag <- flags do withText(flag)(invokePPV(filter, _, true, setBool))
          invokePV(filter, commitFilter)
          invokePV(filter, executeFilter)
          check(device)
        finally if filter != 0 then invokePV(filter, releaseFilter)
      val result = Image.rgb(width, height)
      inMemory(color, identity): colors =>
        def finish(others: (String, FloatBuffer)*): Unit =
          val flags = if others.isEmpty then Vector("hdr") else Vector("hdr", "cleanAux")
          run((("color" -> colors) +: others)*)(colors, flags*)
          loop(result.data.length)(i => result.data(i) = colors.get(i))
        albedo match
          case None => finish()
          case Some(image) =>
            inMemory(image, v => Math.min(Math.max(v, 0f), 1f)): albedos =>
              run("albedo" -> albedos)(albedos)
              normal match
                case None => finish("albedo" -> albedos)
                case Some(vectors) =>
                  inMemory(vectors, v => Math.min(Math.max(v, -1f), 1f)): normals =>
                    run("normal" -> normals)(normals)
                    finish("albedo" -> albedos, "normal" -> normals)
      result

  private def withDevice[A](threads: Int)(use: Long => A): A =
    val device = invokeP(Cpu, newDevice)
    try
      check(device)
      withText("numThreads")(invokePPV(device, _, threads, setDeviceInt))
      invokePV(device, commitDevice)
      check(device)
      use(device)
    finally if device != 0 then invokePV(device, releaseDevice)

  /** Throws the device's error, if any. */
  private def check(device: Long): Unit =
    val stack = stackPush()
    try
      val message = stack.callocPointer(1)
      if invokePPI(device, MemoryUtil.memAddress(message), deviceError) != 0 then
        val text =
          if message.get(0) == 0 then "unknown error" else MemoryUtil.memUTF8(message.get(0))
        throw ImageError(Code.Denoiser, s"Open Image Denoise: $text")
    finally stack.close()

  /** Binds an image of three floats per pixel. LWJGL has no call with these nine arguments: libffi
    * makes it.
    */
  private def bind(filter: Long, name: String, data: FloatBuffer, width: Int, height: Int): Unit =
    withText(name): text =>
      val stack = stackPush()
      try
        val kinds = Vector(ffi_type_pointer, ffi_type_pointer, ffi_type_pointer, ffi_type_sint) ++
          Vector.fill(5)(ffi_type_pointer)
        val types = stack.mallocPointer(kinds.size)
        for (kind, i) <- kinds.zipWithIndex do
          val _ = types.put(i, kind.address)
        val signature = FFICIF.calloc(stack)
        if ffi_prep_cif(signature, FFI_DEFAULT_ABI, ffi_type_void: FFIType, types) != FFI_OK then
          throw ImageError(Code.MissingLibrary, "this platform can't call Open Image Denoise")
        val numbers = Vector(filter, text, MemoryUtil.memAddress(data), Float3) ++
          Vector[Long](width, height, 0, 0, 0)
        val values = stack.mallocLong(numbers.size)
        val arguments = stack.mallocPointer(numbers.size)
        for (number, i) <- numbers.zipWithIndex do
          val _ = values.put(i, number)
          val _ = arguments.put(i, MemoryUtil.memAddress(values) + 8 * i)
        ffi_call(signature, setImage, stack.calloc(8), arguments)
      finally stack.close()

object Oidn:
  // OIDNDeviceType and OIDNFormat
  private val Cpu = 1
  private val Float3 = 3L

  /** Loads the library from where it is installed.
    *
    * @throws ImageError if it is not, or can't be loaded; says how to get it
    */
  def load(environment: Map[String, String] = sys.env): Oidn =
    val files = OidnLibrary.candidates(environment).map(_.toString)
    // The system's loader knows more folders.
    val systemNames = if environment.contains(OidnLibrary.Variable) then Vector.empty
    else OidnLibrary.Names.take(1)
    NativeLibrary.loadFirst("Open Image Denoise 2", files ++ systemNames).map(Oidn(_)).getOrElse:
      throw ImageError(
        Code.MissingLibrary,
        environment.get(OidnLibrary.Variable).fold("Open Image Denoise is not installed")(named =>
          s"${OidnLibrary.Variable}=$named: no library of Open Image Denoise 2"
        ) + "; `pip install pyoidn` installs it, or set " +
          s"${OidnLibrary.Variable} to the library or its folder (openimagedenoise.org)"
      )

  private def withText[A](text: String)(use: Long => A): A =
    val stack = stackPush()
    try use(MemoryUtil.memAddress(stack.ASCII(text)))
    finally stack.close()

package candela.growth

import org.objectweb.asm.{ClassReader, ClassVisitor, ClassWriter, Label, MethodVisitor, Opcodes}

import scala.collection.mutable
import scala.util.Using

/** Loads the program and Scala's library anew, so that they count their [[Operations]]. Unlike
  * seconds, these are the same in each run and on each machine.
  */
final class CountingLoader(parent: ClassLoader) extends ClassLoader(parent):

  override def loadClass(name: String, resolve: Boolean): Class[?] =
    getClassLoadingLock(name).synchronized:
      if !isCounted(name) then super.loadClass(name, resolve)
      else
        Option(findLoadedClass(name)).getOrElse:
          val resource = parent.getResourceAsStream(s"${name.replace('.', '/')}.class")
          if resource == null then throw ClassNotFoundException(name)
          val bytes = CountingLoader.counting(Using.resource(resource)(_.readAllBytes))
          defineClass(name, bytes, 0, bytes.length)

  private def isCounted(name: String) =
    Seq("candela.", "scala.").exists(name.startsWith) &&
      !name.startsWith(CountingLoader.Counter.replace('/', '.'))

private object CountingLoader:
  val Counter = "candela/growth/Operations"

  def counting(original: Array[Byte]): Array[Byte] =
    val writer = ClassWriter(ClassWriter.COMPUTE_MAXS)
    ClassReader(original).accept(
      new ClassVisitor(Opcodes.ASM9, writer):
        override def visitMethod(
            access: Int,
            name: String,
            descriptor: String,
            signature: String,
            exceptions: Array[String]
        ): MethodVisitor =
          Counting(super.visitMethod(access, name, descriptor, signature, exceptions))
      ,
      0
    )
    writer.toByteArray

  private final class Counting(to: MethodVisitor) extends MethodVisitor(Opcodes.ASM9, to):
    private val visited = mutable.HashSet.empty[Label]

    private def increment(): Unit =
      super.visitMethodInsn(Opcodes.INVOKESTATIC, Counter, "add", "()V", false)

    /** As many as the number on the top of the stack. */
    private def addTop(): Unit =
      super.visitInsn(Opcodes.DUP)
      super.visitMethodInsn(Opcodes.INVOKESTATIC, Counter, "add", "(I)V", false)

    override def visitCode(): Unit =
      super.visitCode()
      increment()

    override def visitLabel(label: Label): Unit =
      visited += label
      super.visitLabel(label)

    override def visitJumpInsn(opcode: Int, label: Label): Unit =
      if visited(label) then increment()
      super.visitJumpInsn(opcode, label)

    override def visitIntInsn(opcode: Int, operand: Int): Unit =
      if opcode == Opcodes.NEWARRAY then addTop()
      super.visitIntInsn(opcode, operand)

    override def visitTypeInsn(opcode: Int, kind: String): Unit =
      if opcode == Opcodes.ANEWARRAY then addTop()
      super.visitTypeInsn(opcode, kind)

    override def visitMethodInsn(
        opcode: Int,
        owner: String,
        name: String,
        descriptor: String,
        isInterface: Boolean
    ): Unit =
      val copies = owner == "java/lang/System" && name == "arraycopy" ||
        owner == "java/util/Arrays" && name == "copyOf" && descriptor.contains("I)")
      if copies then addTop()
      super.visitMethodInsn(opcode, owner, name, descriptor, isInterface)

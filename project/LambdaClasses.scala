package packaging

import scala.collection.mutable

import org.objectweb.asm.Opcodes._
import org.objectweb.asm.{ClassReader, ClassVisitor, ClassWriter, Handle, MethodVisitor, Type}

/** Classes for lambdas that capture something: what `new` makes. The JVM makes such a lambda by a
  * method handle, which calls `Unsafe.allocateInstance`, and only C2 compiles that; in code that C1
  * compiles or that is interpreted, each lambda takes a call of the JVM through JNI.
  * docs/decisions/0014-start-up.md has measurements.
  *
  * Each class is a nest mate of the one whose lambda it is, as most bodies are private methods.
  *
  * @param reader of the class with the lambdas
  */
final class LambdaClasses(reader: ClassReader) {
  private val owner = reader.getClassName

  private var version = 0
  private var isNested = false
  private val access = mutable.Map.empty[(String, String), Int]
  reader.accept(
    new ClassVisitor(ASM9) {
      override def visit(
          classVersion: Int,
          access: Int,
          name: String,
          signature: String,
          superName: String,
          interfaces: Array[String]
      ): Unit = version = classVersion & 0xffff
      override def visitNestHost(host: String): Unit = isNested = true
      override def visitNestMember(member: String): Unit = isNested = true
      override def visitMethod(
          flags: Int,
          name: String,
          descriptor: String,
          signature: String,
          exceptions: Array[String]
      ): MethodVisitor = {
        access((name, descriptor)) = flags
        null
      }
    },
    ClassReader.SKIP_CODE | ClassReader.SKIP_DEBUG | ClassReader.SKIP_FRAMES
  )

  private val made = mutable.ArrayBuffer.empty[(String, Array[Byte])]
  private val mates = mutable.ArrayBuffer.empty[String]

  /** Internal names and contents of the classes made so far. */
  def classes: Seq[(String, Array[Byte])] = made.toSeq

  /** Those of them that the class must name as members of its nest. */
  def members: Seq[String] = mates.toSeq

  /** Calls what makes the lambda, if that can be a class.
    *
    * @param method     its only abstract method
    * @param descriptor from what it captures to its interface
    * @param arguments  as of `LambdaMetafactory.metafactory`
    * @return false if nothing was written
    */
  def write(
      to: MethodVisitor,
      method: String,
      descriptor: String,
      arguments: Seq[AnyRef]
  ): Boolean =
    arguments match {
      case Seq(erased: Type, body: Handle, typed: Type) if canCall(body) =>
        val name = s"$owner$$Lambda${made.size}"
        val lambda = new LambdaClass(name, version, method, descriptor, erased, body, typed)
        val host = if (isPrivate(body)) Some(owner) else None
        lambda.bytes(host) match {
          case Some(contents) =>
            if (host.isDefined) mates += name
            made += name -> contents
            to.visitMethodInsn(INVOKESTATIC, name, LambdaClass.Make, descriptor, false)
            true
          case None => false
        }
      case _ => false
    }

  private def flags(body: Handle): Option[Int] =
    if (body.getOwner == owner) access.get((body.getName, body.getDesc)) else None

  private def isPrivate(body: Handle): Boolean = flags(body).exists(f => (f & ACC_PRIVATE) != 0)

  /** Nests exist from Java 11 on. Bodies elsewhere in the package are those that Scala has moved to
    * an object about the class; other methods there may be inherited and protected.
    */
  private def canCall(body: Handle): Boolean =
    flags(body) match {
      case Some(f) if (f & ACC_PRIVATE) != 0 => version >= V11 && !isNested
      case Some(_) => body.getTag != H_INVOKESPECIAL // which no override replaces
      case None =>
        !isNested && folder(body.getOwner) == folder(owner) && body.getName.contains("$anonfun")
    }

  private def folder(name: String) = name.take(name.lastIndexOf('/'))
}

/** @param name   its internal name
  * @param erased the type of its method in the interface
  * @param typed  what that is for this lambda
  */
private final class LambdaClass(
    name: String,
    version: Int,
    method: String,
    descriptor: String,
    erased: Type,
    body: Handle,
    typed: Type
) {
  import LambdaClass._

  private val captured = Type.getArgumentTypes(descriptor).toSeq
  private val interface = Type.getReturnType(descriptor)

  /** @param host of its nest
    * @return nothing if it captures nothing, or if arguments need more than casts and boxes
    */
  def bytes(host: Option[String]): Option[Array[Byte]] =
    for {
      _ <- captured.headOption
      parameters <- bodyParameters
      taken = parameters.drop(captured.size)
      if parameters.take(captured.size) == captured && taken.size == erased.getArgumentTypes.length
      passed <- all(erased.getArgumentTypes.toSeq.zip(typed.getArgumentTypes).zip(taken).map {
        case ((from, as), to) => conversion(from, as, to)
      })
      returned <- result
    } yield {
      val writer = new ClassWriter(ClassWriter.COMPUTE_MAXS)
      writer.visit(
        version,
        ACC_FINAL | ACC_SUPER | ACC_SYNTHETIC,
        name,
        null,
        Root,
        Array(interface.getInternalName)
      )
      host.foreach(name => writer.visitNestHost(name))
      for ((t, i) <- captured.zipWithIndex)
        writer.visitField(ACC_PRIVATE | ACC_FINAL, field(i), t.getDescriptor, null, null).visitEnd()
      construct(writer)
      make(writer)
      call(writer, passed, returned)
      writer.visitEnd()
      writer.toByteArray
    }

  /** What the body takes, with the object whose method it is. */
  private def bodyParameters: Option[Seq[Type]] = {
    val own = Type.getArgumentTypes(body.getDesc).toSeq
    body.getTag match {
      case H_INVOKESTATIC => Some(own)
      case H_INVOKESPECIAL | H_INVOKEVIRTUAL | H_INVOKEINTERFACE =>
        Some(Type.getObjectType(body.getOwner) +: own)
      case _ => None
    }
  }

  private def result: Option[MethodVisitor => Unit] = {
    val (from, to) = (Type.getReturnType(body.getDesc), erased.getReturnType)
    (from.getSort, to.getSort) match {
      case (Type.VOID, Type.VOID) => Some(_ => ())
      case (Type.VOID, _) => None
      case (_, Type.VOID) => Some(_.visitInsn(if (from.getSize == 2) POP2 else POP))
      case _ => conversion(from, typed.getReturnType, to)
    }
  }

  private def construct(writer: ClassWriter): Unit = {
    val m = writer.visitMethod(0, "<init>", constructor, null, null)
    m.visitCode()
    m.visitVarInsn(ALOAD, 0)
    m.visitMethodInsn(INVOKESPECIAL, Root, "<init>", "()V", false)
    for (((t, slot), i) <- captured.zip(slots(captured, 1)).zipWithIndex) {
      m.visitVarInsn(ALOAD, 0)
      m.visitVarInsn(t.getOpcode(ILOAD), slot)
      m.visitFieldInsn(PUTFIELD, name, field(i), t.getDescriptor)
    }
    m.visitInsn(RETURN)
    finish(m)
  }

  private def make(writer: ClassWriter): Unit = {
    val m = writer.visitMethod(ACC_STATIC, Make, descriptor, null, null)
    m.visitCode()
    m.visitTypeInsn(NEW, name)
    m.visitInsn(DUP)
    for ((t, slot) <- captured.zip(slots(captured, 0))) m.visitVarInsn(t.getOpcode(ILOAD), slot)
    m.visitMethodInsn(INVOKESPECIAL, name, "<init>", constructor, false)
    m.visitInsn(ARETURN)
    finish(m)
  }

  private def call(
      writer: ClassWriter,
      passed: Seq[MethodVisitor => Unit],
      returned: MethodVisitor => Unit
  ): Unit = {
    val m = writer.visitMethod(ACC_PUBLIC, method, erased.getDescriptor, null, null)
    m.visitCode()
    for ((t, i) <- captured.zipWithIndex) {
      m.visitVarInsn(ALOAD, 0)
      m.visitFieldInsn(GETFIELD, name, field(i), t.getDescriptor)
    }
    val parameters = erased.getArgumentTypes.toSeq
    for (((t, slot), convert) <- parameters.zip(slots(parameters, 1)).zip(passed)) {
      m.visitVarInsn(t.getOpcode(ILOAD), slot)
      convert(m)
    }
    val opcode = body.getTag match {
      case H_INVOKESTATIC => INVOKESTATIC
      case _ => if (body.isInterface) INVOKEINTERFACE else INVOKEVIRTUAL
    }
    m.visitMethodInsn(opcode, body.getOwner, body.getName, body.getDesc, body.isInterface)
    returned(m)
    m.visitInsn(erased.getReturnType.getOpcode(IRETURN))
    finish(m)
  }

  private def constructor: String = Type.getMethodDescriptor(Type.VOID_TYPE, captured: _*)
}

private object LambdaClass {

  /** The static method that makes the lambda. */
  val Make = "make"

  private val Root = "java/lang/Object"

  private def field(i: Int) = s"c$i"

  private def finish(m: MethodVisitor): Unit = {
    m.visitMaxs(0, 0)
    m.visitEnd()
  }

  private def slots(types: Seq[Type], first: Int): Seq[Int] =
    types.scanLeft(first)(_ + _.getSize).init

  private def all[A](parts: Seq[Option[A]]): Option[Seq[A]] =
    if (parts.forall(_.isDefined)) Some(parts.flatten) else None

  /** From one type to another that is `as` in between, as `LambdaMetafactory` converts. Nothing for
    * conversions that Scala does not ask for, such as widening.
    */
  private def conversion(from: Type, as: Type, to: Type): Option[MethodVisitor => Unit] =
    (isObject(from), isObject(to)) match {
      case (true, true) =>
        Some(if (to == from || to.getInternalName == Root) _ => () else cast(to))
      case (false, false) => if (from == to) Some(_ => ()) else None
      case (true, false) =>
        for (box <- Boxes.get(to) if as == to || as == Type.getObjectType(box))
          yield { m =>
            cast(Type.getObjectType(box))(m)
            m.visitMethodInsn(
              INVOKEVIRTUAL,
              box,
              s"${to.getClassName}Value",
              s"()${to.getDescriptor}",
              false
            )
          }
      case (false, true) =>
        for (box <- Boxes.get(from) if to.getInternalName == Root || to.getInternalName == box)
          yield _.visitMethodInsn(
            INVOKESTATIC,
            box,
            "valueOf",
            s"(${from.getDescriptor})L$box;",
            false
          )
    }

  private def cast(to: Type): MethodVisitor => Unit =
    _.visitTypeInsn(CHECKCAST, to.getInternalName)

  private def isObject(t: Type) = t.getSort == Type.OBJECT || t.getSort == Type.ARRAY

  private val Boxes = Map(
    Type.BOOLEAN_TYPE -> "Boolean",
    Type.CHAR_TYPE -> "Character",
    Type.BYTE_TYPE -> "Byte",
    Type.SHORT_TYPE -> "Short",
    Type.INT_TYPE -> "Integer",
    Type.LONG_TYPE -> "Long",
    Type.FLOAT_TYPE -> "Float",
    Type.DOUBLE_TYPE -> "Double"
  ).map { case (primitive, box) => primitive -> s"java/lang/$box" }
}

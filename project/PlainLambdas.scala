package packaging

import org.objectweb.asm.{
  Attribute, ClassReader, ClassVisitor, ClassWriter, Handle, MethodVisitor, Opcodes, Type
}

/** Lambdas that start fast. Scala makes every lambda serialisable, which class-data sharing can't
  * archive: a few hundred classes would be generated at every start. This program never serialises
  * lambdas, so they need not be, and what would read them again goes.
  *
  * Also removes the bridges that Scala requests: the interfaces below declare only the erased
  * method.
  */
object PlainLambdas {

  def apply(bytes: Array[Byte]): Array[Byte] = {
    val writer = new ClassWriter(0) // without constants that are no longer used
    new ClassReader(bytes).accept(new Rewritten(writer), 0)
    writer.toByteArray
  }

  private final class Rewritten(to: ClassVisitor) extends ClassVisitor(Opcodes.ASM9, to) {

    /** Leaves out the identity of the `.tasty` file, which the jar lacks: it depends on which other
      * files were compiled at the same time.
      */
    override def visitAttribute(attribute: Attribute): Unit =
      if (attribute.`type` != "TASTY") super.visitAttribute(attribute)

    override def visitMethod(
        access: Int,
        name: String,
        descriptor: String,
        signature: String,
        exceptions: Array[String]
    ): MethodVisitor = if (name == Deserializing) null
    else {
      val inner = super.visitMethod(access, name, descriptor, signature, exceptions)
      new MethodVisitor(Opcodes.ASM9, inner) {
        override def visitInvokeDynamicInsn(
            name: String,
            descriptor: String,
            bootstrap: Handle,
            arguments: AnyRef*
        ): Unit =
          if (isPlain(bootstrap, descriptor, arguments))
            super.visitInvokeDynamicInsn(name, descriptor, Metafactory, arguments.take(3): _*)
          else super.visitInvokeDynamicInsn(name, descriptor, bootstrap, arguments: _*)
      }
    }
  }

  private def isPlain(bootstrap: Handle, descriptor: String, arguments: Seq[AnyRef]): Boolean =
    bootstrap.getOwner == Factory && bootstrap.getName == "altMetafactory" && {
      val interface = Type.getReturnType(descriptor).getInternalName
      val flags = arguments(3).asInstanceOf[Integer].intValue
      (flags & LambdaMarkers) == 0 && Interfaces.exists(name => interface.startsWith(name))
    }

  private val Deserializing = "$deserializeLambda$"
  private val Interfaces = Seq("scala/Function", "scala/runtime/", "java/util/function/")

  /** `LambdaMetafactory.FLAG_MARKERS`: additional marker interfaces, which must stay. */
  private val LambdaMarkers = 2
  private val Factory = "java/lang/invoke/LambdaMetafactory"
  private val Metafactory = {
    val (types, handles) = ("Ljava/lang/invoke/MethodType;", "Ljava/lang/invoke/MethodHandle")
    val caller = s"$handles" + "s$Lookup;Ljava/lang/String;"
    val descriptor = s"($caller$types$types$handles;$types)Ljava/lang/invoke/CallSite;"
    new Handle(Opcodes.H_INVOKESTATIC, Factory, "metafactory", descriptor, false)
  }
}

package candela.cli

import packaging.PlainLambdas

import org.objectweb.asm.{ClassReader, ClassVisitor, Handle, MethodVisitor, Opcodes}
import org.scalatest.funsuite.AnyFunSuite

/** What `./sbt stage` makes of lambdas in the program's jar. */
class PlainLambdasSuite extends AnyFunSuite:
  import PlainLambdasSuite.*

  private def bytes(c: Class[?]): Array[Byte] =
    c.getResourceAsStream(c.getName.split('.').last + ".class").readAllBytes()

  private val rewritten: Map[String, Array[Byte]] =
    Vector(classOf[Lambdas], classOf[Deeper], classOf[Named])
      .map(c => c.getName -> PlainLambdas(bytes(c))).toMap

  /** Loads the rewritten classes, which the JVM then verifies, and all others as they are. */
  private object Loader extends ClassLoader(getClass.getClassLoader):
    override def loadClass(name: String, resolve: Boolean): Class[?] =
      rewritten.get(name).fold(super.loadClass(name, resolve)): b =>
        Option(findLoadedClass(name)).getOrElse(defineClass(name, b, 0, b.length))

  private def results(c: Class[?]): Vector[Any] =
    val made = c.getConstructor(classOf[Int], classOf[Long]).newInstance(3, 1L << 40)
    c.getMethod("results").invoke(made).asInstanceOf[Vector[Any]]

  test("lambdas do what they did, of whatever they capture and take"):
    for c <- Vector(classOf[Lambdas], classOf[Deeper]) do
      val plain = Loader.loadClass(c.getName)
      assert(plain ne c)
      assert(results(plain) == results(c))

  test("none can be serialised, so that an archive can have all"):
    val scalas = factories(bytes(classOf[Lambdas]))
    assert(scalas.contains("altMetafactory") && scalas.contains(Deserializing))
    for b <- rewritten.values do assert(factories(b).toSet == Set("metafactory"))

  private val Deserializing = "$deserializeLambda$"

  /** What the JVM makes the lambdas of a class by, and the method that would read them again. */
  private def factories(of: Array[Byte]): Seq[String] =
    val found = Vector.newBuilder[String]
    val visitor = new ClassVisitor(Opcodes.ASM9):
      override def visitMethod(a: Int, name: String, d: String, s: String, e: Array[String]) =
        if name == Deserializing then found += name
        new MethodVisitor(Opcodes.ASM9):
          override def visitInvokeDynamicInsn(n: String, d: String, b: Handle, a: AnyRef*): Unit =
            if b.getOwner == "java/lang/invoke/LambdaMetafactory" then found += b.getName
    ClassReader(of).accept(visitor, 0)
    found.result()

object PlainLambdasSuite:
  trait Named:
    def name: String
    def greeting: () => String = () => s"I am $name"

  /** Lambdas of each kind that Scala makes. */
  class Lambdas(small: Int, large: Long) extends Named:
    def name: String = s"$small of $large"

    private def scaled(x: Double) = x * small

    def own: () => Int = () => small

    def results: Vector[Any] =
      val (b, c, f, d, s) = (true, 'x', 1.5f, 2.5, "text")
      var changing = 0
      val add: Int => Unit = i => changing += i
      val pair: (Long, Double) => Double = (l, x) => l + x + large + d
      val box: Any => Any = x => Vector(x, b, c, f, d, s, small, large)
      val choose: Float => Boolean = _ < f
      val text: String => String = _ + s
      val array: Array[Int] => Int = _.sum + small
      val runnable: Runnable = () => changing += 100
      val free: Int => Int = _ + 1
      val curried: Int => Int => Long = i => j => i + j + large
      add(5)
      runnable.run()
      def lazily(x: => Int) = x + x
      Vector(
        changing,
        pair(1L, 2.0),
        box(1),
        choose(1f),
        choose(2f),
        text("a "),
        array(Array(1, 2)),
        free(1),
        curried(1)(2),
        lazily(small + 1),
        greeting(),
        own(),
        Option(2.0).map(scaled),
        Vector(1, 2, 3).map(i => i * small),
        Vector("a", "b").foldLeft(s)(_ + _ + c),
        scala.util.Try(if b then throw IllegalStateException(s) else small).toString
      )

  /** Has private bodies of the same names as the class above it. */
  class Deeper(small: Int, large: Long) extends Lambdas(small, large):
    override def own: () => Int = () => small + 1000
    override def greeting: () => String = () => super.greeting() + s" and $small"

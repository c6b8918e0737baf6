package candela.cluster

import org.apache.spark.SparkConf
import org.apache.spark.serializer.*

import java.io.{InputStream, OutputStream}
import java.nio.ByteBuffer
import java.util.concurrent.atomic.AtomicBoolean

import scala.reflect.ClassTag

/** Java's serialization, but the first film that each process sends has a wrong bit. */
final class DamagingSerializer(conf: SparkConf) extends Serializer with Serializable:
  private val java = JavaSerializer(conf)

  def newInstance(): SerializerInstance =
    val plain = java.newInstance()
    new SerializerInstance:
      def serialize[T: ClassTag](t: T): ByteBuffer = plain.serialize(t)
      def deserialize[T: ClassTag](bytes: ByteBuffer): T = plain.deserialize(bytes)
      def deserialize[T: ClassTag](bytes: ByteBuffer, loader: ClassLoader): T =
        plain.deserialize(bytes, loader)
      def deserializeStream(s: InputStream): DeserializationStream = plain.deserializeStream(s)
      def serializeStream(s: OutputStream): SerializationStream =
        DamagingSerializer.Stream(plain.serializeStream(s))

private object DamagingSerializer:
  private val isDone = AtomicBoolean()

  final class Stream(plain: SerializationStream) extends SerializationStream:
    def writeObject[T: ClassTag](t: T): SerializationStream =
      t match
        // By its name: the class itself belongs to the program's class loader
        case chunk: Product
            if chunk.productPrefix == "FilmChunk" && isDone.compareAndSet(false, true) =>
          chunk.productElement(2) match
            case bytes: Array[Byte] =>
              bytes(bytes.length / 2) = (bytes(bytes.length / 2) ^ 1).toByte
          plain.writeObject(t)
        case other => plain.writeObject(other)
      this
    def flush(): Unit = plain.flush()
    def close(): Unit = plain.close()

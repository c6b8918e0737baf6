package candela.build

/** Recipes of participating media: v3's and v4's. */
object Media:
  val all: Recipes[Unit] = Recipes(
    "medium",
    Vector(HomogeneousMedium, HeterogeneousMedium, UniformGrid, RgbGrid, Cloud, NanoVdb)
  )

/** Recipes of v2's volumes, which fill a box. */
object Volumes:
  val all: Recipes[Unit] =
    Recipes("volume", Vector(HomogeneousVolume, VolumeGrid, ExponentialVolume))

/** Of media that are not rendered yet. */
trait Vacuum extends Recipe[Unit]:
  override def pending: Option[String] = Some("it is left out")
  protected def make()(using Site): Unit = ()

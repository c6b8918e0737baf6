package candela.cli

/** Entry point for `spark-submit`, which says by a property on which master to render. */
object SparkMain:
  def main(args: Array[String]): Unit =
    val master = sys.props.getOrElse("spark.master", "local[*]")
    val words = if args.headOption.contains("render") then args.drop(1) else args
    Main.main(Array("render", "--spark", master) ++ words)

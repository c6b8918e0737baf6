package packaging

/** Descriptions of the release for package managers. */
object Manifests {

  /** All of them, by their file names.
    *
    * @param libraries the program's Maven modules, as Coursier spells them
    * @param options   of the JVM
    */
  def all(
      facts: Facts,
      artifacts: Seq[Artifact],
      libraries: Seq[String],
      options: Seq[String]
  ): Seq[(String, String)] = {
    val files = new Files(facts, artifacts)
    Seq(
      "coursier.json" -> coursier(facts, libraries, options),
      "homebrew/candela.rb" -> homebrew(facts, files),
      "scoop/candela.json" -> scoop(facts, files),
      "nix/candela.nix" -> nix(facts, files),
      "docker/Dockerfile" -> docker(facts, files)
    )
  }

  /** The artifacts by platform; hash and address of what is not made yet are visibly none. */
  private final class Files(facts: Facts, artifacts: Seq[Artifact]) {
    def plain(platform: String): Artifact = of(platform, hasRuntime = false)
    def full(platform: String): Artifact = of(platform, hasRuntime = true)

    /** With its runtime, if it is there. */
    def best(platform: String): Artifact =
      find(platform, hasRuntime = true).getOrElse(plain(platform))

    def url(artifact: Artifact): String = facts.address(artifact.file)

    private def find(platform: String, hasRuntime: Boolean) =
      artifacts.find(a =>
        a.platform.name == platform && a.hasRuntime == hasRuntime && a.file.endsWith(".zip")
      )

    private def of(platform: String, hasRuntime: Boolean) =
      find(platform, hasRuntime).getOrElse {
        val known = Platform.all.find(_.name == platform).get
        Artifact(facts.zip(known, hasRuntime), known, hasRuntime, NoHash, 0)
      }
  }

  val NoHash: String = "0" * 64

  private def json(text: String): String =
    "\"" + text.replace("\\", "\\\\").replace("\"", "\\\"") + "\""

  private def listed(texts: Seq[String]): String =
    texts.map(t => s"      ${json(t)}").mkString("[\n", ",\n", "\n    ]")

  /** A channel of one application: `cs install --channel FILE candela`. */
  private def coursier(facts: Facts, libraries: Seq[String], options: Seq[String]): String =
    s"""{
       |  ${json(facts.command)}: {
       |    "repositories": ["central"],
       |    "dependencies": ${listed(libraries)},
       |    "mainClass": "candela.cli.Main",
       |    "javaOptions": ${listed(options)}
       |  }
       |}
       |""".stripMargin

  private def homebrew(facts: Facts, files: Files): String = {
    def choice(processor: String, platform: String) = {
      val file = files.plain(platform)
      s"""    on_$processor do
         |      url "${files.url(file)}"
         |      sha256 "${file.sha256}"
         |    end""".stripMargin
    }
    s"""class ${facts.name} < Formula
       |  desc "${facts.description}"
       |  homepage "${facts.homepage}"
       |  version "${facts.version}"
       |  license "${facts.licence}"
       |
       |  depends_on "openjdk"
       |
       |  on_macos do
       |${choice("arm", "macos-arm64")}
       |${choice("intel", "macos-x64")}
       |  end
       |  on_linux do
       |${choice("arm", "linux-arm64")}
       |${choice("intel", "linux-x64")}
       |  end
       |
       |  def install
       |    man1.install Dir["share/man/man1/*"]
       |    libexec.install Dir["*"]
       |    (bin/"${facts.command}").write_env_script libexec/"bin/${facts.command}",
       |      Language::Java.overridable_java_home_env
       |  end
       |
       |  test do
       |    assert_match "${facts.command} ${facts.release}", shell_output("#{bin}/${facts.command} --version")
       |  end
       |end
       |""".stripMargin
  }

  private def scoop(facts: Facts, files: Files): String = {
    def choice(name: String, file: Artifact) =
      s"""    ${json(name)}: {
         |      "url": ${json(files.url(file))},
         |      "hash": ${json(file.sha256)},
         |      "extract_dir": ${json(facts.folder)}
         |    }""".stripMargin
    val both = Seq("64bit" -> files.best("windows-x64"), "arm64" -> files.best("windows-arm64"))
    val java =
      if (both.forall(_._2.hasRuntime)) ""
      else "\n  \"suggest\": { \"JDK\": \"java/temurin-jdk\" },"
    s"""{
       |  "version": ${json(facts.version)},
       |  "description": ${json(facts.description)},
       |  "homepage": ${json(facts.homepage)},
       |  "license": ${json(facts.licence)},$java
       |  "architecture": {
       |${both.map { case (name, file) => choice(name, file) }.mkString(",\n")}
       |  },
       |  "bin": "bin\\\\${facts.command}.bat"
       |}
       |""".stripMargin
  }

  private def nix(facts: Facts, files: Files): String = {
    val systems = Seq(
      "x86_64-linux" -> "linux-x64",
      "aarch64-linux" -> "linux-arm64",
      "x86_64-darwin" -> "macos-x64",
      "aarch64-darwin" -> "macos-arm64"
    )
    val sources = systems.map { case (system, platform) =>
      val file = files.plain(platform)
      s"""    $system = fetchurl {
         |      url = "${files.url(file)}";
         |      sha256 = "${file.sha256}";
         |    };""".stripMargin
    }
    val dollar = "$"
    s"""# nix-build -E '(import <nixpkgs> {}).callPackage ./candela.nix {}'
       |{ lib, stdenv, fetchurl, unzip, makeWrapper, autoPatchelfHook, jdk }:
       |
       |let
       |  sources = {
       |${sources.mkString("\n")}
       |  };
       |in
       |stdenv.mkDerivation {
       |  pname = "${facts.command}";
       |  version = "${facts.version}";
       |  src = sources.$dollar{stdenv.hostPlatform.system};
       |
       |  nativeBuildInputs = [ unzip makeWrapper ]
       |    ++ lib.optional stdenv.hostPlatform.isLinux autoPatchelfHook;
       |  buildInputs = lib.optional stdenv.hostPlatform.isLinux stdenv.cc.cc.lib;
       |
       |  installPhase = ''
       |    mkdir -p $dollar{placeholder "out"}/bin $dollar{placeholder "out"}/opt
       |    cp -r . $dollar{placeholder "out"}/opt/${facts.command}
       |    makeWrapper $dollar{placeholder "out"}/opt/${facts.command}/bin/${facts.command} \\
       |      $dollar{placeholder "out"}/bin/${facts.command} --set-default CANDELA_JAVA $dollar{jdk.home}
       |  '';
       |
       |  meta = {
       |    description = "${facts.description}";
       |    homepage = "${facts.homepage}";
       |    license = lib.licenses.asl20;
       |    mainProgram = "${facts.command}";
       |    platforms = builtins.attrNames sources;
       |  };
       |}
       |""".stripMargin
  }

  private def docker(facts: Facts, files: Files): String = {
    def stage(architecture: String, platform: String) = {
      val file = files.full(platform)
      s"""FROM unzip AS $architecture
         |ADD --checksum=sha256:${file.sha256} \\
         |  ${files.url(file)} /tmp/candela.zip
         |""".stripMargin
    }
    s"""# docker build -t ${facts.command} - < Dockerfile
       |# docker run --rm -v "$$PWD:/work" ${facts.command} scene.pbrt --outfile scene.exr
       |
       |FROM debian:stable-slim AS unzip
       |RUN apt-get update && apt-get install -y --no-install-recommends unzip
       |
       |${stage("amd64", "linux-x64")}
       |${stage("arm64", "linux-arm64")}
       |FROM $${TARGETARCH} AS unpacked
       |RUN unzip -q /tmp/candela.zip -d /opt && mv /opt/${facts.folder} /opt/${facts.command}
       |RUN CANDELA_ARCHIVE=make /opt/${facts.command}/bin/${facts.command}
       |
       |FROM debian:stable-slim
       |LABEL org.opencontainers.image.title="${facts.name}" \\
       |  org.opencontainers.image.version="${facts.version}" \\
       |  org.opencontainers.image.licenses="${facts.licence}" \\
       |  org.opencontainers.image.url="${facts.homepage}"
       |COPY --from=unpacked /opt/${facts.command} /opt/${facts.command}
       |ENV JAVA_OPTS=-XX:MaxRAMPercentage=80
       |WORKDIR /work
       |ENTRYPOINT ["/opt/${facts.command}/bin/${facts.command}"]
       |""".stripMargin
  }
}

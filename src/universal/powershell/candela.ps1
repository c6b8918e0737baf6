# Starts Candela as bin\candela.bat does. Ctrl-C ends it without a question, and words reach it as
# they are. Where scripts may not run, `bin` is the folder for PATH; else this one, before `bin`.
#   CANDELA_JAVA  folder of the JDK to use instead
#   JAVA_OPTS     additional JVM options, such as -Xmx4g
$ErrorActionPreference = 'Stop'
$root = Split-Path -Parent (Split-Path -Parent $PSCommandPath)
$lib = Join-Path $root 'lib'
$bundled = Join-Path $root 'runtime'
$windows = $env:OS -eq 'Windows_NT'
$java = if ($windows) { 'bin\java.exe' } else { 'bin/java' }

function Read-Jdk([string] $folder) {
  $release = Join-Path $folder 'release'
  if (-not (Test-Path -LiteralPath (Join-Path $folder $java)) -or
      -not (Test-Path -LiteralPath $release)) { return }
  $text = Get-Content -LiteralPath $release -Raw
  if ($text -match '(?m)^JAVA_VERSION="?(\d+)') {
    [pscustomobject]@{
      Home = $folder
      Major = [int]$Matches[1]
      HasVectors = $text -match 'jdk\.incubator\.vector'
    }
  }
}

$best = $null
if ($env:CANDELA_JAVA) {
  $best = Read-Jdk $env:CANDELA_JAVA
} else {
  $folders = @($bundled)
  if ($env:JAVA_HOME) { $folders += $env:JAVA_HOME }
  $places = if ($windows) {
    foreach ($name in 'Java', 'Eclipse Adoptium', 'Microsoft', 'Amazon Corretto', 'Zulu') {
      Join-Path $env:ProgramFiles $name
    }
    Join-Path $env:USERPROFILE '.jdks'
  } else { '/usr/lib/jvm', (Join-Path $HOME '.jdks') }
  foreach ($place in $places) {
    if (Test-Path -LiteralPath $place) {
      $folders += (Get-ChildItem -LiteralPath $place -Directory).FullName
    }
  }
  foreach ($folder in $folders) {
    $jdk = Read-Jdk $folder
    if ($jdk -and (-not $best -or $jdk.Major -gt $best.Major) -and
        (-not $best -or $best.Home -ne $bundled -or $jdk.HasVectors)) { $best = $jdk }
  }
}
if (-not $best -or $best.Major -lt 17) {
  [Console]::Error.WriteLine('candela: no JDK 17 or newer found.')
  [Console]::Error.WriteLine('candela: Install one, for example from https://adoptium.net, or set CANDELA_JAVA to its folder.')
  exit 2
}

$natives = if (-not $windows) { 'linux-x64' }
  elseif ($env:PROCESSOR_ARCHITECTURE -eq 'ARM64') { 'windows-arm64' } else { 'windows-x64' }
$options = Join-Path $lib $(if ($best.Major -ge 25) { 'options-25' } else { 'options' })
$words = @("@$options", "-Dorg.lwjgl.librarypath=$(Join-Path (Join-Path $lib 'natives') $natives)")
# Since JDK 19, Java maintains the class-data archive itself.
if ($best.Major -ge 19 -and $env:LOCALAPPDATA) {
  $cache = Join-Path $env:LOCALAPPDATA 'candela'
  $null = New-Item -ItemType Directory -Force -Path $cache
  $archive = Join-Path $cache "classes-$($best.Major).jsa"
  $words += '-XX:+AutoCreateSharedArchive', "-XX:SharedArchiveFile=$archive", '-Xlog:cds*=off'
}
$asked = @("$env:JAVA_OPTS" -split '\s+' | Where-Object { $_ })
# Java refuses two collectors: one that is asked for replaces ours.
if ($asked -match '^-XX:\+Use(G1|Serial|Z|Shenandoah|Epsilon)GC$') { $words += '-XX:-UseParallelGC' }
$words += $asked
$words += '-cp', (Join-Path $lib 'candela.jar'), 'candela.cli.Main'
& (Join-Path $best.Home $java) @words @args
exit $LASTEXITCODE

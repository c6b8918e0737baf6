@echo off
rem Starts sbt. Needs a JDK 17 or newer and nothing else: the launcher is fetched once from Maven
rem Central, checked against the sum below, and kept in %LOCALAPPDATA%\candela.
rem   JAVA_HOME          the JDK to use, instead of the java on PATH
rem   SBT_OPTS           further options for sbt's JVM, such as -Xmx4g
rem   SBT_LAUNCHER_REPO  a Maven repository to fetch from, instead of Maven Central
setlocal EnableExtensions
cd /d "%~dp0"
rem The same as in project\build.properties
set "VERSION=1.13.0"
set "SHA256=18d4a733eae2f70fd4d71a46e9da21d2eb7c9bf6ee85a67be9a9800e7c01403e"
set "REPO=https://repo1.maven.org/maven2"
if defined SBT_LAUNCHER_REPO set "REPO=%SBT_LAUNCHER_REPO%"

set "JAVA="
if defined JAVA_HOME set "JAVA=%JAVA_HOME%\bin\java.exe"
if not defined JAVA_HOME for %%J in (java.exe) do set "JAVA=%%~$PATH:J"
if not defined JAVA (
  echo sbt: no java found: JAVA_HOME is not set, and there is no java on PATH. 1>&2
  echo sbt: Install a JDK 17 or newer, for example from https://adoptium.net 1>&2
  exit /b 1
)
if not exist "%JAVA%" (
  echo sbt: there is no "%JAVA%": JAVA_HOME should be the folder of a JDK 17 or newer. 1>&2
  exit /b 1
)
rem A JDK has a file `release`; a java elsewhere, as in the folder of Oracle's installer, has none
set "MAJOR=17"
for %%J in ("%JAVA%") do if exist "%%~dpJ..\release" call :read "%%~dpJ..\release"
if %MAJOR% LSS 17 (
  echo sbt: a JDK 17 or newer is needed, but "%JAVA%" is version %MAJOR%. 1>&2
  echo sbt: Set JAVA_HOME to the folder of a newer one. 1>&2
  exit /b 1
)

set "CACHE=%LOCALAPPDATA%\candela"
if not defined LOCALAPPDATA set "CACHE=%~dp0project\target\home"
set "LAUNCHER=%CACHE%\sbt-launch-%VERSION%.jar"
set "URL=%REPO%/org/scala-sbt/sbt-launch/%VERSION%/sbt-launch-%VERSION%.jar"
"%JAVA%" %SBT_OPTS% project\fetch\Fetch.java keep "%URL%" %SHA256% "%LAUNCHER%"
if errorlevel 1 exit /b 1

rem JDK 24 and later warn about what Scala's lazy values do.
set "QUIET="
if %MAJOR% GEQ 23 set "QUIET=--sun-misc-unsafe-memory-access=allow"
"%JAVA%" -Xms256m -Xmx2g -Xss8m -XX:+UseParallelGC -XX:ReservedCodeCacheSize=256m ^
  --enable-native-access=ALL-UNNAMED %QUIET% -Dfile.encoding=UTF-8 %SBT_OPTS% -jar "%LAUNCHER%" %*
exit /b %ERRORLEVEL%

:read
for /f "usebackq tokens=1,2 delims==" %%K in ("%~1") do if "%%K"=="JAVA_VERSION" call :major %%L
exit /b 0

:major
for /f "delims=.-+ " %%M in ("%~1") do set "MAJOR=%%M"
exit /b 0
